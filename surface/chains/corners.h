// The corners of a mesh of quads, as exact Catmull-Clark patches tell them apart (docs/catmull_clark.md), and the
// points of level 1 round a quad.
#pragma once

#include "shaders/shared/chains.h"
#include "surface/refinement.h"

#include <array>
#include <vector>

namespace supple::surface::chains {

enum class VertexKind : uint8_t {
    plain,  ///< uniform B-splines all round, cut by endless creases: closed-form coefficients
    tensor, ///< four faces, or two at a border, and one semi-sharp crease straight through: a leaf a quarter
    chain   ///< everything else: a chain of leaves
};
/// `spokes`: the sharpness of a vertex's edges, counter-clockwise, on the level of the mesh.
[[nodiscard]] VertexKind vertexKind(std::span<const float> spokes, bool open, float vertexSharpness);

/// Faces of a plain vertex between two endless creases, or all round it.
struct FanRun {
    uint32_t vertex = 0;
    uint32_t firstSpoke = 0; ///< of the vertex
    uint32_t faces = 0;
    bool closed = false;
    [[nodiscard]] uint32_t spokes() const { return faces + (closed ? 0 : 1); }
};

/// Points of level 1, numbered as refine() does: row by row, the quad's own 3 x 3 in the middle.
using QuadNet = std::array<uint32_t, size_t{shared::kNetSide} * shared::kNetSide>;

class Corners {
public:
    /// `mesh`: of quads; must outlive this.
    explicit Corners(const RefinedMesh& mesh);

    [[nodiscard]] VertexKind kind(uint32_t vertex) const { return kinds_[vertex]; }
    /// Vertex by vertex.
    [[nodiscard]] const std::vector<FanRun>& runs() const { return runs_; }
    /// By spoke of the topology: the run that has the sector behind it, or cage::kNone.
    [[nodiscard]] uint32_t runOf(uint32_t spoke) const { return runOfSector_[spoke]; }
    /// Spokes of the topology.
    [[nodiscard]] std::vector<uint32_t> spokesOf(const FanRun& run) const;
    /// Quads whose chains lie at the same corners are evaluated side by side: this is the corner of a face that is
    /// corner 0 of its patch, so that there are as few kinds as possible.
    [[nodiscard]] uint8_t firstCorner(uint32_t face) const;
    /// A bit per corner, from the first on, that has a chain.
    [[nodiscard]] uint32_t chainsOf(uint32_t face) const;
    /// `first`: the corner of the face that is corner 0. What neither a leaf of level 1 nor the middle of a side reads,
    /// or what lies behind a border, is the quad's own middle.
    [[nodiscard]] QuadNet netOf(uint32_t face, uint32_t first, const StepPoints& points) const;

private:
    [[nodiscard]] uint32_t cornerOf(uint32_t face, uint32_t i) const { return mesh_.cage.faceStarts[face] + i % 4; }
    [[nodiscard]] uint32_t chainsFrom(uint32_t face, uint32_t first) const;
    void addRuns(uint32_t vertex, std::span<const float> spokes);

    const RefinedMesh& mesh_;
    std::vector<VertexKind> kinds_;
    std::vector<FanRun> runs_;
    std::vector<uint32_t> runOfSector_;
};

} // namespace supple::surface::chains
