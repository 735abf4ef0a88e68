#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(location = 0) out vec3 outPosition;

void main() {
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    vec2 corner = corners[gl_VertexIndex];
    outPosition = vec3(corner.x, 0.0, corner.y) * 60.0;
    gl_Position = scene.viewProjection * vec4(outPosition, 1.0);
}
