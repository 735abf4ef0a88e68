// The pose pass: push constants, the layout of the clip table, of an instance's playback and of the scratch memory.
//
// Clip table (uvec4 elements, floats as bits), static, one an asset. Nodes are those that move a joint, sorted by
// depth, so that parents stand before children and a level's nodes side by side; kNodeElements each, from the first
// element on:
//   node       (parent or kNoNode, flags (kNodeFixed, ...), element of its rotation if its local matrix is fixed, 1 + its
//              number if it is a foot, else 0); then the three rows of the fixed matrix, or translation, rotation (x, y, z, w),
//              scale of the rest pose
//   rotation   one element each, of the nodes with a fixed matrix: the nearest to it (x, y, z, w)
//   joint      kJointElements each, from `joints` on: the three rows of the inverse bind matrix; (node, 0, 0, 0)
//   level      one element each, from `levels` on: (first node, end, 0, 0)
//   weights    from `restWeights` on: the file's morph weights, four an element
//   clip       one element each, from `clips` on: (first of its nodes' elements, first of its targets' elements or 0,
//              duration as a high and a low float). A packed clip has kPackedClip + its first element instead of the former
//   clip node  one element a node: channels of its translation, rotation and scale, or 0
//   clip target  one element a morph target: (channel or 0, place in a value, numbers of a value, 0)
//   packed clip  kPackedHeadElements: (frames a second as a float, number of the last frame, properties that change +
//              65536 * constants, segments); (first element of its masks, constants, segments, 0); (first of its nodes'
//              elements, for channels that are not packed, or 0; what the frames a second are more than that float, 0, 0). A property is the translation, rotation or scale of
//              a node; properties are counted by node, then in this order. Behind the last node, three morph weights count as the
//              translation of a node
//   masks      one element for every 16 nodes, a bit each: properties that change (translations + 65536 * rotations; low half:
//              scales), constants (high half of the second: scales; translations + 65536 * rotations); properties before these
//              nodes (those that change + 65536 * constants)
//   constants  two words each: three numbers of 20 bits with a sign, and in the last 4 bits (27 - their exponent) / 2
//   segment    (first record, first element of its data, frames, 0). While a segment of a clip with a coarse twin is
//              missing, the last is the first element of the twin: a packed clip of the same frames, whose nodes' elements
//              are not read; the first two then mean nothing
//   record     of a property in a segment: (frames that are knots, a bit each; 3 times 5 bits, its reference if it is a rotation, else
//              its base, 3 shifts of 4 bits, its exponent + 8; of x, y and z, the bits of an outer knot's number, 5 each, those of an
//              inner one's, 5 each; of x, y and z, 5 bits each with a sign, the lowest of the outer knots' numbers, as (these + 16 (base -
//              16)) * 2^shift, of rotations without the base). In the 2 high bits of the third and 17 of the last, from low to high:
//              where the first knot begins in the data, in bits
//   data       knot after knot x, y and z, and the knot at the segment's end last. Every second knot, from the first on, and the last
//              one are outer ones, from the lowest number on. Those between two of them are inner ones: what they are off the line
//              (shaders/pose/knots.h), from -2^(bits - 1) on. An inner knot and its neighbors have at most 129 bits
//   foot       one element each, from `contacts` on: (node, height of the joint over its sole in the rest pose, height of the
//              sole over the origin, 0)
//   foot of a clip  one element for every clip and foot of it: (first of its contacts, how many, 0, 0)
//   contact    kContactElements each, by rising time: (place x, z at the clip's time 0, what it moves by a second, x, z);
//              (begin, end in seconds of the clip, 1 / the seconds in which it takes hold, 0)
//   springs    if the character has some, kSpringHeadElements from `springs` on: (levels, their first element, chains, their
//              first element); (colliders, their first element, 0, 0)
//   spring level  one element each: (first, end, 0, 0) of elements that name a node in x: those above joints that swing and
//              above colliders, parents before children, a level's nodes side by side
//   chain      one element each: (first, end, 0, 0) of its nodes' elements: a joint that swings and all below it that springs
//              need, parents before children
//   node of a chain  kSpringNodeElements each: (node, its number among the joints that swing or kNoNode, first of its
//              colliders' references, how many); (the tail in the node's frame; stiffness of a step); (direction of gravity
//              in the world; its pull of a step); (the part of the way that is kept, radius, center node or kNoNode, 0)
//   reference  a word each, four an element: the number of a collider
//   collider   kColliderElements each: (node or kNoNode, kCollider flags, 0, 0); (point in the node's frame; radius); (a
//              capsule's other end, or a plane's normal; 0)
//   drivers    if morph weights follow from joints, one element from `drivers` on: (quads, 0, 0, 0); then
//   quad       one element each: (four morph weights by their number, first, end of its shares, 0)
//   share      kShareElements each, what a driver sets of a quad: (inputs, their first element, poses, first of their
//              rotations); the least that it sets, by weight; the most; (first coefficient, 1 / sigma^2 as a float, 0, 0)
//   input      kDriverInputElements each: (node, its number among those that drivers look at, kTurn part, weight as a
//              float); what undoes its rotation in the rest pose; (axis, 0)
//   rotation   one element each, pose after pose, for every input
//   coefficient  one element a pose, by weight of the quad
//   channel    (4 * keys + interpolation, keys a second as a float, element of the key times, of the values); times four an
//              element; a value is one element, morph weights are packed; a cubic spline has in-tangent, value, out-tangent a key
//
// Playback (uvec4 elements, one run of `stateStride` an instance), uploaded when it changes:
//   header     kStateElements: (layers, flags, root node or kNoNode, root axes);
//              three rows of the instance's transform;
//              travel: (translation of the first layer's root from the clip's time at the layer's start to the clip's
//              beginning; 0); (sine and cosine of half that turn; a loop's turn in double
//              turns, high and low); (what a loop moves by; 1) where it does not turn, else (x, height a loop, z; 0)
//              with the point (x, z) that the loop turns about
//   layer      kLayerElements each, kMaxPlaybackLayers of them, of which only the first `layers` are read:
//              (clip, flags, mask or 0, 0); (start, clip offset, of a loop within it: high and low floats each);
//              (speed, weight, fade weight, fade duration); (fade start, reference time: high and low each);
//              the root's position at the clip's beginning; its rotation
//   weights    the host's morph weights, four an element
//   modifiers  in groups that have them, kMaxModifiers, of which only as many are read as the flags say; kModifierElements each:
//              (kind + 256 * flags, length of the chain, 0, 0); nodes of the chain, two a word, the low half first, from the
//              top down to the joint; (weight, fade weight, fade duration, share of joints above the last one); (fade start,
//              high and low; cosine and sine of half the limit or, to lower, the distance and 0); (target; weight of the pole); (pole; soft) or, to aim, (the
//              eye in the joint's frame; 0); rotation; (axis in the joint's frame; 0)
//   transition in groups that have them, from `transition` on, read only if the flags say so: (begin, high and low float;
//              seconds; kind); kTransitionElements a node, in the order of the table; then two elements for every four morph
//              weights. Dead blending has: (rotation); (its speed, as the tangent of a quarter of the angle a second; scale x);
//              (translation; scale y); (its speed; scale z); weights, their speeds. A quintic has the differences to what is
//              played in these places. Its rotation is the tangent of a quarter of the angle, with the seconds that its speed
//              takes in w
//
// Masks (floats, four an element), kMaxMasks runs of `maskStride` elements: one value a node, from the next whole
// element on one a morph target. In groups with steps as many more: what they were in the last frame. What an instance has
// played before the last call names these.
//
// Pose (vec4 elements, one run of `poseStride` an instance): what the deform pass reads (shaders/shared/deform.h).
//
// Ends (vec4 elements, in groups with update rates): two poses an instance, `endStride` apart, at the two grid times that a time
// lies between; of number 1 and 2. They stand in model space, or where the instance has travelled to from there: the transform is
// left out. They serve later frames, so they have a buffer that stays on this queue.
// In groups where something is soft the buffer has the pose of each step of a round instead, in the order of the list, in model space.
//
// List of what is posed (words), in groups with update rates, made anew for every frame. For each window of instances: an entry for
// every pose that is due, slot | number of the end << kPosedEndShift, 0: what is shown; from `times` on two words for each of these, its time as a high and a
// low float; an entry for every instance that is shown between its ends, slot | number of the earlier one << kPosedEndShift;
// then a float for each of these, the part of the way from the earlier end to the later one.
// In groups with springs or what is soft the list has, for each window, rounds of steps. The first round has an entry for every pose
// that is shown, `shown` of them, and for each instance its last step. Rounds that come before it in the frame have the steps before
// that one. In each round: an entry for each step, slot | kPosedBefore if it is posed as before the last call | kPosedTravels if root
// motion travels; from `times` on the times of all entries; then kStepWords for each instance that runs steps or shows them:
//   slot; the first of its steps; its steps; the part of the way from the step before the last to the last, as a float; where its
//   moves begin or 0; its entry among those that are shown or kNotShown; how much is shown of what springs do, as a float; its steps
//   of what is soft, none while that sleeps; how much is shown of what these do, as a float
// Steps are how many | kStepLightCloths | a jump | the low 4 bits of the first one's number | kStepSettles, with the steps that are
// left out. Then moves, of each step: the three rows of how the model's frame at the step before lies in the one of this step, but
// for what root motion has travelled, the direction of the world's down in this step's, and the wind there; with cloths or wind all
// steps have them.
//
// Springs (vec4 elements, one run of `springStride` an instance): three rows of what it had travelled at the last step; then
// kSpringJointElements for every joint that swings: its tail after the last step, and before that, in model space or in the frame of
// its center; by how much its direction then was off the pose's, as unit vectors in the frame that it hangs in; the same a step before.
//
// Scratch (vec4 elements, one run of `scratchStride` an entry of the list): three a node, its local translation, rotation (x, y, z, w;
// of any length) and scale, then in their place the rows of its global matrix; three rows of the instance's transform with
// what it has travelled; then, if feet are planted, one for every foot: x of where it is held, times how firmly; how far it has
// been lowered; z as x; how firmly. A node whose local matrix is fixed has that, whatever stands here. With springs, from
// `springScratch` on: three rows of what the instance has travelled, if it does; two for every collider: (a point; radius, negative
// if tails stay inside), (the way to a capsule's other end; 1 / its square) or (a plane's normal; -1). Of a step only nodes that
// springs need are there.
#ifndef SUPPLE_SHARED_POSE_H
#define SUPPLE_SHARED_POSE_H

