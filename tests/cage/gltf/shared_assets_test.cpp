// The characters and Khronos samples beside the repository: what each of them must read as.
#include "cage/gltf/reader.h"
#include "cage/gltf/uri.h"
#include "cage/topology.h"
#include "tests/support/shared_assets.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace supple::cage {
namespace {

namespace fs = std::filesystem;
using test::sharedAssets;
using test::sharedFolder;

struct Expected {
    const char* file;
    uint32_t sourceVertices, vertices, faces, quads;
    size_t joints, clips;
    const char* polygons; ///< name of the polygon source
    std::vector<std::string> warnings;
};

const char* const kNgons = "FB_ngon_encoding";
const char* const kTriangles = "triangles";

const std::vector<Expected>& expectations() {
    static const std::vector<Expected> list = {
        {"characters/dragon.glb", 554, 554, 614, 462, 27, 3, kNgons, {}},
        {"characters/eagle.glb", 768, 768, 784, 728, 24, 2, kNgons, {}},
        {"characters/horse.glb", 347, 347, 375, 287, 28, 3, kNgons, {}},
        {"characters/knight.glb", 480, 480, 551, 391, 31, 4, kNgons, {}},
        {"characters/llama_nonmanifold.glb",
         332,
         333,
         352,
         306,
         24,
         1,
         kNgons,
         {"mesh 0: 1 edge has three or more faces: edge (303, 304) of faces 140, 141, 316, 317; cut into sheets, 1 "
          "vertex "
          "repeated"}},
        {"characters/man_casual_quads.glb", 3980, 3980, 3966, 3966, 31, 3, kNgons, {}},
        {"characters/mh_body_13k_infl8.glb", 13380, 13380, 13378, 13378, 163, 2, kNgons, {}},
        {"characters/mh_female1605.glb", 1605, 1605, 1584, 1584, 53, 3, kNgons, {}},
        {"characters/mh_female1605_morph.glb", 1605, 1605, 1584, 1584, 53, 1, kNgons, {}},
        {"characters/mh_proxy741.glb", 741, 741, 730, 730, 163, 2, kNgons, {}},
        {"characters/pawn_creased.glb", 601, 601, 588, 588, 5, 1, kNgons, {}},
        {"characters/rook_creased.glb", 768, 768, 777, 733, 5, 1, kNgons, {}},
        {"characters/shark.glb", 324, 324, 328, 284, 8, 1, kNgons, {}},
        {"characters/snake.glb", 815, 815, 822, 788, 15, 2, kNgons, {}},
        {"characters/spot.glb", 188, 188, 180, 160, 12, 2, kNgons, {}},
        {"characters/spot_uvsplit.glb", 267, 188, 180, 160, 12, 2, kNgons, {}},
        {"characters/suzanne.glb",
         507,
         507,
         501,
         467,
         6,
         1,
         kNgons,
         {"mesh 0: 2 vertices agree with another in position but not in skin (first: vertices 15 and 114); kept apart",
          "mesh 0: 1 inner vertex has two faces only: vertex 137 between faces 142 and 143; kept, and a face cut by an "
          "edge to it"}},
        {"characters/trex_ngons.glb", 912, 912, 838, 626, 29, 2, kNgons, {}},
        {"characters/velociraptor.glb", 626, 626, 664, 576, 29, 4, kNgons, {}},
        {"khronos/CesiumMan.glb", 3273, 2338, 4672, 0, 19, 1, kTriangles, {}},
        {"khronos/Fox.glb", 1728, 290, 576, 0, 24, 3, kTriangles, {}},
        {"khronos/RiggedFigure_2017_unnormalised_weights.glb",
         370,
         130,
         256,
         0,
         19,
         1,
         kTriangles,
         {"mesh 0 WEIGHTS: normalised: they do not sum to 1 at 31 vertices, largest deviation 0.8"}},
        {"khronos/RiggedSimple.glb", 96, 96, 188, 0, 2, 1, kTriangles, {}},
        {"khronos/SimpleSkin.gltf", 10, 10, 8, 0, 2, 1, kTriangles, {}},
        {"khronos/BoxAnimated.gltf",
         320,
         258,
         254,
         0,
         2,
         1,
         kTriangles,
         {"mesh 0: 18 faces are turned against their neighbours, the first is face 1; turned round",
          "mesh 1: 12 edges have three or more faces, the first is edge (6, 7) of faces 4, 5, 127, 128; cut into "
          "sheets, 16 vertices repeated",
          "mesh 1: 64 faces are turned against their neighbours, the first is face 1; turned round"}},
        {"khronos/InterpolationTest.gltf", 220, 76, 110, 0, 10, 9, kTriangles, {}},
        {"khronos/MorphStressTest.gltf", 1528, 1224, 2412, 0, 1, 3, kTriangles, {}},
        {"khronos/SimpleMorph/SimpleMorph.gltf", 3, 3, 1, 0, 1, 1, kTriangles, {}},
        {"khronos/AnimatedMorphCube/AnimatedMorphCube.gltf", 24, 8, 12, 0, 1, 1, kTriangles, {}},
        {"khronos/asset-generator/Animation_Node/Animation_Node_00.gltf", 24, 8, 12, 0, 1, 1, kTriangles, {}},
        {"khronos/asset-generator/Animation_Node/Animation_Node_01.gltf", 24, 8, 12, 0, 1, 1, kTriangles, {}},
        {"khronos/asset-generator/Animation_Node/Animation_Node_02.gltf", 24, 8, 12, 0, 1, 1, kTriangles, {}},
        {"khronos/asset-generator/Animation_Node/Animation_Node_03.gltf", 24, 8, 12, 0, 1, 1, kTriangles, {}},
        {"khronos/asset-generator/Animation_Node/Animation_Node_04.gltf", 24, 8, 12, 0, 1, 1, kTriangles, {}},
        {"khronos/asset-generator/Animation_Node/Animation_Node_05.gltf", 24, 8, 12, 0, 1, 1, kTriangles, {}},
        {"khronos/asset-generator/Animation_Skin/Animation_Skin_00.gltf", 6, 6, 4, 0, 2, 0, kTriangles, {}},
        {"khronos/asset-generator/Animation_Skin/Animation_Skin_01.gltf", 6, 6, 4, 0, 2, 1, kTriangles, {}},
        {"khronos/asset-generator/Animation_Skin/Animation_Skin_02.gltf", 6, 6, 4, 0, 2, 0, kTriangles, {}},
        {"khronos/asset-generator/Animation_Skin/Animation_Skin_03.gltf", 6, 6, 4, 0, 2, 0, kTriangles, {}},
        {"khronos/asset-generator/Animation_Skin/Animation_Skin_04.gltf", 6, 6, 4, 0, 2, 0, kTriangles, {}},
        {"khronos/asset-generator/Animation_Skin/Animation_Skin_07.gltf", 10, 10, 8, 0, 5, 0, kTriangles, {}},
        {"khronos/asset-generator/Animation_Skin/Animation_Skin_09.gltf",
         13,
         13,
         10,
         1,
         4,
         0,
         kTriangles,
         {"mesh 0: 1 T-corner: vertex 4 on edge (2, 3) of face 1; made a four-sided facet"}},
        {"khronos/asset-generator/Animation_SkinType/Animation_SkinType_00.gltf", 6, 6, 4, 0, 2, 0, kTriangles, {}},
        {"khronos/asset-generator/Animation_SkinType/Animation_SkinType_01.gltf", 6, 6, 4, 0, 2, 0, kTriangles, {}},
        {"khronos/asset-generator/Animation_SkinType/Animation_SkinType_02.gltf", 6, 6, 4, 0, 2, 0, kTriangles, {}},
        {"khronos/asset-generator/Animation_SkinType/Animation_SkinType_03.gltf", 6, 6, 4, 0, 2, 0, kTriangles, {}},
    };
    return list;
}

TEST(SharedAssets, ReadAsExpected) {
    if (!fs::exists(sharedFolder())) {
        GTEST_SKIP() << expectations().size() << " cases left out: " << sharedFolder() << " is not present";
    }
    for (const Expected& expected : expectations()) {
        SCOPED_TRACE(expected.file);
        const Result<Character> result = readGltfFile(sharedFolder() + expected.file, {.pairing = Pairing::never});
        ASSERT_TRUE(result.ok()) << result.error().message;
        const Character& c = *result;
        EXPECT_EQ(c.sourceVertexCount, expected.sourceVertices);
        EXPECT_EQ(c.cage.vertexCount(), expected.vertices);
        if (c.damages.empty()) {
            EXPECT_EQ(c.seamVertexCount, expected.sourceVertices - expected.vertices);
        }
        EXPECT_EQ(c.cage.faceCount(), expected.faces);
        uint32_t quads = 0;
        for (uint32_t f = 0; f < c.cage.faceCount(); ++f)
            quads += c.cage.sides(f) == 4 ? 1 : 0;
        EXPECT_EQ(quads, expected.quads);
        EXPECT_EQ(c.skin.joints.size(), expected.joints);
        EXPECT_EQ(c.clips.size(), expected.clips);
        EXPECT_STREQ(polygonSourceName(c.parts[0].polygonSource), expected.polygons);
        EXPECT_EQ(c.warnings, expected.warnings);
        for (const Image& image : c.images)
            EXPECT_FALSE(image.bytes.empty());

        const Result<Topology> topology = buildTopology(c.cage);
        EXPECT_TRUE(topology.ok()) << topology.error().message;
    }
}

TEST(SharedAssets, NoneIsForgotten) {
    if (!fs::exists(sharedFolder())) {
        GTEST_SKIP() << sharedFolder() << " is not present";
    }
    std::set<std::string> found;
    for (const char* folder : {"characters", "khronos"}) {
        for (const std::string& path : test::filesBelow(sharedFolder() + folder, {".glb", ".gltf"})) {
            found.insert(fs::relative(path, sharedFolder()).generic_string());
        }
    }
    std::set<std::string> expected;
    for (const Expected& e : expectations())
        expected.insert(e.file);
    EXPECT_EQ(found, expected);
}

TEST(SharedAssets, UvSplitSpotIsTheSameCage) {
    const std::vector<std::string> paths = sharedAssets({"characters/spot.glb", "characters/spot_uvsplit.glb"});
    if (paths.size() < 2) {
        GTEST_SKIP() << "not both files are in " << sharedFolder();
    }
    const Result<Character> whole = readGltfFile(paths[0]);
    ASSERT_TRUE(whole.ok()) << whole.error().message;
    const Result<Character> split = readGltfFile(paths[1]);
    ASSERT_TRUE(split.ok()) << split.error().message;
    // Splitting may have reordered the vertices: compare by position.
    std::map<std::tuple<float, float, float>, uint32_t> byPosition;
    for (uint32_t v = 0; v < whole->cage.vertexCount(); ++v) {
        const glm::vec3 p = whole->cage.positions[v];
        byPosition[{p.x, p.y, p.z}] = v;
    }
    std::vector<uint32_t> map;
    for (const glm::vec3 p : split->cage.positions) {
        const auto found = byPosition.find({p.x, p.y, p.z});
        ASSERT_NE(found, byPosition.end());
        map.push_back(found->second);
    }
    const auto faces = [](const Cage& cage, auto vertexOf) {
        std::set<std::vector<uint32_t>> set;
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            std::vector<uint32_t> face;
            for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c)
                face.push_back(vertexOf(cage.faceVertices[c]));
            std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
            set.insert(face);
        }
        return set;
    };
    EXPECT_EQ(faces(whole->cage, [](uint32_t v) { return v; }), faces(split->cage, [&](uint32_t v) { return map[v]; }));
}

