// Levels and patches for tests of the level of detail: where the samples of a grid lie, by the same pattern words and
// float operations as the device.
#pragma once

#include "surface/lod/grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

namespace supple::surface::lod {

inline constexpr float kMaxLevel = 63.0f;

/// Where the words of each capacity begin.
inline constexpr std::array<uint32_t, shared::kCapacityCount> kFirstPatternWords{SUPPLE_LOD_FIRST_WORDS};

/// The index of the smallest capacity that is not below `level` (1..63).
inline uint32_t capacityIndexFor(float level) {
    const auto* const found = std::find_if(kCapacities.begin(), kCapacities.end(),
                                           [&](uint32_t capacity) { return static_cast<float>(capacity) >= level; });
    return static_cast<uint32_t>(std::min<std::ptrdiff_t>(found - kCapacities.begin(), kCapacities.size() - 1));
}

/// A level as the device stores it: a = (L - 1) / 2 and 1 / L.
struct LevelPair {
    float a = 0.0f;
    float inverse = 1.0f;
};
inline LevelPair levelPair(float level) {
    return {(level - 1.0f) * 0.5f, 1.0f / level};
}

/// A parameter and its complement. Sample capacity - i has the two swapped, bit for bit.
struct Parameter {
    float t = 0.0f;
    float s = 1.0f;
};
/// The parameter of sample i, 0..capacity, computed with the device's float32 operations.
inline Parameter parameter(uint32_t capacity, uint32_t i, LevelPair level) {
    static const std::vector<uint32_t> all = patternWords();
    const auto c = std::find(kCapacities.begin(), kCapacities.end(), capacity) - kCapacities.begin();
    const uint32_t* words = &all[kFirstPatternWords[static_cast<size_t>(c)]];
    const uint32_t pairs = (capacity - 1) / 2;
    const uint32_t whole = std::min(static_cast<uint32_t>(level.a), pairs);
    const uint32_t full = words[whole];
    const uint32_t fresh = words[std::min(whole + 1, pairs)] ^ full;
    const float growing = level.a - static_cast<float>(whole);

    const bool near = 2 * i <= capacity;
    const uint32_t passed = (1U << (near ? i : capacity - i)) - 1;
    const float x =
        (static_cast<float>(std::popcount(full & passed)) + ((fresh & passed) != 0 ? growing : 0.0f)) * level.inverse;
    const float y = 1.0f - x;
    return near ? Parameter{x, y} : Parameter{y, x};
}

/// A sample of a ring grid. For quads: side 0, ring j, k = i.
struct GridSample {
    uint32_t ring = 0;
    uint32_t side = 0;
    uint32_t k = 0;
};
inline GridSample gridSample(Form form, uint32_t capacity, uint32_t sample) {
    if (form == Form::quad) {
        return {sample / (capacity + 1), 0, sample % (capacity + 1)};
    }
    GridSample at;
    const auto inRing = [&] { return sides(form) * (capacity - 2 * at.ring); };
    for (; sample >= inRing(); ++at.ring) {
        sample -= inRing();
    }
    at.side = sample / (capacity - 2 * at.ring);
    at.k = at.ring + sample % (capacity - 2 * at.ring);
    return at;
}
/// The k-th sample (0..capacity) along side e, from corner e to the next corner.
inline uint32_t edgeSample(Form form, uint32_t capacity, uint32_t side, uint32_t k) {
    if (form != Form::quad) { // the outermost ring comes first
        return (side * capacity + k) % (sides(form) * capacity);
    }
    const uint32_t i[4] = {k, capacity, capacity - k, 0};
    const uint32_t j[4] = {0, k, capacity, capacity - k};
    return j[side] * (capacity + 1) + i[side];
}

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
