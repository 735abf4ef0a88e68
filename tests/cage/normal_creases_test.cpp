// Creases where a file's normals are split.
#include "cage/normal_creases.h"

#include "cage/corner_normals.h"
#include "cage/formats/reader.h"
#include "tests/cage/gltf/builder.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace supple::cage {
namespace {

using Edges = std::set<std::pair<uint32_t, uint32_t>>;

Edges hardCreases(const Cage& cage) {
    Edges edges;
    for (const Crease& crease : cage.creases) {
        if (crease.sharpness >= kHardSharpness) {
            EXPECT_TRUE(edges.insert(std::minmax(crease.a, crease.b)).second) << "one crease an edge";
        }
    }
    return edges;
}

/// Two squares side by side, (0 1 4 3) and (1 2 5 4), with one normal for each.
Cage twoSquares(const glm::vec3& first, const glm::vec3& second) {
    Cage cage = supple::test::grid(2, 1);
    cage.cornerNormals.assign(4, glm::normalize(first));
    cage.cornerNormals.resize(8, glm::normalize(second));
    return cage;
}

TEST(NormalCreases, EdgesWithSplitNormalsAreSharp) {
    Cage cage = twoSquares({0, 0, 1}, {1, 0, 1});
    EXPECT_EQ(creaseSplitNormals(cage), 1u);
    EXPECT_EQ(hardCreases(cage), (Edges{{1, 4}})) << "and no edge of the boundary";
    cage = twoSquares({0, 0, 1}, {0.01f, 0, 1});
    EXPECT_EQ(creaseSplitNormals(cage), 0u) << "half a degree is rounding";
    EXPECT_TRUE(cage.creases.empty());
    cage = twoSquares({0, 0, 1}, {1, 0, 1});
    cage.cornerNormals.clear();
    EXPECT_EQ(creaseSplitNormals(cage), 0u);
    cage.cornerNormals.assign(8, glm::vec3(0.0f));
    EXPECT_EQ(creaseSplitNormals(cage), 0u) << "corners without a normal do not say";
}

TEST(AngleCreases, EdgesWhoseFacesMeetAtMoreAreSharp) {
    Cage cube = supple::test::cube();
    EXPECT_EQ(creaseAngles(cube, 91.0), 0u);
    EXPECT_TRUE(cube.creases.empty());
    cube.creases = {{0, 1, 2.0f}};
    EXPECT_EQ(creaseAngles(cube, 89.0), 12u);
    EXPECT_EQ(hardCreases(cube).size(), 12u) << "the crease that was there is one of them";
    Cage flat = supple::test::grid(3, 3);
    EXPECT_EQ(creaseAngles(flat, 0.1), 0u) << "and no edge of the boundary";
}

TEST(NormalCreases, AHardEdgeMayEndInTheSurface) {
    // The normals agree at vertex 4.
    Cage cage = twoSquares({0, 0, 1}, {1, 0, 1});
    for (uint32_t corner = 0; corner < cage.cornerCount(); ++corner) {
        if (cage.faceVertices[corner] == 4) {
            cage.cornerNormals[corner] = {0, 0, 1};
        }
    }
    EXPECT_EQ(creaseSplitNormals(cage), 1u);
    EXPECT_EQ(hardCreases(cage), (Edges{{1, 4}}));
}

TEST(NormalCreases, CreasesThatAreThereAreKept) {
    for (const auto& [before, after] : {std::pair{2.0f, 10.0f}, {12.0f, 12.0f}}) {
        Cage cage = twoSquares({0, 0, 1}, {1, 0, 1});
        cage.creases = {{0, 1, 3.0f}, {4, 1, before}};
        EXPECT_EQ(creaseSplitNormals(cage), 1u);
        ASSERT_EQ(cage.creases.size(), 2u);
        EXPECT_EQ(cage.creases[0].sharpness, 3.0f);
        EXPECT_EQ(cage.creases[1].sharpness, after);
    }
}

/// Six squares in a row, each bent against the one before; (i i+1 i+8 i+7). Normals are split at edges i < `split`.
Character bentStrip(uint32_t split, PolygonSource source) {
    Character character;
    character.cage = supple::test::grid(6, 1);
    for (glm::vec3& p : character.cage.positions) {
        p.z = 0.3f * p.x * p.x;
    }
    for (uint32_t face = 0; face < 6; ++face) {
        const float step = static_cast<float>(std::min(face, split));
        character.cage.cornerNormals.resize(size_t{4} * (face + 1), glm::normalize(glm::vec3(step, 0, 1)));
    }
    character.parts[0].polygonSource = source;
    return character;
}

TEST(NormalCreases, PlainTrianglesThatAreHardInPlacesKeepTheirEdges) {
    for (const PolygonSource source : {PolygonSource::triangles, PolygonSource::pairedTriangles}) {
        Character some = bentStrip(2, source);
        creasePartlySplitNormals(some);
        EXPECT_EQ(hardCreases(some.cage), (Edges{{1, 8}, {2, 9}}));
        EXPECT_EQ(some.warnings,
                  std::vector<std::string>{"file: 2 edges of 1 of 1 part made hard creases: their normals are split"});
        for (const uint32_t split : {0u, 3u, 5u}) {
            Character other = bentStrip(split, source);
            creasePartlySplitNormals(other);
            EXPECT_TRUE(other.cage.creases.empty()) << "none, or everywhere: " << split << " of 5";
            EXPECT_TRUE(other.warnings.empty());
        }
    }
    Character drawn = bentStrip(2, PolygonSource::obj);
    creasePartlySplitNormals(drawn);
    EXPECT_TRUE(drawn.cage.creases.empty()) << "somebody drew its polygons, and its creases";
}

TEST(NormalCreases, ReadersAddThemIfAsked) {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 1\nv 2 1 1\nvn 0 0 1\nvn -1 0 1\n"
                            "f 1//1 2//1 3//1 4//1\nf 2//2 5//2 6//2 3//2\n";
    test::GltfBuilder gltf;
    gltf.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0,
                            1, 0, 0, 2, 0, 1, 2, 1, 1, 1, 0, 0, 2, 1, 1, 1, 1, 0});
    gltf.addFloats("VEC3", {0,  0, 1, 0,  0, 1, 0,  0, 1, 0,  0, 1, 0,  0, 1, 0,  0, 1,
                            -1, 0, 1, -1, 0, 1, -1, 0, 1, -1, 0, 1, -1, 0, 1, -1, 0, 1});
    gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1}}]}])";
    const std::vector<std::pair<std::string, std::vector<std::byte>>> files = {{"a.obj", test::toBytes(obj)},
                                                                               {"a.glb", gltf.glb()}};
    for (const auto& [name, bytes] : files) {
        for (const bool asked : {false, true}) {
            const Result<Character> character =
                readCharacter(bytes, name, "", {.normalCreases = asked ? NormalCreases::all : NormalCreases::never});
            ASSERT_TRUE(character) << character.error().message;
            EXPECT_EQ(hardCreases(character->cage), (asked ? Edges{{1, 2}} : Edges{})) << name;
        }
    }
}

} // namespace
} // namespace supple::cage
