// Grids of the CPU against what the device writes: the same vertices in the same order.
#include "cage/topology.h"
#include "tests/support/cpu_group.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/prep_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

/// Of the extent. Normals beside corners that are not regular are taken differently.
constexpr double kMost = 1e-6;

struct Worst {
    double position = 0.0, degrees = 0.0;
    size_t vertices = 0, beyond = 0;
};

void compare(GpuSurface& gpu, CpuGroup& cpu, const std::string& name, Worst& worst) {
    ASSERT_TRUE(gpu.valid()) << name;
    ASSERT_TRUE(cpu.valid()) << name << ": " << (cpu.lines().empty() ? "" : cpu.lines().back());
    gpu.evaluate();
    std::vector<glm::vec3> cage = gpu.deformedCage(0);
    cage.resize(cpu.info().cageVertexCount); // what follows on the device is room
    const std::vector<glm::dvec3> exact(cage.begin(), cage.end());
    const double size = extent(exact);
    ASSERT_EQ(cpu.build(cage), SUPPLE_OK) << name;
    const uint32_t rate = gpu.output().grid.rate;
    const CpuGroup::Vertices own = cpu.evaluate(0, rate);
    const auto last = static_cast<uint32_t>(gpu.patches().size()) - 1;
    ASSERT_EQ(own.positions.size(), gpu.vertexIndex(last, gpu.sampleCount(last) - 1) + 1) << name;
    double position = 0.0;
    for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
        for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
            const GpuSurface::Vertex& vertex = gpu.vertex(0, p, s);
            const uint32_t index = gpu.vertexIndex(p, s);
            raise(position, glm::length(glm::dvec3(vertex.position - own.positions[index])) / size);
            const double degrees = angleDegrees(vertex.normal, own.normals[index]);
            raise(worst.degrees, degrees);
            worst.beyond += degrees > 1.0 ? 1 : 0;
            ++worst.vertices;
        }
    }
    EXPECT_LE(position, kMost) << name << " at rate " << rate;
    raise(worst.position, position);
}

/// `most`: of all normals, in degrees.
void report(const char* scheme, const Worst& worst, double most) {
    std::printf("%s: positions %.1e of the extent; normals %.2f degrees, %zu of %zu beyond 1\n", scheme, worst.position,
                worst.degrees, worst.beyond, worst.vertices);
    EXPECT_GT(worst.vertices, 900u);
    EXPECT_LE(worst.degrees, most) << scheme;
    EXPECT_LE(worst.beyond, worst.vertices / 200); // at corners where the limit has no normal, and one is taken inside
}

void compareCages(const char* label, GpuOptions gpu, CpuOptions cpu, const std::vector<SubdivisionCage>& cages,
                  std::initializer_list<uint32_t> rates, double most) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    cpu.scheme = gpu.scheme;
    cpu.rules = gpu.rules;
    cpu.corners = gpu.corners;
    gpu.flags = 0;
    Worst worst;
    size_t turn = 0;
    for (const SubdivisionCage& entry : cages) {
        gpu.rate = cpu.rate = rates.begin()[turn++ % rates.size()]; // each cage at one of them
        GpuSurface own(*device, entry.cage, gpu);
        CpuGroup group(entry.cage, cpu);
        ASSERT_NO_FATAL_FAILURE(compare(own, group, entry.name, worst));
    }
    report(label, worst, most);
}

std::vector<SubdivisionCage> quadCages() {
    return {{"cube", cube()},
            {"cube sphere", perturbed(cage::makeCubeSphere(4), 0.02f, 1)},
            {"split torus", perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2)},
            {"trapezohedron", perturbed(trapezohedron(7), 0.05f, 3)},
            {"open grid", perturbed(grid(4, 3), 0.1f, 4)},
            {"open fan", perturbed(fan(5, 3, 4.7, false), 0.02f, 5)},
            {"biped", perturbed(biped(), 0.05f, 6)}};
}

