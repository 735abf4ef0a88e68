// The blending surface in float: what two faces share, to the bit, and how far it is from the one in double.
#pragma once

#include "tests/support/blend_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <vector>

namespace supple::test {

/// Bits, with the two zeros as one: what is 0 may come out as either.
inline bool sameBits(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i) {
        if (std::bit_cast<uint32_t>(a[i] + 0.0f) != std::bit_cast<uint32_t>(b[i] + 0.0f)) {
            return false;
        }
    }
    return true;
}

struct BlendCounts {
    uint64_t points = 0, differ = 0; ///< samples on edges from both sides, vertices from every face
};

inline void compareSides(const cage::Cage& cage, const surface::blend::Mesh& mesh, std::span<const uint32_t> rates,
                         BlendCounts& counts) {
    const BlendSurface<float> blended(mesh, cage.positions);
    for (const uint32_t rate : rates) {
        const surface::blend::Evaluator<float> evaluator = blended.at(rate);
        std::vector<glm::vec3> points; // half-edge by half-edge
        for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
            for (uint32_t k = 0; k <= rate; ++k) {
                const auto [i, j] = onEdge(c, k, rate);
                points.push_back(evaluator.at(c / 4, i, j).position);
            }
        }
        const auto at = [&](uint32_t corner, uint32_t k) { return points[corner * (rate + 1) + k]; };
        for (const cage::Topology::Edge& edge : mesh.topology.edges) {
            for (uint32_t k = 0; edge.twin != cage::kNone && k <= rate; ++k) {
                ++counts.points;
                counts.differ += sameBits(at(edge.corner, k), at(edge.twin, rate - k)) ? 0 : 1;
            }
        }
        std::map<uint32_t, glm::vec3> vertices;
        for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
            const auto [first, fresh] = vertices.emplace(mesh.cage.faceVertices[c], at(c, 0));
            ++counts.points;
            counts.differ += sameBits(first->second, at(c, 0)) ? 0 : 1;
        }
    }
}

struct BlendErrors {
    double position = 0.0;            ///< by the extent
    uint64_t normals = 0, turned = 0; ///< and those more than 0.05 degrees from their place
    uint64_t notOfUnitLength = 0;
};

/// Float against double.
inline void compareFloats(const cage::Cage& cage, const surface::blend::Mesh& mesh, BlendErrors& errors) {
    constexpr uint32_t kRate = 8;
    const std::vector<glm::dvec3> positions = doublePositions(cage);
    const BlendSurface<float> blended(mesh, cage.positions);
    const BlendSurface<double> exact(mesh, positions);
    const surface::blend::Evaluator<float> evaluator = blended.at(kRate);
    const surface::blend::Evaluator<double> reference = exact.at(kRate);
    const double size = extent(positions);
    constexpr uint32_t kSide = kRate + 1;
    for (uint32_t n = 0; n < kSide * kSide * mesh.cage.faceCount(); ++n) {
        const uint32_t f = n / (kSide * kSide), i = n % kSide, j = n / kSide % kSide;
        const surface::blend::Sample<float> a = evaluator.at(f, i, j);
        const surface::blend::Sample<double> b = reference.at(f, i, j);
        errors.position = std::max(errors.position, glm::distance(b.position, glm::dvec3(a.position)) / size);
        const glm::dvec3 normal(a.normal);
        errors.notOfUnitLength += std::abs(glm::length(normal) - 1.0) < 1e-6 ? 0 : 1;
        ++errors.normals;
        errors.turned += glm::distance(normal, b.normal) < 0.05 * std::numbers::pi / 180.0 ? 0 : 1;
    }
}

} // namespace supple::test
