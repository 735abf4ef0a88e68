// Tables of the exact schemes and what they were made of, for the checks of tables that come from files.
#pragma once

#include "surface/schemes.h"
#include "surface/table_check.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace supple::test {

struct ExactTables {
    surface::Recipe recipe;
    surface::Tables tables;
    uint32_t vertices = 0, faces = 0, parts = 1, materials = 0;

    [[nodiscard]] Status check() const { return check(tables); }
    [[nodiscard]] Status check(const surface::Tables& other) const {
        return surface::checkTables(other, {recipe, vertices, faces, parts, materials});
    }
};

/// `rate`: as a group asks for it.
inline Result<ExactTables> makeExactTables(surface::Recipe recipe, uint32_t rate, const cage::Cage& cage) {
    recipe.rate = surface::schemeOf(recipe.scheme).tableRate(rate, recipe.lod);
    Result<surface::Tables> tables = surface::buildTables(recipe, cage);
    if (!tables) {
        return tables.error();
    }
    ExactTables made{recipe, std::move(*tables), cage.vertexCount(), cage.faceCount()};
    const auto countOf = [](const std::vector<uint32_t>& indices) {
        uint32_t count = 0;
        for (const uint32_t index : indices) {
            count = index == cage::kNone ? count : std::max(count, index + 1);
        }
        return count;
    };
    made.parts = std::max(countOf(cage.faceParts), 1u);
    made.materials = countOf(cage.faceMaterials);
    return made;
}

/// Texture coordinates whose charts end at some of the edges.
inline cage::Cage withCharts(cage::Cage cage, bool second = false) {
    cage.cornerUvs.clear();
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        for (uint32_t c = cage.faceStarts[face]; c < cage.faceStarts[face + 1]; ++c) {
            const glm::vec3& p = cage.positions[cage.faceVertices[c]];
            cage.cornerUvs.push_back(glm::vec2(p.x + 0.3f * p.z, p.y) + glm::vec2(face % 5 < 2 ? 10.0f : 0.0f));
        }
    }
    if (second) {
        cage.cornerUvs1 = cage.cornerUvs;
        std::reverse(cage.cornerUvs1.begin(), cage.cornerUvs1.end());
    }
    return cage;
}

/// Quads with a semi-sharp crease straight through: Catmull-Clark has quads of leaves there, some without chains.
inline cage::Cage straightCrease() {
    cage::Cage cage = grid(5, 5);
    for (uint32_t y = 0; y < 5; ++y) {
        cage.creases.push_back({6 * y + 2, 6 * y + 8, 1.5f});
    }
    return cage;
}

/// Every third edge of a face is a crease: endless, or semi-sharp ones too.
inline cage::Cage withCreases(cage::Cage cage, bool semiSharp) {
    for (uint32_t face = 0; face < cage.faceCount(); face += 2) {
        const uint32_t c = cage.faceStarts[face] + face % cage.sides(face);
        const uint32_t next = c + 1 < cage.faceStarts[face + 1] ? c + 1 : cage.faceStarts[face];
        const float sharpness = semiSharp && face % 3 != 0 ? 0.7f + 0.5f * static_cast<float>(face % 4) : 10.0f;
        const std::pair edge = std::minmax(cage.faceVertices[c], cage.faceVertices[next]);
        const bool known = std::ranges::any_of(cage.creases, [&](const cage::Crease& crease) {
            return std::pair(crease.a, crease.b) == std::pair(edge.first, edge.second);
        });
        if (!known) {
            cage.creases.push_back({edge.first, edge.second, sharpness});
        }
    }
    return cage;
}

} // namespace supple::test
