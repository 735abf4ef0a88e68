// The blending surface on the device: against the reference, both mappings and crease modes, and the bits its patches
// share.
#include "surface/blend/reference.h"
#include "surface/stencil_reference.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/kernel_zoo.h"
#include "tests/support/meshes.h"
#include "tests/support/prep_surface.h"

#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

using surface::blend::CreaseMode;
using surface::blend::Mesh;

struct Param {
    SuppleMapping mapping = SUPPLE_MAPPING_NARROW;
    CreaseMode creases = CreaseMode::cut;

    friend std::ostream& operator<<(std::ostream& out, const Param& p) { return out << p.name(); }
    [[nodiscard]] std::string name() const {
        return std::string(mapping == SUPPLE_MAPPING_NARROW ? "Narrow" : "Wide") +
               (creases == CreaseMode::cut ? "Cut" : "Curve");
    }
};

class BlendOnGpu : public testing::TestWithParam<Param> {
protected:
    [[nodiscard]] GpuOptions options(uint32_t rate) const {
        GpuOptions options;
        options.mapping = GetParam().mapping;
        options.scheme = SUPPLE_SCHEME_BLEND;
        options.creases = GetParam().creases == CreaseMode::curve ? SUPPLE_CREASES_CURVE : SUPPLE_CREASES_CUT;
        options.rate = rate;
        options.flags = SUPPLE_GROUP_ATTRIBUTES;
        return options;
    }
    [[nodiscard]] static Mesh meshOf(const cage::Cage& cage) {
        Result<Mesh> mesh = surface::blend::buildMesh(cage, {GetParam().creases, 1.0f});
        if (!mesh.ok()) {
            ADD_FAILURE() << mesh.error().message;
            return {};
        }
        return std::move(*mesh);
    }
    /// The facet of every patch, and the patch of every facet (kNone for holes), of a group of one material.
    struct Patches {
        std::vector<uint32_t> faces, patches;
    };
    static Patches patchesOf(const Mesh& mesh, const GpuSurface& gpu) {
        Patches result;
        result.patches.assign(mesh.cage.faceCount(), cage::kNone);
        for (const SupplePatchClass patchClass : {SUPPLE_PATCH_BLEND, SUPPLE_PATCH_BLEND_SHARP}) {
            for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
                bool sharp = false;
                for (uint32_t c = 4 * f; c < 4 * f + 4; ++c) {
                    const auto& chartClass = mesh.classOf(mesh.corners[c].chart);
                    sharp = sharp || chartClass.creased() || chartClass.kind == surface::blend::ChartKind::point ||
                            surface::blend::flatAcross(mesh, c);
                }
                if (mesh.holes[f] == 0 && sharp == (patchClass == SUPPLE_PATCH_BLEND_SHARP)) {
                    result.patches[f] = static_cast<uint32_t>(result.faces.size());
                    result.faces.push_back(f);
                }
            }
        }
        EXPECT_EQ(result.faces.size(), gpu.patches().size());
        return result;
    }
};
INSTANTIATE_TEST_SUITE_P(Mappings, BlendOnGpu,
                         testing::Values(Param{SUPPLE_MAPPING_NARROW, CreaseMode::cut},
                                         Param{SUPPLE_MAPPING_WIDE, CreaseMode::cut},
                                         Param{SUPPLE_MAPPING_NARROW, CreaseMode::curve},
                                         Param{SUPPLE_MAPPING_WIDE, CreaseMode::curve}),
                         [](const auto& param) { return param.param.name(); });

bool sameBits(const glm::vec3& a, const glm::vec3& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

TEST_P(BlendOnGpu, SurfaceMatchesTheReference) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
        double worstPosition = 0.0;
        uint64_t samples = 0, differ = 0, steep = 0;
        const std::vector<KernelCage>& zoo = kernelZoo();
        for (size_t z = 0; z < zoo.size(); z += rate < 8 ? 1 : 4) {
            SCOPED_TRACE(zoo[z].name);
            const cage::Cage& cage = zoo[z].cage;
            const Mesh mesh = meshOf(cage);
            GpuSurface gpu(*device, cage, options(rate));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const uint32_t patchRate = mesh.refined ? (rate + 1) / 2 : rate;
            ASSERT_EQ(gpu.output().rate, patchRate);
            const auto [faces, patches] = patchesOf(mesh, gpu);
            const auto exact = surface::blend::construct<double>(
                mesh, surface::applyStencils<double>(mesh.stencils, doublePositions(cage)));
            const auto rounded =
                surface::blend::construct<float>(mesh, surface::applyStencils<float>(mesh.stencils, cage.positions));
            const surface::blend::Evaluator<double> reference(mesh, exact, patchRate);
            const surface::blend::Evaluator<float> floats(mesh, rounded, patchRate);
            for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
                ASSERT_EQ(gpu.patches()[p].face, mesh.sourceFaces[faces[p]]);
                for (uint32_t j = 0; j <= patchRate; ++j) {
                    for (uint32_t i = 0; i <= patchRate; ++i) {
                        const GpuSurface::Vertex& vertex = gpu.vertex(0, p, i, j);
                        const auto expected = reference.at(faces[p], i, j);
                        raise(worstPosition, glm::length(glm::dvec3(vertex.position) - expected.position) /
                                                 extent(doublePositions(cage)));
                        ++samples;
                        differ += sameBits(vertex.position, floats.at(faces[p], i, j).position + 0.0f) ? 0 : 1;
                        steep += angleDegrees(vertex.normal, expected.normal) > 0.05 ? 1 : 0;
                    }
                }
            }
        }
        std::printf(
            "rate %2u: %7llu samples, positions within %.1e of the extent, %llu differ from the float reference in "
            "some bit; %llu normals off by more than 0.05 degrees\n",
            rate, static_cast<unsigned long long>(samples), worstPosition, static_cast<unsigned long long>(differ),
            static_cast<unsigned long long>(steep));
        EXPECT_LE(worstPosition, 1e-6);
        EXPECT_EQ(differ, 0u);
        EXPECT_LE(static_cast<double>(steep), 1e-3 * static_cast<double>(samples));
    }
}

TEST_P(BlendOnGpu, BordersAgreeBitForBit) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    uint64_t samples = 0, different = 0;
    for (const KernelCage& entry : kernelZoo()) {
        const Mesh mesh = meshOf(entry.cage);
        for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
            GpuSurface gpu(*device, entry.cage, options(rate));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const Patches found = patchesOf(mesh, gpu);
            const uint32_t patchRate = gpu.output().rate;
            const auto onEdge = [&](uint32_t corner, uint32_t k) {
                return gpu
                    .vertex(0, found.patches[corner / 4],
                            surface::edgeSample(surface::Domain::quad, patchRate, corner % 4, k))
                    .position;
            };
            for (const cage::Topology::Edge& edge : mesh.topology.edges) {
                if (edge.twin == cage::kNone || found.patches[edge.corner / 4] == cage::kNone ||
                    found.patches[edge.twin / 4] == cage::kNone) {
                    continue;
                }
                for (uint32_t k = 0; k <= patchRate; ++k) {
                    ++samples;
                    different += sameBits(onEdge(edge.corner, k), onEdge(edge.twin, patchRate - k)) ? 0 : 1;
                }
            }
        }
    }
    std::printf("%llu border samples, %llu differ\n", static_cast<unsigned long long>(samples),
                static_cast<unsigned long long>(different));
    EXPECT_EQ(different, 0u);
    EXPECT_GT(samples, 0u);
}

} // namespace
} // namespace supple::test