#include "shaders/shared/instances.h"
#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Descriptor bindings, set 0.
SUPPLE_SHARED_CONST kClipTableBinding = 0u;
SUPPLE_SHARED_CONST kClipTableTexelBinding = 1u;
SUPPLE_SHARED_CONST kStateBinding = 2u;
SUPPLE_SHARED_CONST kStateTexelBinding = 3u;
SUPPLE_SHARED_CONST kMaskBinding = 4u;
SUPPLE_SHARED_CONST kMaskTexelBinding = 5u;
SUPPLE_SHARED_CONST kScratchPoseBinding = 6u;
SUPPLE_SHARED_CONST kScratchPoseTexelBinding = 7u;
SUPPLE_SHARED_CONST kPosedBinding = 8u; // what the deform pass reads
SUPPLE_SHARED_CONST kEndsBinding = 9u;
SUPPLE_SHARED_CONST kEndsTexelBinding = 10u;
SUPPLE_SHARED_CONST kSpringBinding = 11u; // read and written

SUPPLE_SHARED_CONST kNoNode = 0xFFFFFFFFu;
SUPPLE_SHARED_CONST kNodeElements = 4u;
SUPPLE_SHARED_CONST kJointElements = 4u;
SUPPLE_SHARED_CONST kAffineElements = 3u;
SUPPLE_SHARED_CONST kContactElements = 2u;

