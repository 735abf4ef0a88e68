// Corner attributes in the tables: every patch corner finds its own, whether its number is a half word or a whole one.
#include "surface/schemes.h"
#include "tools/common/procedural.h"

#include <bit>
#include <gtest/gtest.h>
#include <set>
#include <utility>

namespace supple::surface {
namespace {

Tables tablesOf(const cage::Cage& cage, SchemeId scheme) {
    Recipe recipe;
    recipe.scheme = scheme;
    Result<Tables> tables = buildTables(recipe, cage);
    EXPECT_TRUE(tables.ok());
    return tables ? std::move(*tables) : Tables{};
}

/// Element of a corner's attributes, by what shaders/shared/surface.h says of the numbers.
uint32_t elementOf(const Tables& tables, const PatchRange& range, uint32_t corner) {
    const uint32_t word = tables.words.at(range.attributes + (tables.attributeHalves ? corner / 2 : corner));
    return tables.attributes + (!tables.attributeHalves ? word : corner % 2 == 0 ? word & 0xFFFFu : word >> 16);
}

/// Compares every patch corner's coordinates with those of the cage's corner; gives the elements met.
std::set<uint32_t> compareAll(const cage::Cage& cage, const Tables& tables) {
    std::set<uint32_t> elements;
    uint32_t differing = 0, compared = 0;
    for (const PatchRange& range : tables.ranges) {
        for (uint32_t p = 0; p < range.section.count; ++p) {
            const uint32_t face = tables.patches[range.firstPatch + p].face;
            for (uint32_t i = 0; i < 4; ++i, ++compared) {
                const uint32_t element = elementOf(tables, range, 4 * p + i);
                const auto uv = [&](uint32_t k) { return std::bit_cast<float>(tables.words.at(4 * element + k)); };
                // The patch's corner 0 may be another of its face's.
                bool found = false;
                for (uint32_t c = 4 * face; c < 4 * face + 4; ++c) {
                    found = found || (cage.faceVertices[c] == tables.patches[range.firstPatch + p].corners[i] &&
                                      cage.cornerUvs[c] == glm::vec2(uv(0), uv(1)));
                }
                differing += found ? 0 : 1;
                elements.insert(element);
            }
        }
    }
    EXPECT_EQ(differing, 0u);
    EXPECT_EQ(compared, cage.cornerCount());
    return elements;
}

TEST(CornerAttributes, MoreThanAHalfWordCounts) {
    cage::Cage cage = cage::makeCubeSphere(106);
    ASSERT_GT(cage.vertexCount(), 1u << 16);
    for (const uint32_t v : cage.faceVertices) {
        cage.cornerUvs.emplace_back(static_cast<float>(v), 0.5f);
    }
    for (const SchemeId scheme : {SchemeId::pm, SchemeId::prep}) {
        const Tables tables = tablesOf(cage, scheme);
        EXPECT_FALSE(tables.attributeHalves);
        EXPECT_EQ(compareAll(cage, tables).size(), cage.vertexCount());
    }
}

TEST(CornerAttributes, SeamsAndSharedOnes) {
    cage::Cage cage = cage::makeCubeSphere(5);
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) { // a side of the cube has coordinates of its own
        cage.cornerUvs.emplace_back(static_cast<float>(cage.faceVertices[c]), static_cast<float>(c / (4 * 25)));
    }
    std::set<std::pair<float, float>> different;
    for (const glm::vec2 uv : cage.cornerUvs) {
        different.emplace(uv.x, uv.y);
    }
    ASSERT_GT(different.size(), cage.vertexCount());
    for (const SchemeId scheme : {SchemeId::pm, SchemeId::prep}) {
        const Tables tables = tablesOf(cage, scheme);
        EXPECT_TRUE(tables.attributeHalves);
        EXPECT_EQ(compareAll(cage, tables).size(), different.size());
    }
}

TEST(CornerAttributes, CornersWithNothingShareOne) {
    const cage::Cage cage = cage::makeCubeSphere(5);
    const Tables tables = tablesOf(cage, SchemeId::prep);
    for (const PatchRange& range : tables.ranges) {
        for (uint32_t corner = 0; corner < 4 * range.section.count; ++corner) {
            EXPECT_EQ(elementOf(tables, range, corner), tables.attributes);
        }
    }
}

} // namespace
} // namespace supple::surface