// ---- against the files themselves, read a second way ----------------------------------------------------------------

/// A GLB or glTF as JSON and the bytes of its buffers.
struct RawFile {
    explicit RawFile(const fs::path& path);

    nlohmann::json json;
    std::vector<std::string> buffers;

    [[nodiscard]] std::vector<float> floats(size_t accessor) const {
        const nlohmann::json& a = json.at("accessors").at(accessor);
        const nlohmann::json& view = json.at("bufferViews").at(a.at("bufferView").get<size_t>());
        const std::map<std::string, size_t> widths{{"SCALAR", 1}, {"VEC3", 3}};
        std::vector<float> values(a.at("count").get<size_t>() * widths.at(a.at("type")));
        EXPECT_EQ(a.at("componentType"), 5126);
        EXPECT_FALSE(a.contains("sparse"));
        const std::string& binary = buffers.at(view.at("buffer").get<size_t>());
        std::memcpy(values.data(), binary.data() + view.value("byteOffset", 0) + a.value("byteOffset", 0),
                    4 * values.size());
        return values;
    }
};

RawFile::RawFile(const fs::path& path) {
    const auto textOf = [](const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    };
    const std::string text = textOf(path);
    if (text.starts_with("glTF")) {
        uint32_t length = 0;
        std::memcpy(&length, text.data() + 12, 4);
        json = nlohmann::json::parse(text.substr(20, length));
        buffers = {text.substr(28 + size_t{length})};
        return;
    }
    json = nlohmann::json::parse(text);
    for (const nlohmann::json& buffer : json.at("buffers")) {
        const std::string uri = buffer.at("uri");
        if (gltf::isDataUri(uri)) {
            const Result<gltf::DataUri> data = gltf::decodeDataUri(uri);
            EXPECT_TRUE(data.ok());
            buffers.emplace_back(reinterpret_cast<const char*>(data->bytes.data()), data->bytes.size());
        } else {
            buffers.push_back(textOf(path.parent_path() / uri));
        }
    }
}

