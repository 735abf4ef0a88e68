// Level of detail (docs/lod.md): what the passes that choose levels, the budget's solver and evaluation share.
//
// A view has one buffer, of words. Where what is as large as any view's lies is a constant; behind it comes what grows with the
// runs that the view has room for, a number R that kernels are told:
//   patterns      the words of all capacities (surface/lod/pattern.h)
//   grids         by form and capacity: (first index, index count) of a draw instance
//   pool end      four words, of which the first counts the units of the view's pool that this frame has given away
//   solution      LodSolution
//   capacities    by priority and bin: the index of the capacity that patches of the bin take
//   split         by priority, form and bin: the histogram that the budget is solved with; a patch's weight of
//                 kSplitUnit is shared between two bins
//   rated         where instances have one of several rates (subdivision) and count: the vertices of all at their coarsest; then
//                 by priority and bin what finer rates have more, which counts while levels are scaled by fewer bins
//   runs          two words a run: form | kRunIsDoubleSided where its patches show their backs too | kRunHasLines where a
//                 lane of the wide mapping takes a line of their samples; the group's first run | dispatch << 16,
//                 kNoDispatch where no group has the run. A run is the patches of one class and material of a window of
//                 instances of a group; a dispatch evaluates the runs of one class, which follow each other
//   counts        by run, priority and bin from kFirstCountBin on: patches; all bins below count in the first
//   buckets       by run and capacity: four words (LodBucket), those of a group from kLodBucketStride times its first run on; one
//                 more behind them tells where the last one's records end
//   dispatches    eight words each (LodDispatch)
//   draws         by run and capacity: VkDrawIndexedIndirectCommand
//   records       sixteen words a patch that is drawn, those of a bucket one after the other, filled up with empty ones
//                 to whole draw instances: (patch in device order, or kEmptyRecord; slot | kInstanceIsNew; first
//                 vertex; capacity index), then pairs (a, 1 / L) as float bits: quads u, v inside, then edges 0..3;
//                 rings inside, then edges 0..4
//
// In an instance's scratch: a float an edge, its level before the budget; then three words a patch (LodPatchLevel); then, where
// patches have chains (shared/chains.h), kDepthWords. In these stand the largest level of a patch with chains, before the budget,
// and an entry of each depth's list of instances; in the first instance's also how many a list has, and the dispatch for them.
#ifndef SUPPLE_SHARED_LOD_H
#define SUPPLE_SHARED_LOD_H

#include "shaders/shared/camera.h"
#include "shaders/shared/portable.h"
#include "shaders/shared/window.h"

SUPPLE_SHARED_BEGIN

// Set 0 of the surface layout.
SUPPLE_SHARED_CONST kLodBinding = 17u;
SUPPLE_SHARED_CONST kLodTexelBinding = 18u;

SUPPLE_SHARED_CONST kCapacityCount = 10u;
// Capacities, and where the words of their patterns begin, (capacity + 1) / 2 each.
#define SUPPLE_LOD_CAPACITIES 1u, 3u, 5u, 7u, 11u, 15u, 23u, 31u, 47u, 63u
#define SUPPLE_LOD_FIRST_WORDS 0u, 1u, 3u, 6u, 10u, 16u, 24u, 36u, 52u, 76u
// The same in six and in eight bits each: GPUs keep arrays that lanes index differently in memory.
#define SUPPLE_LOD_CAPACITY(i) (((i) < 5u ? 0x0B1C50C1u : 0x3FBDF5CFu) >> 6u * ((i) < 5u ? (i) : (i)-5u) & 63u)
#define SUPPLE_LOD_FIRST_WORD(i)                                                                                       \
    (((i) < 4u ? 0x06030100u : (i) < 8u ? 0x2418100Au : 0x00004C34u) >> 8u * ((i)&3u) & 255u)
SUPPLE_SHARED_CONST kPriorityCount = 4u;
SUPPLE_SHARED_CONST kMaxViewRuns = 65472u; // and dispatches: less than kNoDispatch
SUPPLE_SHARED_CONST kRunStep = 64u;        // a view has room for a multiple of this, so that all sections are aligned
SUPPLE_SHARED_CONST kRunIsDoubleSided = 256u;
SUPPLE_SHARED_CONST kRunHasLines = 512u;
SUPPLE_SHARED_CONST kNoDispatch = 65535u;

// Forms of grids (surface/lod/grid.h).
SUPPLE_SHARED_CONST kLodQuadForm = 0u;
SUPPLE_SHARED_CONST kLodTriangleForm = 1u;
SUPPLE_SHARED_CONST kLodQuadRingsForm = 2u;
SUPPLE_SHARED_CONST kLodPentagonForm = 3u;
SUPPLE_SHARED_CONST kLodForms = 4u;

