// Cages that between them bring every rule of the subdivision to every kind of border between fragments.
#pragma once

#include "cage/character.h"

#include <string>
#include <vector>

namespace supple::test {

struct SubdivisionCage {
    std::string name;
    cage::Cage cage;
};

/// Closed and open cages of triangles, quads and other faces, valences 3 to 12, moved out of symmetry; then with
/// semi-sharp and infinite creases, darts, and corners by name; then all with random sharpness on a third of the edges
/// and a tenth of the vertices.
[[nodiscard]] const std::vector<SubdivisionCage>& subdivisionZoo();

/// Sharpness below 1, below 4 and infinite, by the seed.
[[nodiscard]] cage::Cage withRandomSharpness(cage::Cage cage, uint32_t seed);

/// Every face a fan of triangles from its first corner; creases, sharp vertices and holes as they were.
[[nodiscard]] cage::Cage inTriangles(const cage::Cage& cage);

} // namespace supple::test
