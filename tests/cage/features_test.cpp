#include "cage/features.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>
#include <limits>

namespace supple::cage {
namespace {

struct Built {
    Topology topology;
    Features features;
};

Built build(const Cage& cage) {
    Result<Topology> topology = buildTopology(cage);
    if (!topology.ok()) {
        ADD_FAILURE() << topology.error().message;
        return {};
    }
    Features features = buildFeatures(cage, *topology);
    return {std::move(*topology), std::move(features)};
}

float sharpness(const Cage& cage, const Built& built, uint32_t a, uint32_t b) {
    return built.features.edgeSharpness.at(findEdge(cage, built.topology, a, b));
}

TEST(Features, aPlainCageHasNone) {
    const Cage cage = test::cube();
    const Built built = build(cage);
    EXPECT_EQ(built.features.edgeSharpness, std::vector<float>(12, 0.0f));
    EXPECT_EQ(built.features.vertexSharpness, std::vector<float>(8, 0.0f));
    EXPECT_EQ(built.features.spokeAlphas, std::vector<float>(24, -1.0f));
    EXPECT_TRUE(built.features.unused.empty());
}

TEST(Features, boundariesAreHard) {
    const Cage cage = test::grid(3, 2);
    const Built built = build(cage);
    for (uint32_t e = 0; e < built.topology.edges.size(); ++e) {
        const bool boundary = built.topology.edges[e].twin == kNone;
        EXPECT_EQ(built.features.hard(e), boundary);
        EXPECT_EQ(built.features.edgeSharpness[e], boundary ? kHardSharpness : 0.0f);
    }
}

TEST(Features, creases) {
    Cage cage = test::grid(2, 2); // edges of vertex 4 go to 1, 3, 5, 7
    const float nan = std::numeric_limits<float>::quiet_NaN();
    cage.creases = {{4, 1, 2.0f}, {1, 4, 3.0f}, {4, 1, 1.0f}, {3, 4, -2.0f}, {4, 5, nan}, {4, 7, 12.0f}, {0, 1, 0.5f}};
    const Built built = build(cage);
    EXPECT_EQ(sharpness(cage, built, 1, 4), 3.0f); // the sharpest
    EXPECT_EQ(sharpness(cage, built, 3, 4), 0.0f);
    EXPECT_EQ(sharpness(cage, built, 4, 5), 0.0f);
    EXPECT_EQ(sharpness(cage, built, 4, 7), 12.0f);
    EXPECT_EQ(sharpness(cage, built, 0, 1), kHardSharpness); // on the boundary
    EXPECT_TRUE(built.features.hard(findEdge(cage, built.topology, 7, 4)));
    EXPECT_FALSE(built.features.hard(findEdge(cage, built.topology, 1, 4)));
    EXPECT_TRUE(built.features.unused.empty());
}

TEST(Features, sharpVertices) {
    Cage cage = test::cube();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    cage.sharpVertices = {{3, 4.0f}, {3, 11.0f}, {3, 2.0f}, {5, nan}, {6, -1.0f}};
    const Built built = build(cage);
    EXPECT_EQ(built.features.vertexSharpness, (std::vector<float>{0, 0, 0, 11.0f, 0, 0, 0, 0}));
}

TEST(Features, edgesHaveTheSetOfTheirCrease) {
    Cage cage = test::cube();
    EXPECT_TRUE(build(cage).features.edgeSets.empty());
    cage.creaseSets = {"a", "b"};
    cage.creases = {{0, 1, 1.0f, 1}, {0, 2, 3.0f, kNone}};
    const Built built = build(cage);
    for (uint32_t e = 0; e < built.topology.edges.size(); ++e) {
        EXPECT_EQ(built.features.edgeSets[e], e == findEdge(cage, built.topology, 1, 0) ? 1 : kNone);
    }
}

TEST(Features, creaseScalarsStandAtTheirEndOfTheEdge) {
    // Every end of every edge, inside and on the boundary.
    for (Cage cage : {test::cube(), test::grid(3, 2), test::fan(3, 2, 2.0, false)}) {
        const Built plain = build(cage);
        std::vector<float> expected;
        for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
            for (uint32_t s = plain.topology.spokeStarts[v]; s < plain.topology.spokeStarts[v + 1]; ++s) {
                expected.push_back(static_cast<float>(expected.size()) / 1024.0f);
                cage.creaseScalars.push_back({v, plain.topology.spokeVertices[s], expected.back()});
            }
        }
        cage.creaseScalars.insert(cage.creaseScalars.begin(), {0, plain.topology.spokeVertices[0], 0.9f});
        const Built built = build(cage);
        EXPECT_EQ(built.features.spokeAlphas, expected); // of two at one end the last
        EXPECT_TRUE(built.features.unused.empty());
    }
}

TEST(Features, whatIsNotInTheCageIsNamed) {
    Cage cage = test::cube();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    cage.creases = {{0, 7, 1.0f}, {0, 99, 1.0f}, {kNone, 0, 1.0f}, {2, 2, 1.0f}, {0, 1, 5.0f}};
    cage.sharpVertices = {{8, 10.0f}, {0, 10.0f}};
    cage.creaseScalars = {{0, 7, 0.5f}, {0, 1, 1.5f}, {0, 2, -0.25f}, {1, 0, nan}, {0, 4, 1.0f}, {4, 0, 0.0f}};
    const Built built = build(cage);
    EXPECT_EQ(built.features.unused,
              (std::vector<std::string>{"crease (0, 7): the cage has no such edge, and 3 more like it",
                                        "sharp vertex 8: the cage has only 8 vertices",
                                        "crease scalar 0 -> 7: the cage has no such edge",
                                        "crease scalar 0 -> 1: 1.500000 is not between 0 and 1, and 2 more like it"}));
    EXPECT_EQ(sharpness(cage, built, 0, 1), 5.0f); // the rest is used
    EXPECT_EQ(built.features.vertexSharpness[0], 10.0f);
    uint32_t given = 0;
    for (const float alpha : built.features.spokeAlphas) {
        given += alpha >= 0.0f ? 1 : 0;
    }
    EXPECT_EQ(given, 2u);
}

TEST(Features, edgesAreFoundFromEitherEnd) {
    for (const Cage& cage : {test::cube(), test::grid(3, 2), test::cappedCylinder(9, 3)}) {
        const Result<Topology> topology = buildTopology(cage);
        ASSERT_TRUE(topology.ok());
        uint32_t joined = 0;
        for (uint32_t a = 0; a < cage.vertexCount(); ++a) {
            for (uint32_t b = 0; b < cage.vertexCount(); ++b) {
                const uint32_t edge = findEdge(cage, *topology, a, b);
                EXPECT_EQ(edge, findEdge(cage, *topology, b, a));
                if (edge != kNone) {
                    const uint32_t corner = topology->edges[edge].corner;
                    const uint32_t from = cage.faceVertices[corner];
                    const uint32_t to = cage.faceVertices[nextCorner(cage, topology->cornerFaces[corner], corner)];
                    EXPECT_TRUE((from == a && to == b) || (from == b && to == a));
                    ++joined;
                }
            }
        }
        EXPECT_EQ(joined, 2 * topology->edges.size());
        for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
            for (uint32_t s = topology->spokeStarts[v]; s < topology->spokeStarts[v + 1]; ++s) {
                EXPECT_EQ(spokeEdge(cage, *topology, s), findEdge(cage, *topology, v, topology->spokeVertices[s]));
            }
        }
    }
}

} // namespace
} // namespace supple::cage
