// Materials and images of a glTF file, and the files that images and buffers lie in.
#include "tests/cage/gltf/reading.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace supple::cage {
namespace {

using namespace test;

TEST(GltfMaterial, Materials) {
    GltfBuilder b = skinnedQuad();
    b.meshes = replaced(b.meshes, R"("mode":4)", R"("material":0)");
    b.more += R"(,"materials":[{"name":"skin","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,)"
              R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,1,0,1],"baseColorTexture":{"index":0}}},)"
              R"({"alphaMode":"BLEND"},{"alphaMode":"GLASS"},)"
              R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":2}}}],)"
              R"("textures":[{"source":1,"sampler":0},{"source":0}],"samplers":[{"wrapS":33071,"wrapT":33648}],)"
              R"("images":[{"uri":"gone.png"},{"uri":"data:image/png;base64,iVBORw0KGgo=","name":"face"}])";
    const Character c = readWell(b.glb());
    ASSERT_EQ(c.materials.size(), 4u);
    EXPECT_EQ(c.materials[0].name, "skin");
    EXPECT_EQ(c.materials[0].baseColorFactor, glm::vec4(0.5f, 1, 0, 1));
    EXPECT_EQ(c.materials[0].baseColorImage, 1u);
    EXPECT_EQ(c.materials[0].wrapU, Wrap::clampToEdge);
    EXPECT_EQ(c.materials[0].wrapV, Wrap::mirroredRepeat);
    EXPECT_EQ(c.materials[0].alphaMode, AlphaMode::mask);
    EXPECT_EQ(c.materials[0].alphaCutoff, 0.25f);
    EXPECT_TRUE(c.materials[0].doubleSided);
    EXPECT_EQ(c.materials[1].alphaMode, AlphaMode::blend);
    EXPECT_EQ(c.materials[1].alphaCutoff, 0.5f);
    EXPECT_EQ(c.materials[1].baseColorFactor, glm::vec4(1.0f));
    EXPECT_EQ(c.materials[2].alphaMode, AlphaMode::opaque);
    EXPECT_EQ(c.materials[3].baseColorImage, kNone) << "its image is missing";
    EXPECT_EQ(c.cage.faceMaterials, (std::vector<uint32_t>{0, 0}));
    ASSERT_EQ(c.images.size(), 2u);
    EXPECT_TRUE(c.images[0].bytes.empty());
    EXPECT_EQ(c.images[1].name, "face");
    EXPECT_EQ(c.images[1].mimeType, "image/png");
    EXPECT_EQ(c.images[1].bytes.size(), 8u);
    EXPECT_EQ(c.warnings,
              (Strings{"image 0 uri: \"gone.png\": external files are not allowed for an asset read from memory; "
                       "left out",
                       "material 2 alphaMode: \"GLASS\" is unknown; opaque",
                       "material 3 baseColorTexture: texCoord 2: only TEXCOORD_0 and TEXCOORD_1 are read; left out"}));
}

TEST(GltfMaterial, ImagesFromBufferViewsAndFiles) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / ("supple_gltf_images_" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder / "textures");
    std::ofstream(folder / "textures" / "a b.jpg", std::ios::binary) << "\xFF\xD8\xFF\xE0 not really";
    GltfBuilder b = skinnedQuad();
    const int view = b.addIntegers("SCALAR", 5121, {0x89, 'P', 'N', 'G', 1, 2, 3});
    b.more += R"(,"images":[{"bufferView":)" + std::to_string(view) +
              R"(},{"uri":"textures/a%20b.jpg"},{"uri":"../a.png"},{"uri":"textures/none.png"}])";
    const auto bytes = b.glb();
    std::ofstream(folder / "t.glb", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const Result<Character> c = readGltfFile((folder / "t.glb").string());
    ASSERT_TRUE(c.ok()) << c.error().message;
    ASSERT_EQ(c->images.size(), 4u);
    EXPECT_EQ(c->images[0].bytes.size(), 7u);
    EXPECT_EQ(c->images[0].mimeType, "image/png");
    EXPECT_EQ(c->images[1].bytes.size(), 15u);
    EXPECT_EQ(c->images[1].mimeType, "image/jpeg");
    EXPECT_EQ(c->warnings, (Strings{"image 2 uri: \"../a.png\": path leaves the asset's folder; left out",
                                    "image 3 uri: \"textures/none.png\": no such file; left out"}));
    fs::remove_all(folder);
}

// ---- files of the host ----------------------------------------------------------------------------------------------

TEST(GltfMaterial, FilesComeFromTheHost) {
    GltfBuilder b = skinnedQuad();
    b.more += R"(,"images":[{"uri":"./tex/a%20b.png"},{"uri":"../up.png"},{"uri":"none.png"}])";
    std::vector<std::string> asked;
    GltfOptions options;
    options.readFile = [&](const std::string& path) -> Result<std::vector<std::byte>> {
        asked.push_back(path);
        if (path == "none.png") {
            return Error{ErrorCode::io, "not in this archive"};
        }
        return path == "quad.bin" ? b.binary() : std::vector<std::byte>(3);
    };
    Result<Character> c = readGltf(toBytes(b.json("quad.bin")), "t.gltf", "/nowhere", options);
    ASSERT_TRUE(c.ok()) << c.error().message;
    EXPECT_EQ(asked, (Strings{"quad.bin", "./tex/a b.png", "none.png"})) << "decoded, and only what may be asked for";
    EXPECT_EQ(c->images[0].bytes.size(), 3u);
    EXPECT_EQ(c->warnings, (Strings{"image 1 uri: \"../up.png\": path leaves the asset's folder; left out",
                                    "image 2 uri: \"none.png\": not in this archive; left out"}));

    options.readFile = [](const std::string&) -> Result<std::vector<std::byte>> {
        return Error{ErrorCode::io, "offline"};
    };
    c = readGltf(toBytes(b.json("quad.bin")), "t.gltf", "", options);
    ASSERT_FALSE(c.ok());
    EXPECT_EQ(c.error().code, ErrorCode::io);
    EXPECT_EQ(c.error().message, "t.gltf: buffer 0 uri: \"quad.bin\": offline");
    EXPECT_EQ(readGltf(toBytes(b.json("../quad.bin")), "t.gltf", "", options).error().message,
              "t.gltf: buffer 0 uri: \"../quad.bin\": path leaves the asset's folder");
}

} // namespace
} // namespace supple::cage
