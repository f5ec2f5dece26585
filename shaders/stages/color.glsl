// Light that comes straight from a surface to the eye, in X Y Z. Every method is the same sum here: over
// the values i that it carries, sensor_i Σ weight value_i, where a value belongs to a row of the scene and,
// for some methods, to a light (server/methods/direct_tables.h).

layout(std430, binding = 7) readonly buffer Values { vec4 value_of[]; };
layout(std430, binding = 8) readonly buffer Sensors { vec4 sensor_of[]; };
uniform uint value_size;    // of a vector, in vec4s
uniform uint row_stride;    // from a row's vector to the next row's
uniform uint light_stride;  // from a light's vector to the next light's
uniform uint sensor_stride; // from a light's three to the next light's; 0 where all share them

vec3 color_of(vec4 carried, uint sensor) {
    return vec3(dot(carried, sensor_of[sensor]), dot(carried, sensor_of[sensor + value_size]),
                dot(carried, sensor_of[sensor + 2u * value_size]));
}

vec3 color_of_row(uint light, uint row) {
    uint value = row * row_stride + light * light_stride, sensor = light * sensor_stride;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < value_size; ++i) sum += color_of(value_of[value + i], sensor + i);
    return sum;
}

// What a light's lobes on a material are worth: `weights` of its diffuse and specular rows, and of white.
vec3 color_of_lobes(uint light, uint diffuse, uint specular, vec3 weights) {
    uint own = light * light_stride, sensor = light * sensor_stride;
    uint d = diffuse * row_stride + own, s = specular * row_stride + own;
    vec3 sum = vec3(0.0);
    if (weights.y == 0.0 && weights.z == 0.0) {
        for (uint i = 0u; i < value_size; ++i) sum += color_of(value_of[d + i], sensor + i);
        return weights.x * sum;
    }
    for (uint i = 0u; i < value_size; ++i)
        sum += color_of(weights.x * value_of[d + i] + weights.y * value_of[s + i] + weights.z * value_of[own + i],
                        sensor + i);
    return sum;
}
