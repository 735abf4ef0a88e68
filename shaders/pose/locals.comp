// Pose pass, first part: local matrices. One invocation a node and instance; of the instance's transform one, and one for
// every four morph weights, which go straight into the pose. What root motion changes of it is left to roots.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/pose/tables.glsl"

// Additive layers, which some instance of the group plays or none: lavapipe steps through what no lane takes, so that it
// must not be there.
#ifdef ADDS
const bool kAdds = true;
#else
const bool kAdds = false;
#endif
const bool kRoots = false;
#include "shaders/pose/layers.glsl"
#include "shaders/pose/local.glsl"

vec4 morphWeights(uint first, uint quad) {
    uint flags = state(first).y;
    precise vec4 weights = vec4(0.0);
    if ((flags & kStateHostWeights) != 0u) {
        weights = stateFloats(first + kStateElements + kMaxPlaybackLayers * kLayerElements + quad);
    } else if ((flags & kStateBindPose) == 0u) {
        uint count = min(push.morphCount - 4u * quad, 4u);
        for (uint k = 0u; k < count; ++k) {
            precise float weight = posedMorphWeight(first, 4u * quad + k);
            weights = mix(weights, vec4(weight), equal(uvec4(k), uvec4(0u, 1u, 2u, 3u)));
        }
    }
    return weights;
}

void main() {
    uint items = push.nodeCount + 1u + (push.morphCount + 3u) / 4u;
    uint id = min(invocationIndex(), items * push.instanceCount - 1u);
    // CPU devices: neighboring lanes take one node of several instances and walk through the same keys. GPUs: one
    // instance's nodes, whose layers they load together.
    uint entry = kWide ? id / items : id % push.instanceCount;
    uint item = kWide ? id % items : id / push.instanceCount;
    uint instance = instanceSlot(entry);
    uint first = instance * push.stateStride, matrices = instance * push.scratchStride;
    if (item < push.nodeCount) {
        Motion none = standing();
        storeLocal(matrices + kAffineElements * item, localMatrix(item, posedTransform(first, item, none)));
    } else if (item == push.nodeCount) {
        storeLocal(matrices + kAffineElements * item, transformOf(first));
    } else {
        uint quad = item - push.nodeCount - 1u;
        precise vec4 weights = morphWeights(first, quad);
        posed[instance * push.poseStride + push.morphWeights + quad] = weights;
    }
}
