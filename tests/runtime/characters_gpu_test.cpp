// Whole characters on the GPU under p-rep and P_m: skinning against the CPU skinner, surfaces against the
// double-precision reference, and what neighboring patches share: position bits and normals.
#include "skinning/pose.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_gpu.h"
#include "tests/support/pm_surface.h"
#include "tests/support/prep_surface.h"
#include "tests/support/shared_assets.h"
#include "tests/support/worst.h"

#include <array>
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
    if (pose.clip == SUPPLE_BIND_POSE) {
        return doublePositions(character.cage);
    }
    skinning::Pose sampled;
    skinning::sampleClip(character, character.clips[pose.clip], pose.time, sampled);
    return skinning::deformOnCpu(character, sampled);
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

constexpr uint32_t kRate = 8;

/// A scheme's surface in double. Facets are those of its cage, samples are numbered as the device does.
class PrepReference {
public:
    static constexpr SuppleScheme kScheme = SUPPLE_SCHEME_PREP;
    struct Sample {
        glm::dvec3 position, normal;
    };

    PrepReference(const cage::Cage& cage, const std::vector<glm::dvec3>& positions) : surface_(cage, positions) {}

    [[nodiscard]] const cage::Cage& cage() const { return surface_.cage; }
    [[nodiscard]] const cage::Topology& topology() const { return surface_.topology; }
    [[nodiscard]] bool smooth(uint32_t /*edge*/) const { return true; }
    [[nodiscard]] std::vector<uint32_t> patches(const GpuSurface& gpu) const {
        std::vector<uint32_t> patches(cage().faceCount());
        for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
            patches[gpu.patches()[p].face] = p;
        }
        return patches;
    }
    [[nodiscard]] surface::Domain domain(uint32_t /*facet*/) const { return surface::Domain::quad; }
    [[nodiscard]] uint32_t patchEdge(uint32_t corner) const {
        return corner - cage().faceStarts[topology().cornerFaces[corner]];
    }
    [[nodiscard]] Sample at(uint32_t facet, uint32_t sample) const {
        const auto s = surface_.at(facet, sample % (kRate + 1), sample / (kRate + 1), kRate);
        return {s.position, s.normal};
    }

private:
    PrepSurface<double> surface_;
};

class PmReference {
public:
    static constexpr SuppleScheme kScheme = SUPPLE_SCHEME_PM;

    PmReference(const cage::Cage& cage, const std::vector<glm::dvec3>& positions) : surface_(pmMesh(cage), positions) {}

    [[nodiscard]] const cage::Cage& cage() const { return surface_.mesh.cage; }
    [[nodiscard]] const cage::Topology& topology() const { return surface_.mesh.topology; }
    [[nodiscard]] bool smooth(uint32_t edge) const { return !surface_.mesh.features.hard(edge); }
    [[nodiscard]] std::vector<uint32_t> patches(const GpuSurface& gpu) const {
        const PmPatches found(gpu, surface_.mesh);
        std::vector<uint32_t> patches;
        for (uint32_t f = 0; f < cage().faceCount(); ++f) {
            patches.push_back(found.patch(f));
        }
        return patches;
    }
    [[nodiscard]] surface::Domain domain(uint32_t facet) const {
        return surface::domainOf(surface_.mesh.classes[facet]);
    }
    [[nodiscard]] uint32_t patchEdge(uint32_t corner) const { return surface_.patchEdge(corner); }
    [[nodiscard]] surface::pm::Sample<double> at(uint32_t facet, uint32_t sample) const {
        return surface_.at(facet, kRate, sample);
    }

private:
    PmSurface<double> surface_;
};

/// A character's group beside its reference in one pose.
template <class Reference>
struct Posed {
    const GpuSurface& gpu;
    const std::vector<uint32_t>& patches; ///< per facet
    uint32_t instance;
    Reference reference;

    [[nodiscard]] uint32_t facet(uint32_t corner) const { return reference.topology().cornerFaces[corner]; }
    [[nodiscard]] uint32_t edgeSample(uint32_t corner, uint32_t k) const {
        return surface::edgeSample(reference.domain(facet(corner)), kRate, reference.patchEdge(corner), k);
    }
    [[nodiscard]] const GpuSurface::Vertex& vertex(uint32_t f, uint32_t sample) const {
        return gpu.vertex(instance, patches[f], sample);
    }
    [[nodiscard]] const GpuSurface::Vertex& onEdge(uint32_t corner, uint32_t k) const {
        return vertex(facet(corner), edgeSample(corner, k));
    }
    /// Degrees between the device's normal and the reference's.
    [[nodiscard]] double normalError(uint32_t corner, uint32_t k) const {
        return angleDegrees(onEdge(corner, k).normal, reference.at(facet(corner), edgeSample(corner, k)).normal);
    }

