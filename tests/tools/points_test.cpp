// supple points as a user runs it.
#include "tests/tools/command_runner.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace {

using nlohmann::json;
using supple::test::Outcome;
using supple::test::readText;
using supple::test::writeText;

const std::string kPointed = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb";

class Points : public supple::test::CommandTest {
protected:
    /// Runs with such a file of points.
    Outcome points(const std::string& given, const std::string& flags = "") {
        writeText(file("points.json"), given);
        return runOnDevice("points '" + kPointed + "' --points points.json -o frames.json " + flags);
    }
};

double dotOf(const json& a, const json& b) {
    double sum = 0.0;
    for (size_t k = 0; k < 3; ++k) {
        sum += a[k].get<double>() * b[k].get<double>();
    }
    return sum;
}

TEST_F(Points, WritesFramesOfTheSurface) {
    for (const char* flags : {"--scheme catmull-clark --clip walk --time 0.4", "--scheme cage"}) {
        const Outcome outcome =
            points(R"([{"part":0,"face":3,"u":0.25,"v":0.5},{"face":7,"u":0,"v":1,"tangent":[0,1,0]}])", flags);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const json frames = json::parse(readText(file("frames.json")));
        ASSERT_EQ(frames.size(), 2u);
        EXPECT_EQ(frames[0]["face"], 3);
        EXPECT_EQ(frames[0]["u"], 0.25);
        for (const json& frame : frames) {
            EXPECT_NEAR(dotOf(frame["normal"], frame["normal"]), 1.0, 1e-6);
            EXPECT_NEAR(dotOf(frame["tangent"], frame["tangent"]), 1.0, 1e-6);
            EXPECT_NEAR(dotOf(frame["tangent"], frame["normal"]), 0.0, 1e-6);
            EXPECT_NEAR(dotOf(frame["bitangent"], frame["normal"]), 0.0, 1e-6);
            const double size = std::sqrt(dotOf(frame["du"], frame["du"]));
            EXPECT_NEAR(dotOf(frame["du"], frame["normal"]) / size, 0.0, 1e-5);
            EXPECT_GT(frame["area"], 0.0);
        }
    }
}

/// A corner of a face is a surface vertex: it is moved by rounding alone. The other point stays to the bit.
TEST_F(Points, MayHavePositionsOfVertices) {
    const char* const given = R"([{"face":3,"u":0,"v":1},{"face":7,"u":0.3,"v":0.3}])";
    json positions[2];
    for (const bool onVertices : {false, true}) {
        const Outcome outcome = points(given, onVertices ? "--scheme pm --on-vertices" : "--scheme pm");
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const json frames = json::parse(readText(file("frames.json")));
        positions[onVertices ? 1 : 0] = {frames[0]["position"], frames[1]["position"]};
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(positions[0][0][axis].get<double>(), positions[1][0][axis].get<double>(), 1e-6);
    }
    EXPECT_EQ(positions[0][1], positions[1][1]);
    expectFailure(points(given, "--scheme cage --on-vertices"), 1, "needs surface vertices at a rate");
}

/// Where the file has the triangle's vertices; both triangles of a quad have the same diagonal.
TEST_F(Points, AreThoseOfTriangles) {
    const Outcome outcome =
        points(R"([{"mesh":0,"primitive":0,"triangle":0,"weights":[0,0.5,0.5]},{"face":3,"u":0.25,"v":0.5},)"
               R"({"mesh":0,"primitive":0,"triangle":1,"weights":[0.5,0.5,0],"tangent":[0,1,0]}])",
               "--scheme cage");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const json frames = json::parse(readText(file("frames.json")));
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_EQ(frames[1]["face"], 3);
    for (const json& frame : {frames[0], frames[2]}) {
        EXPECT_TRUE(frame["u"] == 0.5 || frame["v"] == 0.5) << frame;
        EXPECT_NEAR(dotOf(frame["normal"], frame["normal"]), 1.0, 1e-6);
    }
}

TEST_F(Points, SaysWhatIsWrongWithThem) {
    expectFailure(points(R"([{"mesh":0,"primitive":0,"triangle":0,"weights":[0.5,0.6,0.5]}])"), 1,
                  "point 0: needs mesh, primitive, triangle and weights that add up to 1");
    expectFailure(points(R"([{"mesh":0,"triangle":0,"weights":[1,0,0]}])"), 1, "point 0: needs mesh, primitive");
    expectFailure(points(R"([{"mesh":7,"primitive":0,"triangle":0,"weights":[1,0,0]}])"), 1,
                  "point 0: the character has no mesh 7 primitive 0 triangle 0");
    expectFailure(points("{}"), 1, "points.json: is no JSON list of points");
    expectFailure(points("[]"), 1, "points.json: has no points");
    expectFailure(points(R"([{"face":3,"u":0.5}])"), 1, "points.json: point 0: needs face, u and v");
    expectFailure(points(R"([{"face":3,"u":0.5,"v":0.5},{"face":-1,"u":0.5,"v":0.5}])"), 1, "point 1: needs face");
    expectFailure(points(R"([{"part":77,"face":3,"u":0.5,"v":0.5}])"), 1, "point 0: ");
    expectFailure(points(R"([{"face":999999,"u":0.5,"v":0.5}])"), 1, "points[0], face 999999: there is no such face");
    expectFailure(points(R"([{"face":3,"u":1.5,"v":0.5}])"), 1, "a and b do not lie in the face");
    expectFailure(points(R"([{"face":3,"u":0.5,"v":0.5,"tangent":[1,2]}])"), 1, "tangent is not three numbers");
    expectFailure(run("points '" + kPointed + "' --points absent.json -o out.json"), 1, "absent.json: cannot be read");
}

} // namespace
