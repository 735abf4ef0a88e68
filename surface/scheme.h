// What the surface schemes have in common: the static tables that a scheme makes of a cage.
#pragma once

#include "cage/character.h"
#include "shaders/shared/surface.h"
#include "surface/patch_class.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::surface {

/// One patch in device order. Patch corner i lies at corner i of its domain.
struct PatchInfo {
    uint32_t face = 0; ///< of the cage as the host gave it
    PatchClass patchClass = PatchClass::regular;
    uint32_t cornerCount = 4;
    std::array<uint32_t, kMaxSides> corners{}; ///< cage vertices; cage::kNone where the scheme put a point of its own
    uint32_t part = 0;                         ///< of the cage (cage::Cage::faceParts)
    uint32_t material = cage::kNone;
};

/// Consecutive records in the tables.
struct Section {
    uint32_t table = 0; ///< first element (four words)
    uint32_t count = 0; ///< records
};

/// The passes that make coefficients from the deformed cage. A barrier separates them.
enum class Stage : uint32_t {
    vertex,   ///< one lane per cage vertex or sector. Subdivision: per vertex of the first step
    assemble, ///< needs the output of `vertex`. One lane per perturbed edge (p-rep), facet (P_m), vertex of the second
              ///< step (subdivision) or chart (blending surface on a subdivided cage)
    deepen ///< at levels of detail, when these are known: levels of chains, for the instances that have samples there
};

/// A kernel and what it is specialized to. Only schemes know which kinds a construction kernel has.
struct KindOfKernel {
    Kernel kernel = Kernel::count;
    uint32_t kind = 0; ///< the value of its kKindConstant

    bool operator==(const KindOfKernel&) const = default;
};

/// One dispatch of a construction pass.
struct Construction {
    Stage stage = Stage::vertex;
    KindOfKernel kernel;
    Section section;
    uint32_t coefficients = 0; ///< how many it writes per instance, for the cost report
    bool readsPool = false;    ///< those before it in its stage write what it reads
    uint32_t from = 0; ///< by stencils: the first vertex that rows may name; of regular fans: how many come before
    uint32_t to = 0;   ///< by stencils: pool index of the first row's point
};
/// Whether it runs rows of stencils (surface/stencil_table.h). Its section then counts the lanes of whole blocks, of
/// which some have no row.
[[nodiscard]] bool isByStencils(const Construction& construction);

/// Consecutive patches of one class in device order.
struct PatchRange {
    PatchClass patchClass = PatchClass::regular;
    Section section;
    uint32_t firstPatch = 0;
    uint32_t attributes = 0; ///< word at which the attribute numbers of its corners begin
    uint32_t smoothUvs = 0;  ///< element at which its smooth texture coordinates begin (Tables::uvMode)
};

/// Consecutive patches of one domain, material and part.
struct DrawRange {
    Domain domain = Domain::quad;
    uint32_t firstPatch = 0;
    uint32_t patchCount = 0;
    uint32_t part = 0;
    uint32_t material = cage::kNone;
};

/// The subdivision evaluates fragments instead of patches (shaders/shared/subdivision.h).
struct Fragments {
    uint32_t steps = 0;         ///< of refinement beyond the isolated level
    bool loop = false;          ///< else Catmull-Clark
    uint32_t scratchStride = 0; ///< points per instance in the scratch buffer
    struct Class {
        uint32_t sharedPoints = 0; ///< points that a workgroup holds at a time
        Section fragments;         ///< one record per fragment
        /// Blocks of work, kWorkKinds sections per step, the limit being the last step. In the tables, blocks of the
        /// same step and kind lie one class after the other.
        std::vector<Section> blocks;
    };
    std::vector<Class> classes; ///< in order of sharedPoints
};

/// What level of detail adds to the tables (surface/lod/tables.h). Empty unless the recipe asks for it.
struct LodTables {
    Borders borders = Borders::cubics; ///< what any of its patches has
    /// Edges of one kind follow each other.
    struct Edges {
        Borders borders = Borders::cubics;
        uint32_t first = 0; ///< edge
        Section section;    ///< one element per edge, two if it lies between charts
    };
    std::vector<Edges> edges;
    uint32_t edgeCount = 0;
    Section patches; ///< two elements per patch, all classes, in device order
    struct PatchRun {
        PatchClass patchClass = PatchClass::regular;
        uint32_t material = cage::kNone;
        uint32_t patchCount = 0;
    };
    std::vector<PatchRun> runs; ///< patches of the same class and material, in device order
    /// Where patches have chains (surface/chains/chain_tables.h): what of an instance's pool tells their last level; 0:
    /// there are none. And the element of the lanes that make each depth (shared::kDepths).
    uint32_t depth = 0, depthLanes = 0;
};