    /// Areas of the grid's triangles: the smallest at a sample, and the mean over all.
    [[nodiscard]] double smallestTriangle(uint32_t f, uint32_t sample) const {
        double smallest = std::numeric_limits<double>::infinity();
        forTriangles(f, [&](const std::array<uint32_t, 3>& corners, double area) {
            if (std::find(corners.begin(), corners.end(), sample) != corners.end()) {
                smallest = std::min(smallest, area);
            }
        });
        return smallest;
    }
    [[nodiscard]] double meanTriangle() const {
        double sum = 0.0;
        uint64_t count = 0;
        for (uint32_t f = 0; f < reference.cage().faceCount(); ++f) {
            forTriangles(f, [&](const std::array<uint32_t, 3>&, double area) {
                sum += area;
                ++count;
            });
        }
        return sum / static_cast<double>(count);
    }

private:
    template <class Visit>
    void forTriangles(uint32_t f, const Visit& visit) const {
        const std::vector<uint16_t> indices = surface::gridIndices(reference.domain(f), kRate);
        for (size_t i = 0; i < indices.size(); i += 3) {
            const std::array<uint32_t, 3> corners = {indices[i], indices[i + 1], indices[i + 2]};
            const glm::dvec3 a = vertex(f, corners[0]).position;
            visit(corners, 0.5 * glm::length(glm::cross(glm::dvec3(vertex(f, corners[1]).position) - a,
                                                        glm::dvec3(vertex(f, corners[2]).position) - a)));
        }
    }
};

struct Comparison {
    double skin = 0.0, positions = 0.0; ///< of the extent
    Angles normals;                     ///< all samples compared, against the reference
    Angles borders;                     ///< those of them that two patches share over a smooth edge
    Angles across;                      ///< between the two sides, on all smooth edges
    ComparedBits bits;                  ///< on all edges, hard ones too
    std::string listed;                 ///< the samples above
};

/// A large cage's reference is slow: every eighth facet then.
template <class Reference>
void compareFacets(const Posed<Reference>& posed, double size, Comparison& result) {
    const Reference& reference = posed.reference;
    const cage::Cage& cage = reference.cage();
    const cage::Topology& topology = reference.topology();
    for (uint32_t f = 0; f<cage.faceCount(); f += cage.faceCount()> 4000 ? 8 : 1) {
        const uint32_t samples = surface::sampleCount(reference.domain(f), kRate);
        std::vector<uint8_t> shared(samples, 0);
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            const bool border = topology.twins[c] != cage::kNone && reference.smooth(topology.cornerEdges[c]);
            for (uint32_t k = 0; k <= kRate && border; ++k) {
                shared[posed.edgeSample(c, k)] = 1;
            }
        }
        for (uint32_t s = 0; s < samples; ++s) {
            const auto expected = reference.at(f, s);
            const GpuSurface::Vertex& vertex = posed.vertex(f, s);
            raise(result.positions, glm::length(glm::dvec3(vertex.position) - expected.position) / size);
            const double angle = angleDegrees(vertex.normal, expected.normal);
            result.normals.add(angle);
            if (shared[s] != 0) {
                result.borders.add(angle);
            }
        }
    }
}

template <class Reference>
void compareSides(const Posed<Reference>& posed, Comparison& result) {
    const cage::Topology& topology = posed.reference.topology();
    double meanTriangle = 0.0;
    for (uint32_t e = 0; e < topology.edges.size(); ++e) {
        const cage::Topology::Edge& edge = topology.edges[e];
        if (edge.twin == cage::kNone) {
            continue;
        }
        for (uint32_t k = 0; k <= kRate; ++k) {
            const GpuSurface::Vertex& a = posed.onEdge(edge.corner, k);
            const GpuSurface::Vertex& b = posed.onEdge(edge.twin, kRate - k);
            result.bits.compare(a.position, b.position);
            if (!posed.reference.smooth(e)) {
                continue;
            }
            const double angle = angleDegrees(a.normal, b.normal);
            result.across.add(angle);
            if (angle > 0.05 && result.listed.size() < 20000) {
                meanTriangle = meanTriangle > 0.0 ? meanTriangle : posed.meanTriangle();
                const uint32_t f = posed.facet(edge.corner);
                char line[200];
                std::snprintf(line, sizeof(line),
                              "    pose %u, face %u, edge %u, sample %u: %.3f degrees, %.3f and %.3f off the "
                              "reference, smallest triangle there %.1e of the mean\n",
                              posed.instance, posed.gpu.patches()[posed.patches[f]].face, e, k, angle,
                              posed.normalError(edge.corner, k), posed.normalError(edge.twin, kRate - k),
                              posed.smallestTriangle(f, posed.edgeSample(edge.corner, k)) / meanTriangle);
                result.listed += line;
            }
        }
    }
}

