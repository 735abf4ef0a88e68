// Pose pass, third part, for groups with modifiers: what instances have of these changes local transforms, behind the root's.
// One invocation an instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/pose/tables.glsl"
#include "shaders/pose/limbs.h"
#include "shaders/pose/time.h"

BUFFER(, Scratch, kScratchPoseBinding, std430, vec4, scratch)

uint locals = 0u; // of the instance
Transform nodeLocal(uint node) {
    uint i = locals + kAffineElements * node;
    Transform t;
    t.translation = scratch.at[i].xyz;
    t.rotation = scratch.at[i + 1u];
    t.scale = scratch.at[i + 2u].xyz;
    return t;
}
bool listed = false;
void keepTranslation(uint node, vec3 translation) {
    precise vec3 own = translation;
    if (listed) scratch.at[locals + kAffineElements * node] = vec4(own, 0.0);
}
void keepRotation(uint node, vec4 rotation) {
    precise vec4 own = rotation;
    if (listed) scratch.at[locals + kAffineElements * node + 1u] = own;
}
Affine placement() {
    uint i = locals + kAffineElements * push.nodeCount;
    return rowsOf(scratch.at[i], scratch.at[i + 1u], scratch.at[i + 2u]);
}
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
