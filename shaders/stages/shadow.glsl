// Whether a light is seen: through the hierarchy of boxes that Embree built, so that shadows are those of
// the CPU backend. Nodes lie in the order of a walk that enters every box; who misses one goes on behind
// its part of the walk, so there is no stack.

// Of each node: bits of x y z; then what it holds, 0 for boxes, else 1 + first · 8 + count of primitives.
layout(std430, binding = 4) readonly buffer Lows { uvec4 low_of[]; };
// Bits of x y z; then where the walk goes on behind its part.
layout(std430, binding = 5) readonly buffer Highs { uvec4 high_of[]; };
layout(std430, binding = 6) readonly buffer Primitives { uint primitive_of[]; };
uniform uint node_count;

bool meets_triangle(uint triangle, vec3 origin, vec3 direction, float skipped, float reach) {
    vec3 a = position_at(corner_of[3u * triangle]);
    vec3 b = position_at(corner_of[3u * triangle + 1u]) - a;
    vec3 c = position_at(corner_of[3u * triangle + 2u]) - a;
    // T. Möller and B. Trumbore, Fast, minimum storage ray/triangle intersection (1997).
    vec3 p = cross(direction, c);
    float scale = 1.0 / dot(b, p);
    vec3 s = origin - a;
    float u = dot(s, p) * scale;
    vec3 q = cross(s, b);
    float v = dot(direction, q) * scale;
    float at = dot(c, q) * scale;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && at > skipped && at < reach;
}

bool meets(uint primitive, vec3 origin, vec3 direction, float skipped, float reach) {
    if (primitive < first_sphere) return meets_triangle(primitive, origin, direction, skipped, reach);
    SphereRay ray = sphere_ray(primitive & ~first_sphere, origin, direction);
    float near_side = ray.at - ray.half_chord, far_side = ray.at + ray.half_chord;
    return ray.half_chord >= 0.0 &&
           ((near_side > skipped && near_side < reach) || (far_side > skipped && far_side < reach));
}

// The segment origin + t direction, skipped < t < reach, is free. What the rasteriser calls visible on an edge
// may lie behind the neighbouring surface by what f32 gets wrong: `skipped` is as much.
bool is_free(vec3 origin, vec3 direction, float skipped, float reach) {
    vec3 steady = mix(direction, vec3(1e-18), lessThan(abs(direction), vec3(1e-18)));
    vec3 inverse = 1.0 / steady;
    uint at = 0u;
    while (at < node_count) {
        uvec4 low = low_of[at], high = high_of[at];
        vec3 first = (uintBitsToFloat(low.xyz) - origin) * inverse;
        vec3 second = (uintBitsToFloat(high.xyz) - origin) * inverse;
        vec3 enter = min(first, second), leave = max(first, second);
        float from = max(max(enter.x, enter.y), max(enter.z, 0.0));
        float to = min(min(leave.x, leave.y), min(leave.z, reach));
        if (from > to * 1.000001) {
            at = high.w;
            continue;
        }
        if (low.w != 0u) {
            uint begin = (low.w - 1u) >> 3, count = (low.w - 1u) & 7u;
            for (uint i = begin; i < begin + count; ++i)
                if (meets(primitive_of[i], origin, direction, skipped, reach)) return false;
        }
        ++at;
    }
    return true;
}
