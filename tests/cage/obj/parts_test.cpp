// Objects and groups as parts, welding by position, colors.
#include "cage/obj/reader.h"
#include "cage/topology.h"
#include "tests/cage/gltf/builder.h"
#include "tests/support/shared_assets.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>

namespace supple::cage {
namespace {

using test::toBytes;
using Lines = std::vector<std::string>;

Character readObject(const std::string& text, const ObjOptions& options = {}) {
    Result<Character> result = readObj(toBytes(text), "t.obj", options);
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() ? std::move(result.value()) : Character{};
}

Lines partNames(const Character& character) {
    Lines names;
    for (const Part& part : character.parts) {
        names.push_back(part.name);
    }
    return names;
}

/// Six vertices in two rows: two quads side by side.
const std::string kSixVertices = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n";
const std::string kLeft = "f 1 2 5 4\n";
const std::string kRight = "f 2 3 6 5\n";

/// A cube whose faces have four vertices each.
std::string cubeOfLooseFaces() {
    const int corners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    std::string vertices, faces;
    for (int f = 0; f < 6; ++f) {
        faces += "f";
        for (int k = 0; k < 4; ++k) {
            const int v = corners[f][k];
            vertices +=
                "v " + std::to_string(v & 1) + " " + std::to_string(v >> 1 & 1) + " " + std::to_string(v >> 2) + "\n";
            faces += " " + std::to_string(4 * f + k + 1);
        }
        faces += "\n";
    }
    return vertices + faces;
}

TEST(ObjParts, ObjectsArePartsUnderTheOneJoint) {
    const Character c = readObject(kSixVertices + "g front\no Body\n" + kLeft + "o Hat # red\n" + kRight);
    EXPECT_EQ(partNames(c), (Lines{"Body", "Hat"}));
    EXPECT_EQ(c.cage.faceParts, (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(c.warnings, Lines());
    ASSERT_EQ(c.skeleton.nodes.size(), 3u);
    EXPECT_EQ(c.skin.joints, (std::vector<uint32_t>{0}));
    for (uint32_t part = 0; part < 2; ++part) {
        const Node& node = c.skeleton.nodes[c.parts[part].node];
        EXPECT_EQ(node.name, c.parts[part].name);
        EXPECT_EQ(node.parent, 0u);
    }
    // The edge that both use is sewn.
    EXPECT_EQ(c.cage.vertexCount(), 6u);
    EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 3, 4, 2, 5}));
    EXPECT_EQ(c.sourceVertexCount, 6u);
    const Result<Topology> topology = buildTopology(c.cage);
    EXPECT_TRUE(topology.ok());

    const Character apart =
        readObject(kSixVertices + "o Body\n" + kLeft + "o Hat\n" + kRight, {.finish = {.sewParts = false}});
    EXPECT_EQ(apart.cage.vertexCount(), 8u);
    EXPECT_EQ(apart.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 3, 4, 1, 2, 4, 5}));
}

TEST(ObjParts, NamesAgainAreTheSamePart) {
    const Character c = readObject(kSixVertices + "v 0 2 0\nv 1 2 0\n" + "g a\n" + kLeft + "g b\n" + kRight +
                                   "g a\nf 4 5 8 7\nt crease 2/1/0 4 3 2\nt corner 1/1/0 4 3\nt hole 1/0/0 2\n");
    EXPECT_EQ(partNames(c), (Lines{"a", "b"}));
    EXPECT_EQ(c.cage.faceParts, (std::vector<uint32_t>{0, 0, 1}));
    EXPECT_EQ(c.cage.holes, (std::vector<uint32_t>{1})) << "tags follow the faces";
    ASSERT_EQ(c.cage.creases.size(), 1u);
    EXPECT_EQ(c.cage.positions[c.cage.creases[0].a] + c.cage.positions[c.cage.creases[0].b], glm::vec3(1, 2, 0));
    ASSERT_EQ(c.cage.sharpVertices.size(), 1u) << "of both parts, sewn";
    EXPECT_EQ(c.cage.positions[c.cage.sharpVertices[0].vertex], glm::vec3(1, 1, 0));
    EXPECT_EQ(c.warnings, Lines());
}

TEST(ObjParts, WhatHasNoNameIsOnePart) {
    EXPECT_EQ(partNames(readObject(kSixVertices + kLeft + "o Hat\n" + kRight)), (Lines{"", "Hat"}));
    EXPECT_EQ(partNames(readObject(kSixVertices + "o Hat\n" + kLeft + kRight)), Lines{"Hat"});
    EXPECT_EQ(partNames(readObject(kSixVertices + "o Empty\n" + "o Hat#2\n" + kLeft + kRight)), Lines{"Hat#2"});
    EXPECT_EQ(partNames(readObject(kSixVertices + "o\n" + kLeft + kRight)), Lines{"t"}) << "as the file";
    EXPECT_EQ(partNames(readObject(kSixVertices + "g a\n" + kLeft + "g b\n" + kRight + "o late\n")), (Lines{"a", "b"}))
        << "an object without faces is none";
    EXPECT_EQ(partNames(readObject(kSixVertices + "o a\n" + kLeft + "o b\nf 1 2 99\n")), Lines{"a"});
}

