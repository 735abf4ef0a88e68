// supple convert as a user runs it: what it writes reads back, poses alike and satisfies Khronos' validator.
#include "cage/formats/reader.h"
#include "tests/support/characters.h"
#include "tests/support/spring_files.h"
#include "tests/tools/command_runner.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <cstdio>
#include <glm/glm.hpp>
#include <set>
#include <span>
#include <sstream>
#include <vector>

namespace {

namespace fs = std::filesystem;
using supple::cage::Character;
using supple::test::expectSame;
using supple::test::Outcome;
using supple::test::readText;
using supple::test::writeText;

const std::string kPip = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
const std::string kWren = std::string(SUPPLE_SAMPLE_ASSETS) + "/wren.glb";

/// A box without its lid, a pentagon beside it: two materials, a seam, a crease, a corner, a hole.
const char* const kBox =
    "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\nv 2 0.5 0\nv 2 0 0.5\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\n"
    "usemtl wood\n"
    "f 1/1 2/2 3/3 4/4\n"
    "f 2/5 1/1 5/2 6/3\n"
    "f 4/1 3/2 7/3 8/4\n"
    "f 1/1 4/2 8/3 5/4\n"
    "usemtl glass\n"
    "f 3/1 2/2 6/3 7/4\n"
    "t crease 3/2/0 4 5 6 10 2.5\n"
    "t corner 1/1/0 7 3\n"
    "t hole 1/0/0 4\n";

class Convert : public supple::test::CommandTest {
protected:
    [[nodiscard]] Character read(const fs::path& path) const {
        const std::string text = readText(path);
        const auto bytes = std::as_bytes(std::span(text));
        supple::Result<Character> result =
            supple::cage::readCharacter(bytes, path.string(), path.parent_path().string());
        EXPECT_TRUE(result.ok()) << result.error().message;
        return result.ok() ? std::move(*result) : Character{};
    }
};

std::vector<glm::vec3> vertices(const fs::path& obj) {
    std::vector<glm::vec3> list;
    std::ifstream stream(obj);
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

TEST_F(Convert, ObjToGlbAndOn) {
    writeText(file("box.obj"), kBox);
    const Outcome outcome = run("convert box.obj -o box.glb");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "supple: warning: box.obj: file: 2 vertices have no face; left out\n");
    for (const char* said : {"box.glb", "4: 5", "8 (", "2 edges, 1 of them hard; 1 sharp vertices; 1 holes"}) {
        EXPECT_NE(outcome.out.find(said), std::string::npos) << said << "\n" << outcome.out;
    }
    const Character obj = read(file("box.obj"));
    expectSame(obj, read(file("box.glb")));

    ASSERT_EQ(run("convert box.glb -o again.glb").exitCode, 0);
    EXPECT_TRUE(readText(file("again.glb")) == readText(file("box.glb")));
}

TEST_F(Convert, GlbToGlbPosesAlike) {
    fs::copy_file(kPip, file("before.glb"));
    ASSERT_EQ(run("convert before.glb -o after.glb").exitCode, 0);
    expectSame(read(file("before.glb")), read(file("after.glb")));
    for (const char* clip : {"idle", "walk"}) {
        const std::string pose = std::string(" --scheme cage --time 0.7 --clip ") + clip;
        ASSERT_EQ(runOnDevice("bake before.glb -o before.obj" + pose).exitCode, 0);
        ASSERT_EQ(runOnDevice("bake after.glb -o after.obj" + pose).exitCode, 0);
        const std::vector<glm::vec3> before = vertices(file("before.obj"));
        const std::vector<glm::vec3> after = vertices(file("after.obj"));
        ASSERT_GT(before.size(), 1000u);
        ASSERT_EQ(before.size(), after.size());
        for (size_t v = 0; v < before.size(); ++v) {
            ASSERT_LT(glm::distance(before[v], after[v]), 1e-6f) << clip << " vertex " << v;
        }
    }
}

TEST_F(Convert, PackedClipsAreWrittenAsTheyPlay) {
    fs::copy_file(kWren, file("wren.glb"));
    ASSERT_EQ(run("cook wren.glb -o wren.supple --scheme polygons --rate 1").exitCode, 0);
    ASSERT_EQ(run("convert wren.supple -o after.glb").exitCode, 0);
    const std::string pose = " --scheme cage --time 2.9 --clip idle"; // a blink
    ASSERT_EQ(runOnDevice("bake wren.supple -o before.obj" + pose).exitCode, 0);
    ASSERT_EQ(runOnDevice("bake after.glb -o after.obj" + pose).exitCode, 0);
    const std::vector<glm::vec3> before = vertices(file("before.obj"));
    const std::vector<glm::vec3> after = vertices(file("after.obj"));
    ASSERT_GT(before.size(), 1000u);
    ASSERT_EQ(before.size(), after.size());
    for (size_t v = 0; v < before.size(); ++v) {
        ASSERT_LT(glm::distance(before[v], after[v]), 2e-6f) << "vertex " << v;
    }
    EXPECT_EQ(read(file("after.glb")).clips.at(0).channels.back().width(), 1u) << "the last part with targets has one";
}

TEST_F(Convert, CreasesByAngle) {
    writeText(file("cube.obj"), supple::test::kCubeObj);
    ASSERT_EQ(run("convert cube.obj -o soft.glb --creases-from-angle 91").exitCode, 0);
    EXPECT_TRUE(read(file("soft.glb")).cage.creases.empty());
    const Outcome outcome = run("convert cube.obj -o hard.glb --creases-from-angle 60");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("12 edges, 12 of them hard"), std::string::npos) << outcome.out;
    EXPECT_EQ(read(file("hard.glb")).cage.creases.size(), 12u);
    expectFailure(run("convert cube.obj -o hard.glb --creases-from-angle 181"), 2, "--creases-from-angle");
}