// Flags of a node.
SUPPLE_SHARED_CONST kNodeFixed = 1u;      // its local matrix is
SUPPLE_SHARED_CONST kNodeOfSprings = 2u;  // steps of springs need it
SUPPLE_SHARED_CONST kNodeInChain = 4u;    // it swings, or hangs on one that does
SUPPLE_SHARED_CONST kNodeOfSoft = 8u;  // steps need it for what is soft

// Packed clips.
SUPPLE_SHARED_CONST kPackedClip = 0x80000000u;
SUPPLE_SHARED_CONST kPackedHeadElements = 3u;
SUPPLE_SHARED_CONST kSegmentFrames = 32u;

SUPPLE_SHARED_CONST kStateElements = 7u;
SUPPLE_SHARED_CONST kLayerElements = 6u;
SUPPLE_SHARED_CONST kMaxPlaybackLayers = 8u;
SUPPLE_SHARED_CONST kMaxMasks = 16u;

// Flags of an instance and of a layer.
SUPPLE_SHARED_CONST kStateBindPose = 1u;
SUPPLE_SHARED_CONST kStateHostWeights = 2u;
SUPPLE_SHARED_CONST kStateTravels = 4u;
SUPPLE_SHARED_CONST kStateTransition = 8u;
SUPPLE_SHARED_CONST kLayerLoops = 1u;
SUPPLE_SHARED_CONST kLayerAdds = 2u;

