// Every mesh and character that lies beside the repository under P_m: which patches it gets, whether its cage is
// repaired before, and what comes of it on the device.
#include "tests/support/pm_gpu.h"
#include "tests/support/shared_assets.h"
#include "tools/common/character_file.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace supple::test {
namespace {

namespace fs = std::filesystem;

/// Files below ../shared/assets with a damaged cage, by the first kind of damage that is told.
const std::map<std::string, std::vector<const char*>>& damaged() {
    static const std::map<std::string, std::vector<const char*>> list = {
        {"three or more faces",
         {"characters/llama_nonmanifold.glb", "meshes/opensubdiv/catmark_fan.obj",
          "meshes/opensubdiv/catmark_nonman_edge100.obj", "meshes/opensubdiv/loop_nonman_edge100.obj",
          "meshes/shortsword_nonmanifold_ngons.obj", "whole/bat.glb"}},
        {"with a repeated vertex", {"whole/RobotExpressive.glb"}},
        {"turned against their neighbours", {"khronos/BoxAnimated.gltf"}},
        {"fewer than three different vertices",
         {"meshes/opensubdiv/catmark_nonman_edges.obj", "meshes/opensubdiv/loop_nonman_edges.obj"}},
        {"twice",
         {"meshes/opensubdiv/catmark_nonman_quadpole360.obj", "meshes/opensubdiv/catmark_nonman_quadpole64.obj",
          "meshes/opensubdiv/catmark_nonman_quadpole8.obj", "meshes/opensubdiv/catmark_val2_back2back.obj",
          "meshes/opensubdiv/catmark_val2_nonman.obj", "meshes/opensubdiv/loop_val2_interior.obj"}},
        {"no single fan",
         {"meshes/opensubdiv/catmark_gregory_test4.obj", "meshes/opensubdiv/catmark_nonman_verts.obj",
          "meshes/opensubdiv/loop_nonman_verts.obj"}},
        {"T-corner", {"khronos/asset-generator/Animation_Skin/Animation_Skin_09.gltf"}},
        {"two faces only",
         {"characters/suzanne.glb", "meshes/opensubdiv/catmark_gregory_test8.obj",
          "meshes/opensubdiv/catmark_val2_foldover.obj", "meshes/opensubdiv/catmark_val2_interior.obj",
          "meshes/suzanne.obj", "whole/triceratops.glb"}}};
    return list;
}

/// "12 regular, 8 p3".
std::string patchCounts(const surface::pm::Mesh& mesh) {
    std::array<uint32_t, std::size(surface::kPatchClasses)> counts{};
    for (const surface::PatchClass patchClass : mesh.classes) {
        ++counts[static_cast<size_t>(patchClass)];
    }
    std::string text;
    for (size_t c = 0; c < counts.size(); ++c) {
        if (counts[c] > 0) {
            text += (text.empty() ? "" : ", ") + std::to_string(counts[c]) + " " + surface::kPatchClasses[c].name;
        }
    }
    return text;
}

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct Totals {
    uint64_t samples = 0;
    uint64_t notFinite = 0;
    ComparedBits smooth, hard;
};

void evaluate(const cage::Cage& cage, const surface::pm::Mesh& mesh, Totals& totals) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    GpuSurface gpu(*device, cage, pmOptions(SUPPLE_MAPPING_NARROW, 3));
    ASSERT_TRUE(gpu.valid());
    gpu.evaluate();
    const PmPatches patches(gpu, mesh);
    uint64_t notFinite = 0;
    for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
        for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
            const GpuSurface::Vertex& vertex = gpu.vertex(0, p, s);
            ++totals.samples;
            notFinite += finite(vertex.position) && finite(vertex.normal) ? 0 : 1;
        }
    }
    ComparedBits smooth, hard;
    for (uint32_t e = 0; e < mesh.topology.edges.size(); ++e) {
        const cage::Topology::Edge& edge = mesh.topology.edges[e];
        if (patches.shared(edge)) {
            (mesh.features.hard(e) ? hard : smooth).add(patches.sharedBits(0, edge));
        }
    }
    EXPECT_EQ(notFinite, 0u);
    EXPECT_EQ(smooth.different, 0u) << "of " << smooth.samples;
    EXPECT_EQ(hard.different, 0u) << "of " << hard.samples;
    totals.notFinite += notFinite;
    totals.smooth.add(smooth);
    totals.hard.add(hard);
}

TEST(AssetsTable, AllAreTaken) {
    const fs::path assets = sharedFolder();
    const std::vector<std::string> paths = filesBelow(assets, {".obj", ".glb", ".gltf"});
    if (paths.empty()) {
        GTEST_SKIP() << "all shared assets left out: " << assets << " is not present";
    }
    const ValidationGuard guard;
    std::map<std::string, std::string> expected; // file -> kind
    for (const auto& [kind, files] : damaged()) {
        for (const char* file : files) {
            expected[file] = kind;
        }
    }
    std::map<std::string, uint32_t> repaired;
    uint32_t shapes = 0;
    uint32_t accepted = 0;
    Totals totals;
    for (const std::string& path : paths) {
        const std::string name = fs::relative(path, assets).generic_string();
        SCOPED_TRACE(name);
        shapes += name.starts_with("meshes/opensubdiv/") ? 1 : 0;
        const Result<host::CharacterFile> file = host::readCharacterFile(path);
        ASSERT_TRUE(file.ok()) << file.error().message;
        const cage::Character& character = file->character;
        if (!character.damages.empty()) {
            const std::string& found = character.damages.front().found;
            EXPECT_NE(found.find(expected.contains(name) ? expected[name] : "no damage"), std::string::npos) << found;
            ++repaired[expected[name]];
            expected.erase(name);
        }
        const cage::Cage& cage = character.cage;
        const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cage);
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        ++accepted;
        std::printf("%-66s %s%s\n", name.c_str(), patchCounts(*mesh).c_str(),
                    character.damages.empty() ? "" : "; repaired");
        ASSERT_NO_FATAL_FAILURE(evaluate(cage, *mesh, totals));
    }
    for (const auto& [file, kind] : expected) {
        ADD_FAILURE() << file << " should be damaged: " << kind;
    }
    EXPECT_GE(shapes, 115u);

    std::printf("%zu files (%u of OpenSubdiv's shapes), %u taken\n", paths.size(), shapes, accepted);
    for (const auto& [kind, count] : repaired) {
        std::printf("%u repaired: %s\n", count, kind.c_str());
    }
    std::printf(
        "rate 3 on the device: %llu samples, %llu not finite; %llu border samples on smooth edges, %llu differ; "
        "%llu on hard ones, %llu differ\n",
        static_cast<unsigned long long>(totals.samples), static_cast<unsigned long long>(totals.notFinite),
        static_cast<unsigned long long>(totals.smooth.samples),
        static_cast<unsigned long long>(totals.smooth.different), static_cast<unsigned long long>(totals.hard.samples),
        static_cast<unsigned long long>(totals.hard.different));
    EXPECT_GT(totals.hard.samples, 0u);
}

} // namespace
} // namespace supple::test
