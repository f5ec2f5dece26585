// What a surface reflects of a light towards the eye, before any spectrum: the weights of its lobes.

uniform float node_last;  // fresnel_nodes − 1

// The sums of a sample: weights of the material's rows and of white. What else a stage keeps of a row it
// sees to in take_row.
vec3 weights = vec3(0.0);
void take_row(uint light, uint row, float weight);

// An exact Fresnel term lies on the line between two nodes.
void add_fresnel(uint light, uint base, float u, float weight) {
    float below = node_below(u, node_last);
    float fraction = node_share(u, below, node_last);
    uint row = word_of[base + material_first_node] + uint(below);
    take_row(light, row, weight * (1.0 - fraction));
    take_row(light, row + 1u, weight * fraction);
}

// A lobe whose geometry depends on wavelength is known at lobe_wavelengths (common/scene/rough_lobe_table.h). C_S is the same
// at all cosines: that at 1.
void add_rough(uint light, uint base, Lobes lobes, float weight) {
    float last = float(lobe_cosines - 1);
    float u = word_of[base + material_fresnel] == uint(fresnel_none) ? 1.0 : lobes.cosine;
    float below = node_below(u, last);
    float fraction = node_share(u, below, last);
    uint row = word_of[base + material_first_lobe] + uint(below) * uint(lobe_wavelengths);
    for (int w = 0; w < lobe_wavelengths; ++w) {
        float k = 6283.1853 / lobe_nm[w];
        Ripples r = ripples_of(lobes.height, lobes.spread, k * k, 5.0, 24.0, 1.0);
        float sum = 0.0;
        for (float i = 0.0; i < r.count; ++i) sum += ripple(r, k * k, i);
        take_row(light, row + uint(w), weight * lobes.fresnel * sum * (1.0 - fraction));
        take_row(light, row + uint(lobe_wavelengths + w), weight * lobes.fresnel * sum * fraction);
    }
}

void add_lobes(uint light, uint base, Lobes lobes, float weight) {
    lobes = fold_fresnel(lobes, int(word_of[base + material_fresnel]));
    if (lobes.fresnel != 0.0 && has_rough && lobes.height >= 0.0)
        add_rough(light, base, lobes, weight);
    else if (lobes.fresnel != 0.0)
        add_fresnel(light, base, lobes.cosine, weight * lobes.fresnel);
    weights += weight * vec3(lobes.diffuse, lobes.specular, lobes.white);
}

// A light's lobes at a place of a triangle.
Lobes place_lobes(uint light, uint triangle, uint object, vec3 side, uint shading, uint base, uint index) {
    Place place = place_of(triangle_of(triangle, object), side, int(shading), float(index));
    Incident there = incident(light, place.position);
    Lobes lobes = reflection(base, angles_of(place.normal, place.tangent, there.direction, unit(eye - place.position),
                                             solid_angle_of(light), needs_azimuth, needs_tangent));
    float weight = is_finite(there) ? there.weight : 0.0;
    lobes.diffuse *= weight;
    lobes.specular *= weight;
    lobes.white *= weight;
    lobes.fresnel *= weight;
    return lobes;
}

// The same for all samples of a picture: places.comp.glsl has evaluated them, where they fit into memory.
layout(std430, binding = 3) buffer Places { vec4 place_of_light[]; };  // two each: lobes; their cosine, height, spread
uniform uint places_of_triangle;  // 0: there are none
uniform uint triangle_count;

uint place_index(uint light, uint triangle, uint index) {
    return 2u * ((light * triangle_count + triangle) * places_of_triangle + index);
}

Lobes lobes_at_place(uint light, Surface surface, uint shading, uint base, uint index) {
    if (places_of_triangle == 0u)
        return place_lobes(light, surface.triangle, surface.object, surface.side, shading, base, index);
    uint at = place_index(light, surface.triangle, index);
    vec4 four = place_of_light[at];
    vec4 more = place_of_light[at + 1u];
    return Lobes(four.x, four.y, four.z, four.w, more.x, more.y, more.z);
}

void reflect_light(uint light, Surface surface, vec3 direction) {
    uint base = object_of[surface.object].material * material_size;
    Incident from_here = incident(light, surface.hit);
    if (!is_finite(from_here)) return;
    uint shading = object_of[surface.object].shading;

    // Ask whether the light is seen, from a point lifted off the surface by what f32 may have got wrong.
    bool lit = shading != 0u || (from_here.weight > 0.0 && dot(surface.normal, from_here.direction) > 0.0);
    if (lit) {
        float lift = lift_off(max(abs(surface.hit), abs(eye)), length(surface.hit - eye));
        lit = is_free(surface.hit + surface.side * lift, from_here.direction, lift, from_here.reach);
    }
    if (lit && shading != 0u) {
        for (uint i = 0u; i < uint(place_count(int(shading))); ++i)
            add_lobes(light, base, lobes_at_place(light, surface, shading, base, i),
                      place_weight(int(shading), int(i), surface.uv.x, surface.uv.y));
        return;
    }
    if (!lit && word_of[base + material_ambient] == 0u) return;
    Angles angles = angles_of(surface.normal, surface.tangent, from_here.direction, -direction, solid_angle_of(light),
                              needs_azimuth, needs_tangent);
    if (!lit) angles.n_dot_l = 0.0;
    add_lobes(light, base, reflection(base, angles), from_here.weight);
}
