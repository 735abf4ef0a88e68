// A character that tinygltf has parsed and supple_tinygltf.hpp hands over is the one that the reader makes of the file.
#include "cage/gltf/reader.h"
#include "runtime/arrays/character_arrays.h"
#include "tests/cage/gltf/layered.h"
#include "tests/support/same_character.h"
#include "tests/support/sample_assets.h"
#include "tests/support/shared_assets.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#ifdef SUPPLE_HAS_TINYGLTF
#include <tiny_gltf.h>

#include <supple/supple_tinygltf.hpp>
#endif

namespace supple::test {
namespace {

using Strings = std::vector<std::string>;

#ifdef SUPPLE_HAS_TINYGLTF

bool load(const std::string& path, tinygltf::Model& model) {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keepTinygltfImage, nullptr);
    std::string errors;
    std::string warnings;
    const bool binary = path.ends_with(".glb");
    const bool loaded = binary ? loader.LoadBinaryFromFile(&model, &errors, &warnings, path)
                               : loader.LoadASCIIFromFile(&model, &errors, &warnings, path);
    EXPECT_TRUE(loaded) << path << ": " << errors;
    return loaded;
}

/// The character that tinygltf's way makes, and what it says.
cage::Character throughTinygltf(const std::string& path, Strings& messages) {
    tinygltf::Model model;
    TinygltfCharacter read;
    if (!load(path, model)) {
        return {};
    }
    EXPECT_TRUE(read.read(model));
    messages = read.messages();
    Result<cage::Character> character =
        runtime::characterFromArrays(read.desc(), std::filesystem::path(path).filename().string());
    EXPECT_TRUE(character.ok()) << (character.ok() ? "" : character.error().message);
    return character.ok() ? std::move(*character) : cage::Character{};
}

/// What differs, by file: a description cannot carry it.
struct Lost {
    Strings messages;
    Strings differences;
};
const std::map<std::string, Lost>& lost() {
    const std::string reason = ": it is left out; SuppleAssetDesc.bytes takes the file with it";
    const Strings springs{"springBones.springs.size()", "springBones.colliderGroups", "springBones.colliders.size()"};
    Strings all{"weights.jiggles.size()", "jiggles.size()"};
    all.insert(all.end(), springs.begin(), springs.end());
    static const std::map<std::string, Lost> kLost = {
        {"pip_moving.glb", {{"SUPPLE_deformers" + reason, "VRMC_springBone" + reason}, all}},
        {"wren_moving.glb", {{"VRMC_springBone" + reason}, springs}},
    };
    return kLost;
}

TEST(TinygltfCharacters, AreThoseOfTheReader) {
    Strings paths = allCharacters();
    for (const char* folder : {"khronos", "whole"}) {
        const Strings files = filesBelow(sharedFolder() + folder, {".glb", ".gltf"});
        if (files.empty()) {
            std::printf("all files of %s%s left out: it is not present\n", sharedFolder().c_str(), folder);
        }
        paths.insert(paths.end(), files.begin(), files.end());
    }
    size_t compared = 0;
    for (const std::string& path : paths) {
        const std::string name = std::filesystem::path(path).filename().string();
        SCOPED_TRACE(name);
        const Result<cage::Character> file = cage::readGltfFile(path);
        ASSERT_TRUE(file.ok()) << file.error().message;
        Strings messages;
        const cage::Character handed = throughTinygltf(path, messages);
        const auto known = lost().find(name);
        const Lost expected = known != lost().end() ? known->second : Lost{};
        EXPECT_EQ(CharacterDifferences(*file, handed, {true, true}).found(), expected.differences);
        EXPECT_EQ(messages, expected.messages);
        EXPECT_TRUE(file->cage.sourceVertices == handed.cage.sourceVertices);
        EXPECT_TRUE(file->seamVertexCount == handed.seamVertexCount);
        ++compared;
    }
    EXPECT_GT(compared, 1u);
    std::printf("%zu files compared\n", compared);
}

TEST(TinygltfCharacters, HaveAllLayersOfMaterials) {
    const std::vector<std::byte> glb = layeredQuad().glb();
    const Result<cage::Character> file = cage::readGltf(glb, "layered.glb", "");
    ASSERT_TRUE(file.ok()) << file.error().message;
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keepTinygltfImage, nullptr);
    tinygltf::Model model;
    std::string errors, warnings;
    ASSERT_TRUE(loader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                            reinterpret_cast<const unsigned char*>(glb.data()),
                                            static_cast<unsigned int>(glb.size())))
        << errors;
    TinygltfCharacter read;
    ASSERT_TRUE(read.read(model));
    const Result<cage::Character> handed = runtime::characterFromArrays(read.desc(), "layered.glb");
    ASSERT_TRUE(handed.ok()) << handed.error().message;
    ASSERT_EQ(handed->materials.size(), 2u);
    EXPECT_TRUE(handed->materials[0].layers == file->materials[0].layers);
    EXPECT_TRUE(handed->materials[1].layers == cage::MaterialLayers{});
}

