#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(location = 0) out vec3 outPosition;

void main() {
    vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0;
    outPosition = vec3(corner.x, 0.0, corner.y) * 400.0;
    gl_Position = scene.viewProjection * vec4(outPosition, 1.0);
}
