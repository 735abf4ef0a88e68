// Vertices that jiggle, behind the deform pass: each runs the steps that are due, towards where joints have it in the pose of
// each, then the shown vertex is moved. One invocation a vertex and instance. Vertices know nothing of each other, so both
// mappings have the same words.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/deform.h"
#include "shaders/shared/fitted_rotation.h"
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/vectors.h"
#include "shaders/soft/jiggle.h"
#include "shaders/deform/kinds.glsl"

BUFFER(, DeformedCage, kDeformedCageBinding, std430, vec4, deformedCage)
BUFFER(, Jiggles, kSoftStateBinding, std430, vec4, jiggles)

#define PUSH_CONSTANTS SoftPush
#include "shaders/shared/push.glsl"
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

LOADED_BUFFER(uvec4, table, Table, kDeformTableBinding, usamplerBuffer, kDeformTableTexelBinding, xyzw)
LOADED_BUFFER(vec4, pose, Poses, kPoseBinding, samplerBuffer, kPoseTexelBinding, xyzw)
LOADED_BUFFER(uvec4, jiggleTable, JiggleTable, kSoftTableBinding, usamplerBuffer, kSoftTableTexelBinding, xyzw)
LOADED_BUFFER(vec4, scratch, Scratch, kSoftPlaceBinding, samplerBuffer, kSoftPlaceTexelBinding, xyzw)

#include "shaders/deform/skin.h"
#include "shaders/pose/moves.glsl"

Affine scratchRows(uint i) { return rowsOf(scratch(i), scratch(i + 1u), scratch(i + 2u)); }

void main() {
    uint id = invocationIndex(), count = push.count * push.instanceCount;
    bool within = id < count; // lanes beyond must not step once more: what they read and make of it nobody sees
    id = min(id, count - 1u);
    uint entry = id / push.count, vertex = id - entry * push.count;
    uvec4 own = jiggleTable(kJiggleTableElements * vertex);
    vec4 spring = uintBitsToFloat(jiggleTable(kJiggleTableElements * vertex + 1u));

    uint words = push.stepping + kStepWords * entry;
    uint slot = slotOf(instanceWord(words)), first = instanceWord(words + 1u), flags = instanceWord(words + 7u);
    uint moves = instanceWord(words + 4u), steps = min(flags & kStepCountMask, kMostDueSteps);
    uint jump = (flags >> kStepJumpShift) & 15u, number = (flags >> kStepNumberShift) & (kStepNumbers - 1u);
    uint ways = slot * push.stateStride, state = ways + kJiggleVertices + kJiggleElements * vertex;
    Jiggling jiggling = jigglingOf(jiggles.at[state], jiggles.at[state + 1u], jiggles.at[state + 2u], jiggles.at[state + 3u]);
    uint wayAt = ways + 3u * ((number + kStepNumbers - 1u) & (kStepNumbers - 1u));
    precise Affine wayBefore = rowsOf(jiggles.at[wayAt], jiggles.at[wayAt + 1u], jiggles.at[wayAt + 2u]);
    for (uint k = 0u; k < steps; ++k) {
        uint posed = push.shown + first + k;
        precise Affine way = identity();
        if ((instanceEntry(posed) & kPosedTravels) != 0u) way = scratchRows(posed * push.scratchStride + push.way);
        precise JiggleStep now;
        now.jumps = jump == k + 1u;
        now.move = stepMove(wayBefore, way, moves, k, now.jumps);
        now.settles = (flags & kStepSettles) != 0u;
        now.skipped = (flags >> kStepSkippedShift) & kMostSkippedSteps;
        wayBefore = way;
        precise vec3 goal = vec3(deformedVertex(own.x, (first + k) * push.stepStride));
        jiggling = jiggledStep(jiggling, goal, now, spring, uintBitsToFloat(own.z));
    }
    uint shownEntry = instanceWord(words + 5u);
    float fade = uintBitsToFloat(instanceWord(words + 8u));
    bool shows = shownEntry != kNotShown && fade != 0.0;
    precise Affine place = scratchRows(SELECT(shows, shownEntry, 0u) * push.scratchStride + push.place);
    precise float weight = uintBitsToFloat(own.y) * fade;
    precise vec3 moved = shownOffset(jiggling, uintBitsToFloat(instanceWord(words + 3u)), weight, place);
    if (!within) return;
    if (steps != 0u) {
        jiggles.at[state] = vec4(jiggling.offset, jiggling.before.x);
        jiggles.at[state + 1u] = vec4(jiggling.speed, jiggling.before.y);
        jiggles.at[state + 2u] = vec4(jiggling.goal, jiggling.before.z);
        jiggles.at[state + 3u] = vec4(jiggling.goalSpeed, jiggling.known);
        uint wayNow = ways + 3u * ((number + steps - 1u) & (kStepNumbers - 1u));
        if (vertex == 0u) {
            jiggles.at[wayNow] = wayBefore.x;
            jiggles.at[wayNow + 1u] = wayBefore.y;
            jiggles.at[wayNow + 2u] = wayBefore.z;
        }
    }
    if (!shows) return;
    uint cage = slot * push.cageStride + own.x;
    vec4 shown = deformedCage.at[cage];
    precise vec3 p = vec3(shown) + moved;
    deformedCage.at[cage] = vec4(p, shown.w);
}
