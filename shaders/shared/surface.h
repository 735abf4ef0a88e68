// What the passes of all surface schemes share: descriptor bindings, push constants, the records evaluation reads.
//
// Coefficient pool: vec4 elements, one run of `poolStride` an instance; what lies where is the scheme's (shared/prep.h,
// shared/pm.h). A group has a run for every slot. In the pool of a view only instances that are drawn have a place, which holds
// the runs of all their surfaces. The list pass says where it begins, in units of kPoolUnit. Every scheme stores canonical
// values: no -0. Limit points are positions; tangents and face coefficients are offsets from their corner's limit point, so
// that beside sharp creases, where they are small, they keep all of float's digits however far from the origin the patch lies.
// A coefficient's position is always the one sum limit point + offset, so that both sides of a border see the same bits.
//
// Tables (one block, read as uvec4 or as uint) begin with their header (shared/table_header.h) and with what the scheme's
// construction needs. They end with
//   patch records    bicubic (regular, perturbed, polar): two elements, for corners 0..3 the pool indices of the limit points,
//                    then the spokes; a spoke, SUPPLE_SPOKE and SUPPLE_NEXT_SPOKE, is the number of the corner's edge to the next
//                    corner among tangents and face coefficients, and the step from it to that of the edge to the last corner. A
//                    polar patch has three corners, then the pool index of its first inner coefficient; and see shared/pm.h.
//                    Perturbed: one element more, see shared/prep.h. P_m: see shared/pm.h. Where the group keeps corner normals
//                    (kCornerNormals), one more element, for each corner the pool index of its normal, or kNoNormal
//   ring             p-rep, P_m: what a vertex's fan is made of, one word a spoke: the element that holds the corners of the
//                    facet behind the spoke, and where in it stand (SUPPLE_RING_PLACE) the vertex itself, the spoke's far end and
//                    the facet's two other far corners, a quad's twice. The element is the first of a patch's record, whose limit
//                    points are numbered as the cage's vertices are, or one of its own: of holes, and where a crease gives a
//                    vertex several limit points. A fan's last spoke without a facet has the vertex for far corners
//   attributes       one element for all corners that have the same: (u, v, color as RG and BA in 16-bit unorm); with a second UV
//                    set or face UVs one more: (u, v of the second set, x, y of the face UVs), 0 where there are none; with
//                    kOutputMapFrames one more: (a unit vector, a sign, a UV set as uint), how the material's normal map lies
//   numbers of them  one word a patch corner, or with `attributeHalves` one for two, the first in the low half; every class of
//                    patches begins an element
//   smooth UVs       where texture coordinates are smooth, in the order of patches, per UV set what SmoothPatch of
//                    evaluate/smooth_uvs.glsl has: two coefficients an element. Catmull-Clark and Loop: records as irregular patches
//                    have them, of pairs of floats of the table (surface/chains/smooth_uvs.h). Fragments: the samples of a rate
//   mesh edges       indexed mesh: three elements an edge, as one of its patches has it on its left: pool indices of the border
//                    cubic (end, its tangent, the other end's tangent, other end); of four offsets that the derivative across is
//                    made of; (corner sample at its beginning, or kNoEdgeSample where another edge stores it; the edge; flags;
//                    extra). Extra: perturbed edges: h20, the others of the four follow, or by kSwappedEdge stand as h30 h20 h31
//                    h21; kStoredNormalEdge: the normal of the beginning; kSingularEdge: b121 of the sector before. Sides of
//                    irregular quads and of Loop patches instead of the first eight words: (element of the record, side)
//   edge attributes  one element a record: (the word with the first of its patch's corner numbers; the edge's side of the patch,
//                    kPatchCornersShift: the patch's corners, kPatchHasSectors, kPatchHalfShift: 1 if that number is the high half
//                    of the word; element of the smooth UV curves or 0, -). The curves: six elements a UV set, the four
//                    coefficients of a cubic, h20, h30, the four coefficients of the derivative across, h21 - h20, h31 - h30
#ifndef SUPPLE_SHARED_SURFACE_H
#define SUPPLE_SHARED_SURFACE_H

