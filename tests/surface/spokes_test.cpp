// What the words of records hold: how many edges a vertex may have, how many kinds of them a cage, and the fans of its
// vertices.
#include "cage/topology.h"
#include "shaders/shared/surface.h"
#include "surface/patch_records.h"
#include "surface/schemes.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>
#include <set>
#include <string>
#include <utility>

namespace supple::surface {
namespace {

using shared::kPointBits;
using shared::kRingPlaceBits;
constexpr uint32_t kMost = shared::kMaxSpokeStep;

TEST(Spokes, StepsAreReadAsTheyAreWritten) {
    using namespace shared;
    constexpr uint32_t kLast = kMaxSpokes - 1;
    for (const auto& [spoke, next] :
         {std::pair(0u, 1u), {0u, kMost}, {kMost, 0u}, {kLast - kMost, kLast}, {kLast, kLast - kMost}}) {
        const uint32_t word = spokeWord(spoke, next);
        EXPECT_EQ(SUPPLE_SPOKE(word), spoke);
        EXPECT_EQ(SUPPLE_NEXT_SPOKE(word), next);
    }
}

TEST(Spokes, AVertexOfTooManyEdgesIsNamed) {
    for (const SchemeId scheme : {SchemeId::prep, SchemeId::pm}) {
        Recipe recipe;
        recipe.scheme = scheme;
        const Result<Tables> most = buildTables(recipe, test::fan(kMost, 2, 6.283185307179586, true));
        EXPECT_TRUE(most.ok()) << most.error().message;
        const Result<Tables> tooMany = buildTables(recipe, test::fan(kMost + 1, 2, 6.283185307179586, true));
        ASSERT_FALSE(tooMany.ok());
        EXPECT_EQ(tooMany.error().code, ErrorCode::limit);
        EXPECT_NE(tooMany.error().message.find("vertex 0 has 512 edges"), std::string::npos) << tooMany.error().message;
    }
}

/// Appends `more`, which shares nothing with it.
void append(cage::Cage& cage, const cage::Cage& more) {
    const uint32_t vertices = cage.vertexCount(), corners = cage.faceStarts.empty() ? 0 : cage.faceStarts.back();
    cage.positions.insert(cage.positions.end(), more.positions.begin(), more.positions.end());
    if (cage.faceStarts.empty()) {
        cage.faceStarts.push_back(0);
    }
    for (size_t f = 1; f < more.faceStarts.size(); ++f) {
        cage.faceStarts.push_back(corners + more.faceStarts[f]);
    }
    for (const uint32_t v : more.faceVertices) {
        cage.faceVertices.push_back(vertices + v);
    }
}

TEST(Spokes, TooManyKindsOfEdgesAreCounted) {
    constexpr double kTurn = 6.283185307179586;
    Recipe recipe;
    recipe.scheme = SchemeId::pm;
    cage::Cage cage;
    for (uint32_t n = 3; n <= kMost; ++n) { // two kinds each, outwards and inwards, and a few they all have
        append(cage, test::fan(n, 1, kTurn, true));
    }
    EXPECT_TRUE(buildTables(recipe, cage).ok());
    for (uint32_t n = 3; n <= 100; ++n) { // the borders beside a vertex of n facets: others again
        append(cage, test::fan(n, 1, 0.9 * kTurn, false));
    }
    const Result<Tables> tooMany = buildTables(recipe, cage);
    ASSERT_FALSE(tooMany.ok());
    EXPECT_EQ(tooMany.error().code, ErrorCode::limit);
    EXPECT_NE(tooMany.error().message.find("patch records hold 1024"), std::string::npos) << tooMany.error().message;
    EXPECT_EQ(tooMany.error().message.find("face "), 0u) << tooMany.error().message;
}

// Vertex and far end of every spoke, as the ring has them: in records of patches, and where a face is a hole in
// elements of its own.
TEST(Spokes, TheRingHoldsAllFans) {
    for (const bool hole : {false, true}) {
        for (const SchemeId scheme : {SchemeId::prep, SchemeId::pm}) {
            cage::Cage cage = test::biped();
            if (hole) {
                cage.holes = {1};
            }
            const Result<cage::Topology> topology = cage::buildTopology(cage);
            ASSERT_TRUE(topology.ok());
            Recipe recipe;
            recipe.scheme = scheme;
            const Result<Tables> tables = buildTables(recipe, cage);
            ASSERT_TRUE(tables.ok()) << tables.error().message;
            std::multiset<std::pair<uint32_t, uint32_t>> expected, found;
            for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
                for (uint32_t s = topology->spokeStarts[v]; s < topology->spokeStarts[v + 1]; ++s) {
                    const uint32_t word = tables->words[tables->ring + expected.size()];
                    const uint32_t* element = &tables->words[size_t{4} * SUPPLE_RING_ELEMENT(word)];
                    expected.emplace(v, topology->spokeVertices[s]);
                    found.emplace(SUPPLE_POINT(element[SUPPLE_RING_PLACE(word, shared::kRingVertex)]),
                                  SUPPLE_POINT(element[SUPPLE_RING_PLACE(word, shared::kRingFarEnd)]));
                }
            }
            EXPECT_EQ(expected, found);
        }
    }
}

} // namespace
} // namespace supple::surface
