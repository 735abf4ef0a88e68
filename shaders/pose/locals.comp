// Pose pass, first part: local transforms. One invocation a node and instance; of the instance's transform one, and one for
// every four morph weights, which go straight into the pose. What root motion changes of it is left to roots.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/pose/tables.glsl"
#include "shaders/pose/affine.h"
#include "shaders/pose/rows.glsl"
#include "shaders/pose/posed.glsl"
#include "shaders/pose/time.h"

// Additive layers and transitions, which some instance of the group has or none: lavapipe steps through what no lane takes,
// so that it must not be there.
#ifdef ADDS
const bool kAdds = true;
#else
const bool kAdds = false;
#endif
#ifdef TRANSITIONS
const bool kTransitions = true;
#else
const bool kTransitions = false;
#endif
const bool kRoots = false;
layout(constant_id = kMorphsConstant) const bool kMorphs = true;
#include "shaders/pose/layers.h"
#include "shaders/pose/transition.h"
#include "shaders/pose/local.glsl"

// What steps do not need: in groups without modifiers, most nodes and, where nothing jiggles, morph weights.
bool isLeftOut(uint item) {
    bool needed = item == push.nodeCount || stepsHavePoses();
    uint flags = push.stepNodes & ~(kStepsHavePoses | kStepsPoseAll);
    if (item < push.nodeCount) needed = flags == 0u || (table(kNodeElements * item).y & flags) != 0u;
    return !needed;
}

void main() {
    uint items = push.nodeCount + 1u + (push.morphCount + 3u) / 4u;
    uint id = min(invocationIndex(), items * push.instanceCount - 1u);
    // CPU devices: neighboring lanes take one node of several instances and walk through the same keys. GPUs: one
    // instance's nodes, whose layers they load together.
    uint entry = kWide ? id / items : id % push.instanceCount;
    uint item = kWide ? id % items : id / push.instanceCount;
    beginEntry(entry);
    uint first = posedState(), locals = entry * push.scratchStride;
    if (isStep() && isLeftOut(item)) return;
    if (item < push.nodeCount) {
        Motion none = standing();
        storeLocal(locals + kAffineElements * item, shownTransform(first, item, posedTransform(first, item, none)));
    } else if (item == push.nodeCount) {
        precise Affine place = identity();
        if (isPlaced()) place = transformOf(first);
        storePlace(locals + kAffineElements * item, place);
    } else if (kMorphs) {
        uint quad = item - push.nodeCount - 1u;
        precise vec4 weights = shownWeights(first, quad, morphWeights(first, quad));
        storePosed(push.morphWeights + quad, weights);
    }
}
