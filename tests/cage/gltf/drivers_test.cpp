// Pose drivers of SUPPLE_deformers: what is read, and every fault by its name.
#include "cage/parts.h"
#include "cage/solved_driver.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

constexpr float kHalf = 0.70710678f;

/// A driver that is right. Accessors: 3 of two rotations, 4 of four values, 5 of one rotation, 6 of 65, 7 of 65 values,
/// 8 of no rotation.
const std::string kDriver =
    R"({"name":"elbow","inputs":[{"node":1,"part":"swing","axis":[0,2,0],"weight":0.5}],"poses":3,"values":4,"targets":[1,0],"width":1.5,"clamp":[-0.5,2]})";

/// A triangle with two morph targets at a node, beside two nodes more, of which the second has a matrix.
GltfBuilder driven(const std::string& drivers, const std::string& more = "") {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.addFloats("VEC3", {0, 0, 1, 0, 0, 0, 0, 0, 0});
    b.addFloats("VEC3", {0, 0, 0, 0, 0, 1, 0, 0, 0});
    b.addFloats("VEC4", {0, 0, kHalf, kHalf, kHalf, 0, 0, kHalf});
    b.addFloats("SCALAR", {1, 0, 0.25f, 1});
    b.addFloats("VEC4", {0, 0, kHalf, kHalf});
    std::vector<float> many, zeros;
    for (int i = 0; i < 65; ++i) {
        many.insert(many.end(), {0.0f, 0.0f, 1.0f, static_cast<float>(i)});
        zeros.push_back(0.0f);
    }
    b.addFloats("VEC4", many);
    b.addFloats("SCALAR", zeros);
    b.addFloats("VEC4", {0, 0, 0, 0, 0, 0, 0, 1});
    b.nodes = R"([{"name":"body","mesh":0},{"name":"forearm"},{"matrix":[2,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}])";
    b.meshes = R"([{"extensions":{"SUPPLE_deformers":{"drivers":)" + drivers +
               R"(}},"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":1},{"POSITION":2}]}]}])";
    b.more = R"(,"extensionsUsed":["SUPPLE_deformers"])" + more;
    return b;
}
/// The right driver, but for one thing.
GltfBuilder but(const std::string& from, const std::string& to) {
    return driven("[" + replaced(kDriver, from, to) + "]");
}

TEST(GltfDrivers, AreReadAsTheyStand) {
    const Character c = readWell(driven("[" + kDriver + "]"), kStrict);
    ASSERT_EQ(c.drivers.size(), 1u);
    const PoseDriver& own = c.drivers[0];
    EXPECT_EQ(own.name, "elbow");
    ASSERT_EQ(own.inputs.size(), 1u);
    EXPECT_EQ(own.inputs[0], (DriverInput{1, TurnPart::swing, {0, 1, 0}, 0.5f})) << "the axis has unit length";
    EXPECT_EQ(own.targets, (std::vector<uint32_t>{1, 0}));
    EXPECT_EQ(own.poses, (std::vector<glm::vec4>{{0, 0, kHalf, kHalf}, {kHalf, 0, 0, kHalf}}));
    EXPECT_EQ(own.values, (std::vector<float>{1, 0, 0.25f, 1}));
    EXPECT_EQ(own.width, 1.5f);
    EXPECT_EQ(own.low, -0.5f);
    EXPECT_EQ(own.high, 2.0f);
    EXPECT_EQ(c.warnings, Strings());

    const Character plain = readWell(driven(R"([{"inputs":[{"node":1}],"poses":5,"values":4,"targets":[0]}])"));
    EXPECT_EQ(plain.drivers.size(), 0u) << "four values for a pose and a target";
    const Character usual = readWell(driven(
        R"([{"inputs":[{"node":1},{"node":0,"part":"twist","axis":[1,0,0]}],"poses":3,"values":4,"targets":[0,1]}])"));
    ASSERT_EQ(usual.drivers.size(), 0u) << "one pose of two inputs has two values";
}

