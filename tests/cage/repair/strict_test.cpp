// Files of every format, damaged in several ways: repaired with a warning for each kind, or refused with all of them.
#include "cage/formats/reader.h"
#include "cage/topology.h"
#include "tests/cage/gltf/reading.h"
#include "tests/support/shared_assets.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace supple::cage {
namespace {

using namespace test;

std::vector<std::byte> bytesOf(const std::string& text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

const char* const kDamagedObj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 2 0 0\nv 3 0 1\nv 3 0 2\n"
                                "f 1 2 3 4\nf 2 1 5 6\nf 1 2 7 7\nf 3 4 1 2\nf 5 8 9\nf 1 2\n";

TEST(RepairStrict, NamesAllKindsOfAnObj) {
    const auto bytes = bytesOf(kDamagedObj);
    const Result<Character> repaired = readCharacter(bytes, "a.obj", "");
    ASSERT_TRUE(repaired.ok()) << repaired.error().message;
    EXPECT_TRUE(buildTopology(repaired->cage).ok());
    const Strings kinds = {"file: 1 face has fewer than three different vertices or bounds nothing: face 5",
                           "file: 1 face passes a vertex twice: face 2",
                           "file: 1 face is there twice: face 3 is face 0 again",
                           "file: 1 edge has three or more faces: edge (0, 1) of faces 0, 1, 2",
                           "file: 1 vertex has faces that are no single fan: vertex 4 of 2 fans"};
    ASSERT_EQ(repaired->warnings.size(), kinds.size());
    std::string refusal;
    for (size_t i = 0; i < kinds.size(); ++i) {
        EXPECT_EQ(repaired->damages[i].found, kinds[i]);
        EXPECT_EQ(repaired->warnings[i], kinds[i] + "; " + repaired->damages[i].repair);
        refusal += (i == 0 ? "a.obj: " : "\na.obj: ") + kinds[i];
    }
    const Result<Character> strict = readCharacter(bytes, "a.obj", "", {.strict = true});
    ASSERT_FALSE(strict.ok());
    EXPECT_EQ(strict.error().message, refusal);
    EXPECT_EQ(strict.error().code, ErrorCode::asset);
}

TEST(RepairStrict, NamesAllKindsOfAGltf) {
    // Three triangles on an edge, a triangle with a repeated vertex, and a duplicate.
    const GltfBuilder b =
        plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1}, {0, 1, 2, 1, 0, 3, 0, 1, 4, 2, 2, 1, 1, 2, 0});
    EXPECT_EQ(readWell(b).warnings.size(), 3u);
    const Result<Character> strict = readGltf(b.glb(), "t.glb", "", {.strict = true});
    ASSERT_FALSE(strict.ok());
    EXPECT_EQ(strict.error().message, "t.glb: mesh 0 primitive 0: 1 triangle with a repeated vertex\n"
                                      "t.glb: mesh 0: 1 face is there twice: face 3 is face 0 again\n"
                                      "t.glb: mesh 0: 1 edge has three or more faces: edge (0, 1) of faces 0, 1, 2");
}

TEST(RepairStrict, TakesWhatIsWhole) {
    EXPECT_TRUE(readGltf(skinnedQuad().glb(), "t.glb", "", {.strict = true}).ok());
}

TEST(RepairStrict, SharedFilesThatWereRefused) {
    const std::vector<std::string> paths = supple::test::sharedAssets(
        {"whole/bat.glb", "whole/triceratops.glb", "whole/studio_stegosaurus.glb", "characters/llama_nonmanifold.glb",
         "characters/suzanne.glb", "meshes/suzanne.obj", "meshes/shortsword_nonmanifold_ngons.obj"});
    for (const std::string& path : paths) {
        SCOPED_TRACE(path);
        std::ifstream stream(path, std::ios::binary);
        const auto bytes = bytesOf(std::string((std::istreambuf_iterator<char>(stream)), {}));
        const std::string folder = std::filesystem::path(path).parent_path().string();
        const Result<Character> repaired = readCharacter(bytes, path, folder);
        ASSERT_TRUE(repaired.ok()) << repaired.error().message;
        EXPECT_TRUE(buildTopology(repaired->cage).ok());
        EXPECT_EQ(readCharacter(bytes, path, folder, {.strict = true}).ok(), repaired->damages.empty());
    }
}

} // namespace
} // namespace supple::cage
