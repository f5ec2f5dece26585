// What a surface reflects of a light towards the eye, before any spectrum: the weights of its lobes.

struct Light {
    vec4 place;  // the position; or the unit direction towards it, and then w is not 0
    vec4 more;   // squared reference distance, 0: no falloff; solid angle
};
layout(std430, binding = 15) readonly buffer Lights { Light light_of[]; };
uniform float node_last;  // fresnel_nodes − 1

const float short_of_light = 0.9999;
const float largest = 3.4028235e38;

// The light as seen from a point.
struct Seen {
    vec3 direction;
    float reach, weight;
};

Seen look(uint light, vec3 from) {
    Light own = light_of[light];
    if (own.place.w != 0.0) return Seen(own.place.xyz, largest, 1.0);
    vec3 way = own.place.xyz - from;
    float squared = dot(way, way), distance = sqrt(squared);
    float weight = own.more.x > 0.0 ? own.more.x / squared : 1.0;
    return Seen(way * (1.0 / distance), distance * short_of_light, weight);
}

// The sums of a sample: weights of the material's rows and of white. What else a stage keeps of a row it
// sees to in take_row.
vec3 weights = vec3(0.0);
void take_row(uint light, uint row, float weight);

// An exact Fresnel term lies on the line between two nodes (common/scene/fresnel_table.h).
void add_fresnel(uint light, uint base, float u, float weight) {
    float below = min(floor(sqrt(u) * node_last), node_last - 1.0);
    float fraction = (u * (node_last * node_last) - below * below) / (2.0 * below + 1.0);
    uint row = word_of[base + material_first_node] + uint(below);
    take_row(light, row, weight * (1.0 - fraction));
    take_row(light, row + 1u, weight * fraction);
}

void add_lobes(uint light, uint base, Lobes lobes, float weight) {
    uint fresnel = word_of[base + material_fresnel];
    if (fresnel == fresnel_exact) {
        if (lobes.fresnel != 0.0) add_fresnel(light, base, lobes.cosine, weight * lobes.fresnel);
        lobes.fresnel = 0.0;
    }
    float away = 1.0 - lobes.cosine, squared = away * away;
    float rise = fresnel == fresnel_schlick ? squared * squared * away : 0.0;
    weights += weight * vec3(lobes.diffuse, lobes.specular + lobes.fresnel * (1.0 - rise),
                             lobes.white + lobes.fresnel * rise);
}

// A light's lobes at a place of a triangle.
Lobes place_lobes(uint light, uint triangle, uint object, vec3 side, uint shading, uint base, uint index) {
    Place place = place_of(triangle, object, side, shading, index);
    Seen there = look(light, place.position);
    Lobes lobes = reflection(base, angles_of(place.normal, place.tangent, there.direction, unit(eye - place.position),
                                             light_of[light].more.y));
    float weight = there.weight <= largest ? there.weight : 0.0;
    lobes.diffuse *= weight;
    lobes.specular *= weight;
    lobes.white *= weight;
    lobes.fresnel *= weight;
    return lobes;
}

// The same for all samples of a picture: places.comp.glsl has evaluated them, where they fit into memory.
layout(std430, binding = 3) buffer Places { vec4 place_of_light[]; };  // two each: lobes; their cosine
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
    return Lobes(four.x, four.y, four.z, four.w, place_of_light[at + 1u].x);
}

void reflect_light(uint light, Surface surface, vec3 direction) {
    uint base = object_of[surface.object].material * material_size;
    Seen from_here = look(light, surface.hit);
    if (!(from_here.weight <= largest)) return;
    uint shading = object_of[surface.object].shading;

    // Ask whether the light is seen, from a point lifted off the surface by what f32 may have got wrong.
    bool lit = shading != 0u || dot(surface.normal, from_here.direction) > 0.0;
    if (lit) {
        vec3 size = max(abs(surface.hit), abs(eye));
        float lift = max(max(size.x, size.y), max(size.z, length(surface.hit - eye))) * 1e-5;
        lit = is_free(surface.hit + surface.side * lift, from_here.direction, lift, from_here.reach);
    }
    if (lit && shading != 0u) {
        for (uint i = 0u; i < place_count(shading); ++i)
            add_lobes(light, base, lobes_at_place(light, surface, shading, base, i),
                      place_weight(shading, surface.uv, i));
        return;
    }
    if (!lit && word_of[base + material_ambient] == 0u) return;
    Angles angles = angles_of(surface.normal, surface.tangent, from_here.direction, -direction, light_of[light].more.y);
    if (!lit) angles.n_dot_l = 0.0;
    add_lobes(light, base, reflection(base, angles), from_here.weight);
}
