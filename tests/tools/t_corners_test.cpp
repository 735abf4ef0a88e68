// A file with T-corners as a user meets it: what the commands say, and that what they write is closed.
#include "tests/tools/baked_files.h"
#include "tests/tools/command_runner.h"

#include <map>
#include <tuple>

namespace supple::test {
namespace {

/// A cube whose upper face is two quads: two of its other faces have a T-corner each.
const char* const kSplitCube = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                               "v 0 -1 1\nv 0 1 1\nf 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
                               "f 5 9 10 8\nf 9 6 7 10\n";

/// Edges of the faces that have not two of them, with vertices at one place as one.
size_t unpairedEdges(const Ply& ply) {
    std::map<std::tuple<float, float, float>, uint32_t> known;
    std::vector<uint32_t> places;
    for (const glm::vec3& p : ply.positions) {
        const auto key = std::tuple(p.x + 0.0f, p.y + 0.0f, p.z + 0.0f);
        places.push_back(known.emplace(key, static_cast<uint32_t>(known.size())).first->second);
    }
    std::map<std::pair<uint32_t, uint32_t>, int> sides;
    for (const std::vector<uint32_t>& face : ply.faces) {
        for (size_t k = 0; k < face.size(); ++k) {
            const uint32_t a = places[face[k]], b = places[face[(k + 1) % face.size()]];
            if (a != b) {
                ++sides[std::minmax(a, b)];
            }
        }
    }
    size_t unpaired = 0;
    for (const auto& side : sides) {
        unpaired += side.second != 2 ? 1 : 0;
    }
    return unpaired;
}

using TCorners = CommandTest;

TEST_F(TCorners, AreSaidOrRefused) {
    writeText(file("t.obj"), kSplitCube);
    const std::string line = "file: 2 T-corners, the first is vertex 8 on edge (4, 5) of face 1";
    const Outcome inspected = run("inspect t.obj --json");
    ASSERT_EQ(inspected.exitCode, 0) << inspected.err;
    const nlohmann::json json = nlohmann::json::parse(inspected.out);
    EXPECT_EQ(json["warnings"], nlohmann::json::array({line + "; made five-sided facets"}));
    EXPECT_EQ(json["boundaryEdges"], 0);
    EXPECT_EQ(json["sides"], nlohmann::json({{"4", 5}, {"5", 2}}));
    EXPECT_EQ(json["schemes"]["pm"]["patches"], nlohmann::json({{"p4", 5}, {"p5", 2}}));
    const Outcome strict = run("inspect t.obj --strict");
    EXPECT_EQ(strict.exitCode, 1);
    EXPECT_EQ(strict.err, "supple: t.obj: " + line + "\n");
}

TEST_F(TCorners, WhatIsBakedIsClosed) {
    writeText(file("t.obj"), kSplitCube);
    for (const std::string scheme : {"pm", "catmull-clark", "loop", "blend", "fragments", "polygons"}) {
        const Outcome baked = runOnDevice("bake t.obj -o t.ply --rate 4 --scheme " + scheme);
        ASSERT_EQ(baked.exitCode, 0) << scheme << baked.err;
        EXPECT_EQ(unpairedEdges(readPly(file("t.ply"))), 0u) << scheme;
    }
}

} // namespace
} // namespace supple::test
