// Where faces lie in the tiles of their trim.
#include "cage/trim.h"

#include <cmath>
#include <gtest/gtest.h>

namespace supple::cage {
namespace {

/// One face a number of sides.
Cage facesOf(const std::vector<uint32_t>& sides, const std::vector<uint32_t>& tiles) {
    Cage cage;
    cage.faceStarts.push_back(0);
    for (const uint32_t n : sides) {
        for (uint32_t corner = 0; corner < n; ++corner) {
            cage.faceVertices.push_back(cage.vertexCount());
            cage.positions.emplace_back(0.0f);
        }
        cage.faceStarts.push_back(cage.cornerCount());
    }
    cage.faceTrimTiles = tiles;
    return cage;
}

TEST(Trim, QuadsFillTheirTile) {
    const std::vector<glm::vec2> at = tileCoordinates(facesOf({4, 4}, {3, kNone}));
    const std::vector<glm::vec2> expected = {{6, 0}, {7, 0}, {7, 1}, {6, 1}, {-2, 0}, {-1, 0}, {-1, 1}, {-2, 1}};
    EXPECT_EQ(at, expected);
}

TEST(Trim, OtherFacesAreRegularPolygonsInIt) {
    for (const uint32_t sides : {3u, 5u, 6u, 9u}) {
        const std::vector<glm::vec2> at = tileCoordinates(facesOf({sides}, {0}));
        ASSERT_EQ(at.size(), sides);
        glm::vec2 sum(0.0f);
        for (uint32_t k = 0; k < sides; ++k) {
            sum += at[k];
            EXPECT_NEAR(glm::distance(at[k], glm::vec2(0.5f)), 0.5f, 1e-6f);
            EXPECT_NEAR(glm::distance(at[k], at[(k + 1) % sides]), std::sin(3.14159265f / static_cast<float>(sides)),
                        1e-6f);
        }
        EXPECT_NEAR(glm::distance(sum / static_cast<float>(sides), glm::vec2(0.5f)), 0.0f, 1e-6f);
        EXPECT_NEAR(at[0].y, at[1].y, 1e-6f) << "the first side is level";
        EXPECT_LT(at[0].x, at[1].x);
        EXPECT_LT(at[0].y, 0.5f);
    }
}

TEST(Trim, TilesNeverMeet) {
    // Whatever lies between corners of one face is nearer to its own tile than to another.
    const std::vector<glm::vec2> at = tileCoordinates(facesOf({4, 5, 3}, {0, 1023, kNone}));
    const float tiles[] = {0, 1023, -1};
    const uint32_t starts[] = {0, 4, 9, 12};
    for (uint32_t f = 0; f < 3; ++f) {
        for (uint32_t c = starts[f]; c < starts[f + 1]; ++c) {
            EXPECT_EQ(std::floor(0.5f * at[c].x + 0.25f), tiles[f]);
        }
    }
    EXPECT_FALSE(hasTrimTiles(facesOf({4}, {kNone})));
    EXPECT_TRUE(hasTrimTiles(facesOf({4, 4}, {kNone, 0})));
}

} // namespace
} // namespace supple::cage
