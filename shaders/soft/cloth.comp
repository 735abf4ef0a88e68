// Cloths, behind the deform pass: each runs the steps that are due, hung on where joints have some of its vertices in the pose of
// each, then the shown vertices are moved. One workgroup a cloth and instance, in both mappings.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/deform.h"
#include "shaders/shared/fitted_rotation.h"
#include "shaders/shared/mapping.glsl"
#include "shaders/pose/colliders.h"
#include "shaders/shared/soft.h"
#include "shaders/deform/kinds.glsl"

BUFFER(, DeformedCage, kDeformedCageBinding, std430, vec4, deformedCage)
BUFFER(, Cloths, kSoftStateBinding, std430, vec4, cloths)

shared vec4 places[kMostClothVertices];
shared float sums[kClothSums];
shared vec4 posedColliders[2u * kMostClothColliders];

#define PUSH_CONSTANTS SoftPush
#include "shaders/shared/push.glsl"
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

LOADED_BUFFER(uvec4, table, Table, kDeformTableBinding, usamplerBuffer, kDeformTableTexelBinding, xyzw)
LOADED_BUFFER(vec4, pose, Poses, kPoseBinding, samplerBuffer, kPoseTexelBinding, xyzw)
LOADED_BUFFER(uvec4, clothTable, ClothTable, kSoftTableBinding, usamplerBuffer, kSoftTableTexelBinding, xyzw)
LOADED_BUFFER(vec4, scratch, Scratch, kSoftPlaceBinding, samplerBuffer, kSoftPlaceTexelBinding, xyzw)

#include "shaders/deform/skin.h"
#include "shaders/pose/moves.glsl"

uint posed = 0u; // where the step's pose begins
uint states = 0u; // where the instance's state does
vec3 goalOf(uint vertex) { return vec3(deformedVertex(vertex, posed)); }
Affine posedJoint(uint joint) {
    uint i = posed + (kSkinning == kLinearSkinning ? kLinearElements * joint : kRotationTransform + kRotationElements * joint);
    return rowsOf(pose(i), pose(i + 1u), pose(i + 2u));
}
vec4 clothState(uint i) { return cloths.at[states + i]; }
void keepClothState(uint i, vec4 v) {
    precise vec4 own = v;
    cloths.at[states + i] = own;
}
vec4 placeAt(uint i) { return places[i]; }
void keepPlace(uint i, vec4 v) {
    precise vec4 own = v;
    places[i] = own;
}
float sumAt(uint i) { return sums[i]; }
void keepSum(uint i, float v) {
    precise float own = v;
    sums[i] = own;
}
vec4 colliderAt(uint i) { return posedColliders[i]; }
void keepCollider(uint collider, vec4 point, vec4 way) {
    precise vec4 first = point;
    precise vec4 second = way;
    posedColliders[2u * collider] = first;
    posedColliders[2u * collider + 1u] = second;
}
uint laneOf() { return gl_LocalInvocationID.x; }
uint laneCount() { return gl_WorkGroupSize.x; }
void meet() {
    memoryBarrierShared();
    barrier();
}
#include "shaders/soft/cloth.h"

Affine scratchRows(uint i) { return rowsOf(scratch(i), scratch(i + 1u), scratch(i + 2u)); }
Affine stateRows(uint i) { return rowsOf(clothState(i), clothState(i + 1u), clothState(i + 2u)); }
void keepStateRows(uint i, Affine rows) {
    keepClothState(i, rows.x);
    keepClothState(i + 1u, rows.y);
    keepClothState(i + 2u, rows.z);
}

void runSteps(ClothTables all, uint words) {
    uint first = instanceWord(words + 1u), flags = instanceWord(words + 7u), moves = instanceWord(words + 4u);
    uint steps = min(flags & kStepCountMask, kMostDueSteps), jump = (flags >> kStepJumpShift) & 15u;
    bool settles = (flags & kStepSettles) != 0u, skips = ((flags >> kStepSkippedShift) & kMostSkippedSteps) != 0u;
    precise Affine before = stateRows(all.state), moveBefore = stateRows(all.state + 3u);
    float known = clothState(all.state + 6u).x;
    for (uint k = 0u; k < steps; ++k) {
        uint entry = push.shown + first + k;
        precise Affine way = identity();
        if ((instanceEntry(entry) & kPosedTravels) != 0u) way = scratchRows(entry * push.scratchStride + push.way);
        posed = (first + k) * push.stepStride;
        ClothStep now = clothStep(stepMove(before, way, moves, k, false), moveBefore, settles, skips, jump == k + 1u, known);
        now.down = worldDirection(way, downRow(moves + kMoveWords * k));
        now.wind = worldVelocity(way, windRow(moves + kMoveWords * k));
        now.light = (flags & kStepLightCloths) != 0u;
        runClothStep(all, now);
        before = way;
        moveBefore = now.move;
        known = knownAfter(now, known);
    }
    if (laneOf() == 0u && steps != 0u) {
        keepStateRows(all.state, before);
        keepStateRows(all.state + 3u, moveBefore);
        keepClothState(all.state + 6u, vec4(known, 0.0, 0.0, 0.0));
    }
}

void main() {
    uint id = workgroupIndex();
    if (id >= push.count * push.instanceCount) return;
    uint entry = id / push.count, words = push.stepping + kStepWords * entry;
    uint slot = slotOf(instanceWord(words));
    ClothTables all = clothTables(id - entry * push.count);
    states = slot * push.stateStride;
    runSteps(all, words);
    uint shownEntry = instanceWord(words + 5u);
    float part = uintBitsToFloat(instanceWord(words + 3u)), fade = uintBitsToFloat(instanceWord(words + 8u));
    if (shownEntry == kNotShown || fade == 0.0) return;
    precise Affine place = scratchRows(shownEntry * push.scratchStride + push.place);
    for (uint i = laneOf(); i < all.vertexCount; i += laneCount()) {
        if (i < all.hangingCount) continue;
        precise vec3 moved = shownClothOffset(all, i, part, place) * fade;
        uint cage = slot * push.cageStride + clothTable(all.vertices + kClothVertexElements * i).x;
        vec4 shown = deformedCage.at[cage];
        precise vec3 p = vec3(shown) + moved;
        deformedCage.at[cage] = vec4(p, shown.w);
    }
}
