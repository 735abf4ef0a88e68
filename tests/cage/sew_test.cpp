// Parts that are sewn together, and what is left open.
#include "cage/sew.h"
#include "cage/topology.h"
#include "tests/cage/face_lists.h"
#include "tests/cage/gltf/reading.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <random>

namespace supple::cage {
namespace {

using namespace test;

/// Every run of faces a part of a node of its own, all of one skin and with the same morph targets.
Character cut(Character character, const std::vector<uint32_t>& firstFaces) {
    const Part whole = character.parts.at(0);
    character.parts.assign(firstFaces.size(), whole);
    for (uint32_t p = 1; p < firstFaces.size(); ++p) {
        Part& part = character.parts[p];
        part.node = static_cast<uint32_t>(character.skeleton.nodes.size());
        part.name = "piece " + std::to_string(p);
        part.firstFace = firstFaces[p];
        const Node node = character.skeleton.nodes[whole.node];
        character.skeleton.nodes.push_back(node);
        character.skeleton.nodes.back().name = part.name;
        character.skeleton.parentsFirst.push_back(part.node);
    }
    return character;
}

/// Runs of 1 to `longest` faces.
std::vector<uint32_t> randomRuns(uint32_t faceCount, uint32_t longest, std::mt19937& random) {
    std::vector<uint32_t> firstFaces;
    for (uint32_t face = 0; face < faceCount; face += 1 + static_cast<uint32_t>(random() % longest)) {
        firstFaces.push_back(face);
    }
    return firstFaces;
}

/// The file without its control cage: triangles, whose vertices are split at seams of the UVs.
std::vector<std::byte> withoutCage(std::vector<std::byte> bytes) {
    const auto isLetter = [](std::byte b, char c) { return static_cast<char>(b) == c; };
    for (const std::string name : {"SUPPLE_mesh_cage", "FB_ngon_encoding"}) {
        const auto find = [&] { return std::search(bytes.begin(), bytes.end(), name.begin(), name.end(), isLetter); };
        for (auto at = find(); at != bytes.end(); at = find()) {
            *at = static_cast<std::byte>('X');
        }
    }
    return bytes;
}

std::vector<std::byte> written(const Character& character) {
    const Result<GlbFile> file = writeGlb(character);
    EXPECT_TRUE(file.ok()) << file.error().message;
    return file.ok() ? file->bytes : std::vector<std::byte>{};
}

void expectSameCage(const Character& parts, const Character& whole) {
    EXPECT_TRUE(parts.damages.empty());
    EXPECT_EQ(parts.cage.vertexCount(), whole.cage.vertexCount());
    EXPECT_EQ(parts.cage.faceStarts, whole.cage.faceStarts);
    EXPECT_EQ(cornerPositions(parts.cage), cornerPositions(whole.cage));
    const Result<Topology> a = buildTopology(whole.cage), b = buildTopology(parts.cage);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(a->twins, b->twins);
}

/// The writer cuts a quad by the one diagonal or the other, as the faces before it ask.
void expectSameButForDiagonals(const Character& parts, const Character& whole) {
    EXPECT_TRUE(parts.damages.empty());
    EXPECT_EQ(parts.cage.vertexCount(), whole.cage.vertexCount());
    EXPECT_EQ(parts.cage.faceCount(), whole.cage.faceCount());
    const Result<Topology> a = buildTopology(whole.cage), b = buildTopology(parts.cage);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(std::count(a->twins.begin(), a->twins.end(), kNone), std::count(b->twins.begin(), b->twins.end(), kNone));
}

TEST(Sewing, ACharacterInAnyRunsOfFacesIsTheWhole) {
    for (const char* name : {"pip.glb", "pip_quads.glb"}) {
        SCOPED_TRACE(name);
        Result<Character> read = readGltfFile(std::string(SUPPLE_SAMPLE_ASSETS) + "/" + name);
        ASSERT_TRUE(read.ok()) << read.error().message;
        Character& character = read.value();
        ASSERT_EQ(character.parts.size(), 1u);
        character.cage.faceMaterials.clear(); // a primitive for each material would change the faces' order
        character.cage.faceTriangles.clear();
        const Character whole = readWell(written(character));
        const Character triangles = readWell(withoutCage(written(character)));
        ASSERT_GT(triangles.cage.faceCount(), 0u);
        std::mt19937 random(5);
        for (const uint32_t longest : {20u, 300u}) {
            SCOPED_TRACE("runs of up to " + std::to_string(longest) + " faces");
            const auto runs = randomRuns(character.cage.faceCount(), longest, random);
            const auto bytes = written(cut(character, runs));
            expectSameCage(readWell(bytes), whole);
            if (triangles.damages.empty()) {
                expectSameButForDiagonals(readWell(withoutCage(bytes)), triangles);
            }
        }
    }
}

/// Meshes of triangles over one set of positions, each at a node of its own.
GltfBuilder meshesOf(const std::vector<float>& positions, const std::vector<std::vector<uint32_t>>& meshes) {
    GltfBuilder b;
    b.addFloats("VEC3", positions);
    b.nodes = "[";
    b.meshes = "[";
    for (size_t m = 0; m < meshes.size(); ++m) {
        const std::string comma = m == 0 ? "" : ",";
        const std::string indices = std::to_string(b.addIntegers("SCALAR", 5121, meshes[m]));
        b.meshes += comma + R"({"primitives":[{"attributes":{"POSITION":0},"indices":)" + indices + "}]}";
        b.nodes += comma + R"({"mesh":)" + std::to_string(m) + R"(,"skin":0})";
    }
    b.nodes += "]";
    b.meshes += "]";
    return b;
}

/// The same, all bound to one joint.
std::vector<std::byte> boundMeshes(const std::vector<float>& positions,
                                   const std::vector<std::vector<uint32_t>>& meshes) {
    GltfBuilder b = meshesOf(positions, meshes);
    const size_t count = positions.size() / 3;
    const std::string joints = std::to_string(b.addIntegers("VEC4", 5121, std::vector<uint32_t>(4 * count, 0)));
    std::vector<float> ones(4 * count, 0.0f);
    for (size_t v = 0; v < count; ++v) {
        ones[4 * v] = 1.0f;
    }
    const std::string weights = std::to_string(b.addFloats("VEC4", ones));
    const std::string plain = R"("POSITION":0)";
    for (size_t place = 0; (place = b.meshes.find(plain, place)) != std::string::npos; place += plain.size()) {
        b.meshes.insert(place + plain.size(), R"(,"JOINTS_0":)" + joints + R"(,"WEIGHTS_0":)" + weights);
    }
    b.nodes = replaced(b.nodes + "#", "]#", ",{}]");
    b.more = R"(,"skins":[{"joints":[)" + std::to_string(meshes.size()) + "]}]";
    return b.glb();
}

TEST(Sewing, FansThatANeighbourJoinsAreNoDamage) {
    // Both parts are bow ties; together they are one fan.
    const auto bytes = boundMeshes(kRing, {{0, 1, 2, 0, 3, 4}, {0, 2, 3, 0, 4, 1}});
    const Character sewn = readWell(bytes);
    EXPECT_EQ(sewn.warnings, Strings());
    EXPECT_EQ(sewn.cage.vertexCount(), 5u);
    EXPECT_EQ(sewn.cage.sharpVertices.size(), 0u);
    EXPECT_EQ(buildTopology(sewn.cage)->boundary[0], 0);
    EXPECT_TRUE(readGltf(bytes, "t.glb", "", {.strict = true}).ok());

    const Strings found = {"mesh 0: 1 vertex has faces that are no single fan: vertex 0 of 2 fans",
                           "mesh 1: 1 vertex has faces that are no single fan: vertex 0 of 2 fans"};
    const Character apart = readWell(bytes, {.sewParts = false, .pairing = Pairing::never});
    EXPECT_EQ(apart.warnings,
              (Strings{found[0] + "; one vertex for each fan", found[1] + "; one vertex for each fan"}));
    EXPECT_EQ(apart.cage.vertexCount(), 12u);
    EXPECT_EQ(apart.parts[1].firstFace, 2u);
    EXPECT_EQ(messageOf(bytes, ErrorCode::asset, {.sewParts = false, .pairing = Pairing::never, .strict = true}),
              "t.glb: " + found[0] + "\nt.glb: " + found[1]);
}

TEST(Sewing, DamageIsNamedAsItsPartCounts) {
    // A quad beside three triangles at an edge, whose vertices are 4 to 8 of the file and 0 to 4 of the mesh.
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 5,
                                          0, 1, 5, 0, 0, 6, 0, 0, 4, 0, 0, 5, 1};
    const Character c = readWell(boundMeshes(positions, {{0, 1, 2, 0, 2, 3}, {4, 5, 6, 5, 4, 7, 4, 5, 8, 4, 5, 6}}));
    ASSERT_EQ(c.damages.size(), 2u);
    EXPECT_EQ(c.damages[0].found, "mesh 1: 1 face is there twice: face 3 is face 0 again");
    EXPECT_EQ(c.damages[1].found, "mesh 1: 1 edge has three or more faces: edge (0, 1) of faces 0, 1, 2");
    EXPECT_EQ(c.damages[1].repair, "cut into sheets, 2 vertices repeated");
    ASSERT_EQ(c.parts.size(), 2u);
    EXPECT_EQ(c.parts[1].firstFace, 2u);
    EXPECT_EQ(c.cage.faceParts, (std::vector<uint32_t>{0, 0, 1, 1, 1}));
    EXPECT_TRUE(buildTopology(c.cage).ok());
}

TEST(Sewing, ATurnedFaceAtASeamIsSewnAsItIsRepaired) {
    // The second part's only face at the seam is turned against its neighbours in that part.
    const std::vector<float> positions = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0};
    const Character c = readWell(boundMeshes(positions, {{0, 2, 1}, {1, 3, 2, 2, 4, 3, 3, 4, 5}}));
    ASSERT_EQ(c.damages.size(), 1u);
    EXPECT_EQ(c.damages[0].found, "mesh 1: 1 face is turned against its neighbours: face 0");
    EXPECT_EQ(c.cage.vertexCount(), 6u);
}

