#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "surface_input.glsl"
#include "material.glsl"
#include "surface_attributes.glsl"

layout(location = 0) out vec3 outTrim;

void main() {
    outTrim = surfaceTrim();
    gl_Position = frame.lights[push.light].shadow * vec4(surfacePosition(surfaceWord()), 1.0);
}
