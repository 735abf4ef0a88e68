// What the surface schemes have in common: classes of patches, and the static tables a scheme makes of a cage.
#pragma once

#include "cage/character.h"
#include "shaders/shared/surface.h"
#include "surface/grid.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::surface {

enum class PatchClass : uint32_t {
    regular = shared::kRegularPatch,     ///< bicubic
    perturbed = shared::kPerturbedPatch, ///< p-rep: bicubic and a sparse perturbation of degree 5
    polar = shared::kPolarPatch,         ///< P_m: a triangle of a polar fan, bicubic with a collapsed side
    p3 = shared::kP3Patch,               ///< P_m: three, four, five triangular sectors of degree 4
    p4 = shared::kP4Patch,
    p5 = shared::kP5Patch,
    catmullClark = shared::kCatmullClarkPatch, ///< subdivision kernel: a face of the isolated level
    loop = shared::kLoopPatch,
    blend = shared::kBlendPatch,          ///< blending surface: smooth all over
    blendSharp = shared::kBlendSharpPatch ///< with creases, or without derivatives somewhere on its border
};
inline constexpr size_t kPatchClassCount = 10;

/// "regular", "perturbed", "polar", "p3", "p4", "p5", "catmull-clark", "loop", "blend", "blend-sharp".
[[nodiscard]] constexpr const char* className(PatchClass patchClass) {
    constexpr const char* kNames[] = {"regular", "perturbed",     "polar", "p3",    "p4",
                                      "p5",      "catmull-clark", "loop",  "blend", "blend-sharp"};
    return kNames[static_cast<uint32_t>(patchClass)];
}

[[nodiscard]] constexpr Domain domainOf(PatchClass patchClass) {
    switch (patchClass) {
    case PatchClass::polar:
        return Domain::polar;
    case PatchClass::p3:
    case PatchClass::loop:
        return Domain::triangle;
    case PatchClass::p5:
        return Domain::pentagon;
    default:
        return Domain::quad;
    }
}

/// Coefficients a patch of a class has, as the patch pass writes them; others have none.
[[nodiscard]] constexpr uint32_t coefficientCount(PatchClass patchClass) {
    constexpr uint32_t kCounts[] = {16, 32, 13, 19, 25, 31, 0, 0, 0, 0};
    return kCounts[static_cast<uint32_t>(patchClass)];
}

/// One patch in device order. Patch corner i lies at corner i of its domain.
struct PatchInfo {
    uint32_t face = 0; ///< of the cage as the host gave it
    PatchClass patchClass = PatchClass::regular;
    uint32_t cornerCount = 4;
    std::array<uint32_t, kMaxSides> corners{}; ///< cage vertices; cage::kNone where the scheme put a point of its own
    uint32_t material = cage::kNone;
};

/// A run of records in the tables.
struct Section {
    uint32_t table = 0; ///< first element (four words)
    uint32_t count = 0; ///< records
};

/// The kernels of all passes; surface/passes.cpp lists what each is made of.
enum class Kernel : uint32_t {
    // p-rep
    prepVertexRegular,
    prepVertex,
    prepEdge,
    // P_m
    pmVertexRegular,
    pmVertex,
    pmVertexCreased,
    pmPolar,
    pmFacet3,
    pmFacet4,
    pmFacet5,
    // subdivision kernel, and the blending surface where it subdivides first
    isolate,
    isolateFromPool, ///< a second step
    // blending surface
    blendChart,
    blendChartFromPool,
    count
};

/// The passes between deformed cage and coefficients, in order; a barrier stands between them.
enum class Stage : uint32_t {
    vertex, ///< one invocation a cage vertex or sector; subdivision kernel: a vertex of the first step
    edge ///< p-rep: a perturbed edge; P_m: a facet; subdivision kernel: a vertex of a second step; blending surface on
         ///< a subdivided cage: a chart
};
inline constexpr uint32_t kStageCount = 2;

struct Construction {
    Stage stage = Stage::vertex;
    Kernel kernel = Kernel::prepVertex;
    Section section;
    uint32_t coefficients = 0; ///< pool elements an instance it writes, for the cost report
};