TEST(Sewing, ThreeFacesAtAnEdgeAreNotMade) {
    // A fin that stands on an inner edge of another part.
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1};
    const Character c = readWell(boundMeshes(positions, {{0, 1, 2, 1, 0, 3}, {0, 1, 4}}));
    EXPECT_TRUE(c.damages.empty());
    EXPECT_EQ(c.cage.vertexCount(), 7u);
    // Two fins on a boundary: which of them goes on is not said.
    const Character two = readWell(boundMeshes(positions, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}));
    EXPECT_TRUE(two.damages.empty());
    EXPECT_EQ(two.cage.vertexCount(), 9u);
}

TEST(Sewing, TwoSidesWithoutThicknessStayOpen) {
    // A cape of 3 x 3 quads, and its lining on it.
    std::vector<float> positions;
    std::vector<uint32_t> cape, lining;
    for (uint32_t i = 0; i < 16; ++i) {
        const auto x = static_cast<float>(i % 4), y = static_cast<float>(i / 4);
        positions.insert(positions.end(), {x, y, 0.1f * x * y});
    }
    for (uint32_t y = 0; y < 3; ++y) {
        for (uint32_t x = 0; x < 3; ++x) {
            const uint32_t a = 4 * y + x, b = a + 1, c = a + 5, d = a + 4;
            cape.insert(cape.end(), {a, b, c, a, c, d});
            lining.insert(lining.end(), {a, c, b, a, d, c});
        }
    }
    const Character c = readWell(boundMeshes(positions, {cape, lining}));
    EXPECT_TRUE(c.damages.empty());
    EXPECT_EQ(c.cage.vertexCount(), 32u);
    // So in one mesh, where each side has vertices of its own.
    std::vector<float> twice = positions;
    twice.insert(twice.end(), positions.begin(), positions.end());
    std::vector<uint32_t> both = cape;
    for (const uint32_t v : lining) {
        both.push_back(16 + v);
    }
    const Character one = readWell(plainMesh(twice, both));
    EXPECT_TRUE(one.damages.empty());
    EXPECT_EQ(one.cage.vertexCount(), 32u);
    EXPECT_EQ(one.warnings, Strings());
}

