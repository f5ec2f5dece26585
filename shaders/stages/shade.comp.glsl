layout(local_size_x = 8, local_size_y = 8) in;

// One light's reflection by what one sample of each pixel sees.

layout(binding = 0) uniform usampler2D seen;

vec3 color = vec3(0.0);  // X Y Z of exact Fresnel terms

void take_row(uint light, uint row, float weight) { color += weight * color_of_row(light, row); }

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, region_size))) return;
    uint name = texelFetch(seen, ivec2(at), 0).x;
    if (name == 0u) return;
    vec3 direction = sample_direction(at);
    Surface surface = find_surface(name - 1u, direction);
    if (!surface.found) return;
    reflect_light(light, surface, direction);

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
