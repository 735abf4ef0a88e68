// What is soft of a cage, vertices that jiggle and cloths: bindings, push constants, the layout of tables and of an instance's state.
//
// Jiggles' table (uvec4 elements), two for every vertex that jiggles: (cage vertex; weight, limit as float bits; 0);
// (exp(h [[0, 1], [-k, -c]]) of a step h, row after row, as float bits), by which a spring goes on for a step
//
// Their state (vec4 elements, one run of `stateStride` an instance): kStepNumbers times three rows, where root motion had taken the
// instance at a step, by the low 4 bits of the step's number; then kJiggleElements for every vertex:
//   (offset from the goal; x of `before`), (its speed; y of `before`), (goal; z of `before`), (speed of the goal; what is known)
// The goal is where joints have the vertex in the step's pose; `before` is the offset a step earlier. Known is nothing (0), the
// goal (1), what may be a part of its speed (2), or its speed too (3). All of it lies in the model's frame of the last step, without what root motion has travelled.
//
// Cloths' table (uvec4 elements): kClothHeadElements for every cloth, then what these say. Floats are as bits.
//   head       (vertices; how many of them hang on joints, the first ones; the first one's element; state elements of each);
//              (colors; the first one's element; faces whose volume is kept, or 0; the first one's element);
//              (colliders; the first one's element; substeps; where its state begins in an instance's run);
//              (seconds of a substep; speed kept in one; lost to the air in one; the farthest that a vertex goes in one);
//              (substeps a second; speed by gravity in one; six times the rest volume; by how much that gives, over the square of seconds);
//              (radius of vertices against colliders; 0, 0, 0);
//              (the exponential of a step of the spring that a light cloth is, as jiggles have it)
//   vertex     kClothVertexElements: (cage vertex; inverse mass, 0: it hangs; the vertex of the cloth that it is tethered to or
//              kClothFree; the tether's length); (where it comes to rest, from where joints have it in the rest pose; 0);
//              (the first of the faces around it, the end; 0, 0)
//   color      (its first constraint, the end; 0, 0): no vertex is in two of them
//   constraint (two vertices of the cloth; their distance at rest; 1 / (inverse masses + compliance over the square of seconds))
//   face       (three vertices of the cloth; 0); around a vertex: (the other two, in the face's order; 0, 0)
//   collider   kColliderElements, as springs have them (shaders/shared/pose.h), but it hangs on a joint of the skin, or is kClothFree, and
//              its points are those of the bind pose
//
// Their state (vec4 elements, one run of `stateStride` an instance), for every cloth kClothVertices: three rows of what root motion
// had travelled at the last step, three of the last step's move, (what is known as of jiggles; 0, 0, 0); then for every vertex:
//   (place; x of `before`), (its speed or, if it hangs, where to; y of `before`), (offset from where joints have it; z of `before`),
//   (speed of the model's frame there, off the wind's; 0), and if a volume is kept (by how much a vertex changes it; 0)
#ifndef SUPPLE_SHARED_SOFT_H
#define SUPPLE_SHARED_SOFT_H

#include "shaders/shared/instances.h"
#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Descriptor bindings, set 0; those of the deform pass are what they are there: the steps' poses are bound as poses.
SUPPLE_SHARED_CONST kSoftTableBinding = 5u;
SUPPLE_SHARED_CONST kSoftTableTexelBinding = 6u;
SUPPLE_SHARED_CONST kSoftStateBinding = 7u;
SUPPLE_SHARED_CONST kSoftPlaceBinding = 8u; // the scratch memory of the pose pass
SUPPLE_SHARED_CONST kSoftPlaceTexelBinding = 9u;

SUPPLE_SHARED_CONST kJiggleTableElements = 2u;
SUPPLE_SHARED_CONST kJiggleVertices = 48u; // where they begin in an instance's run: behind 3 * kStepNumbers
SUPPLE_SHARED_CONST kJiggleElements = 4u;

SUPPLE_SHARED_CONST kClothHeadElements = 7u;
SUPPLE_SHARED_CONST kClothVertexElements = 3u;
SUPPLE_SHARED_CONST kClothFree = 0xFFFFFFFFu;
SUPPLE_SHARED_CONST kClothVertices = 7u; // where they begin in a cloth's state
SUPPLE_SHARED_CONST kClothElements = 4u;
// What a workgroup has in its memory, of which every device has 16 KiB.
SUPPLE_SHARED_CONST kMostClothVertices = 512u;
SUPPLE_SHARED_CONST kMostClothColliders = 16u;
SUPPLE_SHARED_FLOAT kLightClothFrequency = 1.5f; // a second
SUPPLE_SHARED_FLOAT kLeastLightDamping = 0.2f;   // of the critical one
SUPPLE_SHARED_FLOAT kMostClothKick = 5.0f; // units a second, of what a step of the model's frame does to a vertex
SUPPLE_SHARED_CONST kClothSums = 256u; // a power of two: sums over a cloth are those of a tree with so many leaves

struct SoftPush {
    uint count;           // vertices that jiggle, or cloths
    uint firstInstance;   // where the list of what is posed begins
    uint instanceCount;   // that have steps, or show what steps have left
    uint stepping;        // word of the list where these begin
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
