// Clips of other files and morph targets by name, as a user of the commands meets them.
#include "tests/cage/gltf/builder.h"
#include "tests/support/shared_assets.h"
#include "tests/tools/command_runner.h"

#include <cstring>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using supple::test::GltfBuilder;
using supple::test::Outcome;
using supple::test::packGlb;
using supple::test::readText;
using supple::test::writeText;

std::string textOf(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A GLB's JSON and its binary chunk.
std::pair<Json, std::vector<std::byte>> unpack(const std::string& glb) {
    const auto wordAt = [&](size_t place) {
        uint32_t word = 0;
        std::memcpy(&word, glb.data() + place, sizeof word);
        return size_t{word};
    };
    const size_t binary = 20 + wordAt(12);
    return {Json::parse(glb.substr(20, wordAt(12))), supple::test::toBytes(glb.substr(binary + 8, wordAt(binary)))};
}

class ClipFiles : public supple::test::CommandTest {
protected:
    /// Cuts a character in two: still.glb without its animations, clips.glb with them and the bare nodes.
    void cut(const std::string& path) {
        auto [json, binary] = unpack(readText(path));
        Json motion = json;
        json.erase("animations");
        for (const char* key : {"meshes", "skins", "materials", "textures", "images"}) {
            motion.erase(key);
        }
        for (Json& node : motion["nodes"]) {
            for (const char* key : {"mesh", "skin", "weights"}) {
                node.erase(key);
            }
        }
        writeText(file("still.glb"), textOf(packGlb(json.dump(), binary)));
        writeText(file("clips.glb"), textOf(packGlb(motion.dump(), binary)));
    }

    [[nodiscard]] std::vector<glm::vec3> vertices(const std::string& name) const {
        std::vector<glm::vec3> list;
        std::istringstream stream(readText(file(name)));
        for (std::string line; std::getline(stream, line);) {
            std::istringstream words(line);
            std::string keyword;
            glm::vec3 v{};
            if (words >> keyword >> v.x >> v.y >> v.z && keyword == "v") {
                list.push_back(v);
            }
        }
        return list;
    }
};

TEST_F(ClipFiles, ACharacterCutInTwoBakesTheSameBits) {
    std::vector<std::string> paths =
        supple::test::sharedAssets({"whole/RobotExpressive.glb", "whole/studio_spider.glb"});
    paths.push_back(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb");
    for (const std::string& path : paths) {
        SCOPED_TRACE(path);
        cut(path);
        const Json whole = Json::parse(run("inspect '" + path + "' --json").out);
        const Outcome joined = run("inspect still.glb --json --clips clips.glb");
        ASSERT_EQ(joined.exitCode, 0) << joined.err;
        EXPECT_EQ(Json::parse(joined.out)["clips"], whole["clips"]);
        EXPECT_EQ(Json::parse(joined.out)["warnings"], whole["warnings"]);
        EXPECT_EQ(Json::parse(run("inspect still.glb --json").out)["clips"], Json::array());
        const std::string pose = " --scheme cage --time 0.4 --clip ";
        for (size_t clip = 0; clip < whole["clips"].size(); clip += 5) {
            const std::string number = std::to_string(clip);
            ASSERT_EQ(run("bake '" + path + "' -o whole.obj" + pose + number).exitCode, 0);
            ASSERT_EQ(run("bake still.glb -o joined.obj --clips clips.glb" + pose + number).exitCode, 0);
            EXPECT_TRUE(readText(file("whole.obj")) == readText(file("joined.obj"))) << number;
        }
        ASSERT_EQ(run("bake still.glb -o still.obj --scheme cage").exitCode, 0);
        EXPECT_FALSE(readText(file("whole.obj")) == readText(file("still.obj"))) << "the clip moves something";
    }
}

TEST_F(ClipFiles, EveryCommandThatReadsCharactersTakesThem) {
    cut(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb");
    for (const char* command :
         {"render still.glb -o a.png --size 40x40 --rate 2 --clip 1", "convert still.glb -o a.glb",
          "sheet still.glb -o sheet.png --cell 24x24 --columns 1 --rate 2 --only 0,1",
          "profile still.glb --frames 1 --rate 2 --clip 1", "bake still.glb -o a.obj --rate 2 --clip 1"}) {
        const Outcome outcome = run(std::string(command) + " --clips clips.glb");
        EXPECT_EQ(outcome.exitCode, 0) << command << "\n" << outcome.err;
        EXPECT_EQ(outcome.err, "") << command;
    }
    EXPECT_EQ(Json::parse(run("inspect a.glb --json").out)["clips"],
              Json::parse(run("inspect still.glb --json --clips clips.glb").out)["clips"])
        << "convert writes the clips into its file";
}

TEST_F(ClipFiles, ClipsOfAnotherSkeletonAreRetargeted) {
    const std::string pip = "'" + std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb'";
    const std::string wren = "'" + std::string(SUPPLE_SAMPLE_ASSETS) + "/wren.glb'";
    const Outcome converted = run("convert " + pip + " --clips " + wren + " -o both.glb");
    ASSERT_EQ(converted.exitCode, 0) << converted.err;
    EXPECT_NE(converted.err.find("6 clips retargeted: 19 joints by role"), std::string::npos) << converted.err;
    const Json both = Json::parse(run("inspect both.glb --json").out);
    EXPECT_EQ(both["clips"].size(), 9u);
    const auto baked = [&](const std::string& arguments) {
        const Outcome outcome = run("bake " + arguments + " -o pose.obj --scheme cage --time 0.3 --clip run");
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return readText(file("pose.obj"));
    };
    const std::string loaded = baked(pip + " --clips " + wren),
                      freed = baked(pip + " --retarget free-feet --clips " + wren),
                      named = baked(pip + " --retarget never --clips " + wren);
    EXPECT_TRUE(loaded == baked("both.glb")) << "what is written is what is loaded";
    EXPECT_FALSE(loaded == freed || loaded == named || freed == named);
    const Outcome never = run("inspect " + pip + " --json --retarget never --clips " + wren);
    EXPECT_NE(never.out.find("bones differ in length"), std::string::npos);
}

TEST_F(ClipFiles, AMapSaysWhichJointIsWhich) {
    const std::string pip = "'" + std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb'";
    const std::string wren = " --clips '" + std::string(SUPPLE_SAMPLE_ASSETS) + "/wren.glb' --retarget-map map.json";
    writeText(file("map.json"), R"({"roles": {"head": {"to": "neck"}, "neck": {"from": "chest"}},
                                    "joints": [{"from": "ponytail1", "to": "jaw"}]})");
    const Outcome outcome = run("inspect " + pip + " --json" + wren);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("6 clips retargeted"), std::string::npos);
    const auto fails = [&](const char* map, const std::string& reason) {
        writeText(file("map.json"), map);
        expectFailure(run("inspect " + pip + wren), 1, reason);
    };
    fails("{", "map.json: is no JSON");
    fails("[]", "map.json: must be an object with \"roles\" and \"joints\"");
    writeText(file("map.json"), R"({"roles": {"tail": {"to": "x"}}, "joints": [{"from": "a"}, 3], "more": 1})");
    EXPECT_EQ(run("inspect " + pip + wren).err, "supple: map.json: joint 0: needs from and to\n"
                                                "supple: map.json: joint 1: must be an object with from and to\n"
                                                "supple: map.json: unknown key \"more\"; there are \"roles\" and "
                                                "\"joints\"\n"
                                                "supple: map.json: no role is called \"tail\"\n");
    fails(R"({"roles": {"hips": {"to": 3}}})", "map.json: roles \"hips\": to must be a name");
    fails(R"({"roles": {"hips": {}}})", "map.json: roles \"hips\": needs from, to or both");
    fails(R"({"roles": {"hips": {"to": "belt"}}})", "joint pairs: the character has no node \"belt\"");
    std::filesystem::remove(file("map.json"));
    expectFailure(run("inspect " + pip + wren), 1, "map.json: cannot be opened");
}

TEST_F(ClipFiles, WhatIsWrongIsSaid) {
    GltfBuilder quad = supple::test::skinnedQuad();
    writeText(file("quad.glb"), textOf(quad.glb()));
    GltfBuilder other = quad;
    other.nodes = R"([{"mesh":0,"skin":0},{"name":"hips","children":[2]},{"name":"tail"}])";
    writeText(file("other.glb"), textOf(other.glb()));
    const Outcome outcome = run("bake quad.glb --keep-triangles -o out.obj --scheme cage --clips other.glb");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(
        outcome.err,
        "warning: quad.glb: other.glb: 1 clip; 0 of 1 node matched by name; not matched: tail; not retargeted: no "
        "left and right thigh, shin and foot below each other in its skeleton\n");
    expectFailure(run("bake quad.glb --keep-triangles -o out.obj --clips missing.glb"), 1,
                  "missing.glb: cannot be opened");
    writeText(file("broken.glb"), "glTF");
    expectFailure(run("bake quad.glb --keep-triangles -o out.obj --clips broken.glb"), 1, "quad.glb: broken.glb: ");
    writeText(file("cage.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expectFailure(run("bake cage.obj -o out.obj --clips other.glb"), 1,
                  "cage.obj: other.glb: an OBJ file has no nodes");
    cut(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb");
    expectFailure(run("inspect clips.glb"), 1, "it is no character, but a file of clips for one");
}

/// Two quads on nodes of their own, with a target "rise" each and one more each.
GltfBuilder twoFaces() {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    b.addIntegers("SCALAR", 5123, {0, 1, 2, 0, 2, 3});
    b.addFloats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    b.addFloats("VEC3", {0, 0, 0, 0, 0, 0, 0, 8, 0, 0, 8, 0});
    const std::string primitives =
        R"("primitives":[{"attributes":{"POSITION":0},"indices":1,"targets":[{"POSITION":2},{"POSITION":3}]}]})";
    b.meshes = R"([{"weights":[0,0.5],"extras":{"targetNames":["rise","long"]},)" + primitives +
               R"(,{"extras":{"targetNames":["rise"]},)" + primitives + "]";
    b.nodes = R"([{"mesh":0},{"mesh":1,"translation":[5,0,0]}])";
    return b;
}

TEST_F(ClipFiles, MorphTargetsAreSetByName) {
    writeText(file("faces.glb"), textOf(twoFaces().glb()));
    const auto bake = [&](const std::string& flags, const std::string& name = "faces.glb") {
        const Outcome outcome = runOnDevice("bake " + name + " -o out.obj --scheme cage " + flags);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return vertices("out.obj");
    };
    EXPECT_EQ(bake("")[2], glm::vec3(1, 1, 0)) << "the bind pose has no morph targets";
    const std::vector<glm::vec3> rest = bake("--morph rise=0");
    ASSERT_EQ(rest.size(), 8u);
    EXPECT_EQ(rest[2], glm::vec3(1, 5, 0)) << "the file gives long 0.5";
    const std::vector<glm::vec3> risen = bake("--morph rise=0.25");
    for (size_t v = 0; v < 8; ++v) {
        EXPECT_EQ(risen[v], rest[v] + glm::vec3(0, 0, 0.25f)) << "in both parts; the others keep the file's weights";
    }
    const std::vector<glm::vec3> both = bake("--morph long=0 --morph rise=-1");
    EXPECT_EQ(both[2], glm::vec3(1, 1, -1));
    EXPECT_EQ(bake("--morph 3=1")[6], rest[6] + glm::vec3(0, 8, 0)) << "one without a name, by its number";

    // Expressions, and targets that are set by themselves.
    GltfBuilder vrm = twoFaces();
    vrm.more = R"(,"extensions":{"VRMC_vrm":{"expressions":{"preset":{"happy":{"morphTargetBinds":[)"
               R"({"node":0,"index":0,"weight":0.5}]}}}}})";
    writeText(file("vrm.glb"), textOf(vrm.glb()));
    EXPECT_EQ(bake("--expression happy=0.5", "vrm.glb")[0], glm::vec3(0, 0, 0.25f));
    EXPECT_EQ(bake("--expression happy=1 --morph rise=0.75", "vrm.glb")[0], glm::vec3(0, 0, 0.75f))
        << "the target's own";
    expectFailure(run("bake vrm.glb -o out.obj --expression sad=1"), 1, "no expression \"sad\"; it has happy");
    expectFailure(run("bake faces.glb -o out.obj --expression sad=1"), 1, "no expression \"sad\"; it has none");
    expectFailure(run("bake faces.glb -o out.obj --morph smile=1"), 1,
                  "faces.glb: no morph target \"smile\"; it has rise, long, 3");
    for (const char* wrong : {"rise", "=1", "rise=", "rise=x", "rise=nan", "rise=1x"}) {
        expectFailure(run(std::string("bake faces.glb -o out.obj --morph ") + wrong), 2, "--morph");
    }
    writeText(file("quad.glb"), textOf(supple::test::skinnedQuad().glb()));
    expectFailure(run("render quad.glb --keep-triangles -o out.png --morph a=1"), 1,
                  "no morph target \"a\"; it has none");
    const Outcome profiled = run("profile faces.glb --frames 1 --rate 1 --instances 2 --morph rise=1");
    EXPECT_EQ(profiled.exitCode, 0) << profiled.err;
    const Outcome unknown = run("profile faces.glb --frames 1 --morph smile=1");
    EXPECT_EQ(unknown.exitCode, 1);
    EXPECT_NE(unknown.err.find("it has rise, long, 3"), std::string::npos) << unknown.err;
    std::vector<std::string> pictures;
    for (const char* morph : {"", " --morph long=1"}) {
        ASSERT_EQ(runOnDevice(std::string("render faces.glb -o out.png --size 60x40 --rate 1") + morph).exitCode, 0);
        pictures.push_back(readText(file("out.png")));
    }
    EXPECT_NE(pictures[0], pictures[1]);
}

/// Height of a PNG.
uint32_t heightOf(const fs::path& path) {
    const std::string bytes = readText(path);
    uint32_t height = 0;
    for (size_t i = 20; i < 24 && i < bytes.size(); ++i) {
        height = height << 8 | static_cast<uint8_t>(bytes[i]);
    }
    return height;
}

TEST_F(ClipFiles, SheetsTakeASelection) {
    const std::string pip = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
    const Json clips = Json::parse(run("inspect '" + pip + "' --json").out)["clips"];
    ASSERT_GE(clips.size(), 2u);
    const auto name = [&](size_t i) { return clips[i]["name"].get<std::string>(); };
    const auto height = [&](const std::string& flags) {
        const Outcome outcome =
            run("sheet '" + pip + "' -o sheet.png --cell 20x20 --columns 1 --rate 1 --no-labels " + flags);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return heightOf(file("sheet.png"));
    };
    EXPECT_EQ(height(""), 6 + clips.size() * 26);
    EXPECT_EQ(height("--only " + name(1)), 6u + 26);
    EXPECT_EQ(height("--only " + name(1) + ",0"), 6u + 2 * 26);
    EXPECT_EQ(height("--clip 0 --clip " + name(1)), 6u + 2 * 26);
    const Outcome wrong = run("sheet '" + pip + "' -o sheet.png --only 0,nothing");
    EXPECT_EQ(wrong.exitCode, 1);
    EXPECT_NE(wrong.err.find("no clip \"nothing\""), std::string::npos) << wrong.err;
}

} // namespace
