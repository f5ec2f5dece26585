void main() {
    gl_Position = clip_position(position_at(uint(gl_VertexID)));
}