SUPPLE_SHARED_CONST kStateModifierShift = 8u; // 5 bits: how many modifiers

// Modifiers: values of SuppleModifierKind and SuppleModifierFlags.
SUPPLE_SHARED_CONST kMaxModifiers = 16u;
SUPPLE_SHARED_CONST kModifierElements = 8u;
SUPPLE_SHARED_CONST kMaxChain = 8u; // nodes
SUPPLE_SHARED_CONST kModifierSet = 0u;
SUPPLE_SHARED_CONST kModifierAdd = 1u;
SUPPLE_SHARED_CONST kModifierAim = 2u;
SUPPLE_SHARED_CONST kModifierTwoBone = 3u;
SUPPLE_SHARED_CONST kModifierHandOver = 4u;
SUPPLE_SHARED_CONST kModifierPlant = 5u;
SUPPLE_SHARED_CONST kModifierLower = 6u;
SUPPLE_SHARED_CONST kModifierWorld = 1u;
SUPPLE_SHARED_CONST kModifierPole = 2u;
SUPPLE_SHARED_CONST kModifierEndRotation = 4u;
SUPPLE_SHARED_CONST kModifierModel = 8u;

// Transitions: kinds, in the order of SuppleTransitionKind, behind none.
SUPPLE_SHARED_CONST kNoTransition = 0u;
SUPPLE_SHARED_CONST kDeadBlending = 1u;
SUPPLE_SHARED_CONST kQuintic = 2u;
SUPPLE_SHARED_CONST kTransitionElements = 4u;
SUPPLE_SHARED_FLOAT kTransitionReach = 0.072f; // seconds that what was shown goes on for at its first speed, at most
SUPPLE_SHARED_FLOAT kTransitionDecay = 13.888889f;  // 1 / kTransitionReach
SUPPLE_SHARED_FLOAT kTransitionStep = 0.0083333338f; // seconds over which speeds are found

// Update rates.
SUPPLE_SHARED_CONST kPoseEnds = 2u;
SUPPLE_SHARED_CONST kPosedEndShift = 28u; // two bits
#define SUPPLE_POSED_END(entry) (((entry) >> kPosedEndShift) & 3u)
SUPPLE_SHARED_CONST kMaxUpdateInterval = 8u; // steps of the grid
SUPPLE_SHARED_CONST kUpdateSteps = 60u;      // of the grid in a second

// Springs.
SUPPLE_SHARED_CONST kPosedBefore = 0x40000000u;
SUPPLE_SHARED_CONST kPosedTravels = 0x80000000u;
SUPPLE_SHARED_CONST kStepsASecond = 60u;    // of the grid in a second
SUPPLE_SHARED_FLOAT kStepSeconds = 0.016666668f; // between two of them
SUPPLE_SHARED_CONST kMostDueSteps = 8u; // in a frame
// Rounds of an invocation's loops in a step: eight must not come near the 65,536 where some drivers end it.
SUPPLE_SHARED_CONST kMostStepWork = 7000u;
SUPPLE_SHARED_CONST kStepWords = 9u;
SUPPLE_SHARED_CONST kMoveWords = 18u;
SUPPLE_SHARED_CONST kStepSettles = 0x80000000u; // tails at rest in the pose
SUPPLE_SHARED_CONST kStepCountMask = 15u;
SUPPLE_SHARED_CONST kStepLightCloths = 0x10u; // cloths are springs
SUPPLE_SHARED_CONST kNotShown = 0xFFFFFFFFu; // in the place of an entry
SUPPLE_SHARED_CONST kStepJumpShift = 8u; // 4 bits: 1 + the number of a step to which it has not moved
SUPPLE_SHARED_CONST kStepNumberShift = 12u; // 4 bits: the last of the first step's number
SUPPLE_SHARED_CONST kStepNumbers = 16u;     // that these tell apart: more than a frame has steps
SUPPLE_SHARED_CONST kStepSkippedShift = 16u; // 15 bits, beside kStepSettles: steps that are left out
SUPPLE_SHARED_CONST kMostSkippedSteps = 0x7FFFu; // nine minutes; more count as these
SUPPLE_SHARED_CONST kSpringHeadElements = 2u;
SUPPLE_SHARED_CONST kSpringNodeElements = 4u;
SUPPLE_SHARED_CONST kColliderElements = 3u;
SUPPLE_SHARED_CONST kColliderInside = 1u;
SUPPLE_SHARED_CONST kColliderPlane = 2u;
SUPPLE_SHARED_CONST kPosedColliderElements = 2u;
SUPPLE_SHARED_CONST kSpringJoints = 3u; // where they begin in an instance's run
SUPPLE_SHARED_CONST kSpringJointElements = 4u;

