layout(local_size_x = 8, local_size_y = 8) in;

// Adds four wavelengths to X Y Z, E[4.2-1].

layout(binding = 1) uniform sampler2D values;
layout(std430, binding = 8) readonly buffer Observer { vec4 observer_of[]; };
layout(std430, binding = 13) buffer Colors { vec4 color_at[]; };
uniform uint value_size, group;

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, region_size))) return;
    vec4 four = texelFetch(values, ivec2(at), 0);
    color_at[at.y * region_size.x + at.x].xyz +=
        vec3(dot(four, observer_of[group]), dot(four, observer_of[value_size + group]),
             dot(four, observer_of[2u * value_size + group]));
}