// Bins of log2 level: kBinsPerOctave an octave from 2^-kOctavesBelow on.
SUPPLE_SHARED_CONST kBinsPerOctave = 64u;
SUPPLE_SHARED_CONST kOctavesBelow = 6u;
SUPPLE_SHARED_CONST kLodBins = 898u;
SUPPLE_SHARED_CONST kLodBinStride = 900u;
SUPPLE_SHARED_CONST kSplitUnit = 256u;
// The budget scales levels by 2^(-scaled / kBinsPerOctave), scaled = SUPPLE_LOD_SCALED(elasticity, x), x =
// 0..kBudgetSteps: by elasticities first, and where these are used up all priorities further down alike, until every
// level is 1.
SUPPLE_SHARED_CONST kElasticSteps = 512u;
#define SUPPLE_LOD_SCALED(elasticity, x)                                                                               \
    ((x) < float(kElasticSteps) ? (elasticity) * (x)                                                                   \
                                : (elasticity) * float(kElasticSteps) + ((x) - float(kElasticSteps)))

SUPPLE_SHARED_CONST kPatternWordCount = 108u;
SUPPLE_SHARED_CONST kLodPatterns = 0u;
SUPPLE_SHARED_CONST kLodGrids = kLodPatterns + kPatternWordCount;
SUPPLE_SHARED_CONST kLodPoolEnd = kLodGrids + 2u * kLodForms * kCapacityCount;
SUPPLE_SHARED_CONST kLodCamera = kLodPoolEnd + 4u; // LodCamera, for shared dispatches
SUPPLE_SHARED_CONST kLodSolution = kLodCamera + 8u; // what stands before it comes from the host
SUPPLE_SHARED_CONST kLodCapacities = kLodSolution + 16u;
SUPPLE_SHARED_CONST kLodSplit = kLodCapacities + kPriorityCount * kLodBinStride;
SUPPLE_SHARED_CONST kLodRated = kLodSplit + kPriorityCount * kLodForms * kLodBinStride;
SUPPLE_SHARED_CONST kRatedBins = 516u; // kBinsPerOctave an octave above the level a rate is enough for
SUPPLE_SHARED_CONST kBudgetSteps = kElasticSteps + kRatedBins;
SUPPLE_SHARED_CONST kLodHidden = kLodRated + 1u; // patches of hidden parts, of all groups with levels
SUPPLE_SHARED_CONST kLodRatedMore = kLodRated + 4u;
// What hosts may bind lies on multiples of what descriptor offsets need at most, 256 bytes.
SUPPLE_SHARED_CONST kLodAlignment = 64u; // words
SUPPLE_SHARED_CONST kLodRuns =
    (kLodRatedMore + kPriorityCount * kRatedBins + kLodAlignment - 1u) / kLodAlignment * kLodAlignment;
SUPPLE_SHARED_CONST kLodRunWords = 2u;
// Whatever the budget, patches of the bins below this one have the smallest capacity, and so do those of this one.
SUPPLE_SHARED_CONST kFirstCountBin = kOctavesBelow * kBinsPerOctave - 2u;
SUPPLE_SHARED_CONST kCountBins = kLodBins - kFirstCountBin;
SUPPLE_SHARED_CONST kRunCountWords = kPriorityCount * kCountBins;
SUPPLE_SHARED_CONST kLodBucketStride = 16u; // buckets; no less than a run's and one
SUPPLE_SHARED_CONST kLodDispatchWords = 8u;
SUPPLE_SHARED_CONST kLodDrawWords = 5u;
SUPPLE_SHARED_CONST kLodDrawCount = 1u; // the instance count; between two kernels of the solver how many patches there are
// Where the sections begin that grow with `runs`.
#define SUPPLE_LOD_COUNTS(runs) (kLodRuns + kLodRunWords * (runs))
// From here on hosts read.
#define SUPPLE_LOD_BUCKETS(runs) (SUPPLE_LOD_COUNTS(runs) + kRunCountWords * (runs))
#define SUPPLE_LOD_DISPATCHES(runs) (SUPPLE_LOD_BUCKETS(runs) + 4u * kLodBucketStride * (runs))
#define SUPPLE_LOD_DRAWS(runs) (SUPPLE_LOD_DISPATCHES(runs) + kLodDispatchWords * (runs))
#define SUPPLE_LOD_RECORDS(runs) (SUPPLE_LOD_DRAWS(runs) + kLodDrawWords * kCapacityCount * (runs))
SUPPLE_SHARED_CONST kLodRecordWords = 16u;

