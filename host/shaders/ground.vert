// The floor: a square that takes every shadow. All round it the backdrop has the same color.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "ground.glsl"

layout(location = 0) out vec3 outPosition;

void main() {
    vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0;
    vec2 at = frame.target.xz + corner * frame.target.w * kFarthestShadow;
    outPosition = vec3(at.x, frame.ground.x, at.y);
    gl_Position = frame.viewProjection * vec4(outPosition, 1.0);
}
