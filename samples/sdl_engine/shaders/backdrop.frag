#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(location = 0) out vec4 outColor;
layout(location = 1) out vec2 outMotion;

void main() {
    outColor = vec4(background(gl_FragCoord.xy), 1.0);
    outMotion = vec2(0.0);
}
