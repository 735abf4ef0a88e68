#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(location = 0) out vec4 outColor;

void main() { outColor = onScreen(wall(gl_FragCoord.xy)); }
