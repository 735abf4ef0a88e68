// Refinement of a whole cage, a step at a time, by Catmull-Clark's or Loop's rules: connectivity, stencils, sharpness
// and what corners carry. Positions of the cage are read for the rest pose alone.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/subdivision_rules.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace supple::surface {

/// Points as affine combinations of a cage's vertices: row i is the entries [starts[i], starts[i + 1]).
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
    std::vector<uint8_t> holes;        ///< per face: 1 where that one is not drawn
    Stencils stencils;                 ///< of its vertices, over those of the level before
    // What a further step needs; a child has none of it until equip().
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

/// After the corners of a face that came from face `face` of `from`.
void closeFace(Level& to, const Level& from, uint32_t face);

/// The cage's faces, attributes and holes; then `topology` has to be filled in, and beginLevel() called.
[[nodiscard]] Level givenLevel(const cage::Cage& cage);

/// Lays the cage's creases and sharp vertices on the level and gives it stencils of 1 times itself; adds to `notes`
/// what names no edge or vertex.
void beginLevel(Level& level, const cage::Cage& cage, std::vector<std::string>& notes);

/// A step of Catmull-Clark on any faces, or of Loop on triangles: the child but for what equip() gives it. Its vertices
/// are the parent's, then a point an edge (in the order of Topology::edges), then, Catmull-Clark, a point a face. Its
/// faces come in the order of the parent's, of each a face a corner (which is that face's corner 0), then, Loop, the
/// middle one.
[[nodiscard]] Level refine(const Level& parent, Subdivision subdivision);

/// Gives a child of Catmull-Clark what another step asks of it.
[[nodiscard]] std::optional<Error> equip(Level& child, const Level& parent);

/// The edges of a Catmull-Clark child that are the halves of the parent's edge from a corner to the next.
struct EdgeHalves {
    uint32_t first = 0, second = 0;
};
[[nodiscard]] EdgeHalves edgeHalves(const Level& child, const Level& parent, uint32_t corner);

} // namespace supple::surface
