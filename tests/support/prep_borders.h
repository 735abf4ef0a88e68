// Measures what neighboring patches share: the tangent plane in double, the bits in float.
#pragma once

#include "tests/support/prep_surface.h"
#include "tests/support/worst.h"

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace supple::test {

struct Posed {
    std::string name;
    cage::Cage cage;
    std::vector<glm::dvec3> positions;
    surface::prep::Options options;
};

/// Where |Du x Dv| falls below this fraction of (patch size)^2 the surface is folded or pinched and has no normal that
/// double precision could measure to 1e-6 degrees: such samples are listed apart.
inline constexpr double kFoldedArea = 1e-7;

struct G1Result {
    uint64_t samples = 0;
    double worst = 0.0; ///< degrees, over the samples with a measurable normal
    uint64_t folded = 0;
    double worstFolded = 0.0;
    double smallestFolded = 1.0; ///< the smallest |Du x Dv| / size^2 met
};

/// Normal angles at the samples of `rate` over every interior edge.
inline G1Result measureG1(const Posed& posed, uint32_t rate) {
    const PrepSurface<double> surface(posed.cage, posed.positions, posed.options);
    G1Result result;
    for (const cage::Topology::Edge& edge : surface.topology.edges) {
        if (edge.twin == cage::kNone) {
            continue;
        }
        for (uint32_t k = 0; k <= rate; ++k) {
            const surface::prep::Sample<double> a = surface.onEdge(edge.corner, k, rate);
            const surface::prep::Sample<double> b = surface.onEdge(edge.twin, rate - k, rate);
            const glm::dvec3 na = glm::cross(a.du, a.dv);
            const glm::dvec3 nb = glm::cross(b.du, b.dv);
            double size = 0.0;
            for (const uint32_t corner : {edge.corner, edge.twin}) {
                const auto& g = surface.patches[surface.topology.cornerFaces[corner]].g;
                size = std::max({size, glm::distance(g[0], g[15]), glm::distance(g[3], g[12])});
            }
            const double area = std::min(glm::length(na), glm::length(nb)) / (size * size);
            const double angle = test::angleDegrees(na, nb);
            ++result.samples;
            if (!(area < kFoldedArea)) { // a NaN is not folded, it is wrong
                raise(result.worst, angle);
            } else {
                ++result.folded;
                raise(result.worstFolded, angle);
                result.smallestFolded = std::min(result.smallestFolded, area);
            }
        }
    }
    return result;
}

/// Prints the result and expects the largest angle within 1e-6 degrees.
inline void expectG1(const Posed& posed, uint32_t rate = 32) {
    const G1Result r = measureG1(posed, rate);
    std::printf("%-44s %8llu samples, max %.1e degrees", posed.name.c_str(), static_cast<unsigned long long>(r.samples),
                r.worst);
    if (r.folded > 0) {
        std::printf("; folded: %llu, max %.1e degrees, smallest area %.1e", static_cast<unsigned long long>(r.folded),
                    r.worstFolded, r.smallestFolded);
    }
    std::printf("\n");
    EXPECT_LE(r.worst, 1e-6) << posed.name;
}

/// Counts border samples that differ in any bit between the two sides of an edge.
struct BitResult {
    uint64_t samples = 0;
    uint64_t different = 0;
};

inline BitResult measureBits(const cage::Cage& cage, const std::vector<glm::vec3>& positions,
                             const surface::prep::Options& options,
                             const std::vector<uint32_t>& rates = {1, 2, 3, 5, 7, 8, 17, 64}) {
    const PrepSurface<float> surface(cage, positions, options);
    BitResult result;
    for (const cage::Topology::Edge& edge : surface.topology.edges) {
        if (edge.twin == cage::kNone) {
            continue;
        }
        for (const uint32_t rate : rates) {
            for (uint32_t k = 0; k <= rate; ++k) {
                const glm::vec3 a = surface.onEdge(edge.corner, k, rate).position;
                const glm::vec3 b = surface.onEdge(edge.twin, rate - k, rate).position;
                ++result.samples;
                result.different += std::memcmp(&a, &b, sizeof a) != 0 ? 1 : 0;
            }
        }
    }
    return result;
}

/// Normal angles over interior edges in float.
struct FloatNormals {
    uint64_t samples = 0;
    uint64_t above = 0; ///< samples above 0.05 degrees
    double worst = 0.0; ///< degrees
};

inline FloatNormals measureFloatNormals(const cage::Cage& cage, const std::vector<glm::vec3>& positions,
                                        const surface::prep::Options& options, uint32_t rate) {
    const PrepSurface<float> surface(cage, positions, options);
    FloatNormals result;
    for (const cage::Topology::Edge& edge : surface.topology.edges) {
        for (uint32_t k = 0; k <= rate && edge.twin != cage::kNone; ++k) {
            const double angle = angleDegrees(surface.onEdge(edge.corner, k, rate).normal,
                                              surface.onEdge(edge.twin, rate - k, rate).normal);
            ++result.samples;
            result.above += angle <= 0.05 ? 0 : 1;
            raise(result.worst, angle);
        }
    }
    return result;
}

} // namespace supple::test
