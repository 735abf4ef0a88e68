#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec4 outNow;
layout(location = 2) out vec4 outBefore;

void main() {
    vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0;
    outPosition = vec3(14.0 * corner.x, 0.0, -14.0 * corner.y);
    outNow = frame.viewProjection * vec4(outPosition, 1.0);
    outBefore = frame.previousViewProjection * vec4(outPosition, 1.0);
    gl_Position = frame.jitteredViewProjection * vec4(outPosition, 1.0);
}
