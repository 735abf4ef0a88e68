// Pose pass, for groups whose file has pose drivers: adds what these set to the morph weights that clips or the host have set.
// Springs swing afterwards. One invocation for every four weights that some driver adds to, and pose.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/pose/tables.glsl"
#include "shaders/pose/affine.h"

BUFFER(, Posed, kPosedBinding, std430, vec4, posed)
BUFFER(, PosedEnds, kEndsBinding, std430, vec4, posedEnds)

#ifdef WIDE
BUFFER(readonly, Scratch, kScratchPoseBinding, std430, vec4, scratch)
vec4 localRow(uint i) { return scratch.at[i]; }
#else
layout(set = 0, binding = kScratchPoseTexelBinding) uniform samplerBuffer scratchTexels;
vec4 localRow(uint i) { return texelFetch(scratchTexels, int(i)); }
#endif

uint locals = 0u;
vec4 nodeRotation(uint place, uint number) { return localRow(locals + kAffineElements * place + 1u); }
#include "shaders/pose/drivers.h"

void main() {
    uint quads = table(push.drivers).x;
    uint id = invocationIndex(), count = quads * push.instanceCount;
    bool within = id < count; // lanes beyond must not add once more
    id = min(id, count - 1u);
    uint entry = kWide ? id / quads : id % push.instanceCount;
    uint item = kWide ? id % quads : id / push.instanceCount;
    beginEntry(entry);
    locals = entry * push.scratchStride;
    bool bindPose = (state(posedState()).y & kStateBindPose) != 0u; // where no joint is turned
    uvec4 quad = table(push.drivers + 1u + item);
    precise vec4 driven = drivenWeights(quad);
    if (!within || bindPose) return;
    bool shown = isShown();
    uint i = push.morphWeights + quad.x + (shown ? posedSlot() * push.poseStride : firstUnshown());
    vec4 before;
    if (shown) before = posed.at[i];
    else before = posedEnds.at[i];
    precise vec4 weights = before + driven;
    if (shown) posed.at[i] = weights;
    else posedEnds.at[i] = weights;
}
