// Levels and patches for tests of the level of detail.
#pragma once

#include "surface/lod/grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace supple::surface::lod {

/// Spread evenly over octaves, with the awkward ones among them: 1, hardly more, odd integers and hardly more.
inline float randomLevel(std::mt19937& random, float highest) {
    const float level = std::exp(std::uniform_real_distribution<float>(0.0f, std::log(highest))(random));
    const float odd = 2.0f * std::floor((level - 1.0f) / 2.0f) + 1.0f;
    switch (random() % 10) {
    case 0:
        return 1.0f;
    case 1:
        return std::min(std::nextafter(1.0f, 2.0f), highest);
    case 2:
        return odd;
    case 3:
        return std::min(std::nextafter(odd, 64.0f), highest);
    case 4:
        return std::min(odd + 1e-4f, highest);
    default:
        return std::clamp(level, 1.0f, highest);
    }
}

/// A quad's levels: of its edges and of its inside along u and v.
struct QuadLevels {
    std::array<float, 4> edges{};
    float u = 1.0f;
    float v = 1.0f;
};

inline QuadLevels quadLevels(const std::array<float, 4>& edges, float ownU = 1.0f, float ownV = 1.0f) {
    const float highest = std::max({edges[0], edges[1], edges[2], edges[3], ownU, ownV});
    const float least = std::min(3.0f, highest);
    return {edges, std::max({edges[0], edges[2], ownU, least}), std::max({edges[1], edges[3], ownV, least})};
}

/// Parameters (u, v) of sample (i, j) of a quad.
inline std::array<Parameter, 2> quadParameters(uint32_t capacity, uint32_t i, uint32_t j, const QuadLevels& levels) {
    const float alongU = j == 0 ? levels.edges[0] : j == capacity ? levels.edges[2] : levels.u;
    const float alongV = i == capacity ? levels.edges[1] : i == 0 ? levels.edges[3] : levels.v;
    return {parameter(capacity, i, levelPair(alongU)), parameter(capacity, j, levelPair(alongV))};
}

} // namespace supple::surface::lod
