// Pose pass, last part: parents before children, then the joint palette. Narrow mapping: one lane per instance. Wide mapping: one
// workgroup per instance, one depth of the hierarchy at a time, with the matrices in workgroup memory if they fit.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/pose/tables.glsl"
#include "shaders/pose/affine.h"
#include "shaders/pose/rows.glsl"
#include "shaders/pose/posed.glsl"
#include "shaders/pose/nodes.h"

layout(constant_id = kRotationsConstant) const bool kRotations = false; // the pose has some
layout(constant_id = kWorkgroupRowsConstant) const uint kLocalRows = 1u; // 3 * kWorkgroupNodes with the wide mapping

BUFFER(coherent, Scratch, kScratchPoseBinding, std430, vec4, scratch)

shared vec4 localRows[kLocalRows];

#ifdef WIDE
vec4 localRow(uint i) { return scratch.at[i]; }
#else
layout(set = 0, binding = kScratchPoseTexelBinding) uniform samplerBuffer scratchTexels;
vec4 localRow(uint i) { return texelFetch(scratchTexels, int(i)); }
#endif
Affine placeAt(uint i) { return rowsOf(localRow(i), localRow(i + 1u), localRow(i + 2u)); }
Transform localAt(uint i) {
    Transform t;
    t.translation = localRow(i).xyz;
    t.rotation = localRow(i + 1u);
    t.scale = localRow(i + 2u).xyz;
    return t;
}

bool fits() { return kWide && push.nodeCount <= kWorkgroupNodes; }

Affine globalAt(uint matrices, uint node) {
    uint i = kAffineElements * node;
    Affine m;
    if (fits()) {
        m = Affine(localRows[i], localRows[i + 1u], localRows[i + 2u]);
    } else {
        i += matrices;
        m = identity();
        ROWS m = withRow(m, k, scratch.at[i + k]);
    }
    return m;
}
void keepGlobal(uint matrices, uint node, Affine global) {
    precise Affine m = global;
    uint i = kAffineElements * node;
    if (fits()) {
        localRows[i] = m.x;
        localRows[i + 1u] = m.y;
        localRows[i + 2u] = m.z;
    } else {
        i += matrices;
        ROWS scratch.at[i + k] = rowAt(m, k);
    }
}

// Springs have made the matrices of a step's nodes that they need.
bool isGlobalAlready(uint node) {
    return push.springs != 0u && isStep() && (table(kNodeElements * node).y & kNodeOfSprings) != 0u;
}
Affine globalOf(uint matrices, uint node) {
    uint parent = parentOf(node), rows = matrices + kAffineElements * node;
    precise Affine global = localMatrix(node, localAt(rows));
    if (parent != kNoNode) global = combined(globalAt(matrices, parent), global);
    if (isGlobalAlready(node)) global = placeAt(rows);
    return global;
}

// A step needs only what painted vertices hang on.
bool isNeeded(uint node) {
    return !isStep() || (push.stepNodes & kStepsPoseAll) != 0u || (table(kNodeElements * node).y & kNodeOfSoft) != 0u;
}

void storeJoint(uint joint, bool bindPose, uint matrices, Affine place) {
    precise Affine own = identity();
    uint first = push.joints + kJointElements * joint, node = table(first + 3u).x;
    if (!isNeeded(node)) return;
    if (!bindPose) {
        Affine inverseBind = Affine(tableFloats(first), tableFloats(first + 1u), tableFloats(first + 2u));
        own = combined(globalAt(matrices, node), inverseBind);
    }
    if (kRotations) {
        uint i = kRotationTransform + kRotationElements * joint;
        storePosed(i, own);
        precise vec4 rotation = rotationOf(own);
        storePosed(i + 3u, rotation);
    } else {
        storePosed(kLinearElements * joint, combined(place, own));
    }
}

void main() {
    uint id = kWide ? workgroupIndex() : invocationIndex();
    bool within = id < push.instanceCount;
    uint entry = min(id, push.instanceCount - 1u);
    beginEntry(entry);
    uint matrices = entry * push.scratchStride;
    uint lane = kWide ? gl_LocalInvocationID.x : 0u, lanes = kWide ? gl_WorkGroupSize.x : 1u;
    bool bindPose = (state(posedSlot() * push.stateStride).y & kStateBindPose) != 0u;
    precise Affine place = identity();
    if (!isStep()) place = placeAt(matrices + kAffineElements * push.nodeCount);
    // Matrices change in their places: lanes beyond the instances must not store.
    if (kWide) {
        for (uint level = 0u; level < push.levelCount; ++level) {
            uvec4 nodes = table(push.levels + level);
            for (uint node = nodes.x + lane; node < nodes.y; node += lanes) {
                if (!isNeeded(node)) continue;
                Affine global = globalOf(matrices, node);
                if (within) keepGlobal(matrices, node, global);
            }
            memoryBarrierBuffer();
            memoryBarrierShared();
            barrier();
        }
    } else {
        for (uint node = 0u; node < push.nodeCount; ++node) {
            if (!isNeeded(node)) continue;
            Affine global = globalOf(matrices, node);
            if (within) keepGlobal(matrices, node, global);
        }
    }
    if (within) {
        if (kRotations && lane == 0u) storePosed(0u, place);
        for (uint joint = lane; joint < push.jointCount; joint += lanes) {
            storeJoint(joint, bindPose, matrices, place);
        }
    }
}
