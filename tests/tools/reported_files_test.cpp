// Small files after public bug reports of other programs, ../shared/cases/reports, whose right answers were written
// down before Supple saw them. Each stands for a kind of file that people have.
#include "tests/tools/baked_files.h"
#include "tests/tools/command_runner.h"
#include "tests/tools/obj_file.h"

#include "host/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace supple::test {
namespace {

namespace fs = std::filesystem;
using Expectation = nlohmann::json;

const fs::path kFolder = fs::path(SUPPLE_SHARED_DIR) / "cases" / "reports";

/// Files that do not come out right yet, and why. A file that does come out right must not be here.
const std::map<std::string, std::string> kNotRightYet = {
};

/// How much positions may be off: the expected ones have five decimals.
constexpr float kTolerance = 2e-5f;

struct Box {
    glm::vec3 low{1e30f}, high{-1e30f};
};

Box boxOf(const std::vector<glm::vec3>& positions) {
    Box box;
    for (const glm::vec3& p : positions) {
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    }
    return box;
}

std::string textOf(const Box& box) {
    char text[160];
    std::snprintf(text, sizeof text, "[%g %g %g, %g %g %g]", double{box.low.x}, double{box.low.y}, double{box.low.z},
                  double{box.high.x}, double{box.high.y}, double{box.high.z});
    return text;
}

glm::vec3 vectorOf(const Expectation& from) {
    return {from[0].get<float>(), from[1].get<float>(), from[2].get<float>()};
}

double volumeOf(const Obj& obj) {
    double volume = 0.0;
    for (const std::vector<uint32_t>& face : obj.faces) {
        for (size_t k = 1; k + 1 < face.size(); ++k) {
            volume += glm::dot(glm::dvec3(obj.v[face[0]]),
                               glm::cross(glm::dvec3(obj.v[face[k]]), glm::dvec3(obj.v[face[k + 1]]))) /
                      6.0;
        }
    }
    return volume;
}

class ReportedFiles : public CommandTest {
protected:
    /// What is wrong with what Supple makes of a file; empty: nothing.
    std::string faultOf(const std::string& name, const Expectation& expected);

private:
    Outcome runOn(const std::string& command, const std::string& more = "") {
        return runOnDevice(command + " '" + (kFolder / file_).string() + "' " + more);
    }
    Outcome inspect(const std::string& more = "") {
        return run("inspect '" + (kFolder / file_).string() + "' " + more);
    }
    std::string bakeCage(const std::string& options, Obj& obj) {
        const Outcome baked = runOn("bake", "-o cage.obj --scheme cage " + options);
        said_ += baked.err;
        if (baked.exitCode != 0) {
            return "refused: " + baked.err;
        }
        obj = readObj(file("cage.obj"));
        return "";
    }
    std::string faultOfBox(const std::string& options, const Expectation& expected) {
        Obj obj;
        if (const std::string fault = bakeCage(options, obj); !fault.empty()) {
            return fault;
        }
        const Box box = boxOf(obj.v);
        const glm::vec3 low = glm::abs(box.low - vectorOf(expected[0]));
        const glm::vec3 high = glm::abs(box.high - vectorOf(expected[1]));
        const bool near = std::max({low.x, low.y, low.z, high.x, high.y, high.z}) <= kTolerance;
        return near ? "" : "the cage's box is " + textOf(box);
    }
    std::string faultOfPositions(const std::string& options, const Expectation& expected) {
        Obj obj;
        if (const std::string fault = bakeCage(options, obj); !fault.empty()) {
            return fault;
        }
        for (const Expectation& position : expected) {
            const glm::vec3 wanted = vectorOf(position);
            const bool found = std::any_of(obj.v.begin(), obj.v.end(),
                                           [&](const glm::vec3& p) { return glm::length(p - wanted) <= kTolerance; });
            if (!found || obj.v.size() != expected.size()) {
                return "no vertex at " + position.dump() + ", or not as many";
            }
        }
        return "";
    }
    std::string faultOfVolume(const std::string& options, double expected);
    std::string faultOfBindSpaces();
    std::string faultOfNormals();
    std::string faultOfPicture();
    std::string faultOfRed();
    std::string faultOfFrame(const Expectation& expected);

