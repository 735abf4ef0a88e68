// The deform pass: push constants, the layout of its static table and of an instance's pose.
//
// Table (uvec4 elements): one record a cage vertex and one more, then every vertex's run of elements; where the cage
// has morph targets, four words an element with the first influence of every vertex follow; where it is skinned by
// centers of rotation or delta mush, an element a vertex with its center follows.
//   vertex     (x, y, z as float bits; first element of its run); a run ends where the next vertex's begins
//   run        displacements, one an element: (morph target, x, y, z as float bits); then
//              influences, two an element: (joint, weight bits, joint, weight bits), the heaviest first; an odd list is
//              filled up with weight 0
//              light delta mush, three elements for two influences: those two, then (x, y, z, 0) of the offset of each
//              delta mush, three elements an influence: (joint, weight bits, offset x, y), (offset z, spread xx, xy, xz),
//              (spread yy, yz, zz, 0)
//   center     (x, y, z, 1 as float bits), or zeros: the vertex has none and is skinned linearly. Delta mush: its smoothed place
//
// Offset and spread: the first and second moments, about that place, of what the joint moves of the vertex' neighborhood
// (skinning/delta_mush.h).
//
// Pose (vec4 elements, one run of `poseStride` an instance), uploaded every frame:
//   rows               three rows a joint, of its matrix with the instance's transform before it
//   rows, rotations    three rows of the instance's transform; then four elements a joint: the rows of its matrix, and
//                      its rotation as a unit quaternion (x, y, z, w)
//   then, where the cage has morph targets, their weights, four an element
#ifndef SUPPLE_SHARED_DEFORM_H
#define SUPPLE_SHARED_DEFORM_H

#include "shaders/shared/instances.h"
#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Descriptor bindings, set 0. Every table is bound twice: GPUs load it as a storage buffer, CPU devices as texels.
SUPPLE_SHARED_CONST kDeformTableBinding = 0u;
SUPPLE_SHARED_CONST kDeformTableTexelBinding = 1u;
SUPPLE_SHARED_CONST kPoseBinding = 2u;
SUPPLE_SHARED_CONST kPoseTexelBinding = 3u;
SUPPLE_SHARED_CONST kDeformedCageBinding = 4u;

SUPPLE_SHARED_CONST kLinearElements = 3u;    // pose elements a joint
SUPPLE_SHARED_CONST kRotationElements = 4u;  // and with rotations,
SUPPLE_SHARED_CONST kRotationTransform = 3u; // behind the instance's transform

// How joints move vertices: skinning::SkinningMode.
SUPPLE_SHARED_CONST kLinearSkinning = 0u;         // poses of rows
SUPPLE_SHARED_CONST kDualQuaternionSkinning = 1u; // poses of rows and rotations
SUPPLE_SHARED_CONST kCenterSkinning = 2u;         // the same, and the table has centers
SUPPLE_SHARED_CONST kMushSkinning = 3u;           // the same, and moments
SUPPLE_SHARED_CONST kLightMushSkinning = 4u;      // the same, but for spreads

SUPPLE_SHARED_CONST kMushElements = 3u;      // table elements an influence
SUPPLE_SHARED_CONST kLightMushElements = 3u; // for two

struct DeformPush {
    uint vertexCount;
    uint firstInstance; // of the list
    uint instanceCount; // of this window
    uint poseStride;
    uint cageStride;      // vertices an instance in the deformed cage
    uint morphWeights;    // first element of the weights in an instance's pose
    uint firstInfluences; // table element of the vertices' first influences
    uint firstCenter;     // table element of the first vertex' center
};

SUPPLE_SHARED_END

#endif
