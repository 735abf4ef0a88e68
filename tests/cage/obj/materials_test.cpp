// What an OBJ file's materials are made of: MTL files and images.
#include "cage/formats/reader.h"
#include "cage/obj/mtl.h"
#include "cage/obj/reader.h"
#include "tests/cage/gltf/builder.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#ifdef SUPPLE_HAS_TINYOBJ
#include <tiny_obj_loader.h>
#endif

namespace supple::cage {
namespace {

using test::toBytes;
using Said = std::vector<std::string>;

const std::string kPng("\x89PNG\r\n\x1a\n picture", 16);
const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
const std::string kFace = "f 1/1 2/2 3/3\n";

/// Files by path, and which were asked for.
struct Folder {
    std::map<std::string, std::string> files;
    std::vector<std::string> asked;

    FileReader reader() {
        return [this](const std::string& path) -> Result<std::vector<std::byte>> {
            asked.push_back(path);
            const auto found = files.find(path);
            if (found == files.end()) {
                return Error{ErrorCode::io, "no such file"};
            }
            const auto* bytes = reinterpret_cast<const std::byte*>(found->second.data());
            return std::vector<std::byte>(bytes, bytes + found->second.size());
        };
    }
};

Character readFrom(Folder& folder, const std::string& text) {
    Result<Character> result = readObj(toBytes(text), "t.obj", {.readFile = folder.reader()});
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() ? std::move(result.value()) : Character{};
}

/// One triangle with that material.
Character readMaterial(Folder& folder, const std::string& mtl) {
    folder.files["a.mtl"] = "newmtl Skin\n" + mtl;
    Character c = readFrom(folder, "mtllib a.mtl\n" + kTriangle + "usemtl Skin\n" + kFace);
    EXPECT_EQ(c.materials.size(), 1u);
    c.materials.resize(1);
    return c;
}

TEST(ObjMaterials, NumbersBecomeFactors) {
    Folder folder;
    const Character c = readMaterial(folder, "Kd 0.5 0.25 2\nd 0.75\nNs 250\nPm 0.5\nKe 3 1.5 0\n");
    EXPECT_EQ(c.warnings, Said());
    const Material& m = c.materials[0];
    EXPECT_EQ(m.name, "Skin");
    EXPECT_EQ(m.baseColorFactor, glm::vec4(0.5f, 0.25f, 1.0f, 0.75f)) << "linear, within 0..1";
    EXPECT_EQ(m.alphaMode, AlphaMode::blend);
    EXPECT_EQ(m.roughnessFactor, 0.5f);
    EXPECT_EQ(m.metallicFactor, 0.5f);
    EXPECT_EQ(m.emissiveFactor, glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(m.emissiveStrength, 3.0f);

    const Material plain = readMaterial(folder, "Tr 0.25\nPr 0.125\nNs 10\n").materials[0];
    EXPECT_EQ(plain.baseColorFactor, glm::vec4(1.0f, 1.0f, 1.0f, 0.75f));
    EXPECT_EQ(plain.roughnessFactor, 0.125f) << "Pr says more than Ns";
    EXPECT_EQ(plain.metallicFactor, 0.0f);
    EXPECT_EQ(readMaterial(folder, "d 1\nTr 0.5\n").materials[0].alphaMode, AlphaMode::opaque) << "d wins";
    EXPECT_EQ(readMaterial(folder, "Tr 0.5\nd 1\n").materials[0].alphaMode, AlphaMode::opaque);
}

TEST(ObjMaterials, MapsBecomeTextures) {
    Folder folder;
    folder.files["my skin.png"] = folder.files["n.png"] = folder.files["glow.png"] = kPng;
    const Character c = readMaterial(folder, "Kd 0 0 0\nmap_Kd -s 2 4 1 -o 0.5 0.25 my skin.png\nmap_d "
                                             "my skin.png\nnorm -bm 0.5 n.png\nmap_Ke -clamp on glow.png\n");
    EXPECT_EQ(c.warnings, Said());
    const Material& m = c.materials[0];
    ASSERT_EQ(c.images.size(), 3u);
    EXPECT_EQ(c.images[0].name, "my skin.png");
    EXPECT_EQ(c.images[0].mimeType, "image/png");
    EXPECT_EQ(m.baseColorTexture.image, 0u);
    EXPECT_EQ(m.baseColorTexture.scale, glm::vec2(2, 4));
    EXPECT_EQ(m.baseColorTexture.offset, glm::vec2(0.5f, -3.25f)) << "MTL counts upwards";
    EXPECT_EQ(m.baseColorFactor, glm::vec4(1.0f)) << "the image takes the place of Kd";
    EXPECT_EQ(m.alphaMode, AlphaMode::blend);
    EXPECT_EQ(m.normalTexture.wrapU, Wrap::repeat);
    EXPECT_EQ(m.normalScale, 0.5f);
    EXPECT_EQ(m.emissiveTexture.wrapV, Wrap::clampToEdge);
    EXPECT_EQ(m.emissiveFactor, glm::vec3(1.0f));
}

TEST(ObjMaterials, WhatIsNotCarriedOverIsSaid) {
    Folder folder;
    folder.files["a.png"] = kPng;
    folder.files["b.tga"] = "no picture";
    const Character c = readMaterial(folder, "Ka 1 1 1\nillum 2\nmap_Kd gone.png\nmap_Ke b.tga\nmap_Bump a.png\n"
                                             "map_d a.png\nKd 0,5 0 0\nNs\n");
    EXPECT_EQ(c.warnings, (Said{"line 1: mtllib \"a.mtl\": 2 statements make no sense, the first is line 8; left out",
                                "line 1: mtllib \"a.mtl\" map_Kd \"gone.png\": no such file; left out",
                                "line 1: mtllib \"a.mtl\" map_Ke \"b.tga\": not PNG, JPEG, WebP or KTX2; left out",
                                "materials: 1 material has a bump map, which is no normal map: \"Skin\"; left out",
                                "materials: 1 material has a map_d that is not its map_Kd: \"Skin\"; left out",
                                "materials: statements that a material has no place for: Ka, illum; left out"}));
    EXPECT_EQ(c.materials[0].baseColorFactor, glm::vec4(1.0f));
    EXPECT_TRUE(c.images.empty());
}

TEST(ObjMaterials, FilesAreLookedUpBelowTheFolder) {
    Folder folder;
    folder.files["mat/one.mtl"] = "newmtl A\nKd 1 0 0\nmap_Kd ..\\tex\\a.png\nnewmtl B\nmap_Kd C:\\work\\b.png\n";
    folder.files["two words.mtl"] = "newmtl A\nKd 0 1 0\nnewmtl C\nKd 0 0 1\nmap_Kd ../../etc/passwd\n";
    folder.files["tex/a.png"] = folder.files["mat/b.png"] = kPng;
    const Character c =
        readFrom(folder, "mtllib mat/one.mtl\nmtllib two words.mtl\nmtllib mat/one.mtl\n" + kTriangle + "usemtl A\n" +
                             kFace + "usemtl B\n" + kFace + "usemtl C\n" + kFace + "usemtl D\n" + kFace);
    ASSERT_EQ(c.materials.size(), 4u);
    ASSERT_EQ(c.images.size(), 2u);
    EXPECT_EQ(c.images[0].name, "tex/a.png") << "the first material of a name counts";
    EXPECT_EQ(c.images[1].name, "mat/b.png") << "of another machine's path the name";
    EXPECT_EQ(c.materials[2].baseColorFactor, glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(folder.asked, (Said{"mat/one.mtl", "two words.mtl", "tex/a.png", "mat/b.png"}));
    const Said wanted = {
        "line 2: mtllib \"two words.mtl\" map_Kd \"../../etc/passwd\": path leaves the asset's folder; "
        "left out",
        "materials: 1 material is in no MTL file: \"D\"; white"};
    EXPECT_TRUE(std::includes(c.warnings.begin(), c.warnings.end(), wanted.begin(), wanted.end()) ||
                (c.warnings.size() >= 2 && c.warnings[0] == wanted[0] && c.warnings[1] == wanted[1]))
        << c.warnings[0];
}

TEST(ObjMaterials, MissingFilesCostAWarning) {
    Folder folder;
    folder.files["b.mtl"] = "newmtl M\nKd 0 1 0\n";
    const Character c = readFrom(folder, "mtllib a.mtl b.mtl\nmtllib /etc/none.mtl\nmtllib http://x/y.mtl\n"
                                         "mtllib ../up.mtl\nmtllib sub/nul.mtl\n" +
                                             kTriangle + "usemtl M\n" + kFace);
    EXPECT_EQ(c.materials[0].baseColorFactor, glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(c.warnings,
              (Said{"line 1: mtllib \"a.mtl\": no such file; left out",
                    "line 2: mtllib \"/etc/none.mtl\": no such file; left out",
                    "line 3: mtllib \"http://x/y.mtl\": only files of the asset's folder are read; left out",
                    "line 4: mtllib \"../up.mtl\": path leaves the asset's folder; left out",
                    "line 5: mtllib \"sub/nul.mtl\": path names a device of Windows; left out"}));
    EXPECT_EQ(folder.asked, (Said{"a.mtl b.mtl", "a.mtl", "b.mtl", "none.mtl"}));
    EXPECT_TRUE(readObj(toBytes("mtllib a.mtl\n" + kTriangle + kFace), "t.obj", {.finish = {.strict = true}}).ok());
}

TEST(ObjMaterials, ColorsTakeThePlaceOfKd) {
    Folder folder;
    folder.files["a.mtl"] = "newmtl Blue\nKd 0 0 1\nd 0.5\n";
    const Character c = readFrom(folder, "mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0\nusemtl Blue\nf 1 2 3\n");
    ASSERT_EQ(c.cage.cornerColors.size(), 3u);
    EXPECT_EQ(c.cage.cornerColors[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(c.cage.cornerColors[2], glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(c.materials[0].baseColorFactor, glm::vec4(1, 1, 1, 0.5f));
    EXPECT_EQ(c.warnings, (Said{"materials: 1 material's faces have colors of their own: \"Blue\"; they take the place "
                                "of Kd",
                                "file: 1 vertex has no color; as their material"}));
}

TEST(ObjMaterials, ComeFromTheFolderOfTheFile) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "supple_obj_materials";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "a.mtl") << "newmtl M\nKd 1 0 0\n";
    const std::string text = "mtllib a.mtl\n" + kTriangle + "usemtl M\n" + kFace;
    const Result<Character> read = readCharacter(toBytes(text), "a.obj", folder.string());
    const Result<Character> nowhere = readCharacter(toBytes(text), "a.obj", "");
    std::filesystem::remove_all(folder);
    ASSERT_TRUE(read.ok() && nowhere.ok());
    EXPECT_EQ(read->materials[0].baseColorFactor, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(nowhere->materials[0].baseColorFactor, glm::vec4(1.0f));
    EXPECT_EQ(nowhere->warnings.size(), 1u);
}

#ifdef SUPPLE_HAS_TINYOBJ
/// libtinyobjloader reads the same of what is taken.
TEST(ObjMaterials, AreReadAsLibtinyobjloaderReadsThem) {
    const std::string text =
        "# made by hand\r\nnewmtl red paint\r\n\tKd 0.5 .25 1e-1\r\nKs 1 1 1\r\nKe 0 1 2\r\nNs 32.5\r\nd 0.25\r\nTr "
        "0.5\r\n"
        "map_Kd -s 2 3 4 -o 0.5 -1 0 -clamp on my image.png\r\nnorm -bm 0.5 normal.png\r\n\r\nnewmtl b\nTr 0.25\nPr "
        "0.5\nPm 0.125\nmap_Ke -mm 0 1 -blendu off -imfchan m e.png\nmap_d d.png\nmap_Bump -bm 2 b.png\nnewmtl c\nbump "
        "-type sphere c.png\nillum 2";
    std::map<std::string, int> places;
    std::vector<tinyobj::material_t> theirs;
    std::istringstream stream(text);
    std::string warning, error;
    tinyobj::LoadMtl(&places, &theirs, &stream, &warning, &error);
    Warnings warnings;
    const std::vector<obj::MtlMaterial> ours = obj::parseMtl(
        text, [](const std::string&) { return true; }, "a.mtl", warnings);
    EXPECT_EQ(warnings, Warnings());
    ASSERT_EQ(ours.size(), theirs.size());
    const auto expectMap = [](const obj::MtlMap& map, const std::string& name,
                              const tinyobj::texture_option_t& option) {
        EXPECT_EQ(map.file, name);
        EXPECT_EQ(map.offset, glm::vec2(option.origin_offset[0], option.origin_offset[1]));
        EXPECT_EQ(map.scale, glm::vec2(option.scale[0], option.scale[1]));
        EXPECT_EQ(map.clamp, option.clamp);
        EXPECT_EQ(map.multiplier, option.bump_multiplier);
    };
    for (size_t i = 0; i < ours.size(); ++i) {
        const obj::MtlMaterial& a = ours[i];
        const tinyobj::material_t& b = theirs[i];
        SCOPED_TRACE(b.name);
        EXPECT_EQ(a.name, b.name);
        for (int k = 0; k < 3; ++k) {
            EXPECT_FLOAT_EQ(a.emission.value_or(glm::vec3(0.0f))[k], b.emission[k]);
            EXPECT_FLOAT_EQ(a.diffuse.value_or(glm::vec3(b.diffuse[k]))[k], b.diffuse[k]);
        }
        EXPECT_EQ(a.dissolve.value_or(1.0f), b.dissolve);
        EXPECT_EQ(a.shininess.value_or(1.0f), b.shininess);
        EXPECT_EQ(a.roughness.value_or(0.0f), b.roughness);
        EXPECT_EQ(a.metallic.value_or(0.0f), b.metallic);
        expectMap(a.diffuseMap, b.diffuse_texname, b.diffuse_texopt);
        expectMap(a.emissionMap, b.emissive_texname, b.emissive_texopt);
        expectMap(a.alphaMap, b.alpha_texname, b.alpha_texopt);
        expectMap(a.bumpMap, b.bump_texname, b.bump_texopt);
        expectMap(a.normalMap, b.normal_texname, b.normal_texopt);
    }
}
#else
TEST(ObjMaterials, AreReadAsLibtinyobjloaderReadsThem) {
    GTEST_SKIP() << "left out: tiny_obj_loader.h or its library was not found (libtinyobjloader-dev)";
}
#endif

} // namespace
} // namespace supple::cage