    std::string file_;
    std::string said_; ///< errors and warnings
};

std::string ReportedFiles::faultOfVolume(const std::string& options, double expected) {
    Obj obj;
    if (const std::string fault = bakeCage(options, obj); !fault.empty()) {
        return fault;
    }
    const double volume = volumeOf(obj);
    return std::abs(volume - expected) <= 1e-4 ? "" : "the cage's volume is " + std::to_string(volume);
}

/// The bind pose and the rest pose are alike up to a similarity: their boxes have the same proportions.
std::string ReportedFiles::faultOfBindSpaces() {
    Obj bind, rest;
    if (!bakeCage("", bind).empty() || !bakeCage("--rest-pose", rest).empty() || bind.v.size() != rest.v.size()) {
        return "not baked";
    }
    const float scale = glm::length(bind.v[0] - bind.v[1]) / glm::length(rest.v[0] - rest.v[1]);
    for (size_t v = 1; v < bind.v.size(); ++v) {
        const float wanted = scale * glm::length(rest.v[v] - rest.v[0]);
        if (std::abs(glm::length(bind.v[v] - bind.v[0]) - wanted) > 1e-4f * wanted) {
            return "in the bind pose, vertex " + std::to_string(v) + " is not where it is in the rest pose";
        }
    }
    return "";
}

/// Every scheme has normals of unit length, as of the cube of 1 unit.
std::string ReportedFiles::faultOfNormals() {
    for (const std::string scheme : {"prep", "pm", "catmull-clark", "loop", "blend", "fragments", "polygons"}) {
        const Outcome baked = runOn("bake", "-o tiny.ply --rate 2 --scheme " + scheme);
        if (baked.exitCode != 0) {
            return scheme + " is refused: " + baked.err;
        }
        for (const glm::vec3& normal : readPly(file("tiny.ply")).normals) {
            if (!(std::abs(glm::length(normal) - 1.0f) <= 1e-3f)) {
                return scheme + " has a normal of length " + std::to_string(glm::length(normal));
            }
        }
    }
    return "";
}

/// The picture is that of the cube of 1 unit.
std::string ReportedFiles::faultOfPicture() {
    writeText(file("one.obj"), kCubeObj);
    const std::string options = "--size 96x96 --scheme catmull-clark -o ";
    const Outcome tiny = runOn("render", options + "tiny.png");
    const Outcome one = runOnDevice("render one.obj " + options + "one.png");
    if (tiny.exitCode != 0 || one.exitCode != 0) {
        return "not drawn: " + tiny.err + one.err;
    }
    const auto decode = [&](const char* name) {
        const std::string png = readText(file(name));
        return host::decodePicture({reinterpret_cast<const std::byte*>(png.data()), png.size()}, name);
    };
    const Result<host::Picture> a = decode("tiny.png"), b = decode("one.png");
    if (!a || !b || a->rgba.size() != b->rgba.size()) {
        return "no picture";
    }
    size_t different = 0;
    for (size_t i = 0; i < a->rgba.size(); ++i) {
        different += std::abs(int{a->rgba[i]} - int{b->rgba[i]}) > 8 ? 1 : 0;
    }
    return different <= a->rgba.size() / 100 ? "" : std::to_string(different) + " bytes of the picture differ";
}

/// Much of the picture is red.
std::string ReportedFiles::faultOfRed() {
    const Outcome drawn = runOn("render", "--size 96x96 --no-ground -o red.png");
    if (drawn.exitCode != 0) {
        return "not drawn: " + drawn.err;
    }
    const std::string png = readText(file("red.png"));
    const Result<host::Picture> picture =
        host::decodePicture({reinterpret_cast<const std::byte*>(png.data()), png.size()}, "red.png");
    if (!picture) {
        return "no picture";
    }
    size_t red = 0;
    for (size_t i = 0; i < picture->rgba.size(); i += 4) {
        const int r = int{picture->rgba[i]}, g = int{picture->rgba[i + 1]}, b = int{picture->rgba[i + 2]};
        red += r > 60 && r > 2 * std::max(g, b) ? 1 : 0;
    }
    return red >= 96 * 96 / 20 ? "" : std::to_string(red) + " pixels are red";
}

std::string ReportedFiles::faultOfFrame(const Expectation& expected) {
    Obj obj;
    if (const std::string fault = bakeCage("", obj); !fault.empty()) {
        return fault;
    }
    const double volume = volumeOf(obj);
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (const std::vector<uint32_t>& face : obj.faces) {
        for (size_t k = 0; k < face.size(); ++k) {
            ++edges[std::minmax(face[k], face[(k + 1) % face.size()])];
        }
    }
    const auto euler =
        static_cast<long>(obj.v.size()) - static_cast<long>(edges.size()) + static_cast<long>(obj.faces.size());
    if (std::abs(volume - expected["volume"].get<double>()) > 1e-3 ||
        euler != expected["euler_characteristic"].get<long>()) {
        return "the volume is " + std::to_string(volume) + ", the Euler characteristic " + std::to_string(euler);
    }
    return "";
}

/// The options of an expectation; sentences are not for us.
std::string optionsOf(const Expectation& expected) {
    const std::string options = expected.value("options", "");
    return options.starts_with("--") ? options : "";
}

std::string ReportedFiles::faultOf(const std::string& name, const Expectation& expected) {
    file_ = name;
    said_.clear();
    const std::string options = optionsOf(expected);
    std::string fault;
    const auto check = [&](const char* key, auto&& find) {
        if (fault.empty() && expected.contains(key)) {
            fault = find(expected[key]);
        }
    };
    check("cage_box", [&](const Expectation& box) { return faultOfBox(options, box); });
    check("cage_box_rest", [&](const Expectation& box) { return faultOfBox("--rest-pose", box); });
    check("cage_box_at_0_5", [&](const Expectation& box) { return faultOfBox("--clip 0 --time 0.5", box); });
    check("cage_box_at_1_5", [&](const Expectation& box) { return faultOfBox("--clip 0 --time 1.5", box); });
    check("cage", [&](const Expectation& cage) { return faultOfPositions(options, cage); });
    check("signed_volume_of_cage", [&](const Expectation& v) { return faultOfVolume(options, v.get<double>()); });
    check("ratio_of_part_extents_x", [&](const Expectation&) { return faultOfBindSpaces(); });
    check("euler_characteristic", [&](const Expectation&) { return faultOfFrame(expected); });
    check("normals",
          [&](const Expectation&) { return expected.contains("render") ? faultOfNormals() : std::string(); });
    check("render", [&](const Expectation&) { return faultOfPicture(); });
    check("targets", [&](const Expectation& targets) {
        const auto said = nlohmann::json::parse(inspect("--json").out);
        return said["morphTargets"].size() == targets.get<size_t>() ? "" : "other targets";
    });
    check("parts", [&](const Expectation& parts) {
        const auto said = nlohmann::json::parse(inspect("--json").out);
        return said["parts"].size() == parts.size() ? "" : "other parts";
    });
    check("wanted", [&](const Expectation& wanted) {
        if (wanted.get<std::string>().starts_with("red")) {
            return faultOfRed();
        }
        const Outcome inspected = inspect();
        return std::string(inspected.out.find("\nwarning ") != std::string::npos ? "" : "nothing is said");
    });
    return fault;
}

/// A cube of any size has the surface of a cube of 1, and its normals to the bit: what is scaled is scaled by powers of
/// two.
TEST_F(ReportedFiles, SurfacesMayBeOfAnySize) {
    const auto cube = [](float size) {
        std::string text;
        for (int v = 0; v < 8; ++v) {
            char line[80];
            std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", double{size * static_cast<float>(v & 1)},
                          double{size * static_cast<float>(v >> 1 & 1)}, double{size * static_cast<float>(v >> 2)});
            text += line;
        }
        return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    };
    const float tiny = std::ldexp(1.0f, -40); // 9e-13
    writeText(file("one.obj"), cube(1.0f));
    writeText(file("tiny.obj"), cube(tiny));
    for (const std::string scheme : {"prep", "pm", "catmull-clark", "loop", "blend", "fragments", "polygons"}) {
        SCOPED_TRACE(scheme);
        for (const std::string name : {"one", "tiny"}) {
            const Outcome baked = runOnDevice("bake " + name + ".obj -o " + name + ".ply --rate 2 --scheme " + scheme);
            ASSERT_EQ(baked.exitCode, 0) << baked.err;
        }
        const Ply one = readPly(file("one.ply")), small = readPly(file("tiny.ply"));
        ASSERT_EQ(one.positions.size(), small.positions.size());
        for (size_t v = 0; v < one.positions.size(); ++v) {
            ASSERT_EQ(small.positions[v], tiny * one.positions[v]) << v;
            ASSERT_EQ(small.normals[v], one.normals[v]) << v;
        }
    }
}