TEST_F(Convert, KeepsWhatACageWasMadeFor) {
    fs::copy_file(kPip, file("before.glb"));
    Character character = read(file("before.glb"));
    character.parts[0].madeFor = supple::cage::MadeFor::loop;
    character.cage.roundCorners.clear();
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        if (std::count(character.cage.faceVertices.begin(), character.cage.faceVertices.end(), v) == 1) {
            character.cage.roundCorners.push_back(v);
        }
    }
    const auto glb = supple::cage::writeGlb(character);
    ASSERT_TRUE(glb.ok()) << glb.error().message;
    writeText(file("loop.glb"), {reinterpret_cast<const char*>(glb->bytes.data()), glb->bytes.size()});
    ASSERT_EQ(run("convert loop.glb -o again.glb").exitCode, 0);
    expectSame(character, read(file("again.glb")));
}

TEST_F(Convert, KeepsSprings) {
    const auto convert = [&](const std::string& source, const std::string& extensions) {
        const std::vector<std::byte> glb = supple::test::withExtensions(source, extensions);
        writeText(file("springs.glb"), {reinterpret_cast<const char*>(glb.data()), glb.size()});
        EXPECT_EQ(run("convert springs.glb -o again.glb").exitCode, 0);
        return read(file("again.glb")).springBones;
    };
    const supple::cage::SpringBones wren = convert(kWren, supple::test::kWrenSprings);
    ASSERT_EQ(wren.springs.size(), 2u);
    EXPECT_EQ(wren.springs[1].name, "scarf");
    EXPECT_EQ(wren.springs[1].center, 0u);
    EXPECT_EQ(wren.colliders.size(), 5u);
    EXPECT_EQ(wren.colliderGroups, (std::vector<std::vector<uint32_t>>{{0, 1, 4}, {1, 2, 3}}));
    const supple::cage::SpringBones pip = convert(kPip, supple::test::kPipSprings);
    EXPECT_EQ(pip.springs.size(), 3u) << "a tail and two ears";
    EXPECT_EQ(pip.colliders.size(), 1u);
    const std::string pose = " --scheme cage --clip walk --time 1";
    ASSERT_EQ(runOnDevice("bake springs.glb -o still.obj" + pose).exitCode, 0);
    for (const std::string name : {"springs", "again"}) {
        ASSERT_EQ(runOnDevice("bake " + name + ".glb -o " + name + ".obj --simulate 1" + pose).exitCode, 0);
    }
    const std::vector<glm::vec3> swung = vertices(file("springs.obj"));
    ASSERT_GT(swung.size(), 1000u);
    EXPECT_EQ(swung, vertices(file("again.obj"))) << "chains swing as trees do";
    EXPECT_NE(swung, vertices(file("still.obj")));
}