TEST(GltfDrivers, WhatIsLeftOutHasTheSpecificationsValue) {
    GltfBuilder b = driven(R"([{"inputs":[{"node":1}],"poses":3,"values":9,"targets":[0]}])");
    b.addFloats("SCALAR", {1, 0.5f});
    const Character c = readWell(b, kStrict);
    ASSERT_EQ(c.drivers.size(), 1u);
    EXPECT_EQ(c.drivers[0].inputs[0], DriverInput{.node = 1});
    EXPECT_EQ(c.drivers[0].width, 2.0f);
    EXPECT_EQ(c.drivers[0].low, 0.0f);
    EXPECT_EQ(c.drivers[0].high, 1.0f);
}

TEST(GltfDrivers, FaultsAreNamed) {
    const std::string place = R"(t.glb: mesh 0 SUPPLE_deformers drivers[0] "elbow")";
    const auto is = [&](const GltfBuilder& b, const std::string& fault) {
        EXPECT_EQ(messageOf(b), place + fault);
        const Character lenient = readWell(b);
        EXPECT_EQ(lenient.drivers.size(), 0u);
        EXPECT_EQ(lenient.warnings.size(), 1u) << "it is left out alone";
    };
    is(but(R"([{"node":1,"part":"swing","axis":[0,2,0],"weight":0.5}])", "[]"), " inputs: there are none");
    is(but(R"("inputs":[)", R"("inputs":[3,)"), " inputs[0]: not an object");
    is(but(R"("node":1)", R"("node":3)"), " inputs[0] node: node 3 is out of range: the file has 3");
    is(but(R"("node":1,)", ""), " inputs[0]: node is missing");
    is(but(R"("node":1)", R"("node":2)"), " inputs[0] node: node 2 has a matrix, which nothing turns");
    is(but(R"("swing")", R"("bend")"), R"( inputs[0] part: "bend" is not allowed)");
    is(but(R"("swing")", R"("")"), R"( inputs[0] part: "" is not allowed)");
    is(but(R"("axis":[0,2,0],)", ""), " inputs[0]: axis is missing");
    is(but(R"([0,2,0])", R"([0,0,0])"), " inputs[0] axis: has no direction");
    is(but(R"([0,2,0])", R"([0,2])"), " inputs[0] axis: 2 numbers instead of 3");
    is(but(R"("weight":0.5)", R"("weight":0)"), " inputs[0] weight: not a number from 0.001 to 1e+03");
    is(but(R"("targets":[1,0])", R"("targets":[])"), " targets: there are none");
    is(but(R"("targets":[1,0])", R"("targets":[1,2])"), " targets: morph target 2 is out of range: the file has 2");
    is(but(R"("targets":[1,0])", R"("targets":[1,1])"), " targets: morph target 1 is there twice");
    is(but(R"("targets":[1,0])", R"("targets":[0,1,0,1,0,1,0,1,0])"), " targets: 9, of at most 8");
    is(but(R"("poses":3,)", ""), ": poses is missing");
    is(but(R"("poses":3)", R"("poses":99)"), " poses: accessor 99 is out of range: the file has 9");
    is(but(R"("poses":3)", R"("poses":4)"), " values: 4 for 4 poses of 2 targets");
    is(but(R"("poses":3)", R"("poses":6)"), " poses: 65 rotations for 1 input: not of 1 to 64 poses");
    is(but(R"("poses":3)", R"("poses":5)"), " values: 4 for 1 pose of 2 targets");
    is(but(R"("poses":3)", R"("poses":8)"), " poses[0]: not a rotation");
    is(but(R"("values":4)", R"("values":7)"), " values: 65 for 2 poses of 2 targets");
    is(but(R"("width":1.5)", R"("width":-1)"), " width: not a number from 0.01 to 100");
    is(but(R"([-0.5,2])", R"([0.5,2])"), " clamp: 0, which the rest pose has, does not lie between its numbers");
    is(but(R"([-0.5,2])", R"([-2e9,2])"), " clamp: beyond 1e+09");
    is(but(R"([-0.5,2])", R"([-0.5])"), " clamp: 1 numbers instead of 2");
    EXPECT_EQ(
        messageOf(but(R"("axis":[0,2,0])", R"("axis":[0,0,1])")),
        "t.glb: mesh 0 SUPPLE_deformers driver \"elbow\": pose 0 and the rest pose, in which all weights are 0, are "
        "one pose, but for a degree, and have different values");
    EXPECT_EQ(messageOf(driven("{}")), "t.glb: mesh 0 SUPPLE_deformers drivers: not an array");
    EXPECT_EQ(messageOf(driven("[7]")), "t.glb: mesh 0 SUPPLE_deformers drivers[0]: not an object");
    EXPECT_EQ(messageOf(driven(R"([{"name":7}])")), "t.glb: mesh 0 SUPPLE_deformers drivers[0] name: not a string");
}

