// Refines a whole cage, step by step, by the rules of Catmull-Clark or Loop: connectivity, stencils, sharpness and
// corner attributes. The cage's positions matter only for the rest pose of the result.
#pragma once

#include "base/result.h"
#include "surface/split.h"
#include "surface/subdivision_rules.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::surface {

/// Points as affine combinations of a cage's vertices. The entries of row i are [starts[i], starts[i + 1]).
struct Stencils {
    std::vector<uint32_t> starts;
    std::vector<uint32_t> vertices; ///< rising within a row
    std::vector<double> weights;    ///< sum to 1 in every row

    [[nodiscard]] uint32_t rows() const { return static_cast<uint32_t>(starts.size() - 1); }
};
/// Some of the rows.
[[nodiscard]] Stencils rowsOf(const Stencils& all, std::span<const uint32_t> rows);

/// A cage that is subdivided, after some number of steps.
struct RefinedMesh {
    cage::Cage cage;                   ///< without creases and sharp vertices
    std::vector<uint32_t> sourceFaces; ///< per face: the given face it came from
    Stencils stencils;                 ///< one row per vertex, over the vertices before the last step
    // What another step needs. A child has none of it before equip().
    cage::Topology topology;
    std::vector<float> edgeSharpness, vertexSharpness;
};

/// The mesh before the first step: the cage with its faces cut by the rule, if there is one, and stencils in which
/// every vertex is itself. What was cut, creases that name no edge and sharp vertices that do not exist are reported in
/// `notes`. Refuses what splitFaces() refuses.
[[nodiscard]] Result<RefinedMesh> beginRefinement(const cage::Cage& cage, const SplitRule* rule,
                                                  std::vector<std::string>& notes);

/// Corners of a mesh, and how refine() numbers what it makes of it.
class StepPoints {
public:
    explicit StepPoints(const RefinedMesh& parent) : parent_(parent) {}

    [[nodiscard]] uint32_t vertexAt(uint32_t corner) const { return parent_.cage.faceVertices[corner]; }
    [[nodiscard]] uint32_t faceOf(uint32_t corner) const { return parent_.topology.cornerFaces[corner]; }
    [[nodiscard]] uint32_t next(uint32_t corner) const {
        return cage::nextCorner(parent_.cage, faceOf(corner), corner);
    }
    [[nodiscard]] uint32_t previous(uint32_t corner) const {
        return cage::previousCorner(parent_.cage, faceOf(corner), corner);
    }
    /// The point of the edge from a corner to the next.
    [[nodiscard]] uint32_t edgePoint(uint32_t corner) const {
        return parent_.cage.vertexCount() + parent_.topology.cornerEdges[corner];
    }
    [[nodiscard]] uint32_t facePoint(uint32_t face) const {
        return parent_.cage.vertexCount() + static_cast<uint32_t>(parent_.topology.edges.size()) + face;
    }

protected:
    const RefinedMesh& parent_;
};

/// One step of Catmull-Clark on faces of any kind, or of Loop on triangles. The child lacks what equip() adds. Its
/// vertices are those of the parent, then one per edge (in the order of Topology::edges), then, for Catmull-Clark, one
/// per face. Each face of the parent gives one face per corner, which is the new face's corner 0; Loop then adds the
/// middle one.
[[nodiscard]] RefinedMesh refine(const RefinedMesh& parent, Subdivision subdivision);

/// Gives a child what another step needs.
[[nodiscard]] Status equip(RefinedMesh& child, const RefinedMesh& parent);

/// The two edges of a child that the parent's edge from a corner to the next was split into.
struct EdgeHalves {
    uint32_t first = 0, second = 0;
};
[[nodiscard]] EdgeHalves edgeHalves(const RefinedMesh& child, const RefinedMesh& parent, uint32_t corner);

} // namespace supple::surface
