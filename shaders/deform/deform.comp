// Deform pass: morph targets, then skinning of the control cage. One invocation a cage vertex and instance.
// Whatever feeds the position is `precise`: both mappings must give the same cage, bit for bit.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/deform.h"
#include "shaders/shared/fitted_rotation.h"
#include "shaders/shared/mapping.glsl"
#include "shaders/deform/kinds.glsl"

BUFFER(writeonly, DeformedCage, kDeformedCageBinding, std430, vec4, deformedCage)

#define PUSH_CONSTANTS DeformPush
#include "shaders/shared/push.glsl"
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

LOADED_BUFFER(uvec4, table, Table, kDeformTableBinding, usamplerBuffer, kDeformTableTexelBinding, xyzw)
LOADED_BUFFER(vec4, pose, Poses, kPoseBinding, samplerBuffer, kPoseTexelBinding, xyzw)

#include "shaders/deform/skin.h"

void main() {
    // Clamped, not returned early: a divergent return makes every later load slow on CPU devices.
    uint id = min(invocationIndex(), push.vertexCount * push.instanceCount - 1u);
    uint entry = id / push.vertexCount, instance = instanceSlot(entry);
    uint index = id - entry * push.vertexCount;
    deformedCage.at[instance * push.cageStride + index] = deformedVertex(index, instance * push.poseStride);
}