SUPPLE_SHARED_CONST kEmptyRecord = 0xFFFFFFFFu;
SUPPLE_SHARED_CONST kNoBin = 0xFFFFFFFFu; // the patch is not drawn

struct LodSolution {
    float x;        // of the budget
    uint vertices;  // written this frame, padding included, and those of rates where they count
    uint patches;   // drawn
    uint shortfall; // 1 where scaling by elasticity is not enough: x is above kElasticSteps
    float scale[4]; // of levels, by priority
    uint wanted;    // vertices that x = 0 would have written
    uint counted;   // patches, those too that have no room
    uint hidden;    // patches of hidden parts
};
struct LodBucket {
    uint firstRecord;
    uint firstVertex;
    uint cursor;     // records placed so far
    uint firstGroup; // wide mapping: of the dispatch's workgroups
};
struct LodDispatch {
    uint x, y, z; // VkDispatchIndirectCommand
    uint firstRecord;
    uint recordCount;
    uint firstBucket;
    uint bucketCount;
    uint groups;
};

// Table elements.
//   edges     cubics: pool indices (end, its tangent, the other end's tangent, other end); two halves, of exact Catmull-Clark:
//             (first element of an irregular quad's record, its side, -, -); Loop: (first element of a triangle's record, its side, 1
//             if it is irregular, -); blending surface: an element an end, (pool index of c_00 | kCreasedChart, direction of the edge
//             in the chart, 4 / k)
//   edges of one kind follow each other, by Borders (surface/patch_class.h)
//   patches   two elements: edges 0..3; (edge 4, run within the window's, first element of its patch record,
//             class | part << kLodPartShift)
SUPPLE_SHARED_CONST kLodPartShift = 8u;
SUPPLE_SHARED_CONST kLodPatchLevelWords = 3u; // bin, levels the inside asks for along u and along v

// Levels of chains from kFirstDepth on are made only for instances that have samples there (docs/catmull_clark.md).
SUPPLE_SHARED_CONST kFirstDepth = 3u;
SUPPLE_SHARED_CONST kDepths = 4u;
SUPPLE_SHARED_CONST kDepthEntries = 1u;                       // behind the largest level
SUPPLE_SHARED_CONST kDepthCounts = kDepthEntries + kDepths;   // in the first instance's
SUPPLE_SHARED_CONST kDepthDispatches = kDepthCounts + kDepths; // x, y, z
SUPPLE_SHARED_CONST kDepthWords = kDepthDispatches + 3u * kDepths;

// What lod/patch.comp measures, for its kind constant: bicubic nets, or sectors of P_m; regular or irregular triangles of Loop.
SUPPLE_SHARED_CONST kMeasuresNets = 0u;
SUPPLE_SHARED_CONST kMeasuresSectors = 1u;
SUPPLE_SHARED_CONST kMeasuresRegularTriangles = 2u;
SUPPLE_SHARED_CONST kMeasuresIrregularTriangles = 3u;
// And lod/edge.comp of Loop.
SUPPLE_SHARED_CONST kMeasuresWholeSides = 0u;
SUPPLE_SHARED_CONST kMeasuresHalves = 1u;
SUPPLE_SHARED_CONST kMeasuresSharpHalves = 2u; // of a semi-sharp crease

// What the passes that choose levels are told.
struct LodPush {
    WindowPush window;
    uint count; // edges or patches of an instance that the pass takes
    uint first; // one of them
    uint table; // of edges: its first element
    uint levels;       // one level an instance: so far behind its entry stands its level; 0: a level an edge
    uint masks;        // of parts, first word in the list of instances (shared/bounds.h)
    uint maskWords;    // an instance
    uint countsHidden; // 1: this surface of the group counts the patches that an instance hides
    uint runs;         // that the view has room for
    LodCamera camera; // View::levelCamera. Shared dispatches leave it out: kLodCamera
};
// What the passes that make a level of chains are told.
struct DepthPush {
    WindowPush window;
    uint table; // first element of what makes the depth
    uint count; // of an instance
    uint depth; // its number among the depths
};
// The budget in three kernels: what is found with one workgroup, the counts of each run with one a run, where everything lies with
// one.
struct LodSolvePush {
    uint runs;              // that the view has room for
    uint runCount;          // in use, of the view
    uint limit;             // vertices, without what fills up draw instances
    uint room;              // with it
    uint priorities, forms; // bits of those in use
    uint maxGroups;         // of a dispatch in x
    uint rated;             // 1: rates count
    float elasticity[4];
};

SUPPLE_SHARED_END

#endif
