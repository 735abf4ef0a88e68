// Small cages for the tests, and cages read from OBJ files.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::test {

using Faces = std::vector<std::vector<uint32_t>>;

[[nodiscard]] cage::Cage makeCage(std::vector<glm::vec3> positions, const Faces& polygons);
[[nodiscard]] Faces facesOf(const cage::Cage& cage);

/// Corners at +-1.
[[nodiscard]] cage::Cage cube();
/// columns x rows quads in the xy plane, spacing 1, facing +z; vertex (x, y) is y * (columns + 1) + x.
[[nodiscard]] cage::Cage grid(uint32_t columns, uint32_t rows);
/// around x across quads, all of valence 4.
[[nodiscard]] cage::Cage torus(uint32_t around, uint32_t across);
/// Twelve pentagons.
[[nodiscard]] cage::Cage dodecahedron();
/// The outer squares of unit cubes, each named by its corner of least coordinates; no two may meet in an edge or a
/// vertex alone.
[[nodiscard]] cage::Cage voxels(const std::vector<glm::ivec3>& cubes);
/// Seven cubes: a middle and six arms; valences 3, 4 and 6.
[[nodiscard]] cage::Cage jack();
/// 92 quads, valences 3 to 6: legs, a torso two cubes deep, arms, and a head that stands on the torso at z = 5.
[[nodiscard]] cage::Cage biped();
/// 2 n quads between two poles of valence n; the other vertices have valence 3.
[[nodiscard]] cage::Cage trapezohedron(uint32_t n);
/// A flat disk (angle = whole turn: n interior quads round a vertex) or sector of quads round vertex 0: `sectors`
/// sectors of rings x rings quads each. An open sector's apex is a boundary vertex with `sectors` faces.
[[nodiscard]] cage::Cage fan(uint32_t sectors, uint32_t rings, double angle, bool closed);
/// A closed prism: n quads between two n-gons.
[[nodiscard]] cage::Cage prism(uint32_t n);
/// A tube of rings - 1 rings of n quads, closed by fans of n triangles.
[[nodiscard]] cage::Cage cappedCylinder(uint32_t n, uint32_t rings);
/// Triangles alone: two poles of valence n and a zigzag belt.
[[nodiscard]] cage::Cage gyroBipyramid(uint32_t n);
/// A prism with a fan of n triangles for a lid: the quads end in valence 4 at the fan, in valence 3 below.
[[nodiscard]] cage::Cage fanOverQuads(uint32_t n);
/// A fan of 2 n triangles over a ring of n triangles and n quads by turns, closed by an n-gon.
[[nodiscard]] cage::Cage fanOverTriangles(uint32_t n);
/// A fan of n triangles, a ring of n pentagons, and quads round the other pole.
[[nodiscard]] cage::Cage fanOverPentagons(uint32_t n);
/// Every triangle cut into four at the middles of its edges.
[[nodiscard]] cage::Cage quartered(const cage::Cage& triangles);
/// A share of the quads cut into two triangles, chosen by the seed.
[[nodiscard]] cage::Cage withCutQuads(const cage::Cage& cage, double share, uint32_t seed);
/// Neighboring faces merged at random, `tries` times, into faces of up to five sides; no valence below 3 comes of it.
[[nodiscard]] cage::Cage withMergedFaces(const cage::Cage& cage, uint32_t tries, uint32_t seed);
/// The cage without some faces; vertices that no face uses any more are dropped.
[[nodiscard]] cage::Cage withoutFaces(const cage::Cage& cage, const std::vector<uint32_t>& faces);

/// Moves every vertex by up to `amount` in each coordinate; the same for the same seed everywhere.
[[nodiscard]] cage::Cage perturbed(cage::Cage cage, float amount, uint32_t seed);
/// Rotates the corners of face f by f mod sides: the same surface, other starting corners.
[[nodiscard]] cage::Cage rotatedFaces(cage::Cage cage);

struct NamedCage {
    const char* name;
    cage::Cage cage;
};

/// One Catmull-Clark step in double on the cage's polygons, boundary as B-spline curves, corners with one face kept
/// where they are. The first vertexCount() positions are the vertex points.
struct RefinedCage {
    cage::Cage cage; ///< connectivity; its positions are the rounded ones
    std::vector<glm::dvec3> positions;
};
[[nodiscard]] RefinedCage refineCatmullClark(const cage::Cage& cage, const std::vector<glm::dvec3>& positions,
                                             bool sharpCorners);

[[nodiscard]] std::vector<glm::dvec3> doublePositions(const cage::Cage& cage);
[[nodiscard]] bool allQuads(const cage::Cage& cage);
/// Diagonal of the bounding box.
[[nodiscard]] double extent(const std::vector<glm::dvec3>& positions);

/// cage::readObj() of a file. One that cannot be opened is refused as an empty one.
[[nodiscard]] Result<cage::Character> readObjFile(const std::string& path);

} // namespace supple::test