TEST_F(Convert, OtherSubcommandsOpenObjToo) {
    writeText(file("box.obj"), kBox);
    ASSERT_EQ(run("convert box.obj -o box.glb").exitCode, 0);
    ASSERT_EQ(runOnDevice("bake box.obj -o from_obj.obj --scheme cage").exitCode, 0);
    ASSERT_EQ(runOnDevice("bake box.glb -o from_glb.obj --scheme cage").exitCode, 0);
    EXPECT_EQ(vertices(file("from_obj.obj")).size(), 8u);
    EXPECT_EQ(readText(file("from_obj.obj")), readText(file("from_glb.obj")));
    const Outcome inspected = run("inspect box.obj");
    EXPECT_EQ(inspected.exitCode, 0) << inspected.err;
    EXPECT_NE(inspected.out.find("OBJ"), std::string::npos) << inspected.out;
}

TEST_F(Convert, BadUsageIsTwo) {
    writeText(file("box.obj"), kBox);
    writeText(file("box.glb"), "not to be touched");
    fs::create_symlink(file("box.glb"), file("link.glb"));
    expectFailure(run("convert box.obj"), 2, "--output");
    expectFailure(run("convert box.obj -o box.gltf"), 2, ".glb");
    expectFailure(run("convert box.glb -o box.glb"), 2, "is the input itself");
    expectFailure(run("convert link.glb -o ./box.glb"), 2, "is the input itself");
    EXPECT_EQ(readText(file("box.glb")), "not to be touched");
}

TEST_F(Convert, BadInputIsOneAndWritesNothing) {
    writeText(file("bad.obj"), "v 0 0 0\nf 1 2 3\n");
    writeText(file("good.obj"), kBox);
    writeText(file("out.glb"), "still here");
    fs::create_directory(file("folder.glb"));
    expectFailure(run("convert bad.obj -o out.glb"), 1, "bad.obj: line 2: face corner 2: vertex 2 of 1");
    expectFailure(run("convert missing.obj -o out.glb"), 1, "missing.obj");
    EXPECT_EQ(readText(file("out.glb")), "still here");
    expectFailure(run("convert good.obj -o nowhere/out.glb"), 1, "nowhere/out.glb");
    expectFailure(run("convert good.obj -o folder.glb"), 1, "folder.glb");
    size_t files = 0;
    for (const auto& entry : fs::directory_iterator(file("."))) {
        EXPECT_NE(entry.path().extension(), ".tmp");
        ++files;
    }
    EXPECT_EQ(files, 6u) << "the four above, stdout.txt and stderr.txt";
}

TEST_F(Convert, KhronosValidatorFindsNoError) {
    // The folder of the npm package gltf-validator; tools/test.sh installs it where there is npm.
    const char* validator = std::getenv("SUPPLE_GLTF_VALIDATOR");
    if (validator == nullptr || *validator == '\0' || runProgram("node --version").exitCode != 0) {
        GTEST_SKIP() << "SUPPLE_GLTF_VALIDATOR does not name the npm package gltf-validator, or there is no node";
    }
    writeText(file("box.obj"), kBox);
    std::vector<fs::path> inputs{kPip, kWren, file("box.obj")};
    const fs::path shared = fs::path(SUPPLE_SHARED_DIR) / "assets";
    if (fs::exists(shared)) {
        for (const auto& entry : fs::recursive_directory_iterator(shared)) {
            if (std::set<std::string>{".glb", ".gltf", ".obj"}.count(entry.path().extension().string()) != 0) {
                inputs.push_back(entry.path());
            }
        }
    } else {
        std::printf("all shared characters and meshes left out: ../shared not present\n");
    }
    std::string outputs;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const std::string output = std::to_string(i) + "_" + inputs[i].stem().string() + ".glb";
        const Outcome outcome = run("convert '" + inputs[i].string() + "' -o " + output);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        outputs += " " + output;
    }
    const Outcome outcome =
        runProgram("node " SUPPLE_TEST_SCRIPTS "/validate_gltf.mjs '" + std::string(validator) + "'" + outputs);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    std::printf("%s", outcome.out.substr(outcome.out.rfind('\n', outcome.out.size() - 2) + 1).c_str());
}

} // namespace
