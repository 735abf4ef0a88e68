#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 1
#include "supple_surface.glsl"
#include "scene.glsl"

layout(push_constant) uniform Push {
    SuppleRange range;
    uint shadow;
};

layout(location = 0) centroid out vec3 outPosition;
layout(location = 1) centroid out vec3 outNormal;
layout(location = 2) out vec2 outUv;
layout(location = 3) flat out uint outSlot;

void main() {
    SuppleVertex at = suppleVertex(range, gl_InstanceIndex, gl_VertexIndex);
    outPosition = supplePosition(at);
    outNormal = suppleNormal(at);
    outUv = suppleUv(at);
    outSlot = at.slot;
    gl_Position = (shadow != 0u ? scene.sunViewProjection : scene.viewProjection) * vec4(outPosition, 1.0);
}
