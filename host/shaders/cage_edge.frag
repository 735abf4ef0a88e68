#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lines.glsl"

layout(location = 0) noperspective in float inAcross;
layout(location = 0) out vec4 outColor;

void main() {
    float coverage = lineCoverage(abs(inAcross), 0.75 * frame.pixelScale);
    outColor = vec4(push.lineColor.rgb, push.lineColor.a * coverage);
}