#include "shaders/shared/instances.h"
#include "shaders/shared/portable.h"
#include "shaders/shared/table_header.h"
#include "shaders/shared/window.h"
#include "shaders/supple_patch_layout.h"

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
SUPPLE_SHARED_CONST kUv1Binding = 10u;
SUPPLE_SHARED_CONST kPairBinding = 11u;
SUPPLE_SHARED_CONST kScratchBinding = 12u;
SUPPLE_SHARED_CONST kScratchTexelBinding = 13u;
SUPPLE_SHARED_CONST kFaceUvBinding = 14u;
// 15 to 18: shared/instances.h, shared/lod.h
SUPPLE_SHARED_CONST kTangentBinding = 19u;
SUPPLE_SHARED_CONST kDirectionBinding = 20u;       // read by evaluation,
SUPPLE_SHARED_CONST kDirectionOutputBinding = 21u; // and written by attributes
// 22: shared/table_header.h
// Motion of groups in a view: kPoolBinding has the coefficients of the frame before, and this one those of this frame, which
// instances without a past take.
SUPPLE_SHARED_CONST kTodaysPoolBinding = 23u;
SUPPLE_SHARED_CONST kTodaysPoolTexelBinding = 24u;

SUPPLE_SHARED_CONST kPoolUnit = 16u; // coefficients: 256 bytes, as descriptors may begin there

// Classes of patches; values of SupplePatchClass.
SUPPLE_SHARED_CONST kRegularPatch = 0u;
SUPPLE_SHARED_CONST kPerturbedPatch = 1u;
SUPPLE_SHARED_CONST kPolarPatch = 2u;
SUPPLE_SHARED_CONST kP3Patch = 3u;
SUPPLE_SHARED_CONST kP4Patch = 4u;
SUPPLE_SHARED_CONST kP5Patch = 5u;
SUPPLE_SHARED_CONST kFragmentPatch = 6u;
SUPPLE_SHARED_CONST kLoopPatch = 7u;
SUPPLE_SHARED_CONST kBlendPatch = 8u;
SUPPLE_SHARED_CONST kBlendSharpPatch = 9u;
SUPPLE_SHARED_CONST kTrianglePatch = 10u;
// Exact Catmull-Clark; what they have in common is told by kIrregularPatch and above.
SUPPLE_SHARED_CONST kIrregularPatch = 11u;
SUPPLE_SHARED_CONST kIrregularSharpPatch = 12u;
SUPPLE_SHARED_CONST kCreasedPatch = 13u;
SUPPLE_SHARED_CONST kLoopRegularPatch = 14u;
SUPPLE_SHARED_CONST kLoopIrregularPatch = 15u;
SUPPLE_SHARED_CONST kLoopIrregularSharpPatch = 16u;
SUPPLE_SHARED_CONST kBlendRegularPatch = 17u;

// Domains; values of SuppleDomain.
SUPPLE_SHARED_CONST kQuadDomain = 0u;
SUPPLE_SHARED_CONST kPolarDomain = 1u;
SUPPLE_SHARED_CONST kTriangleDomain = 2u;
SUPPLE_SHARED_CONST kPentagonDomain = 3u;
SUPPLE_SHARED_CONST kEdgeDomain = 4u;   // none of a patch: attributes of an indexed mesh along edges
SUPPLE_SHARED_CONST kVertexDomain = 5u; // none of a patch: attributes of the vertices of polygons

// What evaluation writes a sample.
SUPPLE_SHARED_CONST kVertex16 = 0u;       // position, octahedral normal in 2 x snorm16
SUPPLE_SHARED_CONST kVertex24 = 1u;       // position, normal
SUPPLE_SHARED_CONST kVertexPosition = 2u; // position alone, 12 bytes: where a sample was before

SUPPLE_SHARED_CONST kOutputUvs1 = 1u;
SUPPLE_SHARED_CONST kOutputFaceUvs = 2u;
SUPPLE_SHARED_CONST kOutputDirections = 4u;
SUPPLE_SHARED_CONST kOutputMapFrames = 8u; // no output: with directions, corners have the frames of normal maps
SUPPLE_SHARED_CONST kOutputColors = 16u;   // no output: some corner has a color, else all samples are white

// Tangents. A direction word says where the tangent of a sample points, in the two derivatives of its patch (docs/tangents.md): a
// in snorm16, b in snorm15, then 1 where the sign of the frame is negative. No pose changes it. A tangent word is what a host
// reads: octahedral coordinates in snorm16 and snorm15, then that bit.
SUPPLE_SHARED_CONST kNegativeFrame = 0x80000000u;

SUPPLE_SHARED_CONST kNoNormal = SUPPLE_NO_NORMAL;

// Spokes in records of bicubic patches.
SUPPLE_SHARED_CONST kSpokeBits = SUPPLE_SPOKE_BITS;
SUPPLE_SHARED_CONST kMaxSpokes = 1u << kSpokeBits;
SUPPLE_SHARED_CONST kMaxSpokeStep = 511u; // up or down
SUPPLE_SHARED_CONST kPointBits = SUPPLE_POINT_BITS; // limit points in records

