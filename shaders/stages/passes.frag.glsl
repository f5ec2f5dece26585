// Four wavelengths of a light's reflection, as the source's hardware had it: everything is drawn and
// evaluated anew for the next four, and for the next light, since llvmpipe cuts long loops short. PRIMITIVE is the name of what is drawn.

layout(binding = 0) uniform usampler2D seen;
layout(location = 0) out vec4 values;
layout(std430, binding = 12) readonly buffer LightValues { vec4 light_value_of[]; };
uniform uint light;
uniform uint group;  // of four wavelengths

vec4 row_values(uint row) { return value_of[row * row_stride + group]; }

vec4 fresnel = vec4(0.0);
void take_row(uint light, uint row, float weight) { fresnel += weight * row_values(row); }

void main() {
    uint name = PRIMITIVE;
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (texelFetch(seen, at, 0).x != name + 1u) discard;
    vec3 direction = sample_direction(uvec2(at));
    Surface surface = find_surface(name, direction);
    values = vec4(0.0);
    if (!surface.found) return;
    uint base = object_of[surface.object].material * material_size;
    reflect_light(light, surface, direction);
    values = light_value_of[light * value_size + group] *
             (weights.x * row_values(word_of[base + material_diffuse]) +
              weights.y * row_values(word_of[base + material_specular]) + weights.z + fresnel);
}