TEST(ObjParts, MessagesNameThePart) {
    const Character c = readObject(kSixVertices + "o Body\n" + kLeft + "o Hat\n" + kRight + "f 2 2 3\n");
    ASSERT_EQ(c.warnings.size(), 1u);
    EXPECT_EQ(c.warnings[0], "object \"Hat\": 1 face has fewer than three different vertices or bounds nothing: face "
                             "1; left out");
}

TEST(ObjParts, TooManyAreOne) {
    std::string text = kSixVertices;
    for (int i = 0; i < 16385; ++i) {
        text += "g " + std::to_string(i) + "\nf 1 2 5\n";
    }
    const Character c = readObject(text);
    EXPECT_EQ(partNames(c), Lines{"t"});
    ASSERT_FALSE(c.warnings.empty());
    EXPECT_EQ(c.warnings[0], "file: 16385 groups are more than 16384 parts; read as one");
}

TEST(ObjWeld, VerticesInOnePlaceAreOne) {
    const std::string tags = "t crease 2/1/0 0 1 3\nt corner 1/1/0 8 4\n"; // by numbers before they are welded
    const Character c = readObject(cubeOfLooseFaces() + tags);
    EXPECT_EQ(c.warnings, Lines{"file: 24 vertices lie in 8 places; welded"});
    EXPECT_EQ(c.cage.vertexCount(), 8u);
    EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6, 7})) << "in the order of the first";
    EXPECT_EQ(c.parts[0].weldSource, WeldSource::equality);
    EXPECT_EQ(c.sourceVertexCount, 24u);
    EXPECT_EQ(c.seamVertexCount, 16u);
    const Result<Topology> topology = buildTopology(c.cage);
    ASSERT_TRUE(topology.ok());
    ASSERT_EQ(c.cage.creases.size(), 1u);
    EXPECT_EQ(c.cage.creases[0].sharpness, 3.0f);
    ASSERT_EQ(c.cage.sharpVertices.size(), 1u);
    EXPECT_EQ(c.cage.positions[c.cage.sharpVertices[0].vertex], glm::vec3(0, 0, 0));

    const Character apart = readObject(cubeOfLooseFaces(), {.weld = false});
    EXPECT_EQ(apart.warnings, Lines());
    EXPECT_EQ(apart.cage.vertexCount(), 24u);
    EXPECT_EQ(apart.parts[0].weldSource, WeldSource::given);
}

TEST(ObjWeld, ZeroHasNoSign) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -0 -0.0 0\nv 1 -0 -0\nv 1 -1 0\n"
                             "f 1 2 3 4\nf 6 5 7\n";
    const Character c = readObject(text);
    EXPECT_EQ(c.warnings, Lines{"file: 4 vertices lie in 2 places; welded"});
    EXPECT_EQ(c.cage.vertexCount(), 5u);
}

TEST(ObjWeld, WhatMerelyTouchesStaysApart) {
    // Two quads that touch in a corner, and the two sides of a sheet.
    const std::string touching = kSixVertices + "v 1 1 0\nv 1 2 0\nv 2 2 0\n" + kLeft + "f 7 9 8\n";
    EXPECT_EQ(readObject(touching).cage.vertexCount(), 7u);
    EXPECT_EQ(readObject(touching).warnings.size(), 1u) << "an unused vertex";
    const std::string sheet = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                              "f 1 2 3 4\nf 8 7 6 5\n";
    EXPECT_EQ(readObject(sheet).cage.vertexCount(), 8u);
    EXPECT_EQ(readObject(sheet).warnings, Lines());
}

TEST(ObjWeld, PartsAreWeldedForThemselves) {
    const std::string apart = kSixVertices + "v 1 0 0\nv 1 1 0\no a\n" + kLeft + "o b\nf 7 3 6 8\n";
    const Character c = readObject(apart);
    EXPECT_EQ(c.warnings, Lines()) << "sewn, not welded";
    EXPECT_EQ(c.cage.vertexCount(), 6u);
    EXPECT_EQ(c.parts[0].weldSource, WeldSource::given);
}

TEST(ObjColors, AreSrgbPerVertex) {
    const Character c = readObject("v 0 0 0 1 0.5 0\nv 1 0 0 1 1 1\nv 1 1 0 0 0 0.04 0.5\nv 0 1 0\nf 1 2 3 4\n");
    ASSERT_EQ(c.cage.cornerColors.size(), 4u);
    EXPECT_EQ(c.cage.cornerColors[0].x, 1.0f);
    EXPECT_NEAR(c.cage.cornerColors[0].y, 0.21404114f, 1e-6f);
    EXPECT_NEAR(c.cage.cornerColors[2].z, 0.04f / 12.92f, 1e-8f);
    EXPECT_EQ(c.cage.cornerColors[2].w, 1.0f);
    EXPECT_EQ(c.cage.cornerColors[3], glm::vec4(1.0f));
    EXPECT_EQ(c.warnings, Lines{"file: 1 vertex has no color; white"});
}

TEST(ObjColors, FaultyOnesAreLeftOut) {
    const Character c = readObject("v 0 0 0 255 0 0\nv 1 0 0 x 0 0\nv 1 1 0 nan 0 0\nv 0 1 0 1\nf 1 2 3 4\n");
    EXPECT_TRUE(c.cage.cornerColors.empty());
    EXPECT_EQ(c.warnings, Lines{"line 1: 3 colors are not three numbers of 0 to 1, this being the first; left out"});
}

} // namespace
} // namespace supple::cage
