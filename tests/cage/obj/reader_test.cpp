#include "cage/obj/reader.h"

#include "cage/formats/reader.h"
#include "cage/topology.h"
#include "tests/cage/gltf/builder.h"
#include "tests/cage/named_lines.h"
#include "tests/support/meshes.h"
#include "tests/support/shared_assets.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace supple::cage {
namespace {

namespace fs = std::filesystem;
using test::toBytes;
using Strings = std::vector<std::string>;

Result<Character> read(const std::string& text, bool strict = false) {
    return readObj(toBytes(text), "t.obj", {.finish = {.strict = strict}});
}

Character readWell(const std::string& text) {
    Result<Character> result = read(text);
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() ? std::move(result.value()) : Character{};
}

/// By a strict reading.
void expectRefused(const std::string& text, const std::string& message) {
    const Result<Character> result = read(text, true);
    ASSERT_FALSE(result.ok()) << message;
    EXPECT_EQ(result.error().message, "t.obj: " + message);
}

const std::string kFourVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kSquare = kFourVertices + "f 1 2 3 4\n";

/// Two quads side by side: vertices 0 1 2 / 3 4 5, edge 1-4 between them.
const std::string kTwoQuads = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 2 3 6 5\n";

TEST(ObjReader, ReadsNormals) {
    const std::string normals = "vn 0 0 3\nvn 0 1 0\n";
    const Character c = readWell(kFourVertices + "vt 0 0\n" + normals + "f 1//1 2/1/2 3/1/-2 4\n");
    const std::vector<glm::vec3> wanted = {{0, 0, 1}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    EXPECT_EQ(c.cage.cornerNormals, wanted);
    EXPECT_TRUE(c.warnings.empty());
    EXPECT_TRUE(readWell(kSquare + normals).cage.cornerNormals.empty()) << "no face has one";
}

TEST(ObjReader, RepairsNormalsAndNamesThem) {
    const Character c = readWell(kFourVertices + "vn 0 0 0\nvn nan 0 1\nvn 1 2\nvn x y z\nf 1//1 2//2 3//3 4//9\n");
    EXPECT_EQ(c.cage.cornerNormals, std::vector<glm::vec3>(4, glm::vec3(0.0f)));
    ASSERT_EQ(c.warnings.size(), 1u);
    EXPECT_EQ(c.warnings[0],
              "line 5: 5 normals are missing or no directions, this being the first; the faces' own instead");
}

TEST(ObjReader, PolygonsOfAnySidesInTheFilesOrder) {
    const Character c = readWell("# a house\n"
                                 "o house\n"
                                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 1.5 -1e-3\nv 0 1 0\nv 2 0 0 1\n"
                                 "g wall\ns off\n"
                                 "f 1 2 3 4 5\n"
                                 "f 2 6 3\n");
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::obj);
    EXPECT_EQ(c.parts[0].weldSource, WeldSource::given);
    EXPECT_EQ(c.cage.faceStarts, (std::vector<uint32_t>{0, 5, 8}));
    EXPECT_EQ(c.cage.faceVertices, (std::vector<uint32_t>{0, 1, 2, 3, 4, 1, 5, 2}));
    EXPECT_EQ(c.cage.faceMaterials, (std::vector<uint32_t>{kNone, kNone}));
    EXPECT_EQ(c.cage.positions[3], glm::vec3(0.5f, 1.5f, -1e-3f));
    EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(c.sourceVertexCount, 6u);
    EXPECT_TRUE(c.cage.cornerUvs.empty());
    EXPECT_TRUE(buildTopology(c.cage).ok());

    ASSERT_EQ(c.skeleton.nodes.size(), 1u);
    EXPECT_EQ(c.skeleton.nodes[0].name, "t");
    EXPECT_EQ(c.skin.joints, (std::vector<uint32_t>{0}));
    ASSERT_EQ(c.weights.starts.size(), 7u);
    EXPECT_EQ(c.weights.starts[6], 6u);
    EXPECT_EQ(c.weights.influences[5].weight, 1.0f);
}

TEST(ObjReader, CornersHaveTheirOwnUvsCountedDownwards) {
    const Character c = readWell(kTwoQuads + "v 0 2 0\nv 1 2 0\nv 2 2 0\nvt 0 0\nvt 1 0.25\nvt 0.5\nvn 0 0 1\n"
                                             "f 4/1/1 5/2/1 7/-1/-1\nf 5//1 6/3 9\n");
    ASSERT_EQ(c.cage.cornerUvs.size(), 14u);
    EXPECT_EQ(c.cage.cornerUvs[0], glm::vec2(0, 0)) << "no vt there";
    EXPECT_EQ(c.cage.cornerUvs[8], glm::vec2(0, 1));
    EXPECT_EQ(c.cage.cornerUvs[9], glm::vec2(1, 0.75f));
    EXPECT_EQ(c.cage.cornerUvs[10], glm::vec2(0.5f, 1)) << "a missing v is 0";
    EXPECT_EQ(c.cage.cornerUvs[11], glm::vec2(0, 0)) << "a corner without vt";
    EXPECT_EQ(c.cage.cornerUvs[12], glm::vec2(0.5f, 1));
}

TEST(ObjReader, IndicesCountBackFromWhereTheyStandOrForwards) {
    const Character back = readWell(kFourVertices + "f -4 -3 -2 -1\nv 2 0 0\nv 2 1 0\nf -5 -2 -1 -4\n");
    EXPECT_EQ(back.cage.faceVertices, (std::vector<uint32_t>{0, 1, 2, 3, 1, 4, 5, 2}));
    const Character forward = readWell("f 1 2 3 4\n" + kFourVertices);
    EXPECT_EQ(forward.cage.faceVertices, (std::vector<uint32_t>{0, 1, 2, 3}));
}

TEST(ObjReader, LineEndsContinuationsAndComments) {
    const Character c =
        readWell("\xEF\xBB\xBFv 0 0 0\r\nv 1 0 0 # right\r\n\r\n\tv +1\t1.0 \\\r\n 0\r\nv 0 1 0\r\nf 1 2 \\\n"
                 "3 \\\n4");
    EXPECT_EQ(c.cage.faceVertices, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(c.cage.positions[2], glm::vec3(1, 1, 0));
    expectRefused("v 0 \\\n 0 \\\n 0\nv 1\n", "line 4: position: a number is missing");
    EXPECT_TRUE(read(kSquare + "g\\").ok()) << "nothing follows";
}

TEST(ObjReader, MaterialsAreNames) {
    const Character c = readWell("mtllib two.mtl\n" + kTwoQuads + "v 0 2 0\nv 1 2 0\nusemtl  red paint \nf 4 5 7\n" +
                                 "usemtl\nf 5 8 7\nusemtl red paint\nf 5 6 8\n");
    ASSERT_EQ(c.materials.size(), 2u);
    EXPECT_EQ(c.materials[0].name, "red paint");
    EXPECT_EQ(c.materials[0].baseColorFactor, glm::vec4(1.0f));
    EXPECT_EQ(c.materials[1].name, "");
    EXPECT_EQ(c.cage.faceMaterials, (std::vector<uint32_t>{kNone, kNone, 0, 1, 0}));
    EXPECT_EQ(c.warnings, Strings{"line 1: mtllib \"two.mtl\": external files are not allowed for an asset read from "
                                  "memory; left out"});
}

TEST(ObjReader, CreasesAlongChains) {
    const Character c = readWell(kTwoQuads + "t crease 2/1/0 4 1 2.5\n"    // the inner edge
                                             "t crease 3/2/0 0 1 2 1 10\n" // one sharpness an edge
                                             "t crease 3/1/0 3 4 5 3\n"    // one for all
                                             "t crease 2/1/0 1 4 1\n"      // less than before
                                             "t crease 2/1/0 0 3 0\n");    // smooth
    EXPECT_EQ(c.warnings, Strings());
    std::map<std::pair<uint32_t, uint32_t>, float> found;
    for (const Crease& crease : c.cage.creases) {
        EXPECT_TRUE(found.emplace(std::pair(crease.a, crease.b), crease.sharpness).second);
    }
    EXPECT_EQ(found, (std::map<std::pair<uint32_t, uint32_t>, float>{
                         {{1, 4}, 2.5f}, {{0, 1}, 1.0f}, {{1, 2}, 10.0f}, {{3, 4}, 3.0f}, {{4, 5}, 3.0f}}));
}

TEST(ObjReader, CornersAndHoles) {
    const Character c = readWell(kTwoQuads + "t corner 1/1/0 4 3\nt corner 2/2/0 0 4 10 2\nt corner 2/1/0 1 2 0\n"
                                             "t hole 2/0/0 1 1\nt hole 1/0/0 0\n"
                                             "t interpolateboundary 1/0/0 1\n");
    EXPECT_EQ(c.warnings, Strings());
    ASSERT_EQ(c.cage.sharpVertices.size(), 2u);
    EXPECT_EQ(c.cage.sharpVertices[0].vertex, 0u);
    EXPECT_EQ(c.cage.sharpVertices[0].sharpness, 10.0f);
    EXPECT_EQ(c.cage.sharpVertices[1].vertex, 4u);
    EXPECT_EQ(c.cage.sharpVertices[1].sharpness, 3.0f);
    EXPECT_EQ(c.cage.holes, (std::vector<uint32_t>{0, 1}));
}

TEST(ObjReader, UnusedVerticesGoAndTagsFollow) {
    const Character c = readWell("v 9 9 9\n" + kFourVertices + "v 8 8 8\nf 2 2 3\nf 2 3 4 5\nt crease 2/1/0 1 2 4\n" +
                                 "t corner 1/1/0 4 7\nt corner 1/1/0 0 7\nt hole 1/0/0 1\n");
    EXPECT_EQ(c.cage.faceVertices, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{1, 2, 3, 4}));
    EXPECT_EQ(c.cage.positions[0], glm::vec3(0, 0, 0));
    EXPECT_EQ(c.sourceVertexCount, 6u);
    ASSERT_EQ(c.cage.creases.size(), 1u);
    EXPECT_EQ(c.cage.creases[0].a, 0u);
    EXPECT_EQ(c.cage.creases[0].b, 1u);
    ASSERT_EQ(c.cage.sharpVertices.size(), 1u);
    EXPECT_EQ(c.cage.sharpVertices[0].vertex, 3u);
    EXPECT_EQ(c.cage.holes, (std::vector<uint32_t>{0}));
    EXPECT_EQ(c.warnings,
              (Strings{"file: 2 vertices have no face; left out",
                       "file: 1 face has fewer than three different vertices or bounds nothing: face 0; left out"}));
}

TEST(ObjReader, SaysWhatItLeavesOut) {
    const Character c = readWell("v 0 0 0 1 1\nv 1 0 0 1\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 2\nl 2 3\n"
                                 "p 1\ncurv 0 1 1 2\nt crease 2/1/0 0 2 3\nt vertexedit 9/9/9 x\n"
                                 "t interpolateboundary 1/0/0 2\n");
    EXPECT_EQ(c.warnings, (Strings{"line 10: 1 crease is not an edge; left out", "line 9: curv ignored",
                                   "line 6: l ignored, here and on 1 further line", "line 8: p ignored",
                                   "line 12: t interpolateboundary other than 1 (edges and corners) ignored",
                                   "line 11: t vertexedit ignored"}));
    // However many kinds there are, the messages stay few.
    std::string many = kSquare;
    for (int i = 0; i < 1000; ++i) {
        many += "what" + std::to_string(i) + " 1\n";
    }
    const Character d = readWell(many);
    ASSERT_EQ(d.warnings.size(), 9u);
    EXPECT_EQ(d.warnings.back(), "line 14: other statements ignored, here and on 991 further lines");
}

TEST(ObjReader, RefusalsNameLineElementAndReason) {
    expectRefused("", "file: empty: no faces, so there is no surface");
    expectRefused(kFourVertices, "file: nothing but points: no faces, so there is no surface");
    expectRefused(kFourVertices + "p 1 2\n", "file: nothing but points: no faces, so there is no surface");
    expectRefused(kFourVertices + "l 1 2\n", "file: nothing but lines: no faces, so there is no surface");
    expectRefused(kFourVertices + "p 1\nl 1 2\n",
                  "file: nothing but points and lines: no faces, so there is no surface");
    expectRefused("v 0 0\n", "line 1: position: a number is missing");
    expectRefused("v 0 0 nan\n", "line 1: position: \"nan\" is not a finite number");
    expectRefused("v 0 -inf 0\n", "line 1: position: \"-inf\" is not a finite number");
    expectRefused("v 0 1e39 0\n", "line 1: position: \"1e39\" is not a finite number");
    expectRefused("v 0 0,5 0\n", "line 1: position: \"0,5\" is not a finite number");
    expectRefused("vt 1 x\n", "line 1: texture coordinate: \"x\" is not a finite number");
    expectRefused(kFourVertices + "f 1 2\n", "file: no face is left: all have fewer than three different vertices or "
                                             "bound nothing");
    expectRefused(
        kFourVertices + "vt 0 0\nf 1 2 99\nf 1/2 2/1 98/7\n",
        "line 6: face corner 3: vertex 99 of 4, and 1 more like it\nt.obj: line 7: face corner 1: texture coordinate "
        "2 of 1, and 1 more like it");
    expectRefused(kFourVertices + "f 1 2 99\n", "line 5: face corner 3: vertex 99 of 4");
    expectRefused("v 0 0\n" + kSquare + "f 1 x 3\n",
                  "line 1: position: a number is missing\nt.obj: line 7: face corner 2: \"x\" is not an index");
    expectRefused(kSquare + "t corner 1/1/0 9 3\nt hole 1/0/0 7\n",
                  "line 6: t corner: vertex 9 of 4\nt.obj: line 7: t hole: face 7 of 1");
    expectRefused(kFourVertices + "f 1 0 2\n", "line 5: face corner 2: vertex 0 of 4");
    expectRefused(kFourVertices + "f -5 1 2\n", "line 5: face corner 1: vertex -5 of 4");
    expectRefused(kFourVertices + "f 1 2 3/1\n", "line 5: face corner 3: texture coordinate 1 of 0");
    expectRefused(kFourVertices + "f 1 2 /3\n", "line 5: face corner 3: an index is missing");
    expectRefused(kFourVertices + "f 1 2 x\n", "line 5: face corner 3: \"x\" is not an index");
    expectRefused(kFourVertices + "f 1 2 1.5\n", "line 5: face corner 3: \"1.5\" is not an index");
    expectRefused(kFourVertices + "f 1 2 4294967297\n", "line 5: face corner 3: vertex 4294967297 of 4");
    expectRefused(kFourVertices + "f 1 2 99999999999999999999\n",
                  "line 5: face corner 3: \"99999999999999999999\" is not an index");
    for (const std::string& utf16 : {std::string("\xFF\xFEv\0", 4), std::string("\xFE\xFF\0v", 4),
                                     std::string("v\0 \0001\0 \0002\0", 10), std::string("\0v\0 \0001\0 ", 8)}) {
        expectRefused(utf16, "file: UTF-16; OBJ files are ASCII or UTF-8");
    }
    expectRefused(kFourVertices + "f 1 1 2\n", "file: no face is left: all have fewer than three different vertices or "
                                               "bound nothing");
    expectRefused(kFourVertices + "f 1 2 " + std::string(100, '\x01') + "\n",
                  "line 5: face corner 3: \"" + std::string(40, '?') + "...\" is not an index");

    expectRefused(kSquare + "t crease\n", "line 6: t crease: no counts of the form integers/floats/strings");
    expectRefused(kSquare + "t crease 2/1 0 1 2\n", "line 6: t crease: no counts of the form integers/floats/strings");
    expectRefused(kSquare + "t crease 2/1/0 0\n", "line 6: t crease: an index is missing");
    expectRefused(kSquare + "t crease 4000000000/1/0 0 1 2\n", "line 6: t crease: an index is missing");
    expectRefused(kSquare + "t crease 2/1/0 0 1\n", "line 6: t crease: a number is missing");
    expectRefused(kSquare + "t crease 2/1/0 0 1 inf\n", "line 6: t crease: \"inf\" is not a finite number");
    expectRefused(kSquare + "t crease 2/3/0 0 1 1 2 3\n", "line 6: t crease: 3 sharpnesses for 2 vertices");
    expectRefused(kSquare + "t crease 1/1/0 0 1\n", "line 6: t crease: 1 sharpness for 1 vertex");
    expectRefused(kSquare + "t crease 2/1/0 0 4 1\n", "line 6: t crease: vertex 4 of 4");
    expectRefused(kSquare + "t corner 1/0/0 0\n", "line 6: t corner: 0 sharpnesses for 1 vertex");
    expectRefused(kSquare + "t corner 1/1/0 -1 1\n", "line 6: t corner: vertex -1 of 4");
    expectRefused(kSquare + "t hole 1/0/0 1\n", "line 6: t hole: face 1 of 1");
}

/// What a strict reading refuses, another one mends or leaves out: as little as can be.
TEST(ObjReader, FaultsAreLeftOutAlone) {
    const auto said = [](const std::string& text, const std::string& warning) {
        SCOPED_TRACE(warning);
        const Character c = readWell(text);
        EXPECT_EQ(c.warnings, Strings{warning});
        return c;
    };
    const Character uv = said(kFourVertices + "vt 0 0\nf 1/1 2/9 3/1 4/1\n",
                              "line 6: face corner 2: texture coordinate 9 of 1; left out");
    EXPECT_EQ(uv.cage.cornerUvs, (std::vector<glm::vec2>{{0, 1}, {0, 0}, {0, 1}, {0, 1}}));
    const Character face =
        said(kTwoQuads + "f 1 2 99\nt hole 1/0/0 1\n", "line 9: face corner 3: vertex 99 of 6; left out");
    EXPECT_EQ(face.cage.holes, (std::vector<uint32_t>{1}));
    said(kSquare + "t crease 2/1/0 0 4 1\n", "line 6: t crease: vertex 4 of 4; left out");
    const Character number =
        said(kSquare + "vt 1 x\n", "line 6: texture coordinate: \"x\" is not a finite number; left out");
    EXPECT_EQ(number.cage.faceCount(), 1u);
    // Vertices are counted: one that cannot be read moves all the others.
    EXPECT_EQ(read("v 0 0\n" + kSquare).error().message, "t.obj: line 1: position: a number is missing");
    EXPECT_EQ(read(kFourVertices + "f 1 2 99\n").error().message, "t.obj: line 5: face corner 3: vertex 99 of 4");
}

TEST(ObjReader, FacesThatAreLeftOutKeepTheNumbersOfTheOthers) {
    const std::string before = kFourVertices + "f 1 2 99\n" + "f 1 2 3 4\nt hole 1/0/0 1\n";
    EXPECT_EQ(readWell(before).cage.holes, (std::vector<uint32_t>{0}));
}

TEST(ObjReader, LinesMayEndAsOnOldMachines) {
    std::string text = kSquare;
    std::replace(text.begin(), text.end(), '\n', '\r');
    const Character c = readWell(text);
    EXPECT_EQ(c.cage.faceVertices, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(c.warnings, Strings());
    std::string wrong = text + "f 1 2 9\r";
    EXPECT_EQ(read(wrong, true).error().message, "t.obj: line 6: face corner 3: vertex 9 of 4");
}

TEST(ObjReader, NoPrefixOfAFileBreaksIt) {
    const std::string text = "mtllib a\n" + kTwoQuads +
                             "vt 0 1\nusemtl b\nf 1/1 4/1/2 2/1 \\\n 3\nt crease 3/2/0 0 1 2 1 10\n"
                             "t corner 1/1/0 4 3\nt hole 1/0/0 1\n";
    size_t accepted = 0;
    for (size_t length = 0; length <= text.size(); ++length) {
        const Result<Character> result = read(text.substr(0, length));
        accepted += result.ok() ? 1 : 0;
        if (!result.ok()) {
            EXPECT_EQ(result.error().message.rfind("t.obj: ", 0), 0u);
            EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
        }
    }
    EXPECT_GT(accepted, 10u);
}

TEST(ObjReader, DamagedFilesAreReadOrRefused) {
    const std::string text =
        kTwoQuads + "vt 0 1\nvt 1 1\nusemtl b\nf 1/1 4/1/2 2/1 \\\n 3\nf -1 -2 -3\nt crease 3/2/0 0 1 2 1 10\n" +
        "t corner 1/1/0 4 3\nt hole 1/0/0 1\nt interpolateboundary 1/0/0 2\n";
    const std::string pieces = "0123456789-+./# \n\r\t\\fvtexn\xFF";
    std::mt19937 random(11); // NOLINT: the same damage every time
    size_t accepted = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string damaged = text;
        for (uint32_t k = 1 + random() % 4; k > 0; --k) {
            damaged[random() % damaged.size()] = pieces[random() % pieces.size()];
        }
        const Result<Character> result = read(damaged);
        if (!result.ok()) {
            ASSERT_TRUE(test::isLinesAbout("t.obj", result.error().message)) << result.error().message;
            continue;
        }
        ++accepted;
        const Cage& cage = result->cage;
        ASSERT_EQ(cage.faceStarts.back(), cage.cornerCount());
        ASSERT_TRUE(cage.cornerUvs.empty() || cage.cornerUvs.size() == cage.cornerCount());
        ASSERT_EQ(cage.faceMaterials.size(), cage.faceCount());
        for (const uint32_t v : cage.faceVertices) {
            ASSERT_LT(v, cage.vertexCount());
        }
        for (const Crease& crease : cage.creases) {
            ASSERT_LT(std::max(crease.a, crease.b), cage.vertexCount());
        }
        for (const SharpVertex& sharp : cage.sharpVertices) {
            ASSERT_LT(sharp.vertex, cage.vertexCount());
        }
        for (const uint32_t hole : cage.holes) {
            ASSERT_LT(hole, cage.faceCount());
        }
    }
    EXPECT_GT(accepted, 1000u);
}

TEST(CharacterReader, TellsTheFormatsApart) {
    const auto source = [](const std::vector<std::byte>& bytes, const std::string& name) {
        const Result<Character> result = readCharacter(bytes, name, "");
        return result.ok() ? polygonSourceName(result->parts[0].polygonSource) : result.error().message;
    };
    EXPECT_EQ(source(toBytes(kSquare), "a.obj"), "OBJ");
    EXPECT_EQ(source(toBytes(kSquare), "some.folder/A.OBJ"), "OBJ");
    EXPECT_EQ(source(test::skinnedQuad().glb(), "a.glb"), "paired triangles");
    EXPECT_EQ(source(test::skinnedQuad().glb(), "a.obj"), "paired triangles") << "the bytes say more than the name";
    EXPECT_EQ(source(test::skinnedQuad().embedded(), "a.obj"), "paired triangles");
    EXPECT_EQ(source(test::skinnedQuad().embedded(), ""), "paired triangles");
    EXPECT_EQ(source(toBytes(kSquare), "a.glb").rfind("a.glb: ", 0), 0u);
    EXPECT_EQ(source(toBytes(""), "a.obj"), "a.obj: file: empty: no faces, so there is no surface");
}

TEST(ObjReader, SharedMeshes) {
    const fs::path folder = supple::test::sharedFolder() + "meshes";
    struct Expected {
        size_t vertices, faces, creases, sharpVertices, holes;
    };
    const std::map<std::string, Expected> expectations = {
        {"opensubdiv/catmark_cube.obj", {8, 6, 0, 0, 0}},
        {"opensubdiv/catmark_cube_creases0.obj", {8, 6, 2, 0, 0}},
        {"opensubdiv/catmark_cube_corner4.obj", {8, 6, 0, 1, 0}},
        {"opensubdiv/catmark_cubes_semisharp.obj", {32, 24, 14, 2, 0}},
        {"opensubdiv/catmark_pawn.obj", {601, 588, 120, 0, 0}},
        {"opensubdiv/catmark_rook.obj", {768, 777, 280, 0, 0}},
        {"opensubdiv/catmark_car.obj", {1642, 1575, 314, 0, 0}},
        {"opensubdiv/catmark_hole_test1.obj", {8, 6, 0, 0, 1}},
        {"opensubdiv/catmark_pole64.obj", {129, 128, 0, 0, 0}},
        {"spot_control_mesh.obj", {188, 180, 0, 0, 0}},
        {"dodecahedron.obj", {20, 12, 0, 0, 0}},
    };
    if (!fs::exists(folder)) {
        GTEST_SKIP() << expectations.size() << " expected meshes and all others left out: " << folder
                     << " is not present";
    }
    size_t parsed = 0;
    size_t creases = 0;
    size_t shapes = 0;
    size_t matched = 0;
    for (const std::string& path : supple::test::filesBelow(folder, {".obj"})) {
        const std::string name = fs::relative(path, folder).generic_string();
        SCOPED_TRACE(name);
        const Result<Character> result = supple::test::readObjFile(path);
        ASSERT_TRUE(result.ok()) << result.error().message;
        const Cage& cage = result->cage;
        ++parsed;
        shapes += name.starts_with("opensubdiv/") ? 1 : 0;
        creases += cage.creases.size();
        const auto expected = expectations.find(name);
        if (expected != expectations.end()) {
            ++matched;
            EXPECT_EQ(cage.vertexCount(), expected->second.vertices);
            EXPECT_EQ(cage.faceCount(), expected->second.faces);
            EXPECT_EQ(cage.creases.size(), expected->second.creases);
            EXPECT_EQ(cage.sharpVertices.size(), expected->second.sharpVertices);
            EXPECT_EQ(cage.holes.size(), expected->second.holes);
        }
    }
    EXPECT_EQ(matched, expectations.size());
    EXPECT_GE(shapes, 115u);
    std::printf("%zu meshes, %zu of them OpenSubdiv's shapes, %zu creases\n", parsed, shapes, creases);
}

} // namespace
} // namespace supple::cage
