#version 460

layout(location = 0) out vec2 outAt;

void main() {
    outAt = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(outAt, 1.0, 1.0);
}