/// What is not carried over is said, and the rest is.
TEST(TinygltfCharacters, SayWhatTheyDoNotCarry) {
    tinygltf::Model model;
    ASSERT_TRUE(load(kWren, model));
    ASSERT_FALSE(model.images.empty());
    model.images[0].as_is = false; // as tinygltf's own loader leaves it
    model.meshes[0].extensions["EXT_mesh_manifold"] = tinygltf::Value(tinygltf::Value::Object());
    model.meshes[0].primitives[0].extensions["EXT_mesh_polygon"] = tinygltf::Value(tinygltf::Value::Object());
    tinygltf::AnimationChannel pointer;
    pointer.target_path = "pointer";
    model.animations[0].channels.push_back(pointer);
    TinygltfCharacter read;
    EXPECT_TRUE(read.read(model));
    const std::string channel = std::to_string(model.animations[0].channels.size() - 1);
    EXPECT_EQ(read.messages(), (Strings{"image 0: decoded by tinygltf, so it is left out; load with keepTinygltfImage",
                                        "mesh 0: EXT_mesh_manifold is not carried over; welded by equality",
                                        "mesh 0: EXT_mesh_polygon is not carried over; its triangles are",
                                        "animation 0 channel " + channel +
                                            ": moves no node's translation, rotation, scale or weights; ignored"}));
    const Result<cage::Character> handed = runtime::characterFromArrays(read.desc(), "wren.glb");
    ASSERT_TRUE(handed.ok()) << handed.error().message;
    const Result<cage::Character> file = cage::readGltfFile(kWren);
    ASSERT_TRUE(file.ok());
    Strings wanted;
    const CharacterDifferences differences(*file, *handed, {true, true});
    for (const std::string& difference : differences.found()) {
        if (difference.find("exture") == std::string::npos) { // of the image
            wanted.push_back(difference);
        }
    }
    EXPECT_EQ(wanted, (Strings{"materials[0].layers", "images[0].bytes"}))
        << "a texture of these layers has that image too";
}

TEST(TinygltfCharacters, AreRefusedWhereNothingCanBeRead) {
    tinygltf::Model model;
    ASSERT_TRUE(load(kPip, model));
    model.extensionsRequired.emplace_back("EXT_meshopt_compression");
    model.accessors[0].count = 1u << 30;
    model.nodes[0].children.push_back(1000);
    TinygltfCharacter read;
    EXPECT_FALSE(read.read(model));
    ASSERT_GE(read.messages().size(), 3u);
    EXPECT_EQ(read.messages()[0], "file: EXT_meshopt_compression: tinygltf does not decompress it");
    EXPECT_EQ(read.messages()[1], "node 0: child 1000 is no node, or has two parents");
}

#else

TEST(TinygltfCharacters, AreThoseOfTheReader) {
    std::printf("tinygltf cases left out: tiny_gltf.h or its library was not found (libtinygltf-dev)\n");
}

#endif

} // namespace
} // namespace supple::test
