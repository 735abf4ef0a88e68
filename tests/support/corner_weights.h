// What attributes are interpolated with, computed from the grid's own numbers: shaders/evaluate/attributes.comp again.
#pragma once

#include "tools/reference/grid.h"

#include <array>
#include <cstdint>

namespace supple::test {

/// Weights of the patch's corners at a sample: bilinear on quads, linear on triangles, linear between centre (the
/// corners' mean) and edge on pentagons; on polar domains linear towards the apex.
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
    default: {
        std::array<float, surface::kMaxSides> weights;
        weights.fill(v / 5.0f);
        weights[at.sector] += 1.0f - u - v;
        weights[(at.sector + 1) % 5] += u;
        return weights;
    }
    }
}

} // namespace supple::test
