// Pose pass, second part, for groups with root motion or feet that are planted. What the first layer's root has travelled goes
// into the instance's transform. What any layer's root has travelled is taken out of the root's local transform. Where the clips
// hold feet goes behind the transform. One invocation per instance. It is a pass of its own: in locals.comp all nodes would step
// through its code.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/pose/tables.glsl"
#include "shaders/pose/affine.h"
#include "shaders/pose/rows.glsl"
#include "shaders/pose/time.h"

const bool kAdds = true, kRoots = true, kTransitions = true;
#include "shaders/pose/layers.h"
#include "shaders/pose/transition.h"
#include "shaders/pose/contacts.h"
#include "shaders/pose/local.glsl"

void main() {
    uint entry = min(invocationIndex(), push.instanceCount - 1u);
    beginEntry(entry);
    uint first = posedState(), locals = entry * push.scratchStride;
    uvec4 header = state(first);
    if (header.w != 0u) {
        precise Motion sinceBegin = standing();
        Transform root = posedTransform(first, header.z, sinceBegin);
        storeLocal(locals + kAffineElements * header.z, shownTransform(first, header.z, root));
        if ((header.y & kStateTravels) != 0u) {
            // A loop, so that the code is there once: where it stands, then for steps the way alone.
            uint way = 0u, ways = isStep() ? 2u : 1u;
            do { // at least once
                precise Affine place = identity();
                if (isPlaced() && way == 0u) place = transformOf(first);
                uint rows = way == 0u ? kAffineElements * push.nodeCount : push.springScratch;
                storePlace(locals + rows, travelled(first, place, sinceBegin));
                ++way;
            } while (way < ways);
        }
    }
    uint foot = 0u;
    do { // see clip.h
        if (foot < push.footCount) {
            precise vec4 held = heldFoot(first, foot);
            scratch.at[locals + kAffineElements * (push.nodeCount + 1u) + foot] = held;
        }
        ++foot;
    } while (foot < push.footCount);
}
