// Disks round a vertex of so many faces that the points of its net lie as far apart as there are points: some of them
// come again (surface/chains/needed_rows.h).
#pragma once

#include "shaders/shared/subdivision.h"
#include "surface/lod/tables.h"
#include "surface/mesh_tables.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>
#include <vector>

namespace supple::test {

/// Vertex 0, and rings of vertices round it.
struct PoleRings {
    uint32_t around = 0, rings = 0;

    [[nodiscard]] uint32_t at(uint32_t ring, uint32_t k) const { return 1 + ring * around + k % around; }
    [[nodiscard]] std::vector<glm::vec3> positions() const {
        std::vector<glm::vec3> all{glm::vec3(0.0f)};
        for (uint32_t ring = 0; ring < rings; ++ring) {
            for (uint32_t k = 0; k < around; ++k) {
                const double angle = 2.0 * std::numbers::pi * k / around, radius = 1.0 + 1.2 * ring / rings;
                all.push_back(glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 0.3 * std::cos(radius)));
            }
        }
        return all;
    }
};

/// Quads, with creases along the rings.
[[nodiscard]] inline cage::Cage largePoleOfQuads(PoleRings rings = {3000, 7}) {
    Faces polygons;
    for (uint32_t k = 0; k < rings.around; ++k) {
        if (k % 2 == 0) {
            polygons.push_back({0, rings.at(0, k), rings.at(0, k + 1), rings.at(0, k + 2)});
        }
        for (uint32_t r = 0; r + 1 < rings.rings; ++r) {
            polygons.push_back({rings.at(r, k), rings.at(r + 1, k), rings.at(r + 1, k + 1), rings.at(r, k + 1)});
        }
    }
    cage::Cage cage = makeCage(rings.positions(), polygons);
    for (uint32_t r = 1; r + 1 < rings.rings; r += 2) {
        for (uint32_t k = 0; k < rings.around; ++k) {
            cage.creases.push_back({rings.at(r, k), rings.at(r, k + 1), 1.5f});
        }
    }
    return cage;
}

/// Triangles, whose vertices have 4 and 8 of them by turns.
[[nodiscard]] inline cage::Cage largePoleOfTriangles(PoleRings rings = {1500, 12}) {
    Faces polygons;
    for (uint32_t k = 0; k < rings.around; ++k) {
        polygons.push_back({0, rings.at(0, k), rings.at(0, k + 1)});
        for (uint32_t r = 0; r + 1 < rings.rings; ++r) {
            const uint32_t a = rings.at(r, k), b = rings.at(r + 1, k), c = rings.at(r + 1, k + 1),
                           d = rings.at(r, k + 1);
            if ((r + k) % 2 == 0) {
                polygons.insert(polygons.end(), {{a, b, c}, {a, c, d}});
            } else {
                polygons.insert(polygons.end(), {{a, b, d}, {b, c, d}});
            }
        }
    }
    return makeCage(rings.positions(), polygons);
}

/// How many points that stencils make are there already. The tables must be so large that their rows have whole words.
[[nodiscard]] inline size_t repeatedPoints(const surface::Tables& tables) {
    size_t rows = 0;
    std::set<std::vector<uint32_t>> distinct; // by what they are made of
    for (const surface::Construction& made : tables.constructions) {
        if (made.kernel != surface::KindOfKernel{surface::Kernel::subdivisionIsolate, shared::kWholeWords}) {
            continue;
        }
        for (size_t b = 0; b < made.section.count / shared::kBlockLanes; ++b) {
            const uint32_t* block = &tables.words[4 * (made.section.table + b)];
            const size_t first = block[0], each = block[1], count = block[2];
            rows += count;
            for (size_t r = 0; r < count; ++r) {
                const uint32_t* row = &tables.words[first + each * r]; // its number, then weights and vertices
                distinct.insert(std::vector<uint32_t>(row + 1, row + each));
            }
        }
    }
    EXPECT_GT(rows, 0u);
    return rows - distinct.size();
}

/// Points come again, but not many; and both sides of an edge still are one, at levels and in an indexed mesh.
inline void expectCopies(surface::Tables tables, const surface::PatchEdges& given, size_t faces, size_t edges) {
    const size_t again = repeatedPoints(tables);
    EXPECT_GT(again, 100u);
    EXPECT_LT(again, faces / 2);
    surface::lod::appendTables(given, tables);
    EXPECT_EQ(tables.lod.edgeCount, edges);
    surface::appendMeshTables(given, false, false, tables);
    EXPECT_EQ(tables.mesh.edgeCount, edges);
}

} // namespace supple::test
