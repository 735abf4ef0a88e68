// The cage as the subdivision sees it: refined to the isolated level, and cut into fragments. The isolated level is the
// first at which no vertex of a fragment but its centre is irregular. Depends on connectivity and sharpness only; built
// once per asset. Papers and numbers: docs/subdivision.md.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/refinement.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::surface::subdivision {

using surface::Subdivision;

enum class FragmentKind : uint8_t {
    vertex, ///< around a vertex of the level before the isolated one: the nearest quarter of each of its faces
    facet   ///< Loop: the middle triangle of a split one
};

/// One fragment. The sectors of a vertex fragment are numbered counter-clockwise. Sector h lies between spokes h and
/// h + 1. An open fan begins at its boundary edge that all its faces follow counter-clockwise.
struct Fragment {
    FragmentKind kind = FragmentKind::vertex;
    bool open = false;
    uint32_t sectors = 0;         ///< m; 1 for a facet
    uint32_t firstNet = 0;        ///< into Mesh::net
    uint32_t firstSector = 0;     ///< into Mesh::sectorFaces: `sectors` entries
    uint32_t firstSpoke = 0;      ///< into Mesh::spokeSharpness: spokes() entries
    float centreSharpness = 0.0f; ///< of the vertex, on the isolated level

    /// How many sharpness values there are: one per spoke. A facet has one per side v0v1, v1v2, v2v0 of the triangle
    /// that was split; those sides pass through its corners c0, c1, c2.
    [[nodiscard]] uint32_t spokes() const { return kind == FragmentKind::facet ? 3 : sectors + (open ? 1 : 0); }
};

struct Mesh {
    Subdivision subdivision = Subdivision::catmullClark;
    uint32_t isolationSteps = 1; ///< G: 2 for Catmull-Clark unless all faces are quads, else 1
    /// The isolated mesh: quads or triangles with corner attributes, materials, holes and rest positions. Vertices and
    /// faces have the order of surface::refine(). It has no creases and sharp vertices: sharpness is in the fragments.
    cage::Cage cage;
    std::vector<uint32_t> sourceFaces; ///< per face of `cage`: the host's face it came from
    uint32_t hostVertices = 0;         ///< so many vertices of `cage` are the host's; they come first
    /// One entry per step, over the vertices of the step before. The last one gives the vertices of `cage`.
    std::vector<Stencils> stencils;

    std::vector<Fragment> fragments;
    std::vector<uint32_t> net; ///< vertices of `cage` up to radius 2, in spiral order (surface/subdivision/pattern.h)
    /// The face of `cage` that a sector is. Its corner 0 is the centre of the fragment, and corner 1 lies along spoke
    /// h. In a facet corner 0 is c0.
    std::vector<uint32_t> sectorFaces;
    std::vector<float> spokeSharpness; ///< at the isolated level
    std::vector<std::string> notes;    ///< what was changed, one line each
};

/// The cage as the first step takes it: Loop's with triangles alone. Refuses what buildMesh() refuses.
[[nodiscard]] Result<RefinedMesh> beginSteps(const cage::Cage& cage, Subdivision subdivision,
                                             std::vector<std::string>& notes);

/// Refuses what cage::buildTopology refuses, with the same message. Loop splits faces of four and more sides into fans
/// of triangles, with a note. The fan begins at the first corner none of whose diagonals is an edge already; a face
/// without such a corner is refused. O(corners).
[[nodiscard]] Result<Mesh> buildMesh(const cage::Cage& cage, Subdivision subdivision);

/// The isolated mesh, and the level before, whose vertices and faces the fragments are made of: fragment v is that of
/// vertex v.
struct Isolation {
    RefinedMesh parent;
    Mesh mesh;
};
/// One step of a mesh whose vertices and faces the fragments are made of. `mesh` has no host vertices and no notes.
[[nodiscard]] Isolation isolateLevel(RefinedMesh parent, Subdivision subdivision);
/// As buildMesh().
[[nodiscard]] Result<Isolation> isolateCage(const cage::Cage& cage, Subdivision subdivision);

} // namespace supple::surface::subdivision
