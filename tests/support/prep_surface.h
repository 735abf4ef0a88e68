// A whole p-rep surface on the CPU, with walks over its shared borders.
#pragma once

#include "tools/reference/prep.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace supple::test {

/// Angle between two directions in degrees; robust near 0 and 180.
inline double angleDegrees(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

/// The pair (k / rate, 1 - k / rate) of a sample, both correctly rounded.
template <class T>
glm::vec<2, T> parameterPair(uint32_t k, uint32_t rate) {
    return {T(k) / T(rate), T(rate - k) / T(rate)};
}

template <class T>
struct PrepSurface {
    using Vec = glm::vec<3, T>;

    PrepSurface(const cage::Cage& source, const std::vector<Vec>& positions, const surface::prep::Options& options = {})
        : cage(source) {
        Result<cage::Topology> built = cage::buildTopology(cage);
        if (!built.ok()) {
            ADD_FAILURE() << built.error().message;
            return;
        }
        topology = std::move(*built);
        coefficients = surface::prep::construct<T>(cage, topology, positions, options);
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            patches.push_back(surface::prep::gatherPatch<T>(cage, topology, coefficients, f, options));
        }
    }

    [[nodiscard]] surface::prep::Sample<T> at(uint32_t face, uint32_t i, uint32_t j, uint32_t rate) const {
        return surface::prep::evaluate(patches[face], parameterPair<T>(i, rate), parameterPair<T>(j, rate));
    }

    /// Sample k of `rate` on face edge `corner`, counted from the corner.
    [[nodiscard]] surface::prep::Sample<T> onEdge(uint32_t corner, uint32_t k, uint32_t rate) const {
        const uint32_t face = topology.cornerFaces[corner];
        switch (corner - cage.faceStarts[face]) {
        case 0:
            return at(face, k, 0, rate);
        case 1:
            return at(face, rate, k, rate);
        case 2:
            return at(face, rate - k, rate, rate);
        default:
            return at(face, 0, rate - k, rate);
        }
    }

    cage::Cage cage;
    cage::Topology topology;
    surface::prep::Coefficients<T> coefficients;
    std::vector<surface::prep::Patch<T>> patches;
};

} // namespace supple::test
