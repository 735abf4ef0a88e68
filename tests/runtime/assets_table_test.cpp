// Every mesh and character that lies beside the repository under P_m: taken with which patches, or refused with which
// words; and what is taken, evaluated on the device.
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

/// A file below ../shared/assets, and how the line begins that says why P_m does not take it.
struct Refusal {
    const char* file;
    const char* message;
};

/// By reason; every message begins with the edge, vertex or face.
const std::vector<std::pair<const char*, std::vector<Refusal>>>& refusals() {
    static const std::vector<std::pair<const char*, std::vector<Refusal>>> list = {
        {"more than two faces at an edge",
         {{"characters/llama_nonmanifold.glb", "edge (303, 304): four faces meet here: 140, 141, 316, 317"},
          {"meshes/opensubdiv/catmark_fan.obj", "edge (7, 8): three faces meet here: 2, 5, 9"},
          {"meshes/opensubdiv/catmark_nonman_edge100.obj", "edge (200, 201): 100 faces meet here: 0, 1, 2, 3,"},
          {"meshes/opensubdiv/catmark_nonman_edges.obj", "edge (7, 8): three faces meet here: 2, 5, 9"},
          {"meshes/opensubdiv/catmark_val2_nonman.obj", "edge (0, 1): four faces meet here: 0, 1, 2, 3"},
          {"meshes/opensubdiv/loop_nonman_edge100.obj", "edge (100, 101): 100 faces meet here: 0, 1, 2, 3,"},
          {"meshes/opensubdiv/loop_nonman_edges.obj", "edge (7, 8): three faces meet here: 1, 10, 17"},
          {"meshes/opensubdiv/loop_val2_interior.obj", "edge (10, 11): four faces meet here: 6, 7, 8, 9"},
          {"meshes/shortsword_nonmanifold_ngons.obj", "edge (1, 4): four faces meet here: 40, 41, 42, 44"}}},
        {"faces turned against each other",
         {{"khronos/BoxAnimated.gltf", "edge (1, 2): flipped orientation: faces 0 and 1 run along it"}}},
        {"several fans at a vertex",
         {{"khronos/asset-generator/Animation_Skin/Animation_Skin_09.gltf", "vertex 2: several separate fans"},
          {"meshes/opensubdiv/catmark_gregory_test4.obj", "vertex 4: several separate fans"},
          {"meshes/opensubdiv/catmark_nonman_verts.obj", "vertex 1: several separate fans"},
          {"meshes/opensubdiv/loop_nonman_verts.obj", "vertex 1: several separate fans"}}},
        {"interior valence 2",
         {{"characters/suzanne.glb", "vertex 137: interior valence 2, between faces 142 and 143"},
          {"meshes/opensubdiv/catmark_gregory_test8.obj", "vertex 1: interior valence 2, between faces 0 and 3"},
          {"meshes/opensubdiv/catmark_val2_back2back.obj", "vertex 0: interior valence 2, between faces 0 and 1"},
          {"meshes/opensubdiv/catmark_val2_foldover.obj", "vertex 1: interior valence 2, between faces 0 and 2"},
          {"meshes/opensubdiv/catmark_val2_interior.obj", "vertex 16: interior valence 2, between faces 8 and 9"},
          {"meshes/suzanne.obj", "vertex 137: interior valence 2, between faces 142 and 143"}}}};
    return list;
}

/// Files with faces that repeat a vertex: the reader leaves these faces out and says so, the rest is a cage like
/// others.
const std::map<std::string, uint32_t>& degenerateFaces() {
    static const std::map<std::string, uint32_t> counts = {{"meshes/opensubdiv/catmark_nonman_edges.obj", 14},
                                                           {"meshes/opensubdiv/catmark_nonman_quadpole360.obj", 360},
                                                           {"meshes/opensubdiv/catmark_nonman_quadpole64.obj", 64},
                                                           {"meshes/opensubdiv/catmark_nonman_quadpole8.obj", 8},
                                                           {"meshes/opensubdiv/loop_nonman_edges.obj", 4}};
    return counts;
}

uint32_t degenerateFacesOf(const cage::Character& character) {
    for (const std::string& warning : character.warnings) { // "line 21: 8 faces repeat a vertex, ..."
        const size_t end = warning.find(" faces repeat a vertex");
        if (end != std::string::npos) {
            return static_cast<uint32_t>(std::stoul(warning.substr(warning.rfind(' ', end - 1) + 1)));
        }
    }
    return 0;
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

TEST(AssetsTable, TakenOrRefusedByName) {
    const fs::path assets = sharedFolder();
    const std::vector<std::string> paths = filesBelow(assets, {".obj", ".glb", ".gltf"});
    if (paths.empty()) {
        GTEST_SKIP() << "all shared assets left out: " << assets << " is not present";
    }
    const ValidationGuard guard;
    std::map<std::string, std::pair<const char*, const char*>> expected; // file -> reason, message
    for (const auto& [reason, files] : refusals()) {
        for (const Refusal& refusal : files) {
            expected[refusal.file] = {reason, refusal.message};
        }
    }
    std::map<const char*, uint32_t> refused;
    std::map<std::string, uint32_t> degenerate;
    uint32_t shapes = 0;
    uint32_t accepted = 0;
    Totals totals;
    uint32_t leftAside = 0;
    for (const std::string& path : paths) {
        const std::string name = fs::relative(path, assets).generic_string();
        SCOPED_TRACE(name);
        if (name.starts_with("whole/")) { // of several parts, of which the reader takes one
            ++leftAside;
            continue;
        }
        shapes += name.starts_with("meshes/opensubdiv/") ? 1 : 0;
        const Result<host::CharacterFile> file = host::readCharacterFile(path);
        ASSERT_TRUE(file.ok()) << file.error().message;
        const uint32_t leftOut = degenerateFacesOf(file->character);
        if (leftOut > 0) {
            degenerate[name] = leftOut;
        }
        const std::string without = leftOut > 0 ? "; " + std::to_string(leftOut) + " degenerate faces left out" : "";
        const cage::Cage& cage = file->character.cage;
        const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cage);
        if (!mesh.ok()) {
            const std::string& message = mesh.error().message;
            std::printf("%-66s REFUSED %s%s\n", name.c_str(), message.c_str(), without.c_str());
            const auto found = expected.find(name);
            if (found == expected.end()) {
                ADD_FAILURE() << "should be taken: " << message;
                continue;
            }
            EXPECT_EQ(message.rfind(found->second.second, 0), 0u) << message;
            ++refused[found->second.first];
            expected.erase(found);
            continue;
        }
        ++accepted;
        std::printf("%-66s %s%s\n", name.c_str(), patchCounts(*mesh).c_str(), without.c_str());
        ASSERT_NO_FATAL_FAILURE(evaluate(cage, *mesh, totals));
    }
    for (const auto& [file, refusal] : expected) {
        ADD_FAILURE() << file << " should be refused: " << refusal.first << ": " << refusal.second;
    }
    EXPECT_EQ(degenerate, degenerateFaces());
    EXPECT_GE(shapes, 115u);

    std::printf("%zu files (%u of OpenSubdiv's shapes), %u taken, %u of several parts left out\n", paths.size(), shapes,
                accepted, leftAside);
    for (const auto& [reason, files] : refusals()) {
        std::printf("%u refused: %s\n", refused[reason], reason);
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