TEST(SharedAssets, MorphTargetsAreTheFiles) {
    for (const std::string& path :
         sharedAssets({"khronos/SimpleMorph/SimpleMorph.gltf", "khronos/AnimatedMorphCube/AnimatedMorphCube.gltf",
                       "khronos/MorphStressTest.gltf", "characters/mh_female1605_morph.glb"})) {
        SCOPED_TRACE(path);
        const RawFile file(path);
        const Result<Character> c = readGltfFile(path);
        ASSERT_TRUE(c.ok()) << c.error().message;
        const nlohmann::json& mesh = file.json.at("meshes").at(0);
        const size_t targetCount = mesh.at("primitives").at(0).at("targets").size();
        ASSERT_EQ(c->morphs.targets.size(), targetCount);
        EXPECT_EQ(c->morphs.weights, mesh.at("weights").get<std::vector<float>>());
        for (size_t t = 0; t < targetCount; ++t) {
            const MorphTarget& target = c->morphs.targets[t];
            const auto names = mesh.value("extras", nlohmann::json::object()).value("targetNames", nlohmann::json());
            EXPECT_EQ(target.name, names.is_null() ? "" : names.at(t).get<std::string>());
            // All primitives' POSITION elements one after the other, as Cage::sourceVertices counts them.
            std::vector<float> deltas;
            for (const nlohmann::json& primitive : mesh.at("primitives")) {
                const auto own = file.floats(primitive.at("targets").at(t).at("POSITION"));
                deltas.insert(deltas.end(), own.begin(), own.end());
            }
            size_t listed = 0;
            for (uint32_t v = 0; v < c->cage.vertexCount(); ++v) {
                const float* delta = &deltas[3 * size_t{c->cage.sourceVertices[v]}];
                const glm::vec3 expected(delta[0], delta[1], delta[2]);
                const bool isListed = listed < target.vertices.size() && target.vertices[listed] == v;
                ASSERT_EQ(isListed, expected != glm::vec3(0.0f)) << "vertex " << v;
                if (isListed) {
                    EXPECT_EQ(target.deltas[listed++], expected) << "vertex " << v;
                }
            }
            EXPECT_EQ(listed, target.vertices.size());
            EXPECT_GT(listed, 0u);
        }
        size_t checked = 0;
        for (size_t a = 0; a < file.json.at("animations").size(); ++a) {
            const nlohmann::json& animation = file.json.at("animations")[a];
            for (const nlohmann::json& channel : animation.at("channels")) {
                if (channel.at("target").at("path") != "weights") {
                    continue;
                }
                const nlohmann::json& sampler = animation.at("samplers").at(channel.at("sampler").get<size_t>());
                const auto own = std::find_if(c->clips[a].channels.begin(), c->clips[a].channels.end(),
                                              [](const Channel& x) { return x.path == ChannelPath::weights; });
                ASSERT_NE(own, c->clips[a].channels.end());
                EXPECT_EQ(own->node, c->parts[0].node);
                EXPECT_EQ(own->interpolation, Interpolation::linear);
                EXPECT_EQ(own->times, file.floats(sampler.at("input")));
                EXPECT_EQ(own->values, file.floats(sampler.at("output")));
                EXPECT_EQ(own->values.size(), own->times.size() * targetCount);
                ++checked;
            }
        }
        EXPECT_EQ(checked, file.json.at("animations").size()) << "each of these clips animates the weights";
    }
}

