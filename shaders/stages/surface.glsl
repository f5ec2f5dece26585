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

// A place of a triangle at which CONSTANT, GOURAUD and QUADRATIC evaluate the model, as
// server/cpu/triangle_places.h has them: the centroid; the three corners; the corners and the middles of the
// edges 01, 02 and 12.
struct Place {
    vec3 position, normal, tangent;
};

const uint constant_shading = 1u, gouraud_shading = 2u, quadratic_shading = 3u;

uint place_count(uint shading) {
    return shading == constant_shading ? 1u : shading == gouraud_shading ? 3u : 6u;
}

// What a point of the triangle sees of a place; E[2.3-1] with E[2.3-2] for QUADRATIC.
float place_weight(uint shading, vec2 uv, uint index) {
    float part[3] = float[3](1.0 - uv.x - uv.y, uv.x, uv.y);
    if (shading == constant_shading) return 1.0;
    if (index < 3u)
        return shading == gouraud_shading ? part[index] : part[index] * (2.0 * part[index] - 1.0);
    return 4.0 * part[index == 5u ? 1u : 0u] * part[index == 3u ? 1u : 2u];
}

// `side` is the triangle's normal towards the eye.
Place place_of(uint triangle, uint object, vec3 side, uint shading, uint index) {
    uint corner[3] = uint[3](corner_of[3u * triangle], corner_of[3u * triangle + 1u], corner_of[3u * triangle + 2u]);
    bool has_normals = object_of[object].has_normals != 0u;
    Place place;
    place.normal = side;
    if (shading == constant_shading) {
        place.position = (position_at(corner[0]) + position_at(corner[1]) + position_at(corner[2])) / 3.0;
        place.tangent =
            (tangent_at(corner[0], object) + tangent_at(corner[1], object) + tangent_at(corner[2], object)) / 3.0;
    } else if (index < 3u) {
        place.position = position_at(corner[index]);
        if (has_normals) place.normal = unit(normal_at(corner[index]));
        place.tangent = tangent_at(corner[index], object);
    } else {
        uint i = index == 5u ? 1u : 0u, j = index == 3u ? 1u : 2u;
        place.position = 0.5 * (position_at(corner[i]) + position_at(corner[j]));
        // Of unit normals, so that a long one does not outweigh its neighbour.
        if (has_normals) place.normal = unit(unit(normal_at(corner[i])) + unit(normal_at(corner[j])));
        place.tangent = 0.5 * (tangent_at(corner[i], object) + tangent_at(corner[j], object));
    }
    if (place.normal == vec3(0.0)) place.normal = side;
    if (dot(place.normal, side) < 0.0) place.normal = -place.normal;
    place.tangent = steady_tangent(place.normal, place.tangent, object_of[object].z_axis.xyz);
    return place;
}
