#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 1
#define SUPPLE_SURFACE_LOD
#include "supple_surface.glsl"
#include "../../../host/shaders/view_draws.h"
#include "scene.glsl"
#include "tint.glsl"

layout(set = 1, binding = 6, std430) readonly buffer Drawn { ViewDraw drawn[]; };
layout(set = 1, binding = 7, std430) readonly buffer UserData { vec4 of[]; } userData[3]; // by kind: suppleSetUserData

layout(push_constant) uniform Push {
    uint firstDraw; // of the call
    uint paint;     // 1: capacities as colors
    uint sun;       // 1: into the sun's map
};

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec3 outColor;

// From blue, coarse, to red, fine.
vec3 capacityColor(uint capacity) {
    float t = clamp(log2(float(capacity) + 1.0) / 6.0 - 0.12, 0.0, 1.0);
    return clamp(vec3(2.2 * t - 0.5, 1.0 - abs(2.6 * t - 1.1), 1.25 - 2.4 * t), 0.04, 1.0);
}

void main() {
    ViewDraw own = drawn[firstDraw + gl_DrawID];
    SuppleDraw draw = SuppleDraw(own.index, own.verticesPerInstance, own.samplesPerPatch, own.previousWords);
    SuppleVertex at = suppleLodVertex(draw, gl_InstanceIndex, gl_VertexIndex);
    outPosition = supplePosition(at);
    if (sun != 0u) {
        outNormal = outColor = vec3(0.0);
        gl_Position = scene.sunViewProjection * vec4(outPosition, 1.0);
        return;
    }
    outNormal = suppleNormal(at);
    outColor = paint != 0u ? capacityColor(own.capacity)
                          : tinted(suppleColor(at).rgb, userData[own.surface].of[at.slot].xy);
    gl_Position = scene.viewProjection * vec4(outPosition, 1.0);
}
