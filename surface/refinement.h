// Refines a whole cage, step by step, by the rules of Catmull-Clark or Loop: connectivity, stencils, sharpness and
// corner attributes. The cage's positions matter only for the rest pose of the result.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/subdivision_rules.h"

#include <cstdint>
#include <optional>
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

/// A mesh that can be refined.
struct Level {
    cage::Cage cage;                   ///< without creases, sharp vertices and holes
    std::vector<uint32_t> sourceFaces; ///< per face: the face of the first level it came from
    std::vector<uint8_t> holes;        ///< per face: 1 if that face is not drawn
    Stencils stencils;                 ///< one row per vertex, over the vertices of the level before
    // What another step needs. A child has none of it before equip().
    cage::Topology topology;
    std::vector<float> edgeSharpness, vertexSharpness;
};

/// Calls `copy` with every attribute that corners carry.
template <class Copy>
void forEachCornerAttribute(const cage::Cage& from, cage::Cage& to, Copy&& copy) {
    copy(from.cornerUvs, to.cornerUvs);
    copy(from.cornerUvs1, to.cornerUvs1);
    copy(from.cornerColors, to.cornerColors);
    copy(from.cornerFaceUvs, to.cornerFaceUvs);
}

/// Ends a face of `to`, whose corners were added before. It came from face `face` of `from`.
void closeFace(Level& to, const Level& from, uint32_t face);

/// The first level: faces, attributes and holes of the cage. The caller then fills in `topology` and calls
/// beginLevel().
[[nodiscard]] Level givenLevel(const cage::Cage& cage);

/// Gives the level the sharpness of the cage's creases and sharp vertices, and stencils in which every vertex is
/// itself. Creases that name no edge and sharp vertices that do not exist are reported in `notes`.
void beginLevel(Level& level, const cage::Cage& cage, std::vector<std::string>& notes);

/// One step of Catmull-Clark on faces of any kind, or of Loop on triangles. The child lacks what equip() adds. Its
/// vertices are those of the parent, then one per edge (in the order of Topology::edges), then, for Catmull-Clark, one
/// per face. Each face of the parent gives one face per corner, which is the new face's corner 0; Loop then adds the
/// middle one.
[[nodiscard]] Level refine(const Level& parent, Subdivision subdivision);

/// Gives a Catmull-Clark child what another step needs.
[[nodiscard]] std::optional<Error> equip(Level& child, const Level& parent);

/// The two edges of a Catmull-Clark child that the parent's edge from a corner to the next was split into.
struct EdgeHalves {
    uint32_t first = 0, second = 0;
};
[[nodiscard]] EdgeHalves edgeHalves(const Level& child, const Level& parent, uint32_t corner);

} // namespace supple::surface
