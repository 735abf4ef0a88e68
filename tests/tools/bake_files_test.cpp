// supple bake into GLB and PLY as a user runs it: what other programs read there is what the OBJ holds, patch by patch.
#include "cage/formats/reader.h"
#include "host/picture.h"
#include "tests/support/shared_assets.h"
#include "tests/support/spring_files.h"
#include "tests/tools/baked_files.h"
#include "tests/tools/command_runner.h"
#include "tests/tools/obj_file.h"
#include "tools/common/word_hash.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <tuple>

namespace supple::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string kSamplePip = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
const std::string kSampleHelmet = std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb";

/// Position and normal as they are ordered.
using Point = std::tuple<float, float, float>;
Point pointOf(const glm::vec3& v) {
    return {v.x + 0.0f, v.y + 0.0f, v.z + 0.0f};
}

float largestDifference(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 apart = glm::abs(a - b);
    return std::max({apart.x, apart.y, apart.z});
}

double srgbOf(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

class BakeFiles : public CommandTest {
protected:
    void bake(const std::string& arguments) {
        const Outcome outcome = runOnDevice("bake " + arguments);
        ASSERT_EQ(outcome.exitCode, 0) << arguments << "\n" << outcome.err;
        said_ = outcome.err;
    }

    /// A cube whose faces have all that a glTF material has, a plain material, and none.
    void writePaintedCube(const std::string& name);
    /// The same mesh twice, as the parts "left" and "right".
    void writePaintedCubes(const std::string& name);

    std::string said_; ///< by the last bake
};

cage::Material paintedMaterial() {
    cage::Material material;
    material.name = "lacquer";
    material.baseColorFactor = {0.5f, 0.25f, 0.75f, 0.5f};
    material.metallicFactor = 0.25f;
    material.roughnessFactor = 0.375f;
    material.normalScale = 0.5f;
    material.occlusionStrength = 0.75f;
    material.emissiveFactor = {0.25f, 0.5f, 1.0f};
    material.emissiveStrength = 4.0f;
    material.alphaMode = cage::AlphaMode::blend;
    material.doubleSided = true;
    material.baseColorTexture.image = 0;
    material.baseColorTexture.wrapU = cage::Wrap::clampToEdge;
    material.baseColorTexture.wrapV = cage::Wrap::mirroredRepeat;
    material.baseColorTexture.magFilter = cage::Filter::nearest;
    material.baseColorTexture.minFilter = cage::Filter::linearMipmapNearest;
    material.metallicRoughnessTexture.image = 1;
    material.normalTexture.image = 1;
    material.normalTexture.uvSet = 1;
    material.normalTexture.offset = {0.25f, 0.5f};
    material.normalTexture.rotation = 0.5f;
    material.normalTexture.scale = {2.0f, -1.0f};
    material.occlusionTexture.image = 1;
    material.emissiveTexture.image = 0;
    return material;
}

void BakeFiles::writePaintedCube(const std::string& name) {
    const std::string text = kCubeObj;
    Result<cage::Character> cube = cage::readCharacter(std::as_bytes(std::span(text)), "cube.obj", ".");
    ASSERT_TRUE(cube.ok()) << cube.error().message;
    cage::Cage& cage = cube->cage;
    for (uint32_t corner = 0; corner < cage.cornerCount(); ++corner) {
        const glm::vec2 uv((corner + 1) / 2 % 2, corner / 2 % 2);
        cage.cornerUvs.push_back(uv);
        cage.cornerUvs1.push_back(0.5f * uv + 0.25f);
        const float at = static_cast<float>(corner) / 32.0f;
        cage.cornerColors.emplace_back(at, 1.0f - at, 0.5f, 1.0f - at / 2.0f);
    }
    cage.faceMaterials = {0, 0, 0, 1, 1, cage::kNone};
    cage::Material plain;
    plain.name = "paper";
    plain.unlit = true;
    plain.alphaMode = cage::AlphaMode::mask;
    plain.alphaCutoff = 0.25f;
    cube->materials = {paintedMaterial(), plain};
    for (const uint8_t shade : {60, 200}) {
        host::Picture picture = host::Picture::blank(4, 4);
        std::fill(picture.rgba.begin(), picture.rgba.end(), shade);
        ASSERT_TRUE(host::writePng(picture, file("image.png").string()).ok());
        const std::string png = readText(file("image.png"));
        const auto bytes = std::as_bytes(std::span(png));
        cube->images.push_back(
            {"shade " + std::to_string(shade), "image/png", std::vector<std::byte>(bytes.begin(), bytes.end())});
    }
    fs::remove(file("image.png"));
    const Result<cage::GlbFile> glb = cage::writeGlb(*cube);
    ASSERT_TRUE(glb.ok()) << glb.error().message;
    writeText(file(name), {reinterpret_cast<const char*>(glb->bytes.data()), glb->bytes.size()});
}

void BakeFiles::writePaintedCubes(const std::string& name) {
    writePaintedCube(name);
    Glb glb(file(name));
    glb.root["nodes"] =
        Json::parse(R"([{"name": "left", "mesh": 0}, {"name": "right", "mesh": 0, "translation": [4, 0, 0]}])");
    glb.root["scenes"] = Json::parse(R"([{"nodes": [0, 1]}])");
    glb.write(file(name));
}

/// Vertex by vertex of every face: positions to the bit, normals within rounding, and that these are unit vectors.
void expectPlyIsObj(const Ply& ply, const Obj& obj) {
    ASSERT_EQ(ply.faces.size(), obj.faces.size());
    EXPECT_EQ(ply.uvs.empty(), obj.vt.empty());
    float apart = 0.0f;
    for (size_t f = 0; f < obj.faces.size(); ++f) {
        ASSERT_EQ(ply.faces[f].size(), obj.faces[f].size()) << "face " << f;
        for (size_t k = 0; k < obj.faces[f].size(); ++k) {
            const uint32_t in = ply.faces[f][k], of = obj.faces[f][k];
            ASSERT_EQ(ply.positions[in], obj.v[of]) << "face " << f << " corner " << k;
            apart = std::max(apart, largestDifference(ply.normals[in], obj.vn[of]));
            if (!obj.vt.empty()) {
                ASSERT_EQ(ply.uvs[in], obj.vt[of]) << "face " << f;
            }
        }
    }
    EXPECT_LE(apart, 1e-6f);
    for (const glm::vec3& normal : ply.normals) {
        ASSERT_NEAR(glm::length(normal), 1.0f, 2e-6f);
    }
}

TEST_F(BakeFiles, PlyIsTheObj) {
    for (const std::string scheme : {"auto", "catmull-clark", "loop", "polygons"}) {
        SCOPED_TRACE(scheme);
        std::string surface = kSamplePip + " --rate 3 --clip walk --time 0.4";
        surface += " --scheme " + scheme;
        ASSERT_NO_FATAL_FAILURE(bake(surface + " -o pip.obj"));
        ASSERT_NO_FATAL_FAILURE(bake(surface + " -o pip.PLY"));
        EXPECT_EQ(said_.find("supple: warning"), std::string::npos) << said_;
        const Ply ply = readPly(file("pip.PLY"));
        const Obj obj = readObj(file("pip.obj"));
        EXPECT_EQ(ply.properties, (std::vector<std::string>{"float x", "float y", "float z", "float nx", "float ny",
                                                            "float nz", "float s", "float t", "uchar red",
                                                            "uchar green", "uchar blue", "uchar alpha"}));
        expectPlyIsObj(ply, obj);
        const bool patches = scheme != "polygons";
        EXPECT_EQ(ply.positions.size() < obj.v.size(), patches) << "what patches share is there once";
    }
}

/// Of a mesh's triangles: that every corner is a point of the OBJ, and that together they are as many as its faces.
void expectGlbIsObj(const Glb& glb, const Obj& obj) {
    std::map<Point, std::vector<glm::vec3>> normalsAt;
    size_t triangles = 0;
    for (const std::vector<uint32_t>& face : obj.faces) {
        for (const uint32_t vertex : face) {
            normalsAt[pointOf(obj.v[vertex])].push_back(obj.vn[vertex]);
        }
        triangles += face.size() - 2;
    }
    for (const Json& mesh : glb.root["meshes"]) {
        for (const Json& primitive : mesh["primitives"]) {
            const Json& attributes = primitive["attributes"];
            const auto positions = glb.values<glm::vec3>(attributes["POSITION"]);
            const auto normals = glb.values<glm::vec3>(attributes["NORMAL"]);
            const std::vector<uint32_t> indices = glb.indices(primitive);
            EXPECT_EQ(glb.accessor(primitive["indices"])["componentType"], positions.size() > 65535 ? 5125 : 5123);
            triangles -= indices.size() / 3;
            for (const uint32_t index : indices) {
                ASSERT_LT(index, positions.size());
                const auto found = normalsAt.find(pointOf(positions[index]));
                ASSERT_NE(found, normalsAt.end());
                ASSERT_TRUE(std::any_of(found->second.begin(), found->second.end(), [&](const glm::vec3& normal) {
                    return largestDifference(normal, normals[index]) <= 1e-6f;
                }));
            }
        }
    }
    EXPECT_EQ(triangles, 0u);
}

TEST_F(BakeFiles, GlbIsTheObj) {
    const std::string surface = kSamplePip + " --rate 4 --clip walk --time 0.4";
    ASSERT_NO_FATAL_FAILURE(bake(surface + " -o pip.obj"));
    ASSERT_NO_FATAL_FAILURE(bake(surface + " -o pip.glb"));
    EXPECT_EQ(said_, "");
    const Glb glb(file("pip.glb"));
    expectGlbIsObj(glb, readObj(file("pip.obj")));

    // Its uvs and colors are the PLY's.
    ASSERT_NO_FATAL_FAILURE(bake(surface + " -o pip.ply"));
    const Ply ply = readPly(file("pip.ply"));
    std::map<Point, std::set<std::array<int, 4>>> colorsAt;
    for (size_t v = 0; v < ply.positions.size(); ++v) {
        colorsAt[pointOf(ply.positions[v])].insert(
            {ply.colors[v][0], ply.colors[v][1], ply.colors[v][2], ply.colors[v][3]});
    }
    const Json& attributes = glb.root["meshes"][0]["primitives"][0]["attributes"];
    const auto positions = glb.values<glm::vec3>(attributes["POSITION"]);
    const auto colors = glb.values<std::array<uint16_t, 4>>(attributes["COLOR_0"]);
    EXPECT_EQ(glb.accessor(attributes["COLOR_0"])["normalized"], true);
    for (size_t v = 0; v < positions.size(); ++v) {
        std::array<int, 4> color{};
        for (size_t channel = 0; channel < 4; ++channel) {
            const double value = colors[v][channel] / 65535.0;
            color[channel] = static_cast<int>(std::lround(255.0 * (channel < 3 ? srgbOf(value) : value)));
        }
        ASSERT_EQ(colorsAt[pointOf(positions[v])].count(color), 1u);
    }
}

TEST_F(BakeFiles, IndicesHaveAsManyBitsAsTheyNeed) {
    ASSERT_NO_FATAL_FAILURE(bake(kSamplePip + " --rate 6 -o pip.obj"));
    ASSERT_NO_FATAL_FAILURE(bake(kSamplePip + " --rate 6 -o pip.glb"));
    const Glb glb(file("pip.glb"));
    const Json& primitive = glb.root["meshes"][0]["primitives"][0];
    EXPECT_GT(glb.accessor(primitive["attributes"]["POSITION"])["count"], 65535);
    expectGlbIsObj(glb, readObj(file("pip.obj")));
}

TEST_F(BakeFiles, PatchesShareVertices) {
    writeText(file("cube.obj"), kCubeObj);
    ASSERT_NO_FATAL_FAILURE(bake("cube.obj --rate 4 -o cube.glb"));
    ASSERT_NO_FATAL_FAILURE(bake("cube.obj --rate 4 -o cube.ply"));
    const Glb glb(file("cube.glb"));
    const Json& primitive = glb.root["meshes"][0]["primitives"][0];
    const size_t vertices = 8 + 12 * 3 + 6 * 9; // of corners, edges and faces
    EXPECT_EQ(glb.accessor(primitive["attributes"]["POSITION"])["count"], vertices);
    EXPECT_EQ(primitive["attributes"].size(), 2u) << "a cube without texture coordinates has no tangents either";
    EXPECT_FALSE(primitive.contains("material"));
    EXPECT_EQ(glb.indices(primitive).size(), 6u * 16 * 2 * 3);
    const Ply ply = readPly(file("cube.ply"));
    EXPECT_EQ(ply.positions.size(), vertices);
    EXPECT_EQ(ply.faces.size(), 6u * 16);
    EXPECT_EQ(ply.properties.size(), 6u);
    for (const std::vector<uint32_t>& face : ply.faces) {
        EXPECT_EQ(face.size(), 4u);
    }
}

TEST_F(BakeFiles, AccessorsKeepTheRulesOfGltf) {
    ASSERT_NO_FATAL_FAILURE(writePaintedCube("cube.glb"));
    ASSERT_NO_FATAL_FAILURE(bake("cube.glb --rate 5 -o baked.glb"));
    EXPECT_EQ(said_, "");
    const Glb glb(file("baked.glb"));
    ASSERT_EQ(glb.root["meshes"].size(), 1u);
    const Json& primitives = glb.root["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 3u) << "two materials, and faces without one";
    EXPECT_EQ(primitives[0]["material"], 0);
    EXPECT_EQ(primitives[1]["material"], 1);
    EXPECT_FALSE(primitives[2].contains("material"));
    for (const Json& primitive : primitives) {
        const Json& attributes = primitive["attributes"];
        for (const char* name : {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"}) {
            ASSERT_TRUE(attributes.contains(name)) << name;
            const Json& view = glb.root["bufferViews"][glb.accessor(attributes[name])["bufferView"].get<size_t>()];
            EXPECT_EQ(view["target"], 34962) << name;
        }
        const auto positions = glb.values<glm::vec3>(attributes["POSITION"]);
        glm::vec3 low(positions[0]), high(positions[0]);
        for (const glm::vec3& position : positions) {
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
        EXPECT_EQ(glb.accessor(attributes["POSITION"])["min"], Json({low.x, low.y, low.z}));
        EXPECT_EQ(glb.accessor(attributes["POSITION"])["max"], Json({high.x, high.y, high.z}));
        const auto normals = glb.values<glm::vec3>(attributes["NORMAL"]);
        const auto tangents = glb.values<glm::vec4>(attributes["TANGENT"]);
        const auto uvs = glb.values<glm::vec2>(attributes["TEXCOORD_0"]);
        const auto uvs1 = glb.values<glm::vec2>(attributes["TEXCOORD_1"]);
        for (size_t v = 0; v < normals.size(); ++v) {
            EXPECT_NEAR(glm::length(normals[v]), 1.0f, 1e-6f);
            EXPECT_NEAR(glm::length(glm::vec3(tangents[v])), 1.0f, 1e-6f);
            EXPECT_NEAR(glm::dot(glm::vec3(tangents[v]), normals[v]), 0.0f, 2e-4f);
            EXPECT_EQ(std::abs(tangents[v].w), 1.0f);
            EXPECT_LT(glm::distance(uvs1[v], 0.5f * uvs[v] + 0.25f), 1e-6f);
        }
    }
}

/// Where s grows and t stands still, along the faces' own edges.
/// Of the painted cube: where the normal map is looked up, or what stands for it where there is none.
std::vector<glm::vec2> normalMapUvs(const Glb& glb, const Json& primitive) {
    const Json& attributes = primitive["attributes"];
    if (!primitive.contains("material") ||
        !glb.root["materials"][primitive["material"].get<size_t>()].contains("normalTexture")) {
        return glb.values<glm::vec2>(attributes["TEXCOORD_0"]);
    }
    const float c = std::cos(0.5f), s = std::sin(0.5f);
    std::vector<glm::vec2> uvs = glb.values<glm::vec2>(attributes["TEXCOORD_1"]);
    for (glm::vec2& uv : uvs) {
        uv = {2.0f * c * uv.x - s * uv.y, -2.0f * s * uv.x - c * uv.y};
    }
    return uvs;
}

TEST_F(BakeFiles, TangentsPointAlongTheNormalMap) {
    ASSERT_NO_FATAL_FAILURE(writePaintedCube("cube.glb"));
    ASSERT_NO_FATAL_FAILURE(bake("cube.glb --rate 16 --uv-mode all -o baked.glb"));
    const Glb glb(file("baked.glb"));
    size_t compared = 0;
    for (const Json& primitive : glb.root["meshes"][0]["primitives"]) {
        const Json& attributes = primitive["attributes"];
        const auto positions = glb.values<glm::vec3>(attributes["POSITION"]);
        const auto tangents = glb.values<glm::vec4>(attributes["TANGENT"]);
        const std::vector<glm::vec2> uvs = normalMapUvs(glb, primitive);
        const std::vector<uint32_t> indices = glb.indices(primitive);
        for (size_t i = 0; i < indices.size(); i += 3) {
            const uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
            const glm::vec2 s = uvs[b] - uvs[a], t = uvs[c] - uvs[a];
            const float area = s.x * t.y - s.y * t.x;
            if (std::abs(area) < 1e-9f) {
                continue;
            }
            const glm::vec3 along =
                glm::normalize((t.y * (positions[b] - positions[a]) - s.y * (positions[c] - positions[a])) / area);
            const glm::vec4 mean = tangents[a] + tangents[b] + tangents[c];
            EXPECT_GT(glm::dot(along, glm::normalize(glm::vec3(mean))), 0.97f); // least at the corners
            EXPECT_EQ(mean.w, area < 0.0f ? 3.0f : -3.0f);
            ++compared;
        }
    }
    EXPECT_GT(compared, 1000u);
}

TEST_F(BakeFiles, TangentsAreLeftOutWhereThereAreNone) {
    ASSERT_NO_FATAL_FAILURE(writePaintedCubes("cubes.glb"));
    const auto tangentsOf = [&](const char* name) {
        std::vector<bool> tangents;
        const Glb glb(file(name));
        for (const Json& mesh : glb.root["meshes"]) {
            for (const Json& primitive : mesh["primitives"]) {
                tangents.push_back(primitive["attributes"].contains("TANGENT"));
            }
        }
        return tangents;
    };
    ASSERT_NO_FATAL_FAILURE(bake("cubes.glb --rate 2 -o all.glb"));
    EXPECT_EQ(tangentsOf("all.glb"), std::vector<bool>(6, true));
    EXPECT_EQ(said_, "");
    ASSERT_NO_FATAL_FAILURE(bake("cubes.glb --rate 2 --no-tangent-frames -o none.glb"));
    EXPECT_EQ(tangentsOf("none.glb"), std::vector<bool>(6, false));
    EXPECT_EQ(said_, "");
    for (const char* scheme : {"loop", "fragments", "polygons"}) {
        ASSERT_NO_FATAL_FAILURE(bake("cubes.glb --rate 2 --scheme " + std::string(scheme) + " -o named.glb"));
        EXPECT_EQ(tangentsOf("named.glb"), std::vector<bool>(6, true)) << scheme;
        EXPECT_EQ(said_, "");
    }
}

TEST_F(BakeFiles, MaterialsStayWhole) {
    ASSERT_NO_FATAL_FAILURE(writePaintedCube("cube.glb"));
    ASSERT_NO_FATAL_FAILURE(bake("cube.glb --rate 2 -o baked.glb"));
    const Json before = Json::parse(run("inspect cube.glb --json").out);
    const Json after = Json::parse(run("inspect baked.glb --json").out);
    EXPECT_EQ(before["materials"].size(), 2u);
    EXPECT_EQ(before["materials"], after["materials"]);
    EXPECT_EQ(before["images"].size(), 2u);
    EXPECT_EQ(before["images"], after["images"]);
    const Glb source(file("cube.glb")), baked(file("baked.glb"));
    for (size_t i = 0; i < 2; ++i) {
        const Json &from = source.root["images"][i], &to = baked.root["images"][i];
        EXPECT_EQ(to["mimeType"], "image/png");
        EXPECT_EQ(source.viewBytes(from["bufferView"]), baked.viewBytes(to["bufferView"])) << "the same bytes";
    }
    EXPECT_EQ(baked.root["extensionsUsed"],
              Json({"KHR_materials_emissive_strength", "KHR_materials_unlit", "KHR_texture_transform"}));
}

TEST_F(BakeFiles, PartsKeepTheirNamesAndSchemes) {
    ASSERT_NO_FATAL_FAILURE(writePaintedCubes("cubes.glb"));
    const std::string surface = "cubes.glb --rate 2 --part-scheme right=polygons";
    ASSERT_NO_FATAL_FAILURE(bake(surface + " -o mixed.glb"));
    ASSERT_NO_FATAL_FAILURE(bake(surface + " -o mixed.obj"));
    ASSERT_NO_FATAL_FAILURE(bake(surface + " -o mixed.ply"));
    const Glb glb(file("mixed.glb"));
    const Obj obj = readObj(file("mixed.obj"));
    expectGlbIsObj(glb, obj);
    expectPlyIsObj(readPly(file("mixed.ply")), obj);
    EXPECT_EQ(readPly(file("mixed.ply")).comments,
              (std::vector<std::string>{"supple bake", "part 0 left: faces 0 to 23", "part 1 right: faces 24 to 35"}));
    ASSERT_EQ(glb.root["nodes"].size(), 2u);
    EXPECT_EQ(glb.root["scenes"][0]["nodes"], Json({0, 1}));
    for (size_t part = 0; part < 2; ++part) {
        const char* name = part == 0 ? "left" : "right";
        EXPECT_EQ(glb.root["nodes"][part], Json({{"name", name}, {"mesh", part}}));
        EXPECT_EQ(glb.root["meshes"][part]["name"], name);
        EXPECT_EQ(glb.root["meshes"][part]["primitives"].size(), 3u);
    }
    const Json parts = Json::parse(run("inspect mixed.glb --json").out)["parts"];
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0]["name"], "left");
    EXPECT_EQ(parts[1]["name"], "right");
}

TEST_F(BakeFiles, TheCageToo) {
    for (const std::string& pose : {std::string(), std::string(" --clip walk --time 0.4")}) {
        SCOPED_TRACE(pose);
        std::string cage = kSamplePip + " --scheme cage";
        cage += pose;
        ASSERT_NO_FATAL_FAILURE(bake(cage + " -o cage.obj"));
        ASSERT_NO_FATAL_FAILURE(bake(cage + " -o cage.ply"));
        ASSERT_NO_FATAL_FAILURE(bake(cage + " -o cage.glb"));
        EXPECT_EQ(said_, "");
        const Obj obj = readObj(file("cage.obj"));
        const Ply ply = readPly(file("cage.ply"));
        ASSERT_EQ(ply.faces.size(), obj.faces.size());
        size_t triangles = 0;
        std::set<Point> points;
        for (size_t f = 0; f < obj.faces.size(); ++f) {
            ASSERT_EQ(ply.faces[f].size(), obj.faces[f].size()) << "pentagons stay pentagons";
            triangles += obj.faces[f].size() - 2;
            for (size_t k = 0; k < obj.faces[f].size(); ++k) {
                ASSERT_EQ(ply.positions[ply.faces[f][k]], obj.v[obj.faces[f][k]]);
                ASSERT_NEAR(glm::length(ply.normals[ply.faces[f][k]]), 1.0f, 1e-6f);
                points.insert(pointOf(obj.v[obj.faces[f][k]]));
            }
        }
        const Glb glb(file("cage.glb"));
        const Json& primitive = glb.root["meshes"][0]["primitives"][0];
        EXPECT_EQ(glb.indices(primitive).size(), 3 * triangles);
        EXPECT_FALSE(primitive["attributes"].contains("TANGENT"));
        for (const glm::vec3& position : glb.values<glm::vec3>(primitive["attributes"]["POSITION"])) {
            ASSERT_EQ(points.count(pointOf(position)), 1u);
        }
    }
}

/// A quad that is a line has no normal, and one that is a point no faces.
TEST_F(BakeFiles, SurfacesWithoutAreaAreNamedOrMended) {
    const std::string face = "f 1 2 3 4\n";
    writeText(file("line.obj"), "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\n" + face);
    writeText(file("point.obj"), "v 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\n" + face);
    for (const std::string scheme : {"catmull-clark", "polygons"}) {
        SCOPED_TRACE(scheme);
        ASSERT_NO_FATAL_FAILURE(bake("line.obj -o line.glb --rate 4 --scheme " + scheme));
        const Glb glb(file("line.glb"));
        for (const glm::vec3& normal :
             glb.values<glm::vec3>(glb.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"])) {
            EXPECT_NEAR(glm::length(normal), 1.0f, 1e-6f);
        }
        expectFailure(run("bake point.obj -o point.glb --rate 4 --scheme " + scheme), 1, "there are no faces to write");
        expectFailure(run("bake point.obj -o point.ply --rate 4 --scheme " + scheme), 1, "there are no faces to write");
        EXPECT_FALSE(fs::exists(file("point.glb")));
    }
}

TEST_F(BakeFiles, BadUsageIsTwo) {
    writeText(file("cube.obj"), kCubeObj);
    for (const char* name : {"out.stl", "out.gltf", "out", "glb"}) {
        expectFailure(run("bake cube.obj -o " + std::string(name)), 2, "does not end in .obj, .ply or .glb");
    }
    expectFailure(run("bake cube.obj -o ./cube.obj"), 2, "is the input itself");
    EXPECT_EQ(readText(file("cube.obj")), kCubeObj);
    expectFailure(runOnDevice("bake cube.obj -o nowhere/out.glb"), 1, "nowhere/out.glb");
    expectFailure(runOnDevice("bake cube.obj -o nowhere/out.ply"), 1, "nowhere/out.ply");
}

/// Mean difference of a channel, 0..255.
double meanDifference(const host::Picture& a, const host::Picture& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        sum += std::abs(static_cast<int>(a.rgba[i]) - static_cast<int>(b.rgba[i]));
    }
    return sum / static_cast<double>(a.rgba.size());
}

TEST_F(BakeFiles, ABakedGlbIsTheSamePicture) {
    const std::array<std::pair<std::string, std::string>, 2> characters{
        {{kSamplePip, " --clip walk --time 0.4"}, {kSampleHelmet, " --clip salute --time 1"}}};
    for (const auto& [path, pose] : characters) {
        SCOPED_TRACE(path);
        const auto draw = [&](const std::string& from) {
            const Outcome outcome = runOnDevice("render " + from + " -o picture.png --size 120x120");
            EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
            const Result<host::Picture> picture = host::readPng(file("picture.png").string());
            EXPECT_TRUE(picture.ok());
            return picture.ok() ? *picture : host::Picture::blank(120, 120);
        };
        ASSERT_NO_FATAL_FAILURE(bake(path + pose + " --rate 8 -o baked.glb"));
        const host::Picture source = draw(path + pose + " --rate 8");
        EXPECT_LT(meanDifference(source, draw("baked.glb --scheme polygons")), 0.4);
        EXPECT_GT(meanDifference(source, draw(path + " --rate 8")), 1.0) << "another pose";
    }
}

TEST_F(BakeFiles, KhronosValidatorFindsNothing) {
    const char* validator = std::getenv("SUPPLE_GLTF_VALIDATOR");
    if (validator == nullptr || *validator == '\0' || runProgram("node --version").exitCode != 0) {
        GTEST_SKIP() << "SUPPLE_GLTF_VALIDATOR does not name the npm package gltf-validator, or there is no node";
    }
    ASSERT_NO_FATAL_FAILURE(writePaintedCubes("cubes.glb"));
    std::vector<std::string> inputs = sharedAssets(
        {"characters/trex_ngons.glb", "characters/rook_creased.glb", "characters/mh_female1605_morph.glb",
         "khronos/CesiumMan.glb", "khronos/Fox.glb", "meshes/axe_1handed_creased.obj", "whole/kaykit_Knight.glb",
         "whole/RobotExpressive.glb", "whole/studio_goblin.glb", "whole/triceratops.glb"});
    inputs.insert(inputs.end(), {kSamplePip, kSampleHelmet});
    std::string outputs;
    size_t count = 0;
    const auto add = [&](const std::string& input, const std::string& scheme) {
        const std::string output = std::to_string(count++) + ".glb";
        ASSERT_NO_FATAL_FAILURE(bake("'" + input + "' --rate 2 -o " + output + " --scheme " + scheme)) << input;
        outputs += " " + output;
    };
    for (const std::string& input : inputs) {
        for (const char* scheme : {"auto", "catmull-clark", "polygons", "cage"}) {
            add(input, scheme);
        }
    }
    add("cubes.glb", "auto"); // has a normal map, of which the validator warns without tangents
    const Outcome outcome =
        runProgram("node " SUPPLE_TEST_SCRIPTS "/validate_gltf.mjs '" + std::string(validator) + "'" + outputs);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    size_t clean = 0;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) {
        clean += line.ends_with(": 0 errors, 0 warnings") ? 1 : 0;
    }
    EXPECT_EQ(clean, count) << outcome.out;
    std::printf("%zu files\n", count);
}

TEST(WordHashes, AreThoseOfTheSpecification) {
    const auto hashOf = [](std::vector<uint32_t> words) {
        tools::WordHash hash;
        hash.add(std::as_bytes(std::span(words)));
        return hash.value();
    };
    EXPECT_EQ(hashOf({}), 0u);
    EXPECT_EQ(hashOf({0}), 0x3c237f2000000000u);
    EXPECT_EQ(hashOf({1, 2, 3, 0x3F800000, 0xFFFFFFFF}), 0x4e6e43e68e0e5c17u);
    std::vector<uint32_t> many(1000);
    for (uint32_t i = 0; i < many.size(); ++i) {
        many[i] = i * 2654435761u;
    }
    EXPECT_EQ(hashOf(many), 0x14224931f5cbee20u);
    std::swap(many[3], many[7]);
    EXPECT_NE(hashOf(many), 0x14224931f5cbee20u) << "the place counts";
}

/// The lines of `bake --hash` by their first words.
std::map<std::string, std::string> hashesIn(const std::string& text) {
    std::map<std::string, std::string> hashes;
    std::istringstream lines(text);
    for (std::string name, hash; lines >> name >> hash;) {
        hashes[name] = hash;
    }
    return hashes;
}

TEST_F(BakeFiles, HashesTellWhatDiffers) {
    const auto hashes = [&](const std::string& arguments) {
        const Outcome outcome = runOnDevice("bake " + kSamplePip + " --hash " + arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return hashesIn(outcome.out);
    };
    const std::string pose = "--scheme pm --rate 2 --clip walk --time 0.4";
    const std::map<std::string, std::string> walks = hashes(pose);
    ASSERT_EQ(walks.size(), 3u);
    for (const auto& [name, hash] : walks) {
        EXPECT_EQ(hash.size(), 16u) << name;
    }
    std::map<std::string, std::string> wide = hashes(pose + " --mapping wide");
    EXPECT_EQ(wide.at("palette"), walks.at("palette"));
    EXPECT_EQ(wide.at("cage"), walks.at("cage"));
    const std::map<std::string, std::string> later = hashes("--scheme pm --rate 2 --clip walk --time 0.5");
    for (const char* name : {"palette", "cage", "surface"}) {
        EXPECT_NE(later.at(name), walks.at(name)) << name;
    }
    const std::map<std::string, std::string> finer = hashes("--scheme pm --rate 4 --clip walk --time 0.4");
    EXPECT_EQ(finer.at("cage"), walks.at("cage"));
    EXPECT_NE(finer.at("surface"), walks.at("surface"));

    // The cage that is written beside it has the words of the hash.
    const std::map<std::string, std::string> cage =
        hashes("--scheme cage --clip walk --time 0.4 -o " + file("cage.obj").string());
    EXPECT_EQ(cage.size(), 2u);
    EXPECT_EQ(cage.at("cage"), walks.at("cage"));
    tools::WordHash written;
    for (const glm::vec3& position : readObj(file("cage.obj")).v) {
        const glm::vec4 vertex(position, 1.0f);
        written.add(std::as_bytes(std::span(&vertex[0], 4)));
    }
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(written.value()));
    EXPECT_EQ(cage.at("cage"), text);
    EXPECT_EQ(runOnDevice("bake " + kSamplePip).exitCode, 2) << "neither a file nor hashes";
}

TEST_F(BakeFiles, TransitionsGoFromOneClipToTheOther) {
    const std::string bake = "bake " + kSamplePip + " --scheme cage ";
    const auto palette = [&](const std::string& arguments) {
        const Outcome outcome = runOnDevice(bake + "--hash --transition 'walk@0.4->idle' " + arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return hashesIn(outcome.out)["palette"];
    };
    const std::string kinds[] = {"", " --transition-kind quintic", " --transition-kind crossfade"};
    std::set<std::string> before, within, behind;
    for (const std::string& kind : kinds) {
        before.insert(palette("--time 0.2" + kind));
        within.insert(palette("--time 0.5" + kind));
        behind.insert(palette("--time 0.8" + kind));
    }
    EXPECT_EQ(before.size(), 1u);
    EXPECT_EQ(within.size(), 3u);
    EXPECT_EQ(behind.size(), 1u);
    EXPECT_EQ(palette("--time 0.5 --mapping wide"), palette("--time 0.5"));
    EXPECT_NE(palette("--time 0.5 --transition-seconds 0.2"), palette("--time 0.5"));
    for (const char* wrong : {"walk", "walk->idle", "walk@->idle", "walk@0.4->", "@0.4->idle", "walk@-1->idle",
                              "walk@0.4x->idle", "walk@nan->idle"}) {
        const Outcome outcome = runOnDevice(bake + "--hash --time 0.5 --transition '" + wrong + "'");
        EXPECT_EQ(outcome.exitCode, 2) << wrong;
        EXPECT_NE(outcome.err.find("is not CLIP@SECONDS->CLIP"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(runOnDevice(bake + "--hash --time 0.5 --transition 'walk@0.4->fly'").exitCode, 1) << "no such clip";
    EXPECT_EQ(runOnDevice(bake + "--hash --transition 'walk@0.4->idle'").exitCode, 2) << "at no time";
    EXPECT_EQ(runOnDevice(bake + "--hash --time 0.5 --rest-pose --transition 'walk@0.4->idle'").exitCode, 2);
}

TEST_F(BakeFiles, UpdateIntervalsGoStraightBetweenPoses) {
    const std::string bake = "bake " + kSamplePip + " --scheme cage --hash --clip walk ";
    const auto palette = [&](const std::string& arguments) {
        const Outcome outcome = runOnDevice(bake + arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return hashesIn(outcome.out)["palette"];
    };
    // Every eighth step is a multiple of 2/15 s for the first instance.
    EXPECT_NE(palette("--time 0.45 --update-interval 8"), palette("--time 0.45 --update-interval 1"));
    EXPECT_NE(palette("--time 0.45 --update-interval 8"), palette("--time 0.45 --update-interval 4"));
    EXPECT_EQ(palette("--time 0.45 --update-interval 8 --mapping wide"), palette("--time 0.45 --update-interval 8"));
    EXPECT_EQ(palette("--time 0.45 --update-interval 1"), palette("--time 0.45 --set head=0,0,0,1 --weight 0"));
    EXPECT_EQ(runOnDevice(bake + "--time 0.45 --update-interval 3").exitCode, 2);
    EXPECT_EQ(runOnDevice("bake " + kSamplePip + " --hash --update-interval 4").exitCode, 2) << "no clip";

    const Outcome inspected = run("inspect " + kSamplePip + " --json");
    ASSERT_EQ(inspected.exitCode, 0) << inspected.err;
    for (const nlohmann::json& clip : nlohmann::json::parse(inspected.out)["clips"]) {
        const nlohmann::json& errors = clip["updateErrors"];
        EXPECT_TRUE(errors["closes"].get<bool>());
        EXPECT_GT(errors["every2"].get<double>(), 0.0);
        EXPECT_GT(errors["every4"].get<double>(), errors["every2"].get<double>());
        EXPECT_GT(errors["every8"].get<double>(), errors["every4"].get<double>());
        EXPECT_LT(errors["every8"].get<double>(), 0.5);
    }
}

TEST_F(BakeFiles, SpringsSwingForSomeSeconds) {
    const std::vector<std::byte> wren = supple::test::withExtensions(supple::test::kWren, supple::test::kWrenSprings);
    writeText(file("wren.glb"), std::string(reinterpret_cast<const char*>(wren.data()), wren.size()));
    const auto palette = [&](const std::string& arguments) {
        const Outcome outcome = runOnDevice("bake wren.glb --scheme cage --hash --clip run --time 0.4 " + arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return hashesIn(outcome.out)["palette"];
    };
    const auto swung = palette("--simulate 2");
    EXPECT_NE(swung, palette(""));
    EXPECT_NE(swung, palette("--simulate 0.1"));
    EXPECT_EQ(swung, palette("--simulate 2 --mapping wide"));
    EXPECT_EQ(runOnDevice("bake wren.glb --hash --simulate 2 --update-interval 4 --clip run --time 0.4").exitCode, 2);
}

TEST_F(BakeFiles, ModifiersChangeThePose) {
    const std::string bake = "bake " + kSamplePip + " --scheme cage --hash --clip walk --time 0.4 ";
    const auto palette = [&](const std::string& arguments) {
        const Outcome outcome = runOnDevice(bake + arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return hashesIn(outcome.out)["palette"];
    };
    const std::string set = "--set chest=0,0.6,0,0.8";
    const std::set<std::string> all = {palette(set),
                                       palette("--aim head=0.5,1,2"),
                                       palette("--two-bone hand.L=0.3,0.8,0.4"),
                                       palette(set + " --weight 0.5"),
                                       palette(set + " --weight 0"),
                                       palette("--plant foot.L=0,0,0,0.1,1,0"),
                                       palette("--plant foot.L=0,-0.1,0,0,1,0"),
                                       palette("--plant foot.L=0,-0.1,0,0,1,0 --lower hips=0"),
                                       palette("--plant foot.L=0,-0.1,0,0,1,0 --lower hips=0.02"),
                                       palette(set + " --aim head=0.5,1,2")};
    EXPECT_EQ(all.size(), 10u) << "each does something of its own";
    EXPECT_EQ(palette(set + " --weight 0"), palette("--aim head=0.5,1,2 --weight 0")) << "nothing is done";
    EXPECT_EQ(palette("--aim head=0.5,1,2 " + set), palette(set + " --aim head=0.5,1,2")) << "in the order of kinds";
    for (const char* wrong :
         {"--set chest=0,0,0,0", "--set chest=1,2,3", "--aim head=1,2", "--two-bone =1,2,3", "--aim head=1,2,nan",
          "--aim head", "--plant foot.L=0,0,0", "--plant foot.L=0,0,0,1,0,0", "--lower hips=-1"}) {
        EXPECT_EQ(runOnDevice(bake + wrong).exitCode, 2) << wrong;
    }
    const Outcome none = runOnDevice(bake + "--aim nose=1,2,3");
    EXPECT_EQ(none.exitCode, 1);
    EXPECT_NE(none.err.find("no joint \"nose\""), std::string::npos) << none.err;
    const Outcome hand = runOnDevice(bake + "--plant hand.L=0,0,0,0,1,0");
    EXPECT_EQ(hand.exitCode, 1);
    EXPECT_NE(hand.err.find("is no foot"), std::string::npos) << hand.err;
}

} // namespace
} // namespace supple::test
