layout(local_size_x = 64) in;

// Evaluates one light's reflection at the places of all triangles whose shading interpolates between them:
// once a picture, and not for each sample that sees one.

uniform uint light;

void take_row(uint light, uint row, float weight) {}

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= triangle_count) return;
    uint object = owner_of[triangle], shading = object_of[object].shading;
    if (shading == 0u) return;
    vec3 a = position_at(corner_of[3u * triangle]);
    vec3 side = unit(cross(position_at(corner_of[3u * triangle + 1u]) - a,
                           position_at(corner_of[3u * triangle + 2u]) - a));
    if (dot(side, a - eye) > 0.0) side = -side;
    uint base = object_of[object].material * material_size;
    for (uint i = 0u; i < uint(place_count(int(shading))); ++i) {
        Lobes lobes = place_lobes(light, triangle, object, side, shading, base, i);
        uint at = place_index(light, triangle, i);
        place_of_light[at] = vec4(lobes.diffuse, lobes.specular, lobes.white, lobes.fresnel);
        place_of_light[at + 1u] = vec4(lobes.cosine, lobes.height, lobes.spread, 0.0);
    }
}
