layout(local_size_x = 8, local_size_y = 8) in;

// One light's reflection by what one sample of each pixel sees.

layout(binding = 0) uniform usampler2D seen;
uniform bool directional;
uniform vec3 light_place;         // the position; or, if directional, the unit direction towards it
uniform float reference_squared;  // 0: no falloff
uniform float solid_angle;
uniform float node_last;          // fresnel_nodes − 1

const float short_of_light = 0.9999;
const float largest = 3.4028235e38;

// The light as seen from a point.
struct Seen {
    vec3 direction;
    float reach, weight;
};

Seen look(vec3 from) {
    if (directional) return Seen(light_place, largest, 1.0);
    vec3 way = light_place - from;
    float squared = dot(way, way), distance = sqrt(squared);
    float weight = reference_squared > 0.0 ? reference_squared / squared : 1.0;
    return Seen(way * (1.0 / distance), distance * short_of_light, weight);
}

// The sums of a sample: weights of the material's rows and of white; X Y Z of exact Fresnel terms.
vec3 weights = vec3(0.0);
vec3 color = vec3(0.0);

// An exact Fresnel term lies on the line between two nodes (common/scene/fresnel_table.h).
void add_fresnel(uint base, float u, float weight) {
    float below = min(floor(sqrt(u) * node_last), node_last - 1.0);
    float fraction = (u * (node_last * node_last) - below * below) / (2.0 * below + 1.0);
    uint row = word_of[base + material_first_node] + uint(below);
    color += weight * ((1.0 - fraction) * color_of_row(light, row) + fraction * color_of_row(light, row + 1u));
}

void add_lobes(uint base, Lobes lobes, float weight) {
    uint fresnel = word_of[base + material_fresnel];
    if (fresnel == fresnel_exact) {
        if (lobes.fresnel != 0.0) add_fresnel(base, lobes.cosine, weight * lobes.fresnel);
        lobes.fresnel = 0.0;
    }
    float away = 1.0 - lobes.cosine, squared = away * away;
    float rise = fresnel == fresnel_schlick ? squared * squared * away : 0.0;
    weights += weight * vec3(lobes.diffuse, lobes.specular + lobes.fresnel * (1.0 - rise),
                             lobes.white + lobes.fresnel * rise);
}

void reflect_light(Surface surface, vec3 direction) {
    uint base = object_of[surface.object].material * material_size;
    Seen from_here = look(surface.hit);
    if (!(from_here.weight <= largest)) return;
    uint shading = object_of[surface.object].shading;

    // Ask whether the light is seen, from a point lifted off the surface by what f32 may have got wrong.
    bool lit = shading != 0u || dot(surface.normal, from_here.direction) > 0.0;
    if (lit) {
        vec3 size = abs(surface.hit);
        float lift = max(max(size.x, size.y), max(size.z, length(surface.hit))) * 1e-5;
        lit = is_free(surface.hit + surface.side * lift, from_here.direction, from_here.reach);
    }
    if (lit && shading != 0u) {
        for (uint i = 0u; i < place_count(shading); ++i) {
            Place place = place_of(surface, shading, i);
            Seen there = look(place.position);
            if (!(there.weight <= largest)) continue;
            Angles angles = angles_of(place.normal, place.tangent, there.direction, unit(-place.position), solid_angle);
            add_lobes(base, reflection(base, angles), there.weight * place.weight);
        }
        return;
    }
    if (!lit && word_of[base + material_ambient] == 0u) return;
    Angles angles = angles_of(surface.normal, surface.tangent, from_here.direction, -direction, solid_angle);
    if (!lit) angles.n_dot_l = 0.0;
    add_lobes(base, reflection(base, angles), from_here.weight);
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, region_size))) return;
    uint name = texelFetch(seen, ivec2(at), 0).x;
    if (name == 0u) return;
    vec3 direction = sample_direction(at);
    Surface surface = find_surface(name - 1u, direction);
    if (!surface.found) return;
    reflect_light(surface, direction);

    // Gather it with the samples before, or turn them into colour and begin anew.
    if (weights == vec3(0.0) && color == vec3(0.0)) return;
    uint pixel = at.y * region_size.x + at.x, material = object_of[surface.object].material + 1u;
    if (weights_of[first_weight + pixel].w != material) {
        color += color_of_weights(pixel);
        weights_of[first_weight + pixel] = uvec4(0u, 0u, 0u, material);
    }
    weights_of[first_weight + pixel].xyz = floatBitsToUint(uintBitsToFloat(weights_of[first_weight + pixel].xyz) + weights);
    color_at[pixel].xyz += color;
}