/// Consecutive patches of one class in device order.
struct PatchRange {
    PatchClass patchClass = PatchClass::regular;
    Section section;
    uint32_t firstPatch = 0;
    uint32_t attributes = 0; ///< first element of the corner attributes
};

/// Consecutive patches of one domain and material.
struct DrawRange {
    Domain domain = Domain::quad;
    uint32_t firstPatch = 0;
    uint32_t patchCount = 0;
    uint32_t material = cage::kNone;
};

/// What the subdivision kernel evaluates instead of patches (shaders/shared/kernel.h).
struct Fragments {
    uint32_t steps = 0;         ///< after the isolated level
    bool loop = false;          ///< else Catmull-Clark
    uint32_t scratchStride = 0; ///< points an instance in the scratch buffer
    struct Class {
        uint32_t sharedPoints = 0; ///< what a workgroup holds of a fragment at a time
        Section fragments;         ///< one record a fragment
        /// By step, the limit last, and kind of work (kWorkKinds each); those of one kind follow each other, class by
        /// class.
        std::vector<Section> blocks;
    };
    std::vector<Class> classes; ///< sharedPoints rise
};

/// What level of detail adds (surface/lod/tables.h); empty where it is not asked for.
struct LodTables {
    bool charts = false; ///< borders are of charts (blending surface) instead of cubics
    Section edges;       ///< one element each, of charts two
    Section patches;     ///< two elements each, all classes, in device order
    struct Run {
        PatchClass patchClass = PatchClass::regular;
        uint32_t material = cage::kNone;
        uint32_t patchCount = 0;
    };
    std::vector<Run> runs; ///< of one class and material, in device order
};

/// What shared samples add (surface/shared_samples.h); empty where they are not asked for.
struct SharedTables {
    /// Records of edges (shaders/shared/surface.h), by the kernel that evaluates them.
    struct Edges {
        uint32_t kind = shared::kPlainEdges;
        Section section;
    };
    std::vector<Edges> edges;
    Section attributes; ///< an element a record, where the tables have corner attributes
    uint32_t edgeCount = 0;
    uint32_t cornerCount = 0;
    /// Where a patch's borders are: for side i its edge, and whether that runs against the patch; for corner i its
    /// number among the corners.
    struct Patch {
        std::array<uint32_t, kMaxSides> edges{}, corners{};
        std::array<bool, kMaxSides> reversed{};
    };
    std::vector<Patch> patches;
};

/// What depends on connectivity alone: the tables of shaders/shared/{surface,prep,pm,kernel}.h, and where everything
/// lies in them. Patches are ordered by class, then by material, then by face.
struct Tables {
    std::vector<uint32_t> words; ///< a multiple of four
    uint32_t ring = 0;           ///< first word of the ring
    uint32_t poolStride = 0;     ///< coefficients an instance, padded so that instances start on 256 bytes
    uint32_t tangents = 0;       ///< first tangent in the pool
    uint32_t faces = 0;          ///< first face coefficient in the pool
    uint32_t uvSets = 1;
    bool faceUvs = false;        ///< corners have a place in their face's trim tile (cage::Cage::cornerFaceUvs)
    uint32_t isolationSteps = 0; ///< patches are this many halvings smaller than the cage's faces
    uint32_t rate = 0;           ///< segments along a patch edge that the tables are made for; 0: any
    Fragments fragments;         ///< subdivision kernel only
    bool cornerNormals = false;  ///< p-rep: some corner needs its stored normal (CornerRule::smooth)
    std::vector<Construction> constructions;
    std::vector<PatchRange> ranges;
    std::vector<PatchInfo> patches;
    std::vector<DrawRange> drawRanges;
    LodTables lod;
    SharedTables shared;
    std::vector<std::string> notes; ///< what was changed about the cage, one line each

    [[nodiscard]] bool has(Stage stage) const;
    /// Whether samples that patches share are stored once.
    [[nodiscard]] bool sharesSamples() const { return !shared.edges.empty(); }
};

} // namespace supple::surface
