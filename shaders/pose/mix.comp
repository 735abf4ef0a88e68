// Pose pass, behind the others, for groups with update rates: what instances show between their two ends, placed by their
// transforms. One invocation a joint and instance; for dual quaternions one more, of the transform; and one for every four
// morph weights.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/pose/tables.glsl"
#include "shaders/pose/straight.h"

layout(constant_id = kRotationsConstant) const bool kRotations = false; // the pose has their layout

BUFFER(writeonly, Posed, kPosedBinding, std430, vec4, posed)
LOADED_BUFFER(vec4, end, Ends, kEndsBinding, samplerBuffer, kEndsTexelBinding, xyzw)

Affine endRows(uint i) { return rowsOf(end(i), end(i + 1u), end(i + 2u)); }
Affine transformOf(uint first) {
    precise Affine m = rowsOf(stateFloats(first + 1u), stateFloats(first + 2u), stateFloats(first + 3u));
    return m;
}
void storeRows(uint i, Affine m) {
    precise Affine rows = m;
    posed.at[i] = rows.x;
    posed.at[i + 1u] = rows.y;
    posed.at[i + 2u] = rows.z;
}

void main() {
    uint matrices = push.jointCount + (kRotations ? 1u : 0u);
    uint items = matrices + (push.morphCount + 3u) / 4u;
    uint id = min(invocationIndex(), items * push.instanceCount - 1u);
    uint n = kWide ? id / items : id % push.instanceCount;
    uint item = kWide ? id % items : id / push.instanceCount;
    uint entry = instanceEntry(n), instance = slotOf(entry), first = instance * push.stateStride;
    float part = uintBitsToFloat(instanceWord(push.times + n));
    uint shown = instance * push.poseStride, earlier = SUPPLE_POSED_END(entry);
    uint a = firstOfEnd(instance, earlier), b = firstOfEnd(instance, kPoseEnds + 1u - earlier);
    if (item < matrices) {
        bool isJoint = item < push.jointCount;
        uint at = kLinearElements * item;
        if (kRotations) at = isJoint ? kRotationTransform + kRotationElements * item : 0u;
        precise Affine m = straight(endRows(a + at), endRows(b + at), part);
        // Behind dual quaternions, the transform places what they have blended.
        if (!kRotations || !isJoint) m = combined(transformOf(first), m);
        storeRows(shown + at, m);
        if (kRotations && isJoint) {
            precise vec4 rotation = straightRotation(end(a + at + 3u), end(b + at + 3u), part);
            posed.at[shown + at + 3u] = rotation;
        }
    } else {
        uint quad = item - matrices, at = push.morphWeights + quad;
        precise vec4 weights = straight(end(a + at), end(b + at), part);
        // With drivers, ends have what these add to the host's: Playback::setMorphWeights() makes them anew.
        if (push.drivers == 0u && (state(first).y & kStateHostWeights) != 0u) {
            weights = stateFloats(first + kStateElements + kMaxPlaybackLayers * kLayerElements + quad);
        }
        posed.at[shown + at] = weights;
    }
}
