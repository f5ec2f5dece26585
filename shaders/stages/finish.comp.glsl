layout(local_size_x = 8, local_size_y = 8) in;

// Turns what is left of a light's weights into colour, and forgets them.
void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, region_size))) return;
    uint pixel = at.y * region_size.x + at.x;
    color_at[pixel].xyz += color_of_weights(pixel);
    weights_of[first_weight + pixel] = uvec4(0u);
}
