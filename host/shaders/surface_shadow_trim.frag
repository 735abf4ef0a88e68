// Light falls through what is trimmed away, and through what is translucent.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "material.glsl"
#include "surface_trim.glsl"

layout(location = 0) in vec3 inTrim;

void main() {
    if (suppleTrimmed(trimValue(inTrim), materialData.cutoff)) discard;
}
