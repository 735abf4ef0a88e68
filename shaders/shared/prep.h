// The p-rep passes: descriptor bindings, push constants and the layouts of the static tables.
//
// Coefficient pool (vec4 elements, one run of `poolStride` an instance): limit points X (one a cage vertex), tangents TG
// and face coefficients FC (one a spoke slot each), edge coefficients H (four a perturbed edge: h20, h30, h21, h31 in
// the edge's own direction), one zero. The FC slot of a boundary fan's last spoke carries no sector; it holds the vertex
// normal e1 x e2.
//
// Tables (one buffer, read as uvec4 or as uint):
//   vertex records   (cage vertex, spoke slot, class element, 0): regular interior vertices first
//   ring             two words a spoke slot: the spoke's vertex, the diagonal of its sector
//   classes          (sectors | kBoundaryClass, 0, 0, 0), then two elements a spoke:
//                    (limitEdge, limitFace, e1Edge, e1Face), (e2Edge, e2Face, cosine, sine)
//   edge records     three elements: pool indices (A, tA, tB, B), (SA1, SA2, SB1, SB2), (H index, edge class element, 0, 0)
//   edge classes     six elements, for A, tA, tB, B, SA, SB: their weights in (h20, h30, h21, h31)
//   patch records    pool indices: regular 16 g (i + 4 j), perturbed 16 g + 16 h in evaluation order (below);
//                    then one element: for each corner the pool index of its normal, or kNoNormal
//   attributes       four elements a patch, one a corner: (u, v, color as RG and BA in 16-bit unorm)
#ifndef SUPPLE_SHARED_PREP_H
#define SUPPLE_SHARED_PREP_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_CONST kTableBinding = 0u;
SUPPLE_SHARED_CONST kTable4TexelBinding = 1u;
SUPPLE_SHARED_CONST kTable1TexelBinding = 2u;
SUPPLE_SHARED_CONST kCageBinding = 3u;
SUPPLE_SHARED_CONST kCageTexelBinding = 4u;
SUPPLE_SHARED_CONST kPoolBinding = 5u;
SUPPLE_SHARED_CONST kPoolTexelBinding = 6u;
SUPPLE_SHARED_CONST kSurfaceBinding = 7u;
SUPPLE_SHARED_CONST kPatchCoefficientBinding = 8u;
SUPPLE_SHARED_CONST kAttributeBinding = 9u;
SUPPLE_SHARED_CONST kPairBinding = 10u;

SUPPLE_SHARED_CONST kBoundaryClass = 0x80000000u;
SUPPLE_SHARED_CONST kNoNormal = 0xFFFFFFFFu;

SUPPLE_SHARED_CONST kMaxPatchesPerGroup = 8u; // wide mapping: what the shared memory of evaluate.comp holds
SUPPLE_SHARED_CONST kRegularElements = 5u;   // table elements of a regular patch record
SUPPLE_SHARED_CONST kPerturbedElements = 9u; // and of a perturbed one

// Where the sections of the tables and of the pool lie, and what a dispatch covers.
struct PrepPush {
    uint count;         // elements an instance: vertices, edges, patches or patch samples
    uint instanceCount; // of this window
    uint table;         // first table element of the pass's records
    uint ring;          // first table word of the ring
    uint cageStride; // cage vertices an instance in the deformed cage
    uint poolStride;
    uint tangents; // first TG in the pool
    uint faces;    // first FC in the pool
    uint rate;
    uint firstPatch; // of this range in device order
    uint patchCount; // of all ranges
    uint verticesPerInstance;
    uint pairs;           // first parameter pair of the rate
    uint patchesPerGroup; // wide mapping: patches a workgroup evaluates
};

SUPPLE_SHARED_END

// Evaluation order of the 16 perturbation coefficients (h_2j, h_3j for j = 0, 1, 4, 5; h_i2, h_i3 for i = 0, 1, 4, 5) to
// face edge order h[4 e + s], s = local (2,0), (3,0), (2,1), (3,1) of face edge e.
#define SUPPLE_PREP_FACE_EDGE_ORDER 0u, 2u, 11u, 9u, 1u, 3u, 10u, 8u, 13u, 12u, 15u, 14u, 6u, 7u, 4u, 5u

#endif
