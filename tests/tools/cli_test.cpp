// Runs the built supple command as a user would: exit codes, the one line on stderr, and what it writes.
#include "tests/tools/command_runner.h"
#include "tests/tools/obj_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

using supple::test::Obj;
using supple::test::Outcome;
using supple::test::readObj;
using supple::test::readText;
using supple::test::writeText;

/// A cube of edge 2 as glTF, its six quads as FB_ngon_encoding or as plain triangles, with a clip "Rise" that lifts it
/// by 3 in 2 seconds.
std::string cubeGltf(const std::string& binaryName, bool polygons) {
    Json gltf = Json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "cube", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 4}, "indices": 1}]}],
        "animations": [{"name": "Rise", "extras": {"markers": [{"name": "top", "time": 2}, {"name": "lift", "time": 0.25}]},
                        "samplers": [{"input": 2, "output": 3}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72},
                        {"buffer": 0, "byteOffset": 168, "byteLength": 8}, {"buffer": 0, "byteOffset": 176, "byteLength": 24},
                        {"buffer": 0, "byteOffset": 200, "byteLength": 64}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
            {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [2]},
            {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"},
            {"bufferView": 4, "componentType": 5126, "count": 8, "type": "VEC2"}]})");
    gltf["buffers"] = {{{"uri", binaryName}, {"byteLength", 264}}};
    if (polygons) {
        gltf["extensionsUsed"] = {"FB_ngon_encoding"};
        gltf["meshes"][0]["primitives"][0]["extensions"]["FB_ngon_encoding"] = Json::object();
    }
    return gltf.dump();
}

const std::vector<glm::vec2> kCubeUvs{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}};

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::string cubeBinary() {
    const uint16_t quads[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}};
    std::vector<uint16_t> indices;
    uint16_t anchor = 0xFFFF;
    for (const auto& quad : quads) { // a fan each, and no two in a row with the same anchor
        const int start = quad[0] == anchor ? 1 : 0;
        anchor = quad[start];
        for (int i = start + 1; i < start + 3; ++i) {
            indices.insert(indices.end(), {anchor, quad[i % 4], quad[(i + 1) % 4]});
        }
    }
    std::string bytes;
    append<float>(bytes, {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1});
    append(bytes, indices);
    append<float>(bytes, {0, 2});
    append<float>(bytes, {0, 0, 0, 0, 3, 0});
    append(bytes, kCubeUvs);
    return bytes;
}

class Cli : public supple::test::CommandTest {
protected:
    void SetUp() override {
        CommandTest::SetUp();
        writeText(file("cube.bin"), cubeBinary());
        writeText(file("cube.gltf"), cubeGltf("cube.bin", true));
        writeText(file("triangles.gltf"), cubeGltf("cube.bin", false));
    }
};

TEST_F(Cli, HelpAndVersionSucceed) {
    for (const char* arguments : {"--help", "bake --help", "inspect -h", "profile --help", "--version"}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << arguments;
        EXPECT_NE(outcome.out, "") << arguments;
        EXPECT_EQ(outcome.err, "") << arguments;
    }
}

TEST_F(Cli, BadUsageIsTwo) {
    expectFailure(run(""), 2, "subcommand");
    expectFailure(run("polish cube.gltf"), 2, "supple --help");
    expectFailure(run("inspect"), 2, "FILE");
    expectFailure(run("inspect cube.gltf --colour"), 2, "--colour");
    expectFailure(run("bake cube.gltf"), 2, "--output");
    expectFailure(run("bake cube.gltf -o out.obj --scheme bezier"), 2, "bezier");
    expectFailure(run("bake cube.gltf -o out.obj --rate 0"), 2, "--rate");
    expectFailure(run("bake cube.gltf -o out.obj --rate 65"), 2, "--rate");
    expectFailure(run("bake cube.gltf -o out.obj --rate -3"), 2, "--rate");
    expectFailure(run("bake cube.gltf -o out.obj --time nan"), 2, "--time");
    expectFailure(run("bake cube.gltf -o out.obj --mapping sideways"), 2, "--mapping");
    expectFailure(run("inspect cube.gltf --rate 4"), 2, "--compare");
    expectFailure(run("inspect cube.gltf --mapping wide"), 2, "--memory");
    expectFailure(run("inspect cube.gltf --clip Rise"), 2, "--compare");
    expectFailure(run("inspect cube.gltf --memory --clip Rise"), 2, "--compare");
    expectFailure(run("profile cube.gltf --frames 0"), 2, "--frames");
    expectFailure(run("profile cube.gltf --instances 0"), 2, "--instances");
}

TEST_F(Cli, BadInputIsOneAndNamesTheFile) {
    writeText(file("truncated.gltf"), cubeGltf("cube.bin", true).substr(0, 300));
    writeText(file("truncated.glb"), std::string("glTF\x02\x00\x00\x00\x00\x10\x00\x00", 12));
    writeText(file("empty.glb"), "");
    fs::create_directory(file("folder.glb"));
    for (const std::string name : {"missing.glb", "truncated.gltf", "truncated.glb", "empty.glb", "folder.glb"}) {
        expectFailure(run("inspect " + name), 1, name);
        expectFailure(run("bake " + name + " -o out.obj"), 1, name);
    }
    expectFailure(run("profile missing.glb"), 1, "missing.glb");
    fs::remove(file("cube.bin"));
    expectFailure(run("inspect cube.gltf"), 1, "cube.bin");
}

