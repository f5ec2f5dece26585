// The scene's objects as the GPU holds them, in camera space.

const uint first_sphere = 0x80000000u;  // in the names of primitives; triangles count from 0

struct Object {
    vec4 to_unit[3];  // rows: into the space of the unit sphere, for a sphere
    vec4 x_axis;      // the object's, in camera space
    vec4 z_axis;
    uint material;
    uint shading;      // v1::Shading
    uint has_normals;
};

layout(std430, binding = 0) readonly buffer Positions { float position_of[]; };
layout(std430, binding = 1) readonly buffer Corners { uint corner_of[]; };
layout(std430, binding = 2) readonly buffer Objects { Object object_of[]; };

vec3 position_at(uint vertex) {
    return vec3(position_of[3u * vertex], position_of[3u * vertex + 1u], position_of[3u * vertex + 2u]);
}

// A ray from `origin` in an object's space of the unit sphere, and where it is nearest to the middle:
// what lies between there and the surface is small, so f32 is fine however far the ray comes from.
struct SphereRay {
    vec3 direction, nearest;  // the direction not unit: lengths along the ray are those of camera space
    float at;                 // of `nearest`, along the ray
    float half_chord;         // negative: it misses
};

SphereRay sphere_ray(uint object, vec3 origin, vec3 direction) {
    vec4 row0 = object_of[object].to_unit[0];
    vec4 row1 = object_of[object].to_unit[1];
    vec4 row2 = object_of[object].to_unit[2];
    vec3 from = vec3(dot(row0, vec4(origin, 1.0)), dot(row1, vec4(origin, 1.0)), dot(row2, vec4(origin, 1.0)));
    SphereRay ray;
    ray.direction = vec3(dot(row0.xyz, direction), dot(row1.xyz, direction), dot(row2.xyz, direction));
    float squared = dot(ray.direction, ray.direction);
    ray.at = -dot(from, ray.direction) / squared;
    ray.nearest = from + ray.at * ray.direction;
    float inside = 1.0 - dot(ray.nearest, ray.nearest);
    ray.half_chord = inside >= 0.0 ? sqrt(inside / squared) : -1.0;
    return ray;
}
