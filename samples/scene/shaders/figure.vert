#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 1
#define SUPPLE_SURFACE_LOD
#include "supple_surface.glsl"
#include "../../../host/shaders/view_draws.h"
#include "figure.glsl"
#include "scene.glsl"

layout(set = 1, binding = 6, std430) readonly buffer Drawn { ViewDraw drawn[]; };

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec3 outColor;
layout(location = 3) out vec2 outUv;
layout(location = 4) flat out uvec3 outDraw; // figure, material, capacity

void main() {
    ViewDraw own = drawn[push.first + gl_DrawID];
    SuppleDraw draw = SuppleDraw(own.index, own.verticesPerInstance, own.samplesPerPatch, own.previousWords);
    SuppleVertex at = suppleLodVertex(draw, gl_InstanceIndex, gl_VertexIndex);
    outPosition = supplePosition(at);
    if (push.sun != 0u) {
        outNormal = outColor = vec3(0.0);
        outUv = vec2(0.0);
        outDraw = uvec3(0u);
        gl_Position = scene.sunViewProjection * vec4(outPosition, 1.0);
        return;
    }
    Look look = looks[own.surface];
    outNormal = suppleNormal(at);
    outColor = suppleColor(at).rgb;
    outUv = suppleUv(at);
    outDraw = uvec3(own.surface, min(look.firstMaterial + min(own.material, 1000u), look.lastMaterial), own.capacity);
    gl_Position = scene.viewProjection * vec4(outPosition, 1.0);
}
