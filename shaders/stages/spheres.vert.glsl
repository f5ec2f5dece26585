// The box around a sphere, an instance each: 12 triangles.

layout(std430, binding = 3) readonly buffer Boxes { vec4 box_of[]; };  // rows of the way from the unit box
flat out uint sphere;

void main() {
    // Three bits a corner, of a strip that covers the box.
    const uint corners[36] = uint[36](0u, 1u, 2u, 2u, 1u, 3u, 4u, 6u, 5u, 5u, 6u, 7u, 0u, 2u, 4u, 4u, 2u, 6u,
                                      1u, 5u, 3u, 3u, 5u, 7u, 0u, 4u, 1u, 1u, 4u, 5u, 2u, 3u, 6u, 6u, 3u, 7u);
    uint corner = corners[gl_VertexID];
    vec4 at = vec4((corner & 1u) != 0u ? 1.0 : -1.0, (corner & 2u) != 0u ? 1.0 : -1.0,
                   (corner & 4u) != 0u ? 1.0 : -1.0, 1.0);
    uint row = 4u * uint(gl_InstanceID);
    gl_Position = clip_position(vec3(dot(box_of[row], at), dot(box_of[row + 1u], at), dot(box_of[row + 2u], at)));
    sphere = floatBitsToUint(box_of[row + 3u].x);
}