/// What OBJ files have besides polygons, as the command shows it: parts, one of them by another scheme, welded
/// vertices, and a material of the file beside it.
TEST_F(ReportedFiles, ObjFilesHavePartsAndMaterials) {
    writeText(file("two.mtl"), "newmtl Red\nKd 1 0 0\n");
    writeText(file("two.obj"),
              "mtllib two.mtl\no Body\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv 2 1 0\n"
              "usemtl Red\nf 1 2 3 4\nf 5 6 7\no Hat\nv 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2\nf 8 9 10 11\n");
    const auto inspected = [&](const std::string& options) {
        const Outcome outcome = run("inspect two.obj --json " + options);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    };
    const auto said = inspected("");
    ASSERT_EQ(said["parts"].size(), 2u);
    EXPECT_EQ(said["parts"][0]["name"], "Body");
    EXPECT_EQ(said["parts"][1]["name"], "Hat");
    EXPECT_EQ(said["parts"][0]["weldSource"], "equal position, skin and morphs");
    EXPECT_EQ(said["parts"][1]["weldSource"], "as given");
    EXPECT_EQ(said["materials"][0]["baseColorFactor"], nlohmann::json::parse("[1.0, 0.0, 0.0, 1.0]"));
    EXPECT_EQ(said["vertices"], 9);
    EXPECT_EQ(inspected("--vertices-apart")["vertices"], 11);
    // The library gets the same flag.
    for (const auto& [options, vertices] : {std::pair("", 9u), std::pair(" --vertices-apart", 11u)}) {
        const Outcome baked = runOnDevice(std::string("bake two.obj -o cage.obj --scheme cage") + options);
        ASSERT_EQ(baked.exitCode, 0) << baked.err;
        EXPECT_EQ(readObj(file("cage.obj")).v.size(), vertices);
    }
    const Outcome drawn =
        runOnDevice("bake two.obj -o hat.ply --rate 2 --part-scheme Hat=polygons --scheme catmull-clark");
    EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
}

TEST_F(ReportedFiles, ComeOutRight) {
    if (!fs::exists(kFolder / "expected.json")) {
        GTEST_SKIP() << "all reported files left out: " << kFolder << " is not present";
    }
    const Expectation all = Expectation::parse(std::ifstream(kFolder / "expected.json"));
    size_t right = 0;
    for (const auto& [name, entry] : all.items()) {
        SCOPED_TRACE(name);
        const std::string fault = faultOf(name, entry["expected"]);
        const auto known = kNotRightYet.find(name);
        std::printf("  %-28s %s\n", name.c_str(),
                    fault.empty() ? "right" : (fault + (known == kNotRightYet.end() ? "" : " - known")).c_str());
        if (known == kNotRightYet.end()) {
            EXPECT_EQ(fault, "");
        } else {
            EXPECT_NE(fault, "") << "it comes out right now: take it out of kNotRightYet";
        }
        right += fault.empty() ? 1 : 0;
    }
    std::printf("%zu of %zu reported files come out right\n", right, all.size());
}

} // namespace
} // namespace supple::test
