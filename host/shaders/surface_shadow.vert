#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "surface_input.glsl"

void main() { gl_Position = frame.lights[push.light].shadow * vec4(surfacePosition(surfaceWord()), 1.0); }
