// What attributes are interpolated with, computed from the grid's own numbers: shaders/evaluate/attributes.comp again.
#pragma once

#include "cpu/grid_sample.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace supple::test {

/// On the pentagon, bilinear on the five quads that a step of Catmull-Clark makes of it: `at` is searched for in the
/// quad of the nearest corner of a regular pentagon.
inline std::array<float, surface::kMaxSides> pentagonWeights(uint32_t sector, glm::dvec3 weights) {
    const auto corner = [](uint32_t k) {
        const double angle = 2.0 * std::numbers::pi / 5.0 * static_cast<double>(k);
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    const glm::dvec2 at = weights.x * corner(sector) + weights.y * corner(sector + 1);
    const uint32_t own = weights.x >= weights.y ? sector : (sector + 1) % 5, after = (own + 1) % 5,
                   before = (own + 4) % 5;
    const glm::dvec2 a = 0.5 * (corner(own) + corner(after)), b = 0.5 * (corner(own) + corner(before));
    const glm::dvec2 twist = corner(own) - a - b;
    glm::dvec2 p(0.5);
    for (int step = 0; step < 50; ++step) {
        const glm::dvec2 miss = at - (p.x * a + p.y * b + p.x * p.y * twist);
        p += glm::inverse(glm::dmat2(a + p.y * twist, b + p.x * twist)) * miss;
    }
    std::array<double, 5> exact;
    exact.fill((1.0 - p.x) * (1.0 - p.y) / 5.0);
    exact[own] += p.x * p.y + 0.5 * (p.x * (1.0 - p.y) + p.y * (1.0 - p.x));
    exact[after] += 0.5 * p.x * (1.0 - p.y);
    exact[before] += 0.5 * p.y * (1.0 - p.x);
    std::array<float, surface::kMaxSides> rounded{};
    std::ranges::transform(exact, rounded.begin(), [](double w) { return static_cast<float>(w); });
    return rounded;
}

/// Weights of the patch's corners at a sample: bilinear on quads, linear on triangles, on polar domains linear towards
/// the apex.
inline std::array<float, surface::kMaxSides> cornerWeights(surface::Domain domain, uint32_t rate, uint32_t sample) {
    const surface::GridSample at = surface::gridSample(domain, rate, sample);
    const float r = static_cast<float>(rate);
    const float u = static_cast<float>(at.i) / r, v = static_cast<float>(at.j) / r;
    switch (domain) {
    case surface::Domain::quad:
        return {(1.0f - u) * (1.0f - v), u * (1.0f - v), u * v, (1.0f - u) * v, 0.0f};
    case surface::Domain::polar:
        return {(1.0f - u) * (1.0f - v), u * (1.0f - v), v, 0.0f, 0.0f};
    case surface::Domain::triangle:
        return {1.0f - u - v, u, v, 0.0f, 0.0f};
    default:
        return pentagonWeights(at.sector, {(r - static_cast<float>(at.i + at.j)) / r, u, v});
    }
}

} // namespace supple::test
