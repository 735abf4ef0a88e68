// The corners of a mesh of triangles, as Loop patches tell them apart, and the points round a triangle (docs/loop.md).
#pragma once

#include "shaders/shared/chains.h"
#include "surface/refinement.h"
#include "surface/subdivision_rules.h"

#include <array>
#include <span>
#include <vector>

namespace supple::surface::loop {

/// In steps along the directions to corners 1 and 2.
struct TrianglePlace {
    int32_t a = 0, b = 0;
};
/// The net of a triangle after a step, or of a chain's level: two steps along a side, and one more all round. In rows
/// of three, as shaders/loop/box_spline.glsl has a leaf: seen from the next corner, a row moves on by one.
inline constexpr std::array<TrianglePlace, shared::kTriangleNetPoints> kTriangleNet{{{0, 0},
                                                                                     {2, 0},
                                                                                     {0, 2},
                                                                                     {1, 0},
                                                                                     {1, 1},
                                                                                     {0, 1},
                                                                                     {0, -1},
                                                                                     {3, 0},
                                                                                     {-1, 3},
                                                                                     {1, -1},
                                                                                     {2, 1},
                                                                                     {-1, 2},
                                                                                     {2, -1},
                                                                                     {1, 2},
                                                                                     {-1, 1},
                                                                                     {3, -1},
                                                                                     {0, 3},
                                                                                     {-1, 0}}};

/// What a corner of a triangle is.
enum class CornerKind : uint8_t {
    plain,   ///< the triangles at the vertex form a regular lattice, cut by at most one endless crease straight through
    creased, ///< plain, but a crease passes through the vertex, and no side of the triangle is on it
    chain    ///< all others
};

using TriangleCage = std::array<uint32_t, shared::kLeafPoints>;
using TriangleNet = std::array<uint32_t, shared::kTriangleNetPoints>;

class Triangles {
public:
    /// `mesh`: of triangles; must outlive this.
    explicit Triangles(const RefinedMesh& mesh);

    [[nodiscard]] bool isPlain(uint32_t vertex) const { return plain_[vertex] != 0; }
    [[nodiscard]] CornerKind kindOf(uint32_t corner) const;
    /// Of the two sides of the crease through a plain vertex, whether a sector lies on the second one, which begins
    /// with the later of the two spokes.
    [[nodiscard]] bool isBehindCrease(uint32_t vertex, uint32_t sector) const;
    /// As chains::Corners::firstCorner(), and a bit per corner from that one on that has a chain.
    [[nodiscard]] uint8_t firstCorner(uint32_t face) const;
    [[nodiscard]] uint32_t chainsOf(uint32_t face) const { return chainsFrom(face, firstCorner(face)); }
    /// The side behind a corner: whether it is an endless crease, or a semi-sharp one on level 1.
    [[nodiscard]] bool isEndless(uint32_t corner) const { return sharpness(corner) >= kInfiniteSharpness; }
    [[nodiscard]] bool isSemiSharp(uint32_t corner) const {
        return !isEndless(corner) && softened(sharpness(corner), 1) > 0.0f;
    }
    /// Flags of a record (shaders/shared/chains.h) but for whole sides. `corners`: of the mesh, from the patch's first
    /// on.
    [[nodiscard]] uint32_t flagsOf(std::span<const uint32_t> corners) const;
    /// The sharpness of its sides, as records have it.
    [[nodiscard]] std::array<uint32_t, 4> sharpnessOf(std::span<const uint32_t> corners) const;
    /// The limit at a plain vertex, as weights of vertices of the mesh.
    void addLimit(uint32_t vertex, Stencils& rows) const;

    /// Vertices round a face, as a leaf has its points. What lies behind a border or round a chain's vertex may be any.
    [[nodiscard]] TriangleCage cageOf(uint32_t face, uint32_t first) const;
    /// Points of level 1, numbered as refine() does.
    [[nodiscard]] TriangleNet netOf(uint32_t face, uint32_t first) const;

private:
    [[nodiscard]] float sharpness(uint32_t corner) const {
        return mesh_.edgeSharpness[mesh_.topology.cornerEdges[corner]];
    }
    [[nodiscard]] uint32_t cornerOf(uint32_t face, uint32_t i) const { return mesh_.cage.faceStarts[face] + i % 3; }
    [[nodiscard]] uint32_t chainsFrom(uint32_t face, uint32_t first) const;
    /// The spoke so many steps counter-clockwise from a corner's own; cage::kNone behind a border.
    [[nodiscard]] uint32_t spokeFrom(uint32_t corner, uint32_t steps) const;

    const RefinedMesh& mesh_;
    std::vector<uint8_t> plain_; ///< by vertex
};

} // namespace supple::surface::loop