/// What an indexed mesh adds to the tables (surface/mesh_tables.h). Empty unless the recipe asks for it.
struct MeshTables {
    /// Records of edges that the same kernel evaluates (shaders/shared/surface.h).
    struct Edges {
        uint32_t kind = shared::kPlainEdges;
        Section section;
    };
    std::vector<Edges> edges;
    Section attributes;    ///< one element per edge record, if the tables have corner attributes
    bool tangents = false; ///< faces whose texture coordinates turn in different directions share no sample
    uint32_t edgeCount = 0;
    uint32_t cornerCount = 0;
    /// The borders of a patch: side i is an edge, which runs along the side or, if reversed, against it; corner i is
    /// one of the cornerCount corners.
    struct Patch {
        std::array<uint32_t, kMaxSides> edges{}, corners{};
        std::array<bool, kMaxSides> reversed{};
    };
    std::vector<Patch> patches;
};

/// The scheme polygons draws triangles of the cage (shaders/shared/polygons.h). They are the patches, in their order,
/// but nothing is evaluated per patch.
struct Triangles {
    Section vertices;              ///< one record per surface vertex
    uint32_t directions = 0;       ///< with tangents: first of the words that say where a vertex's points; else 0
    std::vector<uint32_t> indices; ///< three vertices per patch
};

/// Vertices per instance in the deformed cage such that every instance starts on 256 bytes.
[[nodiscard]] constexpr uint32_t cageStrideFor(uint32_t vertices) {
    return (vertices + 15) / 16 * 16;
}

/// The tables of a cage (shaders/shared/{surface,prep,pm,subdivision,blend,polygons}.h) and where everything lies in
/// them. They depend on connectivity alone. Patches are ordered by class, then by material, part and face.
struct Tables {
    /// All that the device reads: one block of whole elements that begins with its header (writeHeader()).
    std::vector<uint32_t> words = std::vector<uint32_t>(shared::kTableHeaderWords);
    uint32_t cageStride = 0;   ///< vertices per instance in the deformed cage (cageStrideFor())
    uint32_t poolStride = 0;   ///< coefficients per instance; a multiple of 256 bytes
    uint32_t meshVertices = 0; ///< where steps of subdivision made the mesh: its first vertex in the pool
    uint32_t tangents = 0;     ///< first tangent in the pool
    uint32_t faces = 0;        ///< first face coefficient in the pool
    uint32_t inner = 0;        ///< p-rep: first coefficient of the perturbed edges in the pool
    uint32_t frames = 0;       ///< polygons: first tangent frame in the pool
    uint32_t ring = 0;         ///< first word of the ring
    uint32_t edgeClasses = 0;  ///< p-rep, P_m: first element of the edge classes
    uint32_t coordinates = 0;  ///< blending surface: first element of the coordinates of samples
    uint32_t uvSets = 1;
    cage::UvMode uvMode =
        cage::UvMode::all; ///< all: texture coordinates are linear, and the tables have no smooth ones
    /// Smooth texture coordinates are quads or triangles of leaves, whatever the classes of patches.
    bool uvLeaves = false;
    bool faceUvs = false;    ///< corners have coordinates in the trim tile of their face (cage::Cage::cornerFaceUvs)
    bool colors = false;     ///< some corner has a color that is not white
    bool mapFrames = false;  ///< corners have the frame of their material's normal map (cage::MapFrame)
    uint32_t attributes = 0; ///< first element of the corner attributes, which come last
    bool attributeHalves = false; ///< a word holds two attribute numbers
    uint32_t isolationSteps = 0;  ///< the cage is subdivided so often before patches are made of its faces
    uint32_t rate = 0;            ///< the only tessellation rate that the tables serve, along a patch edge; 0: all
    Fragments fragments;          ///< subdivision only
    Triangles triangles;          ///< polygons only
    bool cornerNormals = false;   ///< p-rep with CornerRule::smooth: records have an element of corner normals
    bool fanRecords = false;      ///< Recipe::fanRecords
    std::vector<Construction> constructions;
    std::vector<PatchRange> ranges;
    std::vector<PatchInfo> patches;
    std::vector<DrawRange> drawRanges;
    LodTables lod;
    MeshTables mesh;
    std::vector<std::string> notes; ///< what the scheme changed about the cage, one line each

    [[nodiscard]] bool has(Stage stage) const;
    /// That of a patch.
    [[nodiscard]] const PatchRange& rangeOf(uint32_t patch) const;
    /// Elements of corner attributes a corner.
    [[nodiscard]] uint32_t cornerElements() const {
        return 1u + (uvSets == 2 || faceUvs ? 1u : 0u) + (mapFrames ? 1u : 0u);
    }
    /// What corners have beside the first UV set and the color: shared::kOutput... bits.
    [[nodiscard]] uint32_t attributeOutputs() const {
        return (uvSets == 2 ? shared::kOutputUvs1 : 0) | (faceUvs ? shared::kOutputFaceUvs : 0) |
               (hasTangents() && triangles.indices.empty() ? shared::kOutputDirections : 0);
    }
    /// Whether evaluation can write tangents. Of a mesh the recipe must ask for them.
    [[nodiscard]] bool hasTangents() const;
    /// Whether samples on borders are stored once for all patches that meet there.
    [[nodiscard]] bool hasIndexedMesh() const { return !mesh.edges.empty(); }
};

} // namespace supple::surface
