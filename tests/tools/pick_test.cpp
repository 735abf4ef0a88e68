// supple pick as a user runs it.
#include "tests/tools/command_runner.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

namespace {

using nlohmann::json;
using supple::test::kCubeObj;
using supple::test::Outcome;
using supple::test::readText;
using supple::test::writeText;

const std::string kPicked = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb";

using Vector = std::array<double, 3>;
Vector vectorOf(const json& value) {
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}
double distanceOf(const Vector& a, const Vector& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
std::string textOf(const Vector& v) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%.9g,%.9g,%.9g", v[0], v[1], v[2]);
    return text.data();
}

class Pick : public supple::test::CommandTest {
protected:
    json pick(const std::string& flags, const std::string& from = kPicked) {
        const Outcome outcome = runOnDevice("pick '" + from + "' " + flags);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return json::parse(outcome.out, nullptr, false);
    }
    /// What the device has at the point that was picked.
    json frameAt(const json& picked, const std::string& flags) {
        json point = {{"part", picked["part"]}, {"face", picked["face"]}, {"u", picked["u"]}, {"v", picked["v"]}};
        point["side"] = picked["side"];
        writeText(file("points.json"), json::array({point}).dump());
        const Outcome outcome = runOnDevice("points '" + kPicked + "' --points points.json -o frames.json " + flags);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return json::parse(readText(file("frames.json")))[0];
    }
};

/// A ray, a place and a pixel, in a pose: the device has the same point and normal there.
TEST_F(Pick, FindsWhatTheDeviceHas) {
    for (const std::string flags : {"--scheme catmull-clark --clip walk --time 0.4", "--scheme cage"}) {
        const json hit = pick("--ray 0.02,0.9,5,0,0,-2 " + flags);
        ASSERT_TRUE(hit.is_object()) << flags;
        const Vector position = vectorOf(hit["position"]), normal = vectorOf(hit["normal"]);
        EXPECT_NEAR(position[0], 0.02, 1e-5);
        EXPECT_NEAR(position[1], 0.9, 1e-5);
        EXPECT_NEAR(hit["distance"].get<double>(), 5.0 - position[2], 1e-5);
        EXPECT_GT(normal[2], 0.0) << "the side that the ray comes from";
        EXPECT_FALSE(hit["partName"].get<std::string>().empty());
        const json frame = frameAt(hit, flags);
        EXPECT_LT(distanceOf(position, vectorOf(frame["position"])), 2e-6);
        EXPECT_LT(distanceOf(normal, vectorOf(frame["normal"])), 2e-4);
        // Straight above the point, the point is the nearest.
        const Vector above = {position[0] + 0.01 * normal[0], position[1] + 0.01 * normal[1],
                              position[2] + 0.01 * normal[2]};
        const json nearest = pick("--closest " + textOf(above) + " " + flags);
        EXPECT_LT(distanceOf(position, vectorOf(nearest["position"])), 1e-4);
        EXPECT_NEAR(nearest["distance"].get<double>(), 0.01, 1e-5);
        // The device finds the same.
        const json cast = pick("--ray 0.02,0.9,5,0,0,-2 --on-device " + flags),
                   near = pick("--closest " + textOf(above) + " --on-device " + flags);
        for (const auto& [own, wanted] : {std::pair(cast, hit), std::pair(near, nearest)}) {
            EXPECT_LT(distanceOf(vectorOf(own["position"]), vectorOf(wanted["position"])), 1e-5);
            EXPECT_LT(distanceOf(vectorOf(own["normal"]), vectorOf(wanted["normal"])), 1e-2);
            EXPECT_EQ(own["partName"], wanted["partName"]);
            EXPECT_NEAR(own["distance"].get<double>(), wanted["distance"].get<double>(), 1e-5);
        }
        const json seen = pick("--at 640,480 --yaw 0 --pitch 0 " + flags);
        ASSERT_TRUE(seen.is_object());
        EXPECT_GT(vectorOf(seen["normal"])[2], 0.0);
    }
    EXPECT_TRUE(pick("--ray 0,90,0,0,0,1 --scheme cage").is_null());
    EXPECT_TRUE(pick("--ray 0,90,0,0,0,1 --scheme cage --on-device").is_null());
    EXPECT_TRUE(pick("--at 3,3 --scheme cage").is_null());
}

/// A pixel's column and row go right and down.
TEST_F(Pick, CountsPixelsFromTheUpperLeft) {
    writeText(file("cube.obj"), kCubeObj);
    const std::string flags = " --size 200x100 --yaw 0 --pitch 0 --scheme cage";
    const std::string cube = file("cube.obj").string();
    const Vector middle = vectorOf(pick("--at 99.5,49.5" + flags, cube)["position"]);
    EXPECT_NEAR(distanceOf(middle, {0, 0, 1}), 0.0, 1e-5);
    const Vector right = vectorOf(pick("--at 110,49.5" + flags, cube)["position"]);
    EXPECT_GT(right[0], 0.05);
    EXPECT_NEAR(right[1], 0.0, 1e-5);
    EXPECT_LT(vectorOf(pick("--at 99.5,60" + flags, cube)["position"])[1], -0.05);
}

TEST_F(Pick, WritesAFileOnRequest) {
    const Outcome outcome = runOnDevice("pick '" + kPicked + "' --ray 0.02,0.9,5,0,0,-2 -o hit.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(json::parse(readText(file("hit.json"))), pick("--ray 0.02,0.9,5,0,0,-2"));
}

TEST_F(Pick, SaysWhatIsWrong) {
    expectFailure(runOnDevice("pick '" + kPicked + "' --ray 0,0,0,0,0,0"), 1, "a direction without a length");
    expectFailure(runOnDevice("pick '" + kPicked + "' --at 1280,3"), 1, "--at 1280,3: the picture has 1280x960 pixels");
    for (const char* const flags : {"", "--ray 1,2,3", "--ray 1,2,3,4,5,6,", "--ray 0,0,0,nan,0,1", "--closest 1,2",
                                    "--closest 1,2,3 --at 3,4", "--at 1,1 --size 20", "--at 1,1 --size 0x20"}) {
        EXPECT_EQ(run("pick '" + kPicked + "' " + flags).exitCode, 2) << flags;
    }
}

} // namespace
