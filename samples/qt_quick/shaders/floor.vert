#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) out vec3 outPosition;

void main() {
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    outPosition = vec3(corners[gl_VertexIndex] * 16.0, 0.0).xzy;
    gl_Position = frame.viewProjection * vec4(outPosition, 1.0);
}
