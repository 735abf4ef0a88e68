#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"

layout(location = 0) out vec4 outColor;

void main() { outColor = shown(background(gl_FragCoord.xy)); }