TEST(Sewing, LipsOfTwoPartsStayOpen) {
    // Two quads side by side; of the second the border follows another joint.
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0});
    std::vector<uint32_t> joints;
    std::vector<float> weights;
    for (uint32_t v = 0; v < 8; ++v) {
        joints.insert(joints.end(), {v < 4 ? 0u : 1u, 0, 0, 0});
        weights.insert(weights.end(), {1, 0, 0, 0});
    }
    b.addIntegers("VEC4", 5121, joints);
    b.addFloats("VEC4", weights);
    b.addIntegers("SCALAR", 5121, {0, 1, 2, 0, 2, 3});
    b.addIntegers("SCALAR", 5121, {4, 5, 6, 4, 6, 7});
    const auto mesh = [](const std::string& indices) {
        return R"({"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":)" + indices + "}]}";
    };
    b.meshes = "[" + mesh("3") + "," + mesh("4") + "]";
    b.nodes = R"([{"mesh":0,"skin":0},{"mesh":1,"skin":0},{},{}])";
    b.more = R"(,"skins":[{"joints":[2,3]}])";
    EXPECT_EQ(readWell(b).cage.vertexCount(), 8u);
    b.more = R"(,"skins":[{"joints":[2,2]}])"; // the same node twice: still two joints, which a host may pose apart
    EXPECT_EQ(readWell(b).cage.vertexCount(), 8u);
}

} // namespace
} // namespace supple::cage
