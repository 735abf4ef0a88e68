// Points of surfaces in the deformed cages of a group: their positions and frames. One invocation a point and instance.
// Whatever scheme a surface has, a point is a combination of cage vertices (shaders/shared/points.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#define OCTAHEDRAL_PRECISE precise
#include "shaders/shared/octahedral.glsl"
#include "shaders/shared/points.h"

layout(constant_id = kVertexFormatConstant) const uint kFormat = kPointFrame48; // SupplePointFormat

BUFFER(writeonly, Points, kPointBinding, std430, uvec4, points)
BUFFER(, Pasts, kPointPastBinding, std430, vec4, pasts)

#define PUSH_CONSTANTS PointPush
#include "shaders/shared/push.glsl"
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

LOADED_BUFFER(uvec4, table, Table, kPointTableBinding, usamplerBuffer, kPointTableTexelBinding, xyzw)
LOADED_BUFFER(vec4, cage, DeformedCage, kPointCageBinding, samplerBuffer, kPointCageTexelBinding, xyzw)

#include "shaders/points/frame.glsl"

// Where the point was, in this frame's coordinates; without a past, where it is. Notes where it is.
vec3 previousPosition(uint at, bool isNew, vec3 position) {
    precise vec3 before = pasts.at[at].xyz - vec3(push.pastX, push.pastY, push.pastZ);
    pasts.at[at] = vec4(position, 0.0);
    return SELECT3(isNew, position, before);
}

// `number`: of the point, among all of the slots that the descriptors reach.
void storePoint(uint number, bool isNew, vec3 position, PointFrame f) {
    uint at = push.firstElement + number * pointElements(kFormat);
    if (kFormat == kPointVertex16) {
        precise float size = (abs(f.normal.x) + abs(f.normal.y)) + abs(f.normal.z);
        precise vec2 octahedral = octahedralOf(f.normal, recip(size));
        uvec2 bits = roundedBits(octahedral, vec2(32767.0));
        points.at[at] = uvec4(floatBitsToUint(position), (bits.x & 0xFFFFu) | bits.y << 16u);
        return;
    }
    for (uint row = 0u; row < 3u; ++row) {
        points.at[at + row] = floatBitsToUint(vec4(f.tangent[row], f.bitangent[row], f.normal[row], position[row]));
    }
    if (kFormat == kPointFrame64) {
        vec3 before = previousPosition(push.firstPast + number, isNew, position);
        points.at[at + 3u] = floatBitsToUint(vec4(before, f.area));
    }
}

void main() {
    uint id = invocationIndex();
    if (id >= push.pointCount * push.instanceCount) return;
    uint listed = id / push.pointCount, point = id - listed * push.pointCount;
    uint entry = instanceEntry(listed), slot = slotOf(entry);
    if (slot - push.firstSlot >= push.slotCount) return; // another dispatch has it
    uvec4 block = table(point / kPointBlock);
    uint at = block.x + point % kPointBlock, base = slot * push.cageStride;
    vec4 first = cage(base + table(at).x);
    precise vec3 position = vec3(0.0), a = vec3(0.0), b = vec3(0.0);
    for (uint i = 1u; i < block.y; ++i) {
        at += block.z;
        uvec4 weight = table(at);
        vec3 shares = uintBitsToFloat(weight.yzw);
        precise vec3 offset = cage(base + weight.x).xyz - first.xyz;
        position += shares.x * offset;
        a += shares.y * offset;
        b += shares.z * offset;
    }
    position += first.xyz;
    if (kFormat == kPointDerivatives32) {
        uint element = push.firstElement + 2u * ((slot - push.firstSlot) * push.pointCount + point);
        points.at[element] = uvec4(floatBitsToUint(a), 0u);
        points.at[element + 1u] = uvec4(floatBitsToUint(b), 0u);
        return;
    }
    bool isNew = push.isFirst != 0u || (entry & kInstanceIsNew) != 0u;
    storePoint((slot - push.firstSlot) * push.pointCount + point, isNew, position, frameOf(a, b, first.w < 0.0));
}
