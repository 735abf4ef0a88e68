// Smooth texture coordinates of p-rep and P_m against the limits of Catmull-Clark over the same channel: at corners
// they are the same in every mode, and on regular patches everywhere.
#include "surface/prep/smooth_uvs.h"

#include "surface/fragments/smooth_uvs.h"
#include "surface/pm/smooth_uvs.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace supple::surface::prep {
namespace {

using cage::UvMode;

/// The positions from above, and faces of one half moved: a seam that passes vertices straight and at angles.
cage::Cage withSeam(cage::Cage cage) {
    cage.cornerUvs.clear();
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        float sum = 0.0f;
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            const glm::vec3 p = cage.positions[cage.faceVertices[c]];
            sum += p.x + 0.3f * p.y;
        }
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            const glm::vec3 p = cage.positions[cage.faceVertices[c]];
            cage.cornerUvs.emplace_back(p.x + 0.2f * p.z + (sum > 0.0f ? 3.0f : 0.0f), p.y - 0.1f * p.z);
        }
    }
    return cage;
}

/// Limits at (x, y) quarters of a face.
struct Limits {
    Limits(const cage::Cage& cage, UvMode mode) {
        std::vector<std::string> notes;
        const Result<RefinedMesh> begin = beginRefinement(cage, nullptr, notes);
        const auto made = fragments::limitUvs(*begin, cage.cornerUvs, {Subdivision::catmullClark, 1, 1, mode, true});
        EXPECT_TRUE(made);
        samples = *made;
    }
    /// Faces of the isolated mesh are quarters that begin at their corner.
    [[nodiscard]] glm::dvec2 at(uint32_t face, uint32_t x, uint32_t y) const {
        const uint32_t c = y <= 2 ? (x <= 2 ? 0 : 1) : x > 2 ? 2 : 3;
        const std::array<glm::uvec2, 4> local{{{x, y}, {y, 4 - x}, {4 - x, 4 - y}, {4 - y, x}}};
        return samples[size_t{9} * (4 * face + c) + 3 * local[c].y + local[c].x].value;
    }
    std::vector<fragments::UvSample> samples;
};

constexpr uint32_t kNetCorners[] = {0, 3, 15, 12};

TEST(PrepSmoothUvs, HaveTheLimitsOfCatmullClarkAtCorners) {
    const cage::Cage cage = withSeam(test::perturbed(test::biped(), 0.05f, 3));
    const cage::Topology topology = *cage::buildTopology(cage);
    const pm::Mesh mesh = *pm::buildMesh(cage);
    for (const UvMode mode : {UvMode::none, UvMode::cornersPlus1, UvMode::cornersPlus2, UvMode::boundaries}) {
        SCOPED_TRACE(cage::uvModeName(mode));
        const Limits limits(cage, mode);
        const Options options;
        const cage::UvChannel channel = *buildUvChannel(cage, topology, options, cage.cornerUvs, mode);
        const UvConstruction own(cage, topology, options, channel);
        const pm::UvConstruction ofPm(mesh, channel);
        double worst = 0.0;
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            const UvPatch patch = own.patch(f), other = ofPm.patch(f);
            const bool sectors = mesh.classes[f] != PatchClass::regular;
            for (uint32_t i = 0; i < 4; ++i) {
                const glm::dvec2 limit = limits.at(f, i == 1 || i == 2 ? 4 : 0, i >= 2 ? 4 : 0);
                worst = std::max(worst, glm::distance(patch.c[kNetCorners[i]], limit));
                worst = std::max(worst, glm::distance(other.c[sectors ? 1 + 6 * i : kNetCorners[i]], limit));
            }
        }
        EXPECT_LT(worst, 1e-12);
    }
}

TEST(PrepSmoothUvs, OfRegularPatchesAreTheLimits) {
    const cage::Cage cage = withSeam(test::perturbed(test::torus(8, 6), 0.05f, 3));
    const cage::Topology topology = *cage::buildTopology(cage);
    const Options options;
    const cage::UvChannel channel = *buildUvChannel(cage, topology, options, cage.cornerUvs, UvMode::cornersPlus1);
    const UvConstruction own(cage, topology, options, channel);
    const Limits limits(cage, UvMode::cornersPlus1);
    double worst = 0.0;
    uint32_t compared = 0;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        bool whole = true; // nothing is discontinuous at its corners
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            whole = whole && channel.rules[channel.cage.faceVertices[c]] == cage::UvChannel::Rule::match;
        }
        const UvPatch patch = own.patch(f);
        for (uint32_t y = 0; y <= 4 && whole; ++y) {
            for (uint32_t x = 0; x <= 4; ++x, ++compared) {
                const auto weights = [](double t) {
                    const double s = 1.0 - t;
                    return std::array{s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t};
                };
                const auto u = weights(0.25 * x), v = weights(0.25 * y);
                glm::dvec2 sum(0.0);
                for (uint32_t k = 0; k < 16; ++k) {
                    sum += u[k % 4] * v[k / 4] * patch.c[k];
                }
                worst = std::max(worst, glm::distance(sum, limits.at(f, x, y)));
            }
        }
    }
    EXPECT_GT(compared, 100u);
    EXPECT_LT(worst, 1e-12);
}

} // namespace
} // namespace supple::surface::prep