// Beside flags of nodes in PosePush::stepNodes: what is soft needs palettes and morph weights of steps.
SUPPLE_SHARED_CONST kStepsHavePoses = 0x80000000u;
// And those are of all nodes, for delta mush: it has joints for a vertex that the vertex itself does not follow.
SUPPLE_SHARED_CONST kStepsPoseAll = 0x40000000u;

// Drivers.
SUPPLE_SHARED_CONST kShareElements = 4u;
SUPPLE_SHARED_CONST kDriverInputElements = 3u;
SUPPLE_SHARED_CONST kMaxDriverInputs = 4u;
SUPPLE_SHARED_CONST kTurnWhole = 0u;
SUPPLE_SHARED_CONST kTurnSwing = 1u;
SUPPLE_SHARED_CONST kTurnTwist = 2u;

// Axes of root motion; values of SuppleRootMotionFlags.
SUPPLE_SHARED_CONST kGroundAxes = 1u;
SUPPLE_SHARED_CONST kHeightAxis = 2u;
SUPPLE_SHARED_CONST kYawAxis = 4u;

// Interpolation of a channel.
SUPPLE_SHARED_CONST kStepKeys = 0u;
SUPPLE_SHARED_CONST kLinearKeys = 1u;
SUPPLE_SHARED_CONST kCubicKeys = 2u;

// Wide mapping: nodes whose matrices fit into the 16 KiB of workgroup memory that every device has. Larger skeletons stay
// in the scratch memory.
SUPPLE_SHARED_CONST kWorkgroupNodes = 320u;

#ifdef __cplusplus
constexpr
#endif
uint modifiersBegin(uint morphCount) {
    return kStateElements + kMaxPlaybackLayers * kLayerElements + (morphCount + 3u) / 4u;
}

struct PosePush {
    float timeHigh; // the group's time
    float timeLow;
    uint firstInstance; // of the list
    uint instanceCount; // of this window, or entries of the list of what is posed
    uint nodeCount;
    uint jointCount;
    uint morphCount; // weights that the deform pass reads
    uint joints;     // sections of the clip table
    uint levels;
    uint levelCount;
    uint restWeights;
    uint clips;
    uint stateStride;
    uint maskStride;
    uint scratchStride;
    uint poseStride;
    uint morphWeights; // first element of the weights in an instance's pose
    uint transition;   // first element of the transition in an instance's state
    uint contacts;     // section of the clip table
    uint footCount;    // 0: none is planted
    uint endStride;    // from one end of an instance, or the pose of one step, to the next
    uint times;        // word of the list where the times of its entries begin; 0: all are posed at the group's time
    uint shown;        // entries before this one are shown, others are steps
    uint stepNodes;    // flags of nodes that steps need, all if there are none; kStepsHavePoses, kStepsPoseAll
    uint stateBefore;  // from an instance's state to what it played before the last call
    uint springs;      // section of the clip table
    uint springScratch;
    uint springStride;
    uint stepWords;  // word of the list where instances that swing begin
    uint drivers;      // section of the clip table; 0: no morph weights follow from joints
};

SUPPLE_SHARED_END

#endif
