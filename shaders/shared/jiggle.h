// Vertices that jiggle: push constants, the layout of their static table and of an instance's state.
//
// Table (uvec4 elements), two for every vertex that jiggles: (cage vertex; weight, limit as float bits; 0);
// (exp(h [[0, 1], [-k, -c]]) of a step h, row after row, as float bits), by which a spring goes on for a step
//
// State (vec4 elements, one run of `stateStride` an instance): kSpringNumbers times three rows, where root motion had taken the
// instance at a step, by the low 4 bits of the step's number; then kJiggleElements for every vertex:
//   (offset from the goal; x of `before`), (its speed; y of `before`), (goal; z of `before`), (speed of the goal; what is known)
// The goal is where joints have the vertex in the step's pose; `before` is the offset a step earlier. Known is nothing (0), the
// goal (1), what may be a part of its speed (2), or its speed too (3). All of it lies in the model's frame of the last step, without what root motion has travelled.
#ifndef SUPPLE_SHARED_JIGGLE_H
#define SUPPLE_SHARED_JIGGLE_H

#include "shaders/shared/instances.h"
#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Descriptor bindings, set 0; those of the deform pass are what they are there: the steps' poses are bound as poses.
SUPPLE_SHARED_CONST kJiggleTableBinding = 5u;
SUPPLE_SHARED_CONST kJiggleTableTexelBinding = 6u;
SUPPLE_SHARED_CONST kJiggleStateBinding = 7u;
SUPPLE_SHARED_CONST kJigglePlaceBinding = 8u; // the scratch memory of the pose pass
SUPPLE_SHARED_CONST kJigglePlaceTexelBinding = 9u;

SUPPLE_SHARED_CONST kJiggleTableElements = 2u;
SUPPLE_SHARED_CONST kJiggleVertices = 48u; // where they begin in an instance's run: behind 3 * kSpringNumbers
SUPPLE_SHARED_CONST kJiggleElements = 4u;

struct JigglePush {
    uint vertexCount;     // that jiggle
    uint firstInstance;   // where the list of what is posed begins
    uint instanceCount;   // that have steps, or show what steps have left
    uint swinging;        // word of the list where these begin
    uint shown;           // entries of the list before this one are shown, others are steps
    uint scratchStride;
    uint place;           // of an instance, in its run of the scratch memory
    uint way;             // what it has travelled, there
    uint stepStride;      // from one step's pose to the next
    uint stateStride;
    uint cageStride;
    uint morphWeights;    // as in DeformPush
    uint firstInfluences;
    uint firstCenter;
};

SUPPLE_SHARED_END

#endif
