// Whole characters on the GPU: skinning against the CPU skinner, surfaces against the double-precision reference, and
// what neighbouring patches share: position bits and normals.
#include "cage/gltf_reader.h"
#include "skinning/pose.h"
#include "surface/prep/reference.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/meshes.h"
#include "tests/support/prep_surface.h"
#include "tests/support/shared_assets.h"

#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

struct Pose {
    uint32_t clip = SUPPLE_BIND_POSE;
    double time = 0.0;
};

/// The bind pose and three times of each clip.
std::vector<Pose> posesOf(const cage::Character& character) {
    std::vector<Pose> poses = {{}};
    for (uint32_t clip = 0; clip < character.clips.size(); ++clip) {
        for (const double fraction : {0.15, 0.4, 0.75}) {
            poses.push_back({clip, fraction * character.clips[clip].duration});
        }
    }
    return poses;
}

std::vector<glm::dvec3> deformedOnCpu(const cage::Character& character, const Pose& pose) {
    std::vector<skinning::Affine> palette(character.skin.joints.size(), skinning::toAffine(glm::mat4(1.0f)));
    if (pose.clip != SUPPLE_BIND_POSE) {
        std::vector<glm::mat4> nodes(character.skeleton.nodes.size());
        skinning::sampleClip(character.skeleton, character.clips[pose.clip], pose.time, nodes);
        skinning::globalTransforms(character.skeleton, nodes, nodes);
        skinning::jointPalette(character.skin, nodes, glm::mat4(1.0f), palette);
    }
    return skinning::deformOnCpu(character.cage, character.weights, palette);
}

/// How many of many small angles exceed a bound, and which is the largest.
struct Angles {
    uint64_t samples = 0, above = 0;
    double sum = 0.0, worst = 0.0;
    void add(double degrees) {
        ++samples;
        above += degrees <= 0.05 ? 0 : 1;
        sum += degrees;
        raise(worst, degrees);
    }
    [[nodiscard]] double mean() const { return samples == 0 ? 0.0 : sum / static_cast<double>(samples); }
    [[nodiscard]] double withinShare() const {
        return samples == 0 ? 1.0 : 1.0 - static_cast<double>(above) / static_cast<double>(samples);
    }
};

