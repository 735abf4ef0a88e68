#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "studio.glsl"

layout(location = 0) out vec4 outColor;

void main() { outColor = vec4(dither(backdrop(gl_FragCoord.xy), gl_FragCoord.xy), 1.0); }