TEST(SharedAssets, CreasesAreTheFiles) {
    const std::map<std::string, size_t> counts{{"pawn_creased.glb", 120}, {"rook_creased.glb", 280}};
    for (const fs::path path : sharedAssets({"characters/pawn_creased.glb", "characters/rook_creased.glb"})) {
        SCOPED_TRACE(path);
        const RawFile file(path);
        const Result<Character> c = readGltfFile(path.string());
        ASSERT_TRUE(c.ok()) << c.error().message;
        const size_t count = counts.at(path.filename().string());
        const nlohmann::json& creases = file.json.at("meshes").at(0).at("extras").at("creases");
        ASSERT_EQ(creases.size(), count);
        ASSERT_EQ(c->cage.creases.size(), count);
        for (size_t i = 0; i < count; ++i) {
            const Crease& crease = c->cage.creases[i];
            EXPECT_EQ(c->cage.sourceVertices[crease.a], creases[i][0].get<uint32_t>());
            EXPECT_EQ(c->cage.sourceVertices[crease.b], creases[i][1].get<uint32_t>());
            EXPECT_EQ(crease.sharpness, creases[i][2].get<float>());
        }
    }
}

TEST(SharedAssets, TrianglesThatWereQuadsArePaired) {
    struct Case {
        const char* file;
        size_t part;
        uint32_t quads, triangles; ///< of the part; no quads: its triangles stay
    };
    const Case cases[] = {{"khronos/InterpolationTest.gltf", 0, 6, 0}, {"khronos/Fox.glb", 0, 0, 576}};
    for (const Case& expected : cases) {
        for (const std::string& path : sharedAssets({expected.file})) {
            const Result<Character> c = readGltfFile(path);
            ASSERT_TRUE(c.ok()) << c.error().message;
            uint32_t quads = 0;
            uint32_t triangles = 0;
            for (uint32_t f = c->parts[expected.part].firstFace; f < endFace(*c, expected.part); ++f) {
                ++(c->cage.sides(f) == 4 ? quads : triangles);
            }
            EXPECT_EQ(quads, expected.quads) << path;
            EXPECT_EQ(triangles, expected.triangles) << path;
            EXPECT_EQ(c->parts[expected.part].polygonSource,
                      quads > 0 ? PolygonSource::pairedTriangles : PolygonSource::triangles);
        }
    }
}

} // namespace
} // namespace supple::cage
