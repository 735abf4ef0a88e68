// Ids of the specialization constants of all kernels. One id has one meaning, whatever kernel has the constant: a
// pipeline may be given constants that its kernel does not have.
#ifndef SUPPLE_SHARED_SPECIALIZATION_H
#define SUPPLE_SHARED_SPECIALIZATION_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Every kernel (shaders/shared/mapping.glsl; gpu/pipeline.cpp sets them).
SUPPLE_SHARED_CONST kLocalSizeConstant = 0u;     // lanes per workgroup; a kernel may have a number of its own
SUPPLE_SHARED_CONST kExactDivisionConstant = 1u; // bool: the device rounds division correctly
SUPPLE_SHARED_CONST kMaxLanes = 128u;            // of a workgroup

// Surface kernels.
SUPPLE_SHARED_CONST kKindConstant = 2u;          // which kind of work: each kernel says what its kinds are
SUPPLE_SHARED_CONST kVertexFormatConstant = 3u;  // kVertex16, kVertex24 or kVertexPosition
SUPPLE_SHARED_CONST kCornerNormalsConstant = 4u; // bool: patch records have an element of corner normals
SUPPLE_SHARED_CONST kInteriorConstant = 5u;      // bool: samples inside patches alone; edges have theirs from elsewhere
SUPPLE_SHARED_CONST kRateConstant = 6u;          // tessellation rate; 0: the push constants tell it
SUPPLE_SHARED_CONST kLanePatchConstant = 17u;    // bool: wide mapping at kRateConstant: a lane takes a patch of kVertex16
SUPPLE_SHARED_CONST kLinesConstant = 20u;        // bool: at levels in the wide mapping lanes take lines (kRunHasLines)
SUPPLE_SHARED_CONST kOutputsConstant = 7u;       // kOutputUvs1, kOutputFaceUvs: what is written beside the attributes

// Subdivision.
SUPPLE_SHARED_CONST kLoopConstant = 8u;              // bool: Loop's rules, else Catmull-Clark's
SUPPLE_SHARED_CONST kSourceConstant = 9u;           // kFromScratch, kFromNet or kFromPastNet
SUPPLE_SHARED_CONST kWorkConstant = 10u;            // kInBulk or kOneByOne
SUPPLE_SHARED_CONST kWorkgroupPointsConstant = 11u; // points that workgroup memory has room for

// Skinning and poses.
SUPPLE_SHARED_CONST kMorphsConstant = 12u;          // bool: the cage has morph targets
SUPPLE_SHARED_CONST kSkinningConstant = 13u;        // kLinearSkinning, kDualQuaternionSkinning or kCenterSkinning
SUPPLE_SHARED_CONST kWorkgroupRowsConstant = 14u;   // matrix rows that workgroup memory has room for
SUPPLE_SHARED_CONST kRotationsConstant = 19u;       // bool: poses are rows and rotations, else rows alone

// Poses: what no pose of a group asks for is left out. All bool.
SUPPLE_SHARED_CONST kListedConstant = 21u;      // the group lists what is posed: ends and steps beside what is shown
SUPPLE_SHARED_CONST kKeyedClipsConstant = 22u;  // some clip has channels of keys
SUPPLE_SHARED_CONST kPackedClipsConstant = 23u; // some clip is packed
SUPPLE_SHARED_CONST kCoarseTwinsConstant = 24u; // some packed clip has a coarse twin

// Tangents.
SUPPLE_SHARED_CONST kTangentsConstant = 15u; // bool: evaluation writes tangents
SUPPLE_SHARED_CONST kSectorsConstant = 16u;  // bool: patches are sectors round a centre (P_m)

SUPPLE_SHARED_CONST kSemiSharpConstant = 18u; // bool: smooth texture coordinates of triangles have semi-sharp creases

SUPPLE_SHARED_END

#endif
