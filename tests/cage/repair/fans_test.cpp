// Vertices whose faces are not one fan.
#include "tests/cage/repair/repaired.h"

#include <random>
#include <set>

namespace supple::cage {
namespace {

using namespace test;

TEST(RepairFans, ABowTieGetsOneVertexForEachFan) {
    const Repaired r = repaired(points(7), {{0, 1, 2}, {0, 3, 4}, {0, 2, 5}, {6, 3, 0}});
    EXPECT_EQ(r.found, Strings{"cage: 1 vertex has faces that are no single fan: vertex 0 of 2 fans"});
    EXPECT_EQ(r.repairs, Strings{"one vertex for each fan"});
    EXPECT_EQ(facesOf(r.cage), (Faces{{0, 1, 2}, {7, 3, 4}, {0, 2, 5}, {6, 3, 7}}));
    EXPECT_EQ(r.cage.sourceVertices.back(), 0u);
    ASSERT_EQ(r.cage.sharpVertices.size(), 2u) << "the fans go on touching";
    EXPECT_EQ(r.cage.sharpVertices[0].vertex, 0u);
    EXPECT_EQ(r.cage.sharpVertices[1].vertex, 7u);
    EXPECT_EQ(r.cage.sharpVertices[1].sharpness, kHardSharpness);
}

TEST(RepairFans, CopiesAreInOrderOfVertexAndFan) {
    // Three fans at vertex 5, two at vertex 1.
    const Repaired r = repaired(points(9), {{5, 0, 1}, {5, 2, 3}, {1, 4, 6}, {5, 7, 8}});
    EXPECT_EQ(r.found, Strings{"cage: 2 vertices have faces that are no single fan, the first is vertex 1 of 2 fans"});
    EXPECT_EQ(facesOf(r.cage), (Faces{{5, 0, 1}, {10, 2, 3}, {9, 4, 6}, {11, 7, 8}}));
    EXPECT_EQ(r.cage.sourceVertices, (Indices{0, 1, 2, 3, 4, 5, 6, 7, 8, 1, 5, 5}));
}

TEST(RepairFans, LooseVerticesAreLeftOut) {
    const Repaired r = repaired(points(5), {{1, 2, 4}});
    EXPECT_EQ(r.found, Strings{"cage: 2 vertices have no face, the first is vertex 0"});
    EXPECT_EQ(r.repairs, Strings{"left out"});
    EXPECT_EQ(r.cage.sourceVertices, (Indices{1, 2, 4}));
    EXPECT_EQ(facesOf(r.cage), (Faces{{0, 1, 2}}));
}

/// Whatever faces there are: a topology can be built afterwards, no proper face is lost, and each keeps its vertices.
TEST(RepairFans, AnyFacesAtAll) {
    std::mt19937 random(7);
    for (uint32_t round = 0; round < 3000; ++round) {
        const uint32_t vertexCount = 4 + random() % 9;
        std::vector<glm::vec3> positions;
        for (uint32_t v = 0; v < vertexCount; ++v) {
            const auto part = [&] { return static_cast<float>(random() % 5); };
            positions.emplace_back(part(), part(), part());
        }
        Faces polygons;
        const uint32_t faces = 1 + random() % 16;
        for (uint32_t f = 0; f < faces; ++f) {
            std::vector<uint32_t> face;
            for (uint32_t sides = random() % (round % 2 == 0 ? 5 : 8); face.size() < sides + 1;) {
                face.push_back(static_cast<uint32_t>(random() % vertexCount));
            }
            polygons.push_back(face);
        }
        const Cage cage = supple::test::makeCage(positions, polygons);
        if (buildTopology(cage).ok()) {
            continue;
        }
        SCOPED_TRACE(round);
        const Repaired r = repaired(cage);
        ASSERT_FALSE(::testing::Test::HasFailure());
        if (!r.refusal.empty()) {
            continue;
        }
        for (uint32_t v = 0; v < r.cage.vertexCount(); ++v) {
            ASSERT_EQ(r.cage.positions[v], positions[r.cage.sourceVertices[v]]);
        }
    }
}

} // namespace
} // namespace supple::cage