std::vector<SubdivisionCage> everyNth(const std::vector<SubdivisionCage>& all, size_t n, size_t first = 0) {
    std::vector<SubdivisionCage> some;
    for (size_t i = first; i < all.size(); i += n) {
        some.push_back(all[i]);
    }
    return some;
}

TEST(CpuEqualsDevice, PRep) {
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_PREP;
    compareCages("p-rep", options, {}, quadCages(), {8, 5, 13, 1}, 0.1);
    options.corners = SUPPLE_CORNERS_SMOOTH;
    compareCages("p-rep with smooth corners", options, {}, {{"open grid", perturbed(grid(4, 3), 0.1f, 4)}}, {8}, 5.0);
}

TEST(CpuEqualsDevice, Pm) {
    std::vector<SubdivisionCage> cages;
    for (const PmCage& entry : pmZoo()) {
        cages.push_back({entry.name + " " + pmVariantName(entry.variant), entry.cage});
    }
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_PM;
    compareCages("P_m", options, {}, everyNth(cages, 3), {8, 5, 12}, 5.0);
}

TEST(CpuEqualsDevice, CatmullClark) {
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    compareCages("Catmull-Clark", options, {}, everyNth(subdivisionZoo(), 3), {8, 6, 16}, 0.1);
}

TEST(CpuEqualsDevice, Loop) {
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_LOOP;
    compareCages("Loop", options, {}, everyNth(subdivisionZoo(), 3, 1), {8, 5, 16}, 0.1);
}

TEST(CpuEqualsDevice, Blend) {
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_BLEND;
    compareCages("blend", options, {}, everyNth(subdivisionZoo(), 4), {8, 6}, 0.05);
}

/// Without creases, or with endless ones that go on.
std::vector<SubdivisionCage> withoutSemiSharp(const std::vector<SubdivisionCage>& all) {
    std::vector<SubdivisionCage> some;
    for (const SubdivisionCage& entry : all) {
        if (entry.cage.creases.empty() && entry.cage.sharpVertices.empty()) {
            some.push_back(entry);
        }
    }
    cage::Cage box = perturbed(cage::makeCubeSphere(4), 0.02f, 1);
    const Result<cage::Topology> topology = cage::buildTopology(box);
    for (const cage::Topology::Edge& edge : topology->edges) { // all round the middle
        const uint32_t a = box.faceVertices[edge.corner], b = box.faceVertices[edge.twin];
        if (std::abs(box.positions[a].z) < 0.1f && std::abs(box.positions[b].z) < 0.1f) {
            box.creases.push_back({a, b, 1e9f});
        }
    }
    EXPECT_GE(box.creases.size(), 8u);
    some.push_back({"cube sphere with a crease", box});
    return some;
}

TEST(CpuEqualsDevice, Fragments) {
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_FRAGMENTS;
    compareCages("fragments", options, {}, withoutSemiSharp(subdivisionZoo()), {8, 16}, 2.0);
    options.rules = SUPPLE_RULES_LOOP;
    compareCages("fragments by Loop's rules", options, {}, withoutSemiSharp(subdivisionZoo()), {8, 4}, 8.0);
}

TEST(CpuEqualsDevice, CharactersInAPose) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    for (const char* file : {"pip_quads.glb", "wren.glb"}) {
        const std::string path = std::string(SUPPLE_SAMPLE_ASSETS) + "/" + file;
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_BLEND}) {
            GpuOptions gpu;
            gpu.scheme = scheme;
            gpu.flags = 0;
            CpuOptions cpu;
            cpu.scheme = scheme;
            GpuSurface own(*device, path, gpu);
            ASSERT_TRUE(own.valid());
            ASSERT_EQ(suppleSetClipPose(own.context().handle(), own.instance(0), 0, 0.4), SUPPLE_OK);
            CpuGroup group(path, cpu);
            Worst worst;
            ASSERT_NO_FATAL_FAILURE(compare(own, group, path, worst));
            report(file, worst, 0.2);
        }
    }
}

} // namespace
} // namespace supple::test
