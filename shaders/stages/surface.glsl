// What a sample sees: found again from its ray and the name of the primitive that the rasteriser left.

layout(std430, binding = 9) readonly buffer Normals { float normal_of[]; };    // of vertices; any length
layout(std430, binding = 10) readonly buffer Tangents { float tangent_of[]; }; // of vertices, where any model asks
layout(std430, binding = 11) readonly buffer Owners { uint owner_of[]; };      // objects of triangles
uniform bool has_tangents;

vec3 normal_at(uint vertex) {
    return vec3(normal_of[3u * vertex], normal_of[3u * vertex + 1u], normal_of[3u * vertex + 2u]);
}

// From the mesh's UVs, else the object's x axis.
vec3 tangent_at(uint vertex, uint object) {
    vec3 own = vec3(0.0);
    if (has_tangents)
        own = vec3(tangent_of[3u * vertex], tangent_of[3u * vertex + 1u], tangent_of[3u * vertex + 2u]);
    return own == vec3(0.0) ? object_of[object].x_axis.xyz : own;
}

struct Surface {
    uint object, triangle;
    vec3 hit;       // in camera space
    vec3 side;      // the geometry's normal, unit, towards the eye
    vec3 normal;    // that of shading, on the same side
    vec3 tangent;   // of any length
    vec2 uv;        // barycentric, of the second and third corner
    bool found;
};

void find_on_sphere(vec3 direction, inout Surface surface) {
    SphereRay ray = sphere_ray(surface.object, eye, direction);
    float chord = max(ray.half_chord, 0.0);
    float along = ray.at - chord > 0.0 ? -chord : chord;
    surface.found = ray.at + along > 0.0;
    surface.hit = eye + direction * (ray.at + along);
    vec3 local = ray.nearest + along * ray.direction;
    vec4 row0 = object_of[surface.object].to_unit[0];
    vec4 row1 = object_of[surface.object].to_unit[1];
    vec4 row2 = object_of[surface.object].to_unit[2];
    surface.side = unit(local.x * row0.xyz + local.y * row1.xyz + local.z * row2.xyz);
    surface.normal = surface.side;
    surface.tangent = object_of[surface.object].x_axis.xyz;
}

void find_on_triangle(vec3 direction, inout Surface surface) {
    uint first = corner_of[3u * surface.triangle], second = corner_of[3u * surface.triangle + 1u];
    uint third = corner_of[3u * surface.triangle + 2u];
    vec3 a = position_at(first), b = position_at(second) - a, c = position_at(third) - a;
    vec3 s = eye - a;
    vec3 p = cross(direction, c), q = cross(s, b);
    float scale = 1.0 / dot(b, p);
    surface.uv = vec2(dot(s, p), dot(direction, q)) * scale;
    float at = dot(c, q) * scale;
    surface.found = true;
    surface.hit = eye + direction * at;
    // A sample that the rasteriser counts to the triangle may miss it by a little: back onto it. Seen on edge
    // it has no place that f32 could tell: take the middle.
    if (!(at > 0.0 && at < 1e30)) surface.uv = vec2(1.0 / 3.0);
    if (!(at > 0.0 && at < 1e30) || any(lessThan(surface.uv, vec2(0.0))) || surface.uv.x + surface.uv.y > 1.0) {
        surface.uv = max(surface.uv, vec2(0.0));
        surface.uv /= max(surface.uv.x + surface.uv.y, 1.0);
        surface.hit = a + surface.uv.x * b + surface.uv.y * c;
    }
    surface.side = unit(cross(b, c));
    surface.normal = surface.side;
    float w = 1.0 - surface.uv.x - surface.uv.y;
    if (object_of[surface.object].has_normals != 0u)
        surface.normal =
            unit(w * normal_at(first) + surface.uv.x * normal_at(second) + surface.uv.y * normal_at(third));
    surface.tangent = w * tangent_at(first, surface.object) + surface.uv.x * tangent_at(second, surface.object) +
                      surface.uv.y * tangent_at(third, surface.object);
}

Surface find_surface(uint name, vec3 direction) {
    Surface surface;
    surface.triangle = name;
    surface.uv = vec2(0.0);
    if (name >= first_sphere) {
        surface.object = name & ~first_sphere;
        find_on_sphere(direction, surface);
    } else {
        surface.object = owner_of[name];
        find_on_triangle(direction, surface);
    }
    if (dot(surface.side, direction) > 0.0) surface.side = -surface.side;
    if (surface.normal == vec3(0.0)) surface.normal = surface.side;
    if (dot(surface.normal, surface.side) < 0.0) surface.normal = -surface.normal;
    surface.tangent = steady_tangent(surface.normal, surface.tangent, object_of[surface.object].z_axis.xyz);
    return surface;
}

Triangle triangle_of(uint triangle, uint object) {
    Triangle at;
    bool has_normals = object_of[object].has_normals != 0u;
    for (uint i = 0u; i < 3u; ++i) {
        uint vertex = corner_of[3u * triangle + i];
        at.position[i] = position_at(vertex);
        at.normal[i] = has_normals ? normal_at(vertex) : vec3(0.0);
        at.tangent[i] = tangent_at(vertex, object);
    }
    at.across = object_of[object].z_axis.xyz;
    return at;
}
