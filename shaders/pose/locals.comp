// Pose pass, first half: local matrices. One invocation a node and instance; of the instance's transform one, and one for
// every four morph weights, which go straight into the pose.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/pose/tables.glsl"

// What some instance of the group plays: lavapipe steps through what no lane takes, so that it must not be there.
layout(constant_id = 3) const bool kRoots = true; // root motion
layout(constant_id = 4) const bool kAdds = true;  // additive layers

#include "shaders/pose/time.glsl"
#include "shaders/pose/rotation.glsl"
#include "shaders/pose/affine.glsl"
#include "shaders/pose/clip.glsl"
#include "shaders/pose/root.glsl"
#include "shaders/pose/layers.glsl"

layout(set = 0, binding = kScratchPoseBinding, std430) writeonly buffer Scratch { vec4 scratch[]; };

void storeLocal(uint i, Affine m) {
    precise Affine local = m;
    scratch[i] = local.x;
    scratch[i + 1u] = local.y;
    scratch[i + 2u] = local.z;
}

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
        storeLocal(matrices + kAffineElements * item, localMatrix(item, posedTransform(first, item)));
    } else if (item == push.nodeCount) {
        storeLocal(matrices + kAffineElements * item, placement(first));
    } else {
        uint quad = item - push.nodeCount - 1u;
        precise vec4 weights = morphWeights(first, quad);
        posed[instance * push.poseStride + push.morphWeights + quad] = weights;
    }
}
