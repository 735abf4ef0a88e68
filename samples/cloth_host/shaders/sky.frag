#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"

layout(location = 0) out vec4 outColor;

void main() { outColor = developed(sky(gl_FragCoord.xy)); }
