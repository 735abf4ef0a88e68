// The deformed vertices of a cage's piece: those of the whole deformed cage that it has. One invocation a vertex of the
// piece and instance. The bindings are those of the deform pass: the table has the whole cage's vertex of each of the
// piece's, four an element, and the whole deformed cage, `poseStride` vertices an instance, stands where poses do.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/deform.h"
#include "shaders/shared/mapping.glsl"

BUFFER(writeonly, Piece, kDeformedCageBinding, std430, vec4, piece)

#define PUSH_CONSTANTS DeformPush
#include "shaders/shared/push.glsl"
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

LOADED_BUFFER(uvec4, table, Table, kDeformTableBinding, usamplerBuffer, kDeformTableTexelBinding, xyzw)
LOADED_BUFFER(vec4, whole, DeformedCage, kPoseBinding, samplerBuffer, kPoseTexelBinding, xyzw)

void main() {
    uint id = min(invocationIndex(), push.vertexCount * push.instanceCount - 1u);
    uint entry = id / push.vertexCount, instance = instanceSlot(entry);
    uint index = id - entry * push.vertexCount;
    piece.at[instance * push.cageStride + index] = whole(instance * push.poseStride + table(index / 4u)[index & 3u]);
}