template <class Reference>
void compareCharacter(host::Device& device, const std::string& path, const cage::Character& character) {
    const std::string name = std::filesystem::path(path).filename();
    const std::vector<Pose> poses = posesOf(character);
    GpuOptions options;
    options.scheme = Reference::kScheme;
    options.instanceCount = static_cast<uint32_t>(poses.size());
    options.rate = kRate;
    options.flags = 0;
    GpuSurface gpu(device, path, options);
    ASSERT_TRUE(gpu.valid());
    for (uint32_t i = 0; i < poses.size(); ++i) {
        ASSERT_EQ(suppleSetClipPose(gpu.context().handle(), gpu.instance(i), poses[i].clip, poses[i].time), SUPPLE_OK);
    }
    gpu.evaluate();

    Comparison result;
    std::vector<uint32_t> patches;
    for (uint32_t instance = 0; instance < poses.size(); ++instance) {
        const std::vector<glm::dvec3> deformed = deformedOnCpu(character, poses[instance]);
        const double size = extent(deformed);
        for (uint32_t v = 0; v < deformed.size(); ++v) {
            raise(result.skin, glm::length(glm::dvec3(gpu.deformed(instance, v)) - deformed[v]) / size);
        }
        const Posed<Reference> posed{gpu, patches, instance, Reference(character.cage, deformed)};
        if (instance == 0) {
            patches = posed.reference.patches(gpu);
        }
        compareFacets(posed, size, result);
        compareSides(posed, result);
    }
    std::printf("%-24s %2zu poses: skin %.1e, positions %.1e of the extent; normals %.4f %% within 0.05, max %.3f, on "
                "borders %.4f %%; across borders %.4f %% within 0.05, mean %.5f, max %.3f degrees; %llu of %llu border "
                "samples differ\n",
                name.c_str(), poses.size(), result.skin, result.positions, 100.0 * result.normals.withinShare(),
                result.normals.worst, 100.0 * result.borders.withinShare(), 100.0 * result.across.withinShare(),
                result.across.mean(), result.across.worst, static_cast<unsigned long long>(result.bits.different),
                static_cast<unsigned long long>(result.bits.samples));
    if (!result.listed.empty()) {
        std::printf("  %llu samples above 0.05 degrees across borders:\n%s",
                    static_cast<unsigned long long>(result.across.above), result.listed.c_str());
    }
    EXPECT_LE(result.skin, 1e-5);
    EXPECT_LE(result.positions, 1e-5);
    EXPECT_GE(result.normals.withinShare(), 0.999);
    EXPECT_GE(result.borders.withinShare(), 0.999);
    EXPECT_GE(result.across.withinShare(), 0.999);
    if (character.damages.empty()) { // where sheets were cut, edges are hard
        EXPECT_LE(result.across.mean(), 0.003);
        EXPECT_LE(result.across.worst, 0.05);
    }
    EXPECT_EQ(result.bits.different, 0u);
}

TEST(CharactersOnGpu, Prep) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    forEachCharacter(allQuadCharacters(), [&](const std::string& path, const cage::Character& character) {
        compareCharacter<PrepReference>(*device, path, character);
    });
}

/// Whatever their polygons and creases.
TEST(CharactersOnGpu, Pm) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    forEachCharacter(allCharacters(), [&](const std::string& path, const cage::Character& character) {
        const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(character.cage);
        if (!mesh.ok()) { // tests/runtime/assets_table_test.cpp says which these are
            std::printf("refused: %s: %s\n", path.c_str(), mesh.error().message.c_str());
            return;
        }
        compareCharacter<PmReference>(*device, path, character);
    });
}

} // namespace
} // namespace supple::test