TEST(GltfDrivers, OneThatIsLeftOutLeavesTheOthers) {
    const std::string wrong = replaced(kDriver, R"("node":1)", R"("node":7)");
    const GltfBuilder b = driven("[" + wrong + "," + kDriver + "]");
    const Character c = readWell(b);
    EXPECT_EQ(c.drivers.size(), 1u);
    EXPECT_EQ(c.warnings.size(), 1u);
}

TEST(GltfDrivers, PosesThatAreHardToTellApartAreWarnedOf) {
    GltfBuilder b = driven(R"([{"name":"knee","inputs":[{"node":1}],"poses":9,"values":10,"targets":[0]}])");
    b.addFloats("VEC4", {0, 0, 0.5f, 0.8660254f, 0, 0, 0.53729961f, 0.84339145f}); // 60, 65 degrees
    b.addFloats("SCALAR", {0.5f, 3.0f});
    EXPECT_EQ(
        saidOf(b.glb()),
        R"(mesh 0 SUPPLE_deformers driver "knee": pose 0 and pose 1 are 5 degrees apart: between and beyond them weights may be far off)"
        "\n"
        R"(mesh 0 SUPPLE_deformers driver "knee": the value 3 is beyond its clamp, which is what it sets)");
    GltfBuilder wide =
        driven(R"([{"name":"knee","inputs":[{"node":1}],"poses":9,"values":10,"targets":[0],"width":100}])");
    wide.addFloats("VEC4", {0, 0, 0.5f, 0.8660254f, 0, 0, 0.70710678f, 0.70710678f});
    wide.addFloats("SCALAR", {0.5f, 1.0f});
    EXPECT_NE(saidOf(wide.glb()).find("its poses are hard to tell apart (condition"), std::string::npos)
        << saidOf(wide.glb());
}

TEST(GltfDrivers, JointsThatSwingAreRefused) {
    const std::string springs = R"(,"extensions":{"VRMC_springBone":{"springs":[{"joints":[{"node":1},{"node":2}]}]}})";
    GltfBuilder b = driven("[" + kDriver + "]", springs);
    b.nodes = R"([{"name":"body","mesh":0},{"name":"forearm","children":[2]},{"name":"hand"}])";
    EXPECT_EQ(messageOf(b), "t.glb: mesh 0 SUPPLE_deformers driver \"elbow\": node 1 swings by a spring, after drivers "
                            "have looked at it");
    EXPECT_EQ(readWell(b).drivers.size(), 0u);
    EXPECT_EQ(readWell(b).springBones.springs.size(), 1u) << "a .glb may have springs";
    b = driven("[" + replaced(kDriver, R"("node":1)", R"("node":2)") + "]", springs);
    b.nodes = R"([{"name":"body","mesh":0},{"name":"forearm","children":[2]},{"name":"hand"}])";
    EXPECT_EQ(readWell(b, kStrict).drivers.size(), 1u) << "the last joint of a spring is a tail alone";
}

