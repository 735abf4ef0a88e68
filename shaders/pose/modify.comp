// Pose pass, third part, for groups with modifiers: what instances have of these changes local transforms, behind the root's.
// One invocation an instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/pose/tables.glsl"
#include "shaders/pose/limbs.h"
#include "shaders/pose/rows.glsl"
#include "shaders/pose/time.h"

BUFFER(, Scratch, kScratchPoseBinding, std430, vec4, scratch)

uint locals = 0u; // of the instance
Affine scratchRows(uint i) {
    Affine m = identity();
    ROWS m = withRow(m, k, scratch.at[i + k]);
    return m;
}
Transform nodeLocal(uint node) { return transformAt(scratchRows(locals + kAffineElements * node)); }
bool listed = false;
void keepTranslation(uint node, vec3 translation) {
    precise vec3 local = translation;
    if (listed) scratch.at[locals + kAffineElements * node] = vec4(local, 0.0);
}
void keepRotation(uint node, vec4 rotation) {
    precise vec4 local = rotation;
    if (listed) scratch.at[locals + kAffineElements * node + 1u] = local;
}
Affine placement() { return scratchRows(locals + kAffineElements * push.nodeCount); }
vec4 heldAt(uint foot) { return scratch.at[locals + kAffineElements * (push.nodeCount + 1u) + foot]; }
void keepHeld(uint foot, vec4 held) {
    precise vec4 own = held;
    if (listed) scratch.at[locals + kAffineElements * (push.nodeCount + 1u) + foot] = own;
}
#include "shaders/pose/modify.h"

void main() {
    uint id = invocationIndex();
    listed = id < push.instanceCount; // lanes beyond the instances must not store: others change what they have read
    uint entry = min(id, push.instanceCount - 1u);
    beginEntry(entry);
    locals = entry * push.scratchStride;
    modifyInstance(posedState());
}
