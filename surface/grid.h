// Tessellation grids at an integer rate: how the samples of a patch are numbered, which triangles lie between them, and
// the parameters of samples.
#pragma once

#include "shaders/shared/surface.h"

#include <cstdint>
#include <vector>

namespace supple::surface {

inline constexpr uint32_t kMaxRate = 64; ///< segments along a patch edge
inline constexpr uint32_t kMaxSides = 5; ///< of a patch

/// The domains of patches. Samples are counted by integers 0..rate; R is the rate.
///
///   quad      (R+1)^2 samples (i, j), u = i/R, v = j/R, u fastest. Corners (0,0) (R,0) (R,R) (0,R).
///   polar     the same samples; the side v = 1 is one point, corner 2. Corners (0,0) (R,0) (.,R).
///   triangle  (R+1)(R+2)/2 samples, rows j = 0..R parallel to edge 0, each i = 0..R-j: barycentric weights
///             (R-i-j, i, j)/R of corners 0, 1, 2.
///   pentagon  5 R(R+1)/2 + 1 samples. Sector after sector; sector s lies between edge s and the centre. It has rows
///             j = 0..R-1 parallel to the edge, each i = 0..R-j-1: weights (R-i-j, i, j)/R of corner s, corner s+1 and
///             the centre. The last point of a row belongs to sector s+1. The last sample is the centre.
enum class Domain : uint32_t {
    quad = shared::kQuadDomain,
    polar = shared::kPolarDomain,
    triangle = shared::kTriangleDomain,
    pentagon = shared::kPentagonDomain
};
inline constexpr uint32_t kDomainCount = 4;

[[nodiscard]] constexpr uint32_t cornerCount(Domain domain) {
    return domain == Domain::pentagon ? 5 : domain == Domain::quad ? 4 : 3;
}

[[nodiscard]] constexpr uint32_t sampleCount(Domain domain, uint32_t rate) {
    switch (domain) {
    case Domain::triangle:
        return (rate + 1) * (rate + 2) / 2;
    case Domain::pentagon:
        return 5 * rate * (rate + 1) / 2 + 1;
    default:
        return (rate + 1) * (rate + 1);
    }
}

/// The k-th sample (0..rate) along edge e of the domain, from corner e to the next corner. Polar domains: edge 0 is the
/// outer one, 1 and 2 are radial.
[[nodiscard]] uint32_t edgeSample(Domain domain, uint32_t rate, uint32_t edge, uint32_t k);

/// Triangles between the samples, counter-clockwise seen from outside, none of zero area. They serve all patches of the
/// domain at this rate.
[[nodiscard]] std::vector<uint16_t> gridIndices(Domain domain, uint32_t rate);

/// The pairs (k / rate, (rate - k) / rate), k = 0..rate, correctly rounded, for rates 1..kMaxRate one after the other:
/// those of a rate from SUPPLE_FIRST_PAIR on (shaders/shared/surface.h).
[[nodiscard]] std::vector<float> parameterPairs();

} // namespace supple::surface