// Kinds of fans: specialization of the vertex stage. Creased and variable ones are P_m's alone. Catmull-Clark has one more
// (shared/chains.h).
SUPPLE_SHARED_CONST kRegularFan = 0u; // closed, four facets, no crease
SUPPLE_SHARED_CONST kFewFan = 1u;     // up to kFewSpokes spokes
SUPPLE_SHARED_CONST kManyFan = 2u;
SUPPLE_SHARED_CONST kCreasedFan = 3u;
SUPPLE_SHARED_CONST kVariableFan = 4u; // creased, with edges of crease sets
SUPPLE_SHARED_CONST kFewSpokes = 6u;

// Crease sets: what instances say of their edges, kCreaseSetElements an instance. A number is P_m's alpha, or negative: the
// edge has its own.
SUPPLE_SHARED_CONST kAlphaBinding = 25u;
SUPPLE_SHARED_CONST kAlphaTexelBinding = 26u;
SUPPLE_SHARED_CONST kMaxCreaseSets = 64u;
SUPPLE_SHARED_CONST kCreaseSetElements = kMaxCreaseSets / 4u; // 256 bytes, as descriptors may begin there

// Words of the ring.
SUPPLE_SHARED_CONST kRingPlaceBits = 8u;
SUPPLE_SHARED_CONST kRingVertex = 0u;
SUPPLE_SHARED_CONST kRingFarEnd = 1u;
SUPPLE_SHARED_CONST kRingFarCorner = 2u;
SUPPLE_SHARED_CONST kRingOtherCorner = 3u;
#define SUPPLE_RING_ELEMENT(word) ((word) >> kRingPlaceBits)
#define SUPPLE_RING_PLACE(word, which) ((word) >> 2u * (which)&3u)

// The 16 coefficients of a bicubic patch, row by row in v: the corner, and what of it. Polar patches repeat the apex.
SUPPLE_SHARED_CONST kNetPoint = 0u;
SUPPLE_SHARED_CONST kNetTangent = 1u;     // of the spoke
SUPPLE_SHARED_CONST kNetNextTangent = 2u; // of the next spoke
SUPPLE_SHARED_CONST kNetFace = 3u;        // of the spoke
SUPPLE_SHARED_CONST kNetBehind = 4u;      // behind the point
// Two bits a coefficient, from the lowest on: GPUs keep arrays that lanes index differently in memory.
#define SUPPLE_NET_CORNER(k) (0xAFAF5050u >> 2u * (k)&3u)                               // 0011 0011 3322 3322
#define SUPPLE_NET_KIND(k) (0x18BD7E24u >> 2u * (k)&3u)                                 // 0120 2331 1332 0210
#define SUPPLE_POLAR_NET_CORNER(k) (0xAABE5050u >> 2u * (k)&3u)                         // 0011 0011 2332 2222
#define SUPPLE_POLAR_NET_KIND(k) ((k) == 10u ? kNetBehind : 0x00817E24u >> 2u * (k)&3u) // 0120 2331 1042 0000

// Indexed mesh: kinds of edges, each a kernel.
SUPPLE_SHARED_CONST kPlainEdges = 0u;     // of bicubic patches
SUPPLE_SHARED_CONST kPerturbedEdges = 1u; // of p-rep's perturbed patches, where the perturbation is
SUPPLE_SHARED_CONST kMixedEdges = 2u;     // of all of P_m's patches
SUPPLE_SHARED_CONST kHalvesEdges = 3u;    // of irregular quads of exact patches
SUPPLE_SHARED_CONST kTriangleEdges = 4u;   // of regular Loop patches
SUPPLE_SHARED_CONST kIrregularTriangleEdges = 5u;
SUPPLE_SHARED_CONST kSharpTriangleEdges = 6u; // of irregular triangles with semi-sharp creases
SUPPLE_SHARED_CONST kEdgeKinds = 7u;