TEST_F(Cli, TheLimitOfMemoryIsKept) {
    const std::string file = "'" SUPPLE_SAMPLE_ASSETS "/wren.glb'";
    for (const char* command : {"inspect ", "convert -o out.glb ", "bake -o out.ply ", "render -o out.png "}) {
        expectFailure(run(command + file + " --memory-limit 1"), 1, "needs more memory than the 1048576 bytes");
    }
    EXPECT_EQ(run("inspect " + file + " --memory-limit 100").exitCode, 0);
    expectFailure(run("inspect " + file + " --memory-limit 0"), 2, "--memory-limit");
}

TEST_F(Cli, UnknownDeviceIsThree) {
    expectFailure(run("bake cube.gltf -o out.obj --device \"no such device\""), 3, "no such device");
    expectFailure(run("profile cube.gltf --device 99"), 3, "99");
}

TEST_F(Cli, UnwritableOutputIsOne) {
    expectFailure(run("bake cube.gltf -o nowhere/out.obj"), 1, "nowhere/out.obj");
}

TEST_F(Cli, InspectCountsACube) {
    const Outcome outcome = run("inspect cube.gltf --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["polygonSource"], "FB_ngon_encoding");
    EXPECT_EQ(json["vertices"], 8);
    EXPECT_EQ(json["faces"], 6);
    EXPECT_EQ(json["edges"], 12);
    EXPECT_EQ(json["boundaryEdges"], 0);
    EXPECT_EQ(json["sides"], Json({{"4", 6}}));
    EXPECT_EQ(json["valences"]["interior"], Json({{"3", 8}}));
    EXPECT_EQ(json["valences"]["boundary"], Json::object());
    EXPECT_EQ(json["seamVertices"], 0);
    EXPECT_EQ(json["uvSets"], 1);
    EXPECT_EQ(json["joints"], 1);
    ASSERT_EQ(json["clips"].size(), 1u);
    EXPECT_EQ(json["clips"][0]["name"], "Rise");
    EXPECT_DOUBLE_EQ(json["clips"][0]["duration"], 2.0);
    EXPECT_EQ(json["clips"][0]["markers"],
              Json::parse(R"([{"name": "lift", "time": 0.25}, {"name": "top", "time": 2.0}])"));
    EXPECT_EQ(json["schemes"]["prep"]["accepted"], true);

    const Outcome text = run("inspect cube.gltf");
    EXPECT_EQ(text.exitCode, 0);
    EXPECT_NE(text.out.find("Rise"), std::string::npos);
    EXPECT_NE(text.out.find("marker lift  0.250 s"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("accepted"), std::string::npos);
}

/// A texture without a transform as inspect tells it.
Json textureJson(uint32_t image, const char* wrap) {
    return {{"image", image},
            {"alternateImage", nullptr},
            {"uvSet", 0},
            {"wrap", Json::array({wrap, wrap})},
            {"magFilter", "ANY"},
            {"minFilter", "ANY"},
            {"offset", Json::array({0.0, 0.0})},
            {"rotation", 0.0},
            {"scale", Json::array({1.0, 1.0})}};
}

TEST_F(Cli, InspectTellsTrims) {
    const std::string helmet = std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb";
    const Json materials = Json::parse(run("inspect " + helmet + " --json").out)["materials"];
    ASSERT_EQ(materials.size(), 3u);
    EXPECT_FALSE(materials[0].contains("trim"));
    EXPECT_EQ(
        materials[1]["trim"],
        Json({{"domain", "uv"}, {"texture", textureJson(0, "CLAMP_TO_EDGE")}, {"channel", "r"}, {"cutoff", 0.5}}));
    EXPECT_EQ(materials[2]["trim"]["texture"]["image"], 1);
    EXPECT_NE(run("inspect " + helmet)
                  .out.find("visor  base color 0.8 0.55 0.18 1  metallic 0  roughness 0.6  double-sided  trimmed on UV "
                            "set 0, image 1, channel r below 0.5"),
              std::string::npos);

    // All faces share tile 0.
    Json gltf = Json::parse(cubeGltf("cube.bin", true));
    writeText(file("tile.bin"), std::string(8 * sizeof(float), '\0'));
    gltf["buffers"].push_back({{"uri", "tile.bin"}, {"byteLength", 32}});
    gltf["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 32}});
    gltf["accessors"].push_back({{"bufferView", 5}, {"componentType", 5126}, {"count", 8}, {"type", "SCALAR"}});
    writeText(file("strip.png"), "\x89PNG\r\n\x1a\n");
    gltf["images"] = {{{"uri", "strip.png"}}};
    gltf["textures"] = {{{"source", 0}}};
    gltf["materials"] = {{{"name", "lace"}}};
    gltf["materials"][0]["extras"]["trim"] = {
        {"texture", {{"index", 0}}}, {"domain", "face"}, {"tiles", 4}, {"channel", "a"}, {"cutoff", 0.25}};
    Json& primitive = gltf["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["attributes"]["_TRIM_TILE"] = 5;
    writeText(file("lace.gltf"), gltf.dump());
    const Outcome lace = run("inspect lace.gltf --json");
    ASSERT_EQ(lace.exitCode, 0) << lace.err;
    EXPECT_EQ(Json::parse(lace.out)["materials"][0]["trim"], Json({{"domain", "face"},
                                                                   {"texture", textureJson(0, "REPEAT")},
                                                                   {"tiles", 4},
                                                                   {"channel", "a"},
                                                                   {"cutoff", 0.25}}));
    EXPECT_NE(run("inspect lace.gltf")
                  .out.find("lace  base color 1 1 1 1  metallic 1  roughness 1  trimmed on faces' tiles, 4 in image 0, "
                            "channel a below 0.25"),
              std::string::npos);
}

TEST_F(Cli, InspectSaysWhyASchemeRefuses) {
    const Json triangles = Json::parse(run("inspect triangles.gltf --keep-triangles --json").out);
    EXPECT_EQ(triangles["faces"], 12);
    EXPECT_EQ(triangles["schemes"]["prep"]["accepted"], false);
    EXPECT_NE(triangles["schemes"]["prep"]["reason"].get<std::string>().find("face 0 with 3 sides"), std::string::npos);
    const Json paired = Json::parse(run("inspect triangles.gltf --pair-quads --json").out);
    EXPECT_EQ(paired["sides"], Json({{"4", 6}}));
    EXPECT_EQ(paired["schemes"]["prep"]["accepted"], true);
    EXPECT_EQ(triangles["schemes"]["pm"]["accepted"], true);
    EXPECT_EQ(triangles["schemes"]["pm"]["patches"], Json({{"p3", 12}}));
    expectFailure(run("bake triangles.gltf --keep-triangles -o out.obj --scheme prep"), 1, "3 sides");
}

TEST_F(Cli, InspectCountsLoopsPatchesWithSemiSharpCreases) {
    const std::string pip = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
    const Json loop = Json::parse(run("inspect " + pip + " --json").out)["schemes"]["loop"];
    EXPECT_EQ(loop["accepted"], true);
    EXPECT_EQ(loop["patches"].size(), 3u) << loop;
    EXPECT_GT(loop["patches"]["loop-irregular-sharp"], 0) << loop;
    EXPECT_EQ(run("inspect " + pip).out.find("semi-sharp"), std::string::npos);
}

TEST_F(Cli, DamageIsRepairedOrRefusedByName) {
    writeText(file("fin.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\nf 2 1 3\n");
    const std::string twice = "file: 1 face is there twice: face 3 is face 0 again";
    const std::string edge = "file: 1 edge has three or more faces: edge (0, 1) of faces 0, 1, 2";
    const Json json = Json::parse(run("inspect fin.obj --json").out);
    EXPECT_EQ(json["warnings"], Json::array({twice + "; left out", edge + "; cut into sheets, 2 vertices repeated"}));
    for (const char* scheme : {"catmull-clark", "pm", "fragments", "loop", "blend"}) {
        EXPECT_EQ(json["schemes"][scheme]["accepted"], true) << scheme;
    }
    const std::string bothLines = "supple: fin.obj: " + twice + "\nsupple: fin.obj: " + edge + "\n";
    for (const char* command : {"inspect", "convert -o out.glb", "bake -o out.obj", "render -o out.png"}) {
        const std::string line = std::string(command) + " --strict fin.obj";
        const bool onDevice = line.starts_with("bake") || line.starts_with("render");
        const Outcome strict = onDevice ? runOnDevice(line) : run(line);
        EXPECT_EQ(strict.exitCode, 1) << command;
        EXPECT_EQ(strict.err, bothLines) << command;
    }
    EXPECT_EQ(run("inspect cube.gltf --strict").exitCode, 0);
}

/// Two flat fans of ten triangles back to back, every other triangle above cut into three round its middle.
std::string flatFans() {
    constexpr int kSpokes = 10;
    std::ostringstream obj, faces;
    const auto add = [&](glm::dvec2 p, double z) { obj << "v " << p.x << " " << p.y << " " << z << "\n"; };
    const auto rim = [](int i) {
        const double angle = 2.0 * std::numbers::pi * i / kSpokes;
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    add({0, 0}, 0.1);
    add({0, 0}, -0.1);
    for (int i = 0; i < kSpokes; ++i) {
        add(rim(i), 0.0);
    }
    int middle = 2 + kSpokes; // vertices count from 1
    for (int i = 0; i < kSpokes; ++i) {
        const int a = 3 + i, b = 3 + (i + 1) % kSpokes;
        faces << "f 2 " << b << " " << a << "\n";
        if (i % 2 == 1) {
            faces << "f 1 " << a << " " << b << "\n";
            continue;
        }
        add((rim(i) + rim(i + 1)) / 3.0, 0.1 / 3.0);
        ++middle;
        faces << "f 1 " << a << " " << middle << "\nf 1 " << middle << " " << b << "\nf " << a << " " << b << " "
              << middle << "\n";
    }
    return obj.str() + faces.str();
}

TEST_F(Cli, InspectReportsFolds) {
    writeText(file("fans.obj"), flatFans());
    const Json json = Json::parse(run("inspect fans.obj --json").out);
    ASSERT_EQ(json["faces"], 30);
    const Json& folds = json["schemes"]["pm"]["folds"];
    ASSERT_TRUE(folds.is_object()) << json.dump();
    EXPECT_GE(folds["faces"], 1);
    EXPECT_GT(folds["flippedShare"], 0.01);
    EXPECT_LT(folds["flippedShare"], 0.1);
    ASSERT_EQ(folds["worst"].size(), std::min<size_t>(5, folds["faces"]));
    double last = 1.0;
    for (const Json& face : folds["worst"]) {
        EXPECT_LT(face["face"], 30);
        EXPECT_GT(face["flippedShare"], 0.0);
        EXPECT_LE(face["flippedShare"], last);
        last = face["flippedShare"];
    }
    const std::string text = run("inspect fans.obj").out;
    EXPECT_NE(text.find("folds"), std::string::npos) << text;
    EXPECT_NE(text.find("face " + folds["worst"][0]["face"].dump() + " ("), std::string::npos) << text;

    EXPECT_FALSE(Json::parse(run("inspect cube.gltf --json").out)["schemes"]["pm"].contains("folds"));
    EXPECT_EQ(run("inspect cube.gltf").out.find("folds"), std::string::npos);
}

TEST_F(Cli, BakeWritesOneGroupAPatch) {
    const Outcome outcome = runOnDevice("bake cube.gltf -o out.obj");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Obj obj = readObj(file("out.obj"));
    ASSERT_EQ(obj.groups.size(), 6u);
    ASSERT_EQ(obj.v.size(), 6u * 81u);
    ASSERT_EQ(obj.vn.size(), obj.v.size());
    ASSERT_EQ(obj.vt.size(), obj.v.size());
    ASSERT_EQ(obj.faces.size(), 6u * 64u);
    for (size_t g = 0; g < obj.groups.size(); ++g) {
        EXPECT_EQ(obj.groups[g], "patch_" + std::to_string(g));
        EXPECT_EQ(obj.groupVertices[g], g * 81) << "v and vn of a patch stand inside its group";
        EXPECT_EQ(obj.groupFaces[g], g * 64);
    }
    for (size_t f = 0; f < obj.faces.size(); ++f) {
        const auto& face = obj.faces[f];
        ASSERT_EQ(face.size(), 4u);
        for (const uint32_t vertex : face) {
            EXPECT_EQ(vertex / 81, f / 64) << "a face uses the samples of its own patch";
        }
        const glm::vec3 normal = glm::cross(obj.v[face[1]] - obj.v[face[0]], obj.v[face[3]] - obj.v[face[0]]);
        EXPECT_GT(glm::dot(normal, obj.v[face[0]]), 0.0f) << "face " << f << " is wound inwards";
    }
    for (size_t i = 0; i < obj.v.size(); ++i) {
        EXPECT_NEAR(glm::length(obj.vn[i]), 1.0f, 1e-5f);
        EXPECT_GT(glm::dot(obj.vn[i], obj.v[i]), 0.0f);
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(std::abs(obj.v[0][axis]), 0.5f, 1e-6f) << "the limit point of a cube's corner";
    }
}

TEST_F(Cli, BakePosesByClipNameAndIndex) {
    ASSERT_EQ(runOnDevice("bake cube.gltf -o rest.obj --rate 3").exitCode, 0);
    ASSERT_EQ(runOnDevice("bake cube.gltf -o name.obj --rate 3 --clip Rise --time 1").exitCode, 0);
    ASSERT_EQ(runOnDevice("bake cube.gltf -o index.obj --rate 3 --clip 0 --time 99").exitCode, 0);
    const Obj rest = readObj(file("rest.obj"));
    const Obj half = readObj(file("name.obj"));
    const Obj end = readObj(file("index.obj"));
    ASSERT_EQ(rest.v.size(), 6u * 16u);
    ASSERT_EQ(half.v.size(), rest.v.size());
    ASSERT_EQ(end.v.size(), rest.v.size());
    for (size_t i = 0; i < rest.v.size(); ++i) {
        EXPECT_NEAR(half.v[i].y, rest.v[i].y + 1.5f, 1e-5f);
        EXPECT_NEAR(end.v[i].y, rest.v[i].y + 3.0f, 1e-5f) << "times are clamped to the clip";
        EXPECT_NEAR(half.v[i].x, rest.v[i].x, 1e-5f);
    }
    expectFailure(run("bake cube.gltf -o out.obj --clip Fall"), 1, "Rise");
    expectFailure(run("bake cube.gltf -o out.obj --clip 1"), 1, "cube.gltf");
}

TEST_F(Cli, BakeCageKeepsThePolygons) {
    const Outcome outcome = runOnDevice("bake cube.gltf -o cage.obj --scheme cage --clip Rise --time 2");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Obj obj = readObj(file("cage.obj"));
    ASSERT_EQ(obj.v.size(), 8u);
    ASSERT_EQ(obj.faces.size(), 6u);
    EXPECT_TRUE(obj.groups.empty());
    EXPECT_EQ(obj.v[0], glm::vec3(-1, 2, -1));
    EXPECT_EQ(obj.v[6], glm::vec3(1, 4, 1));
    for (const auto& face : obj.faces) {
        EXPECT_EQ(face.size(), 4u);
    }
}

TEST_F(Cli, BakePatchesMatchTheSurface) {
    const Outcome outcome = runOnDevice("bake cube.gltf -o out.obj --scheme prep --rate 5 --patches patches.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Obj obj = readObj(file("out.obj"));
    const Json json = Json::parse(readText(file("patches.json")));
    EXPECT_EQ(json["scheme"], "prep");
    EXPECT_EQ(json["rate"], 5);
    ASSERT_EQ(json["patches"].size(), 6u);
    std::vector<int> faces;
    for (size_t p = 0; p < 6; ++p) {
        const Json& patch = json["patches"][p];
        faces.push_back(patch["face"]);
        EXPECT_EQ(patch["class"], "perturbed");
        ASSERT_EQ(patch["corners"].size(), 4u);
        ASSERT_EQ(patch["coefficients"].size(), 32u);
        // Corner coefficients are corner samples, to the bit: g(0,0), g(3,0), g(0,3), g(3,3).
        struct Corner {
            size_t coefficient, sample, index;
        };
        for (const Corner corner : {Corner{0, 0, 0}, {3, 5, 1}, {12, 30, 3}, {15, 35, 2}}) {
            const Json& coefficient = patch["coefficients"][corner.coefficient];
            const size_t sample = p * 36 + corner.sample;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_EQ(coefficient[static_cast<size_t>(axis)].get<float>(), obj.v[sample][axis]);
            }
            const auto vertex = patch["corners"][corner.index].get<size_t>();
            const glm::vec2 upwards(kCubeUvs[vertex].x, 1.0f - kCubeUvs[vertex].y);
            EXPECT_EQ(obj.vt[sample], upwards) << "cage vertices keep the file's order here";
        }
    }
    std::sort(faces.begin(), faces.end());
    EXPECT_EQ(faces, (std::vector<int>{0, 1, 2, 3, 4, 5}));
}

TEST_F(Cli, BakeOfSubdivisionHasAGroupAPatch) {
    const Outcome outcome = runOnDevice("bake cube.gltf -o out.obj --scheme fragments --rate 3");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("rate 3"), std::string::npos) << "that it was rounded up: " << outcome.err;
    EXPECT_EQ(readText(file("out.obj"))
                  .rfind("# supple bake: scheme fragments, rate 2 (3 asked for along an edge of "
                         "the cage), 24 patches\n",
                         0),
              0u);
    const Obj quads = readObj(file("out.obj"));
    EXPECT_EQ(quads.groups.size(), 24u);
    ASSERT_EQ(quads.v.size(), 24u * 9u);
    EXPECT_EQ(quads.vn.size(), quads.v.size());
    EXPECT_EQ(quads.vt.size(), quads.v.size());
    EXPECT_EQ(quads.faces.size(), 24u * 4u);

    ASSERT_EQ(runOnDevice("bake cube.gltf -o loop.obj --scheme loop --rate 4").exitCode, 0);
    const Obj triangles = readObj(file("loop.obj"));
    EXPECT_EQ(triangles.groups.size(), 12u);
    EXPECT_EQ(triangles.v.size(), 12u * 15u);
    ASSERT_EQ(triangles.faces.size(), 12u * 16u);
    for (const Obj* obj : {&quads, &triangles}) {
        for (const auto& face : obj->faces) {
            ASSERT_EQ(face.size(), obj == &quads ? 4u : 3u);
            const glm::vec3 normal = glm::cross(obj->v[face[1]] - obj->v[face[0]], obj->v[face[2]] - obj->v[face[0]]);
            EXPECT_GT(glm::dot(normal, obj->v[face[0]]), 0.0f);
        }
    }
}

TEST_F(Cli, BakeWritesPatchesOfSchemesThatHaveCoefficients) {
    const std::vector<std::pair<std::string, bool>> schemes{
        {"pm", true},         {"prep", true},           {"loop", false},     {"blend", false},
        {"fragments", false}, {"catmull-clark", false}, {"polygons", false}, {"cage", false}};
    // A cube has known polygons.
    expectFailure(run("bake cube.gltf -o out.obj --patches p.json"), 2,
                  "--patches: part 0 has scheme catmull-clark, which has no patch coefficients; pm, prep have");
    const std::string help = run("bake --help").out;
    const size_t list = help.find('{', help.find("--scheme"));
    ASSERT_NE(list, std::string::npos) << help;
    std::set<std::string> named, known{"auto"};
    std::istringstream names(help.substr(list + 1, help.find('}', list) - list - 1));
    for (std::string name; std::getline(names, name, ',');) {
        named.insert(name);
    }
    for (const auto& [scheme, coefficients] : schemes) {
        known.insert(scheme);
        const std::string command = "bake cube.gltf -o out.obj --rate 2 --patches p.json --scheme " + scheme;
        if (!coefficients) {
            expectFailure(run(command), 2, "--patches: " + scheme + " has no patch coefficients");
            EXPECT_FALSE(fs::exists(file("out.obj"))) << scheme;
            continue;
        }
        const Outcome outcome = runOnDevice(command);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const Json patches = Json::parse(readText(file("p.json")))["patches"];
        ASSERT_EQ(patches.size(), 6u) << scheme;
        for (const Json& patch : patches) {
            EXPECT_GT(patch["coefficients"].size(), 0u) << scheme;
        }
        fs::remove(file("out.obj"));
    }
    EXPECT_EQ(named, known) << "every scheme that --scheme takes";
}

TEST_F(Cli, InspectKnowsSubdivision) {
    const Json schemes = Json::parse(run("inspect cube.gltf --json").out)["schemes"];
    EXPECT_EQ(schemes["fragments"]["patches"], Json({{"fragment", 24}}));
    EXPECT_EQ(schemes["fragments"]["notes"], Json::array());
    EXPECT_EQ(schemes["loop"]["patches"], Json({{"loop-irregular", 12}}));
    EXPECT_EQ(schemes["loop"]["notes"],
              Json::array({"6 faces have more than 3 sides, the first is face 0; split into triangles"}));
    EXPECT_NE(run("inspect cube.gltf").out.find("accepted: 24 fragment"), std::string::npos);
}

TEST_F(Cli, ProfileOfAllSchemes) {
    const Outcome outcome = runOnDevice("profile cube.gltf --scheme all --rate 6 --frames 2 --json p.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("rate 6 (4 a patch)"), std::string::npos) << outcome.out;
    const Json runs = Json::parse(readText(file("p.json")))["runs"];
    ASSERT_EQ(runs.size(), 7u);
    for (const Json& run : runs) {
        if (run["scheme"] == "polygons") { // has no rate
            continue;
        }
        const bool subdivided = run["scheme"] == "fragments";
        EXPECT_EQ(run["rate"], 6);
        EXPECT_EQ(run["patchRate"], subdivided ? 4 : 6) << run["scheme"];
    }
}

/// Width and height of a PNG.
std::pair<uint32_t, uint32_t> pngSize(const fs::path& path) {
    const std::string bytes = readText(path);
    const auto word = [&](size_t at) {
        uint32_t value = 0;
        for (size_t i = at; i < at + 4 && i < bytes.size(); ++i) {
            value = value << 8 | static_cast<uint8_t>(bytes[i]);
        }
        return value;
    };
    return {word(16), word(20)};
}

TEST_F(Cli, RenderOfAllSchemesIsOneSheet) {
    const Outcome all = runOnDevice("render cube.gltf -o all.png --scheme all --size 80x60 --rate 4");
    ASSERT_EQ(all.exitCode, 0) << all.err;
    const auto four = pngSize(file("all.png"));
    const Outcome some = runOnDevice(
        "render triangles.gltf --keep-triangles -o some.png --scheme all --size 80x60 --zoom 3 --at 0.4,0.6");
    ASSERT_EQ(some.exitCode, 0) << some.err;
    EXPECT_NE(some.err.find("3 sides"), std::string::npos) << "what is missing and why: " << some.err;
    const auto three = pngSize(file("some.png"));
    EXPECT_GT(four.first * four.second, 4u * 80u * 60u);
    EXPECT_GT(three.first * three.second, 3u * 80u * 60u);
    writeText(file("ridge.obj"), "v -1 0 0\nv 0 0 0\nv 1 0 0\nv -1 1 0\nv 0 1 1\nv 1 1 0\nv -1 2 0\nv 0 2 0\nv 1 2 0\n"
                                 "f 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\nf 5 6 9 8\n"
                                 "t crease 2/1/0 1 4 3.0\nt crease 2/1/0 4 7 3.0\n");
    std::vector<std::string> pictures;
    for (const char* flags : {"", "--creases curve", "--sharp 4"}) {
        const Outcome ridge =
            runOnDevice(std::string("render ridge.obj -o ridge.png --scheme blend --size 80x60 --rate 4 ") + flags);
        ASSERT_EQ(ridge.exitCode, 0) << ridge.err;
        pictures.push_back(readText(file("ridge.png")));
    }
    EXPECT_NE(pictures[0], pictures[1]);
    EXPECT_NE(pictures[0], pictures[2]);
    expectFailure(run("render cube.gltf -o x.png --at 0.5"), 2, "--at");
    expectFailure(run("render cube.gltf -o x.png --at 2,0"), 2, "--at");
    expectFailure(run("render cube.gltf -o x.png --zoom 0"), 2, "--zoom");
    expectFailure(run("sheet cube.gltf -o x.png --scheme all"), 2, "--scheme");
}

/// Three cubes, a part each: "near", "far", "near".
std::string threeCubes() {
    Json gltf = Json::parse(cubeGltf("cube.bin", true));
    gltf["nodes"] = Json::parse(R"([{"name": "near", "mesh": 0}, {"name": "far", "mesh": 0, "translation": [3, 0, 0]},
                                    {"name": "near", "mesh": 0, "translation": [0, 3, 0]}])");
    gltf["scenes"][0]["nodes"] = {0, 1, 2};
    return gltf.dump();
}

TEST_F(Cli, PartsHaveSchemesOfTheirOwn) {
    writeText(file("cubes.gltf"), threeCubes());
    const Json parts = Json::parse(run("inspect cubes.gltf --json").out)["parts"];
    ASSERT_EQ(parts.size(), 3u);
    for (const Json& part : parts) {
        EXPECT_EQ(part["scheme"], "catmull-clark");
        EXPECT_EQ(part["schemeReason"], "its polygons are known");
    }
    EXPECT_NE(run("inspect cubes.gltf").out.find("auto: catmull-clark, its polygons are known"), std::string::npos);

    ASSERT_EQ(runOnDevice("bake cubes.gltf -o all.obj --rate 2 --scheme loop").exitCode, 0);
    ASSERT_EQ(runOnDevice("bake cubes.gltf -o mixed.obj --rate 2 --part-scheme far=loop").exitCode, 0);
    ASSERT_EQ(runOnDevice("bake cubes.gltf -o quads.obj --rate 2").exitCode, 0);
    const std::vector<std::string> loop = readObj(file("all.obj")).vLines, quads = readObj(file("quads.obj")).vLines;
    const std::vector<std::string> mixed = readObj(file("mixed.obj")).vLines;
    ASSERT_EQ(quads.size(), 3u * 6 * 9) << "six patches of a cube";
    ASSERT_EQ(loop.size(), 3u * 12 * 6) << "two triangles of each square";
    std::vector<std::string> expected(quads.begin(), quads.begin() + 54); // parts in their order
    expected.insert(expected.end(), loop.begin() + 72, loop.begin() + 144);
    expected.insert(expected.end(), quads.begin() + 108, quads.end());
    EXPECT_EQ(mixed, expected);
    const std::string text = readText(file("mixed.obj"));
    EXPECT_NE(text.find("scheme catmull-clark, rate 2, 12 patches"), std::string::npos);
    EXPECT_NE(text.find("scheme loop, rate 2, 12 patches"), std::string::npos);
    EXPECT_NE(text.find("g patch_23\n"), std::string::npos) << "numbered through";

    const std::string bake = "bake cubes.gltf -o x.obj --patches p.json --rate 2 --scheme pm ";
    expectFailure(run(bake + "--part-scheme 1=loop"), 2, "--patches: part 1 has scheme loop");
    ASSERT_EQ(runOnDevice(bake + "--part-scheme 1=prep").exitCode, 0);
    const Json patches = Json::parse(readText(file("p.json")));
    EXPECT_EQ(patches["scheme"], "pm+prep");
    EXPECT_EQ(patches["patches"].size(), 18u);
    EXPECT_EQ(patches["patches"][12]["face"], 6) << "of the second part";

    ASSERT_EQ(runOnDevice("profile cubes.gltf --frames 2 --json p.json --part-scheme 0=polygons").exitCode, 0);
    EXPECT_EQ(Json::parse(readText(file("p.json")))["runs"][0]["scheme"], "polygons+catmull-clark");
    expectFailure(run("bake cubes.gltf -o x.obj --part-scheme far"), 2, "PART=SCHEME");
    expectFailure(run("bake cubes.gltf -o x.obj --part-scheme far=cage"), 2, "no scheme of a part");
    expectFailure(run("bake cubes.gltf -o x.obj --part-scheme nose=pm"), 1, "0 near, 1 far, 2 near");
}

TEST_F(Cli, PicturesShowThePartsThatAreNamed) {
    writeText(file("cubes.gltf"), threeCubes());
    const auto render = [&](const std::string& flags) {
        const Outcome outcome = runOnDevice("render cubes.gltf -o parts.png --size 80x60 --rate 4 " + flags);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return readText(file("parts.png"));
    };
    const std::string all = render(""), far = render("--part far"), near = render("--part near");
    EXPECT_NE(all, far);
    EXPECT_NE(all, near);
    EXPECT_NE(far, near);
    EXPECT_EQ(render("--part 1"), far);
    EXPECT_EQ(render("--part 0 --part 2"), near) << "a name shows all parts of that name";
    EXPECT_EQ(render("--part near --part far"), all);
    EXPECT_NE(render("--scheme cage --part far"), render("--scheme cage"));
    expectFailure(run("render cubes.gltf -o x.png --part nose"), 1, "0 near, 1 far, 2 near");
    expectFailure(run("render cubes.gltf -o x.png --part 3"), 1, "no part \"3\"");
    expectFailure(run("render cubes.gltf -o x.png --part"), 2, "--part");
}

TEST_F(Cli, MappingsAgreeBitForBit) {
    ASSERT_EQ(runOnDevice("bake cube.gltf -o narrow.obj --rate 7 --mapping narrow").exitCode, 0);
    ASSERT_EQ(runOnDevice("bake cube.gltf -o wide.obj --rate 7 --mapping wide").exitCode, 0);
    const Obj narrow = readObj(file("narrow.obj"));
    ASSERT_EQ(narrow.v.size(), 6u * 64u);
    EXPECT_EQ(narrow.vLines, readObj(file("wide.obj")).vLines);
}

TEST_F(Cli, ProfileMeasuresMotionWhenAsked) {
    for (const bool motion : {false, true}) {
        const Outcome outcome =
            runOnDevice(std::string("profile cube.gltf --frames 3 --json p.json") + (motion ? " --motion" : ""));
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        uint64_t points = 0;
        const Json json = Json::parse(readText(file("p.json")));
        for (const Json& pass : json["runs"][0]["passes"]) {
            points += pass["pass"] == "motion" ? pass["points"].get<uint64_t>() : 0;
        }
        EXPECT_EQ(points, motion ? 6u * 81u : 0u);
    }
}

TEST_F(Cli, ProfileMeasuresTangentsWhenAsked) {
    for (const bool tangents : {false, true}) {
        const Outcome outcome = runOnDevice(std::string("profile cube.gltf --scheme pm --frames 3 --json p.json") +
                                            (tangents ? " --tangent-frames" : ""));
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const Json json = Json::parse(readText(file("p.json")));
        bool evaluated = false;
        for (const Json& pass : json["runs"][0]["passes"]) {
            if (pass["pass"] == "evaluate") {
                evaluated = true;
                EXPECT_EQ(pass["bytes"].get<uint64_t>(), pass["points"].get<uint64_t>() * (tangents ? 20u : 16u));
            }
        }
        EXPECT_TRUE(evaluated);
    }
}

TEST_F(Cli, ProfilePlaysOnTheDeviceWhenAsked) {
    for (const bool playback : {false, true}) {
        const Outcome outcome = runOnDevice(std::string("profile cube.gltf --scheme cage --frames 3 --json p.json") +
                                            (playback ? " --playback" : ""));
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const Json json = Json::parse(readText(file("p.json")));
        const Json& run = json["runs"][0];
        EXPECT_EQ(run["playback"].get<bool>(), playback);
        EXPECT_EQ(run["passes"][0]["pass"], playback ? "pose" : "upload") << "nothing is uploaded where nothing is set";
    }
}

TEST_F(Cli, ProfilePlaysTheFirstClipOrTheOneItIsTold) {
    Json gltf = Json::parse(cubeGltf("cube.bin", true));
    gltf["animations"].push_back(gltf["animations"][0]);
    gltf["animations"][1]["name"] = "Leap";
    writeText(file("two.gltf"), gltf.dump());
    gltf.erase("animations");
    writeText(file("still.gltf"), gltf.dump());
    const std::tuple<const char*, const char*, std::string> kCases[] = {
        {"two.gltf", "", "Rise"}, {"two.gltf", " --clip Leap", "Leap"}, {"still.gltf", "", "bind pose"}};
    for (const auto& [name, flags, clip] : kCases) {
        const Outcome outcome =
            runOnDevice(std::string("profile --scheme cage --frames 1 --json p.json ") + name + flags);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_EQ(Json::parse(readText(file("p.json")))["runs"][0]["clip"], clip);
        EXPECT_NE(outcome.out.find("clip " + clip), std::string::npos) << outcome.out;
    }
    for (const char* scheme : {"pm", "all"}) {
        const Outcome outcome = run(std::string("profile two.gltf --clip Fall --scheme ") + scheme);
        EXPECT_EQ(outcome.exitCode, 1) << scheme;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("Leap"), std::string::npos) << outcome.err;
    }
}

TEST_F(Cli, ProfileOfAViewShowsItsShortfall) {
    for (const uint32_t budget : {200000u, 1024u}) {
        const Outcome outcome = runOnDevice("profile cube.gltf triangles.gltf --view --instances 40 --frames 3 "
                                            "--json p.json --budget " +
                                            std::to_string(budget));
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const Json runs = Json::parse(readText(file("p.json")))["runs"];
        ASSERT_EQ(runs.size(), 1u) << "all files are one crowd";
        const Json& run = runs[0];
        EXPECT_EQ(run["file"], "cube.gltf + triangles.gltf");
        EXPECT_EQ(run["instances"], 40);
        EXPECT_EQ(run["playback"], true);
        EXPECT_EQ(run["frames"], 3);
        std::set<std::string> passes;
        for (const Json& pass : run["passes"]) {
            EXPECT_TRUE(passes.insert(pass["pass"]).second) << "each once: " << pass;
        }
        for (const char* pass : {"pose", "deform", "bounds", "list", "level", "solve", "place", "evaluate"}) {
            EXPECT_TRUE(passes.contains(pass)) << pass;
        }
        EXPECT_FALSE(passes.contains("shortfall")) << "is no pass";
        const Json& view = run["view"];
        EXPECT_EQ(view["budget"], budget);
        EXPECT_GT(view["vertices"], 0);
        EXPECT_LE(view["vertices"], budget);
        EXPECT_EQ(run["frame"]["points"], view["vertices"]);
        EXPECT_EQ(view["shortfallFrames"], budget == 1024 ? 3 : 0) << view;
        EXPECT_EQ(view["mostDroppedInstances"] > 0, budget == 1024) << view;
    }
    expectFailure(run("profile cube.gltf --budget 5000"), 2, "--view");
    expectFailure(run("profile cube.gltf --view --budget 50331649"), 2, "--budget"); // SUPPLE_MAX_VIEW_VERTICES + 1
}

TEST_F(Cli, ProfileTellsWhoHoldsMemoryAndWhatGoesBackUnseen) {
    const Outcome outcome =
        runOnDevice("profile cube.gltf --view --instances 3 --frames 2 --scheme pm --keep-unseen 2 --json p.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(" of it goes back\n"), std::string::npos) << outcome.out;
    const Json first = Json::parse(readText(file("p.json")))["runs"][0];
    const Json& holders = first["holders"];
    ASSERT_EQ(holders.size(), 3u);
    uint64_t sum = 0;
    for (const Json& holder : holders) {
        sum += holder["deviceLocalBytes"].get<uint64_t>();
    }
    EXPECT_LE(sum, first["memory"]["deviceLocalBytes"]) << "the context has some of its own";
    EXPECT_EQ(holders[0]["name"], "asset cube.gltf");
    EXPECT_EQ(holders[0]["givenBackBytes"], 0);
    EXPECT_EQ(holders[1]["name"], "group cube.gltf");
    EXPECT_GT(holders[1]["coefficientsBytes"], 0) << "measured while all are seen";
    EXPECT_GE(holders[1]["givenBackBytes"], holders[1]["coefficientsBytes"]);
    EXPECT_LT(holders[1]["givenBackBytes"], holders[1]["deviceLocalBytes"]);
    EXPECT_EQ(holders[2]["name"], "the view");
    expectFailure(run("profile cube.gltf --keep-unseen 5"), 2, "--view");
}

TEST_F(Cli, ProfileHashesWhatAViewDrewLast) {
    for (const char* scheme : {"pm", "loop", "fragments"}) {
        std::vector<std::string> hashes;
        for (const char* frames : {"1", "1", "4"}) {
            const Outcome outcome =
                runOnDevice(std::string("profile cube.gltf --view --instances 6 --motion --json p.json "
                                        "--hashes hashes.txt --scheme ") +
                            scheme + " --frames " + frames);
            ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
            hashes.push_back(readText(file("hashes.txt")));
            const Json view = Json::parse(readText(file("p.json")))["runs"][0]["view"];
            const uint64_t drawn = scheme == std::string("fragments") ? view["drawnInstances"] : view["patches"];
            EXPECT_GT(drawn, 0u);
            EXPECT_EQ(static_cast<uint64_t>(std::count(hashes.back().begin(), hashes.back().end(), '\n')), drawn + 1)
                << "a line for the scheme, and a line for each: " << hashes.back();
        }
        EXPECT_EQ(hashes[0], hashes[1]) << scheme;
        EXPECT_NE(hashes[0], hashes[2]) << "other times have other poses";
    }
    expectFailure(run("profile cube.gltf --hashes hashes.txt"), 2, "--view");
}

TEST_F(Cli, ProfileWritesTableJsonCsvAndTrace) {
    const Outcome outcome =
        runOnDevice("profile cube.gltf cube.gltf --instances 3 --frames 7 --json p.json --csv p.csv "
                    "--trace t.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("evaluate"), std::string::npos) << outcome.out;

    const Json json = Json::parse(readText(file("p.json")));
    EXPECT_NE(json["machine"]["device"], "");
    ASSERT_EQ(json["runs"].size(), 2u);
    for (const Json& run : json["runs"]) {
        EXPECT_EQ(run["scheme"], "catmull-clark") << "what auto stands for";
        EXPECT_EQ(run["instances"], 3);
        EXPECT_EQ(run["frames"], 7) << "no frame's timings were skipped";
        EXPECT_EQ(run["frame"]["points"], 3 * 6 * 81);
        bool evaluated = false;
        for (const Json& pass : run["passes"]) {
            EXPECT_LE(pass["gpuMs"]["median"], pass["gpuMs"]["max"]);
            evaluated = evaluated || pass["pass"] == "evaluate";
        }
        EXPECT_TRUE(evaluated);
    }
    const std::string csv = readText(file("p.csv"));
    EXPECT_EQ(csv.rfind("file,scheme,rate,", 0), 0u);
    EXPECT_NE(csv.find(",evaluate,"), std::string::npos);

    const Json trace = Json::parse(readText(file("t.json")));
    int slices = 0;
    for (const Json& event : trace["traceEvents"]) {
        if (event["ph"] == "X") {
            ++slices;
            EXPECT_GE(event["dur"].get<double>(), 0.0);
        }
    }
    EXPECT_GT(slices, 2 * 7);
}

} // namespace
