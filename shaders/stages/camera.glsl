// The camera of a region of the picture, whose rows count downwards. A sample lies in its pixel where the
// sample pattern says.

uniform vec3 eye;                   // near the origin, where f32 is finest
uniform vec3 corner, across, down;  // direction = corner + x across + y down, x and y in pixels
uniform vec3 forward;               // unit
uniform uvec2 region;               // the pixel of the picture that is the region's first
uniform uvec2 region_size;
uniform vec2 place;  // of the sample in its pixel

vec3 sample_direction(uvec2 pixel) {
    vec2 film = vec2(region + pixel) + place;
    return unit(corner + across * film.x + down * film.y);
}

// A point in the clip space of this sample: depth is `near` by distance, so that f32 spends itself
// evenly over all distances.
uniform mat4x3 to_clip;  // rows x, y and w of a point as seen from the eye
const float near = 1e-6;

vec4 clip_position(vec3 point) {
    vec3 xyw = to_clip * vec4(point - eye, 1.0);
    return vec4(xyw.xy, near, xyw.z);
}