SUPPLE_SHARED_CONST kEdgeElements = 3u;
SUPPLE_SHARED_CONST kNoEdgeSample = 0xFFFFFFFFu;
// Flags; the low bits are the sides of a P_m patch, 0 for bicubic ones.
SUPPLE_SHARED_CONST kEdgeSidesMask = 7u;
SUPPLE_SHARED_CONST kApexLastEdge = 8u;   // of a polar patch, to its apex
SUPPLE_SHARED_CONST kApexFirstEdge = 16u; // from it
SUPPLE_SHARED_CONST kSwappedEdge = 32u;
SUPPLE_SHARED_CONST kStoredNormalEdge = 64u;
SUPPLE_SHARED_CONST kSingularEdge = 128u; // no normal at its beginning but as a limit
// Words of edge attributes.
SUPPLE_SHARED_CONST kPatchSideMask = 7u;
SUPPLE_SHARED_CONST kPatchCornersShift = 3u;
SUPPLE_SHARED_CONST kPatchHasSectors = 64u;
SUPPLE_SHARED_CONST kPatchHalfShift = 7u;
SUPPLE_SHARED_CONST kUvCurveElements = 6u;

// The parameter pairs of a rate: those of all rates follow each other.
#define SUPPLE_FIRST_PAIR(rate) ((rate) * ((rate) + 1u) / 2u - 1u)

SUPPLE_SHARED_CONST kPatchStride = 32u; // elements a patch of any class in the patch-coefficient buffer
// Wide mapping: what the workgroup memory of the evaluation passes holds, patches of any class, and of those that go by rows
// elements of nets. Of 16 KiB the rest is for 128 lanes a word each, and the normals of five samples of 4 bytes,
// or three of 12.
SUPPLE_SHARED_CONST kMaxPatchesPerGroup = 8u;
// At levels, where a lane takes a line of samples (kRunHasLines). Quads of capacity 1 have four lines, 32 of them 128.
// Of triangles there would be lanes for 42, but then records took more than 3.5 KiB of workgroup memory.
SUPPLE_SHARED_CONST kMaxRecordsPerGroup = 32u;
SUPPLE_SHARED_CONST kPatchLanes = 32u; // lanes of a workgroup where a lane takes a patch (kLanePatchConstant)
SUPPLE_SHARED_CONST kMaxLanePatchRate = 16u; // then 32 rows take 9 KiB
SUPPLE_SHARED_CONST kWideNetElements = 17u; // of a patch
SUPPLE_SHARED_CONST kWidePerturbedNetElements = 33u;
SUPPLE_SHARED_CONST kWideBlendElements = 37u;
#define SUPPLE_WIDE_ELEMENTS(vertexFormat) ((vertexFormat) == kVertex24 ? 704u : 832u)

// What a dispatch alone knows: its window of instances, its range, and where it writes. What all dispatches of a surface share
// stands in the tables' header (shared/table_header.h). `count`: elements an instance, which are what `table` begins.
struct ConstructPush {
    WindowPush window;
    uint table; // first element of the records
    uint count;
    uint from; // by stencils: the first vertex that rows may name; regular fans of Catmull-Clark: how many come before
    uint to;   // by stencils: pool index of the first row's point
};
// The pass `patch`.
struct PatchPush {
    WindowPush window;
    uint table; // first element of the records
    uint count;
    uint firstPatch; // of the range in device order
};
// Evaluation at a rate.
struct EvaluatePush {
    WindowPush window;
    uint table; // first element of the records
    uint count;
    uint rate;
    uint samples;     // of a patch
    uint firstVertex; // of the range in an instance's surface vertices
    uint verticesPerInstance;
    uint patchesPerGroup; // wide mapping: patches a workgroup evaluates
};
// Edges of an indexed mesh.
struct EdgePush {
    WindowPush window;
    uint table; // first element of the records
    uint count;
    uint rate;
    uint firstVertex; // of all edges in an instance's surface vertices
    uint firstCorner; // the first vertex at a corner
    uint verticesPerInstance;
};
struct AttributesPush {
    WindowPush window;
    uint table; // first word of the attribute numbers; of edges: first element of their records
    uint count; // samples or vertices
    uint rate;
    uint samples;     // of a patch
    uint firstVertex; // of the range in an instance's surface vertices
    uint firstCorner; // indexed mesh: the first vertex at a corner
    uint edges;       // indexed mesh: first element of the edges that evaluation has
    uint smoothUvs;   // first element of the range's smooth texture coordinates
};
// Evaluation and attributes at levels.
struct LevelsPush {
    WindowPush window;
    uint table; // first element of the records; attributes: first word of the attribute numbers
    uint count; // patches
    uint firstPatch; // of the range in device order
    uint run;        // the range's number; with the window's first run, the view's dispatch
    uint runs;       // that the view has room for
    uint vertices;   // of the view
    uint smoothUvs;  // attributes: first element of the range's smooth texture coordinates
};

SUPPLE_SHARED_END

#endif
