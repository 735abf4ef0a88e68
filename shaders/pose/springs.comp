// Pose pass, fourth part, for groups with springs: instances run the steps that are due, each from a pose of its own, and what they
// show swings. Narrow mapping: one lane per instance. Wide mapping: one workgroup per instance, in which a lane takes a node of a
// level, then a collider, then a chain.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/pose/tables.glsl"
#include "shaders/pose/colliders.h"
#include "shaders/pose/rows.glsl"

BUFFER(coherent, Scratch, kScratchPoseBinding, std430, vec4, scratch)
BUFFER(coherent, Springs, kSpringBinding, std430, vec4, springs)

bool listed = false; // lanes beyond the instances must not store: others change what they have read
uint locals = 0u;    // of the step, or of what is shown
uint tails = 0u;     // of the instance

Affine scratchRows(uint i) {
    Affine m = identity();
    ROWS m = withRow(m, k, scratch.at[i + k]);
    return m;
}
Transform nodeLocal(uint node) { return transformAt(scratchRows(locals + kAffineElements * node)); }
void keepLocal(uint node, Transform t) {
    precise Transform local = t;
    if (listed) scratch.at[locals + kAffineElements * node + 1u] = local.rotation;
}
Affine nodeGlobal(uint node) { return scratchRows(locals + kAffineElements * node); }
void keepGlobal(uint node, Affine m) {
    precise Affine global = m;
    uint i = locals + kAffineElements * node;
    if (listed) {
        ROWS scratch.at[i + k] = rowAt(global, k);
    }
}
uint colliderPlace(uint collider) {
    return locals + push.springScratch + kAffineElements + kPosedColliderElements * collider;
}
PosedCollider posedCollider(uint collider) {
    PosedCollider posed;
    uint i = colliderPlace(collider);
    TURNS(kPosedColliderElements) {
        vec4 element = scratch.at[i + k];
        if (k == 0u) posed.point = element;
        else posed.way = element;
    }
    return posed;
}
void keepCollider(uint collider, vec4 point, vec4 way) {
    precise vec4 first = point;
    precise vec4 second = way;
    uint i = colliderPlace(collider);
    if (listed) {
        TURNS(kPosedColliderElements) scratch.at[i + k] = k == 0u ? first : second;
    }
}
Affine springRows(uint i) {
    Affine rows = identity();
    ROWS rows = withRow(rows, k, springs.at[tails + i + k]);
    return rows;
}
void keepSpringRows(uint i, Affine rows) {
    precise Affine own = rows;
    if (listed) {
        ROWS springs.at[tails + i + k] = rowAt(own, k);
    }
}
void keepSpring(uint i, vec4 v) {
    precise vec4 own = v;
    if (listed) springs.at[tails + i] = own;
}
#include "shaders/pose/springs.h"
#include "shaders/pose/moves.glsl"

// Behind what other lanes of the workgroup have stored.
void meet() {
    if (kWide) {
        memoryBarrierBuffer();
        barrier();
    }
}

void runStep(SpringTables all, SpringStep now, uint lane, uint lanes) {
    for (uint level = 0u; level < all.levelCount; ++level) {
        uvec4 nodes = table(all.levels + level);
        for (uint i = nodes.x + lane; i < nodes.y; i += lanes) poseSpringNode(table(i).x);
        meet();
    }
    for (uint i = lane; i < all.colliderCount; i += lanes) poseCollider(i, all.colliders + kColliderElements * i);
    meet();
    for (uint chain = lane; chain < all.chainCount; chain += lanes) {
        stepChain(table(all.chains + chain), now);
    }
    meet();
}

void main() {
    uint id = kWide ? workgroupIndex() : invocationIndex();
    listed = id < push.instanceCount;
    uint words = push.stepWords + kStepWords * min(id, push.instanceCount - 1u);
    uint slot = slotOf(instanceWord(words)), first = push.shown + instanceWord(words + 1u);
    uint steps = instanceWord(words + 2u), moves = instanceWord(words + 4u);
    uint lane = kWide ? gl_LocalInvocationID.x : 0u, lanes = kWide ? gl_WorkGroupSize.x : 1u;
    SpringTables all = springTables();
    tails = slot * push.springStride;
    SpringStep now;
    now.settles = (steps & kStepSettles) != 0u;
    uint jump = (steps >> kStepJumpShift) & 15u;
    steps = min(steps & kStepCountMask, kMostDueSteps);
    precise Affine before = springRows(0u);
    meet();
    for (uint k = 0u; k < steps; ++k) {
        beginEntry(first + k);
        locals = (first + k) * push.scratchStride;
        precise Affine way = identity();
        if ((state(posedState()).y & kStateTravels) != 0u) way = scratchRows(locals + push.springScratch);
        now.move = stepMove(before, way, moves, k, jump == k + 1u);
        now.wind = vec3(0.0);
        if (moves != 0u) now.wind = worldVelocity(way, windRow(moves + kMoveWords * k));
        before = way;
        now.place = scratchRows(locals + kAffineElements * push.nodeCount);
        runStep(all, now, lane, lanes);
    }
    if (lane == 0u && steps != 0u) keepSpringRows(0u, before);
    uint shown = instanceWord(words + 5u);
    if (shown == kNotShown) return;
    locals = shown * push.scratchStride;
    float part = uintBitsToFloat(instanceWord(words + 3u)), fade = uintBitsToFloat(instanceWord(words + 6u));
    for (uint chain = lane; chain < all.chainCount; chain += lanes) {
        uvec4 nodes = table(all.chains + chain);
        for (uint i = nodes.x; i < nodes.y; i += kSpringNodeElements) showSpringNode(i, part, fade);
    }
}
