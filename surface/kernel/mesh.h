// The cage as the subdivision kernel sees it: refined by Catmull-Clark's or Loop's rules until every fragment has at
// most its centre irregular (the isolated level), and cut into fragments. Connectivity and sharpness only; built once
// per asset. Paper and numbers: docs/kernel.md.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/subdivision.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::surface::kernel {

using surface::Subdivision;

enum class FragmentKind : uint8_t {
    vertex, ///< the corner sectors of the faces round a vertex of the level before the isolated one
    facet   ///< Loop: the middle triangle of a split one
};

/// One fragment. Sectors of a vertex fragment are numbered counter-clockwise: sector h lies between spokes h and h + 1;
/// open fans begin at the boundary edge that all their faces follow counter-clockwise.
struct Fragment {
    FragmentKind kind = FragmentKind::vertex;
    bool open = false;
    uint32_t sectors = 0;         ///< m; 1 for a facet
    uint32_t firstNet = 0;        ///< into Mesh::net
    uint32_t firstSector = 0;     ///< into Mesh::sectorFaces: `sectors` entries
    uint32_t firstSpoke = 0;      ///< into Mesh::spokeSharpness: spokes() entries
    float centreSharpness = 0.0f; ///< of the vertex, on the isolated level

    /// Sharpness values: one a spoke; of a facet one a side, sides v0v1, v1v2, v2v0 of the triangle that was split
    /// (lines through corners c0, c1, c2).
    [[nodiscard]] uint32_t spokes() const { return kind == FragmentKind::facet ? 3 : sectors + (open ? 1 : 0); }
};

struct Mesh {
    Subdivision subdivision = Subdivision::catmullClark;
    uint32_t isolationSteps = 1; ///< G: 2 for Catmull-Clark unless all faces are quads, else 1
    /// The isolated level: quads or triangles, with corner attributes, materials and rest positions carried down.
    /// Its vertices are the parent level's vertices, then a point an edge (in the order of Topology::edges), then,
    /// Catmull-Clark, a point a face. Its faces come in the order of the parent's, of each a face a corner (which is
    /// that face's corner 0), then, Loop, the middle one. Without creases, sharp vertices and a list of holes:
    /// sharpness stands in the fragments, holes below.
    cage::Cage cage;
    std::vector<uint32_t> sourceFaces; ///< per face of `cage`: the host's face it came from
    std::vector<uint8_t> holes;        ///< per face of `cage`: 1 where the host's face is not drawn
    /// Per face of `cage` and corner (3 or 4 a face, packed as its corners are): the host's cage vertex that stands
    /// there, or kNone.
    std::vector<uint32_t> cornerSources;
    /// A step each, the last of `cage`; over the vertices of the step before, in double.
    std::vector<Stencils> stencils;

    std::vector<Fragment> fragments;
    std::vector<uint32_t> net; ///< vertices of `cage`, in the order of the spiral index (pattern.h), radius 2
    /// Faces of `cage`, a sector each. Catmull-Clark: face corner 0 is the fragment's centre, corner 1 lies along spoke
    /// h. Loop's corner triangles likewise; of a facet corner 0 is c0.
    std::vector<uint32_t> sectorFaces;
    std::vector<float> spokeSharpness; ///< on the isolated level; kInfiniteSharpness and more never softens
    std::vector<std::string> notes; ///< what was changed on the way in: "face 12 has 4 sides: split into 2 triangles"
};

/// Refuses by name what cage::buildTopology refuses. Loop splits faces of four and more sides into fans of triangles
/// and says so; from the first corner whose diagonals are no edges yet, and refuses a face that has none. O(corners).
[[nodiscard]] Result<Mesh> buildMesh(const cage::Cage& cage, Subdivision subdivision);

} // namespace supple::surface::kernel
