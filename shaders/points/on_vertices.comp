// Points that lie where surface vertices are take over their positions, to the bit. One invocation a point and instance. It comes
// behind the frames of the points (stencils.comp) and behind the evaluation of the surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/points.h"

layout(constant_id = kVertexFormatConstant) const uint kFormat = kPointFrame48; // SupplePointFormat, with a position

BUFFER(readonly, Vertices, kPointVertexBinding, std430, uint, vertices)
BUFFER(readonly, Entries, kVertexPointBinding, std430, uvec2, entries)
BUFFER(writeonly, Points, kPointBinding, std430, uint, points)
BUFFER(writeonly, Pasts, kPointPastBinding, std430, uvec4, pasts)

#define PUSH_CONSTANTS VertexPointPush
#include "shaders/shared/push.glsl"
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

void main() {
    uint id = invocationIndex();
    if (id >= push.entryCount * push.instanceCount) return;
    uint listed = id / push.entryCount, entry = instanceEntry(listed), slot = slotOf(entry);
    if (slot - push.firstSlot >= push.slotCount) return; // another dispatch has it
    uvec2 own = entries.at[push.firstEntry + (id - listed * push.entryCount)];
    uint from = slot * push.instanceWords + own.y * push.vertexWords;
    uvec3 position = uvec3(vertices.at[from], vertices.at[from + 1u], vertices.at[from + 2u]);
    uint number = (slot - push.firstSlot) * push.pointCount + own.x;
    uint to = 4u * (push.firstElement + number * pointElements(kFormat));
    uint apart = kFormat == kPointVertex16 ? 1u : 4u, first = kFormat == kPointVertex16 ? to : to + 3u; // the column of a matrix
    for (uint axis = 0u; axis < 3u; ++axis) points.at[first + axis * apart] = position[axis];
    if (kFormat != kPointFrame64) return;
    pasts.at[push.firstPast + number] = uvec4(position, 0u);
    if (push.isFirst == 0u && (entry & kInstanceIsNew) == 0u) return;
    for (uint axis = 0u; axis < 3u; ++axis) points.at[to + 12u + axis] = position[axis]; // without a past
}