TEST(CharactersOnGpu, SkinSurfaceAndBorders) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    constexpr uint32_t kRate = 8;
    for (const std::string& path : allQuadCharacters()) {
        const std::string name = std::filesystem::path(path).filename();
        Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        const cage::Cage& cage = character->cage;
        Result<cage::Topology> topology = cage::buildTopology(cage);
        ASSERT_TRUE(topology.ok()) << name << ": " << topology.error().message;

        const std::vector<Pose> poses = posesOf(*character);
        GpuOptions options;
        options.instanceCount = static_cast<uint32_t>(poses.size());
        options.rate = kRate;
        options.flags = 0;
        GpuSurface gpu(*device, path, options);
        ASSERT_TRUE(gpu.valid()) << name;
        for (uint32_t i = 0; i < poses.size(); ++i) {
            ASSERT_EQ(suppleSetClipPose(gpu.context().handle(), gpu.group(), i, poses[i].clip, poses[i].time),
                      SUPPLE_OK);
        }
        gpu.evaluate();

        std::vector<uint32_t> patchOfFace(cage.faceCount());
        for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
            patchOfFace[gpu.patches()[p].face] = p;
        }
        // The reference is slow; a large cage is compared at every eighth patch, its borders everywhere.
        const uint32_t step = cage.faceCount() > 4000 ? 8 : 1;
        double skin = 0.0, positions = 0.0;
        uint64_t differentBits = 0, borderSamples = 0;
        Angles normals, across;
        std::string listed;
        for (uint32_t instance = 0; instance < poses.size(); ++instance) {
            const std::vector<glm::dvec3> deformed = deformedOnCpu(*character, poses[instance]);
            const double size = extent(deformed);
            for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
                raise(skin, glm::length(glm::dvec3(gpu.deformed(instance, v)) - deformed[v]) / size);
            }

            const auto coefficients = surface::prep::construct<double>(cage, *topology, deformed, {});
            double area = 0.0;
            uint64_t areaSamples = 0;
            for (uint32_t face = 0; face < cage.faceCount(); face += step) {
                const auto patch = surface::prep::gatherPatch<double>(cage, *topology, coefficients, face, {});
                for (uint32_t j = 0; j <= kRate; ++j) {
                    for (uint32_t i = 0; i <= kRate; ++i) {
                        const auto sample = surface::prep::evaluate<double>(patch, parameterPair<double>(i, kRate),
                                                                            parameterPair<double>(j, kRate));
                        const GpuSurface::Vertex& vertex = gpu.vertex(instance, patchOfFace[face], i, j);
                        raise(positions, glm::length(glm::dvec3(vertex.position) - sample.position) / size);
                        normals.add(angleDegrees(vertex.normal, sample.normal));
                        area += glm::length(glm::cross(sample.du, sample.dv));
                        ++areaSamples;
                    }
                }
            }
            const double meanArea = area / static_cast<double>(areaSamples);

            for (const cage::Topology::Edge& edge : topology->edges) {
                if (edge.twin == cage::kNone) {
                    continue;
                }
                for (uint32_t k = 0; k <= kRate; ++k) {
                    const auto at = [&](uint32_t corner, uint32_t sample) -> const GpuSurface::Vertex& {
                        const uint32_t face = topology->cornerFaces[corner];
                        const glm::uvec2 grid = edgeSample(corner - cage.faceStarts[face], sample, kRate);
                        return gpu.vertex(instance, patchOfFace[face], grid.x, grid.y);
                    };
                    const GpuSurface::Vertex &a = at(edge.corner, k), &b = at(edge.twin, kRate - k);
                    ++borderSamples;
                    differentBits += std::memcmp(&a.position, &b.position, sizeof(a.position)) != 0 ? 1 : 0;
                    const double angle = angleDegrees(a.normal, b.normal);
                    across.add(angle);
                    if (angle > 0.05 && listed.size() < 20000) {
                        const uint32_t face = topology->cornerFaces[edge.corner];
                        const auto patch = surface::prep::gatherPatch<double>(cage, *topology, coefficients, face, {});
                        const glm::uvec2 grid = edgeSample(edge.corner - cage.faceStarts[face], k, kRate);
                        const auto sample = surface::prep::evaluate<double>(patch, parameterPair<double>(grid.x, kRate),
                                                                            parameterPair<double>(grid.y, kRate));
                        char line[160];
                        std::snprintf(line, sizeof(line),
                                      "    pose %u, face %u, sample %u: %.3f degrees, |Du x Dv| %.1e of the mean\n",
                                      instance, face, k, angle,
                                      glm::length(glm::cross(sample.du, sample.dv)) / meanArea);
                        listed += line;
                    }
                }
            }
        }
        std::printf(
            "%-24s %2zu poses: skin %.1e, positions %.1e of the extent; normals %.4f %% within 0.05, max %.3f; across "
            "borders %.4f %% within 0.05, mean %.5f, max %.3f degrees; %llu of %llu border samples differ\n",
            name.c_str(), poses.size(), skin, positions, 100.0 * normals.withinShare(), normals.worst,
            100.0 * across.withinShare(), across.mean(), across.worst, static_cast<unsigned long long>(differentBits),
            static_cast<unsigned long long>(borderSamples));
        if (!listed.empty()) {
            std::printf("  %llu samples above 0.05 degrees across borders:\n%s",
                        static_cast<unsigned long long>(across.above), listed.c_str());
        }
        EXPECT_LE(skin, 1e-5) << name;
        EXPECT_LE(positions, 1e-5) << name;
        EXPECT_GE(normals.withinShare(), 0.999) << name;
        EXPECT_GE(across.withinShare(), 0.999) << name;
        EXPECT_LE(across.mean(), 0.003) << name;
        EXPECT_EQ(differentBits, 0u) << name;
    }
}

} // namespace
} // namespace supple::test