std::string timesOver(const std::string& one, int times) {
    std::string list = one;
    for (int i = 1; i < times; ++i) {
        list += "," + one;
    }
    return list;
}

TEST(GltfDrivers, ManyAreBounded) {
    const Character c = readWell(driven("[" + timesOver(kDriver, 3000) + "]").glb());
    EXPECT_EQ(driverWork(c.drivers.at(0)), 2u * 3 * 4);
    EXPECT_EQ(c.drivers.size(), kMaxDriverWork / 24);
    EXPECT_EQ(c.warnings.size(), 1u) << "of alike lines the first";
}

/// Two meshes of the same shape, at two nodes. Their targets have names, or not.
GltfBuilder twoMeshes(const std::string& first, const std::string& second, bool names = true) {
    GltfBuilder b = driven("[" + kDriver + "]");
    const auto mesh = [&](const std::string& drivers) {
        return std::string("{") + (names ? R"("extras":{"targetNames":["a","b"]},)" : "") +
               R"("extensions":{"SUPPLE_deformers":{"drivers":)" + drivers +
               R"(}},"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":1},{"POSITION":2}]}]})";
    };
    b.nodes = R"([{"name":"body","mesh":0},{"name":"forearm"},{"name":"coat","mesh":1,"translation":[9,0,0]}])";
    b.meshes = "[" + mesh(first) + "," + mesh(second) + "]";
    return b;
}

TEST(GltfDrivers, PartsWithTheSameCountOnce) {
    const std::string many = "[" + timesOver(kDriver, 1500) + "]";
    const Character shared = readWell(twoMeshes(many, many));
    EXPECT_EQ(shared.drivers.size(), 1500u);
    EXPECT_EQ(shared.morphs.targets.size(), 2u);
    EXPECT_EQ(shared.warnings, Strings());
    const Character nameless = readWell(twoMeshes(many, many, false));
    EXPECT_EQ(nameless.morphs.targets.size(), 4u) << "they do not share";
    EXPECT_EQ(nameless.drivers.size(), kMaxDriverWork / 24);
    EXPECT_EQ(nameless.warnings.size(), 1u);
    // What is left out of one is left out of both: they share all the same.
    const std::string wrong = "[" + kDriver + "," + replaced(kDriver, R"([0,2,0])", R"([0,0,1])") + "]";
    const Character less = readWell(twoMeshes(wrong, wrong));
    EXPECT_EQ(less.drivers.size(), 1u);
    EXPECT_EQ(less.morphs.targets.size(), 2u);
}

TEST(GltfDrivers, PartsShareTargetsOnlyIfTheyHaveTheSame) {
    const auto both = [](const std::string& second) { return twoMeshes("[" + kDriver + "]", second); };
    const Character same = readWell(both("[" + kDriver + "]"));
    EXPECT_EQ(same.morphs.targets.size(), 2u);
    EXPECT_EQ(same.drivers.size(), 1u);
    const Character apart = readWell(both("[]"));
    EXPECT_EQ(apart.morphs.targets.size(), 4u);
    EXPECT_EQ(apart.drivers.size(), 1u);
    const Character other = readWell(both("[" + replaced(kDriver, R"("width":1.5)", R"("width":1)") + "]"));
    ASSERT_EQ(other.drivers.size(), 2u);
    EXPECT_EQ(other.drivers[1].targets, (std::vector<uint32_t>{3, 2}));
    for (size_t part = 0; part < 2; ++part) {
        const Character taken = takePart(other, part);
        ASSERT_EQ(taken.drivers.size(), 1u);
        EXPECT_EQ(taken.drivers[0].width, part == 0 ? 1.5f : 1.0f);
        EXPECT_EQ(taken.drivers[0].targets, (std::vector<uint32_t>{1, 0})) << "of the part's own";
    }
}

} // namespace
} // namespace supple::cage
