// Images of a glTF file, and the files that images and buffers lie in.
#include "tests/cage/gltf/reading.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace supple::cage {
namespace {

using namespace test;

TEST(GltfImages, ImagesFromBufferViewsAndFiles) {
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
    const Result<Character> c = readGltfFile((folder / "t.glb").string(), kKeepTriangles);
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

TEST(GltfImages, FilesComeFromTheHost) {
    GltfBuilder b = skinnedQuad();
    b.more += R"(,"images":[{"uri":"./tex/a%20b.png"},{"uri":"../up.png"},{"uri":"none.png"}])";
    std::vector<std::string> asked;
    GltfOptions options = kKeepTriangles;
    options.readFile = [&](const std::string& path) -> Result<std::vector<std::byte>> {
        asked.push_back(path);
        if (path == "none.png") {
            return Error{ErrorCode::io, "not in this archive"};
        }
        return path == "quad.bin" ? b.binary() : std::vector<std::byte>(3);
    };
    Result<Character> c = readGltf(toBytes(b.json("quad.bin")), "t.gltf", "/nowhere", options);
    ASSERT_TRUE(c.ok()) << c.error().message;
    EXPECT_EQ(asked, (Strings{"quad.bin", "tex/a b.png", "none.png"})) << "decoded, and only what may be asked for";
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
