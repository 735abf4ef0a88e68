#include "cage/piece.h"

#include "cage/parts.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace supple::cage {
namespace {

TEST(CagePiece, HasWhatItsFacesHave) {
    Cage cube = test::cube();
    for (uint32_t c = 0; c < cube.cornerCount(); ++c) {
        cube.cornerUvs.emplace_back(static_cast<float>(c), 0.5f);
    }
    for (uint32_t f = 0; f < cube.faceCount(); ++f) {
        cube.faceMaterials.push_back(10 + f);
        const uint32_t s = cube.faceStarts[f];
        cube.faceTriangles.insert(cube.faceTriangles.end(), {s + 1, s + 2, s + 3, s + 1, s + 3, s});
    }
    cube.holes = {2, 4};
    const uint32_t a = cube.faceVertices[cube.faceStarts[4]], b = cube.faceVertices[cube.faceStarts[4] + 1];
    cube.creases = {{a, b, 3.0f}};
    cube.sharpVertices = {{a, 4.0f}};

    const std::vector<uint32_t> faces = {1, 4};
    const CagePiece piece = takeFaces(cube, faces);
    ASSERT_EQ(piece.faces, faces);
    ASSERT_EQ(piece.cage.faceCount(), 2u);
    EXPECT_TRUE(std::is_sorted(piece.vertices.begin(), piece.vertices.end()));
    for (uint32_t f = 0; f < 2; ++f) {
        EXPECT_EQ(piece.cage.faceMaterials[f], 10 + faces[f]);
        for (uint32_t k = 0; k < 4; ++k) {
            const uint32_t own = piece.cage.faceStarts[f] + k, from = cube.faceStarts[faces[f]] + k;
            EXPECT_EQ(piece.vertices[piece.cage.faceVertices[own]], cube.faceVertices[from]);
            EXPECT_EQ(piece.cage.positions[piece.cage.faceVertices[own]], cube.positions[cube.faceVertices[from]]);
            EXPECT_EQ(piece.cage.cornerUvs[own], cube.cornerUvs[from]);
        }
    }
    EXPECT_EQ(piece.cage.faceTriangles, (std::vector<uint32_t>{1, 2, 3, 1, 3, 0, 5, 6, 7, 5, 7, 4}));
    EXPECT_EQ(piece.cage.holes, std::vector<uint32_t>{1});
    ASSERT_EQ(piece.cage.creases.size(), 1u);
    EXPECT_EQ(piece.vertices[piece.cage.creases[0].a], a);
    EXPECT_EQ(piece.vertices[piece.cage.creases[0].b], b);
    ASSERT_EQ(piece.cage.sharpVertices.size(), 1u);
    EXPECT_EQ(piece.vertices[piece.cage.sharpVertices[0].vertex], a);

    // A face that has not both ends of the crease has no crease.
    for (const uint32_t face : {0u, 1u, 2u, 3u, 5u}) {
        const auto begin = cube.faceVertices.begin() + cube.faceStarts[face], end = begin + 4;
        const bool both = std::find(begin, end, a) != end && std::find(begin, end, b) != end;
        EXPECT_EQ(takeFaces(cube, {&face, 1}).cage.creases.size(), both ? 1u : 0u) << face;
    }
}

TEST(CagePiece, PartsThatShareVerticesAreSewn) {
    Cage cube = test::cube();
    EXPECT_EQ(sewnTo(cube, 1), std::vector<uint32_t>{0}) << "one part needs no list of parts";
    cube.faceParts = {3, 3, 3, 1, 1, 1};
    EXPECT_EQ(sewnTo(cube, 5), (std::vector<uint32_t>{0, 1, 2, 1, 4}));
    // Two cubes, each of two parts; 0 and 2 are the first one's.
    Cage two = test::cube();
    const Cage other = test::cube();
    for (const glm::vec3& p : other.positions) {
        two.positions.push_back(p + glm::vec3(5.0f, 0.0f, 0.0f));
    }
    for (uint32_t f = 0; f < other.faceCount(); ++f) {
        two.faceStarts.push_back(two.faceStarts.back() + 4);
    }
    for (const uint32_t v : other.faceVertices) {
        two.faceVertices.push_back(other.vertexCount() + v);
    }
    two.faceParts = {0, 0, 0, 2, 2, 2, 1, 1, 1, 3, 3, 3};
    EXPECT_EQ(sewnTo(two, 4), (std::vector<uint32_t>{0, 1, 0, 1}));
}

} // namespace
} // namespace supple::cage
