// What a pixel has received from one light: the weights of its newest material, summed over the samples
// that saw it, and the X Y Z of those before. So the spectral work is done once for a pixel inside a
// surface, and once for each material at its edges.

layout(std430, binding = 12) buffer Weights { uvec4 weights_of[]; };  // bits of diffuse, specular, white; 1 + material
layout(std430, binding = 13) buffer Colors { vec4 color_at[]; };
uniform uint light;
uniform uint first_weight;  // of the light

vec3 color_of_weights(uint pixel) {
    uvec4 bits = weights_of[first_weight + pixel];
    if (bits.w == 0u) return vec3(0.0);
    uint base = (bits.w - 1u) * material_size;
    return color_of_lobes(light, word_of[base + material_diffuse], word_of[base + material_specular],
                          uintBitsToFloat(bits.xyz));
}
