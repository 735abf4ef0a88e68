#include "surface/lod/pattern.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace supple::surface::lod {

namespace {

constexpr uint32_t pairsOf(uint32_t capacity) {
    return (capacity - 1) / 2;
}

constexpr bool firstWordsFollow() {
    uint32_t next = 0;
    bool follow = true;
    for (size_t c = 0; c < kFirstPatternWords.size(); ++c) {
        follow = follow && kFirstPatternWords[c] == next && SUPPLE_LOD_FIRST_WORD(c) == next &&
                 SUPPLE_LOD_CAPACITY(c) == kCapacities[c];
        next += pairsOf(kCapacities[c]) + 1;
    }
    return follow && next == shared::kPatternWordCount;
}
static_assert(firstWordsFollow());

constexpr uint32_t kMostPairs = pairsOf(kCapacities.back());

/// Rank in the order of birth of segment j from the corner, where all 32 had one: the bits of j reversed, so that each
/// new segment splits the widest run of missing ones and the corner's comes first.
constexpr uint32_t spread(uint32_t j) {
    uint32_t rank = 0;
    for (uint32_t bit = 0; bit < 5; ++bit) {
        rank = rank << 1 | (j >> bit & 1U);
    }
    return rank;
}

using Ranks = std::array<uint32_t, kMostPairs + 1>;

/// The first `pairs` entries are ranks of the segments between a corner and the middle one. Dropping the late-born ones
/// from the longest order makes every shorter one, which is what nests the patterns.
constexpr Ranks birthRanks(uint32_t pairs) {
    Ranks ranks{};
    uint32_t segment = 0;
    for (uint32_t j = 0; j <= kMostPairs; ++j) {
        if (spread(j) < pairs) {
            ranks[segment++] = spread(j);
        }
    }
    return ranks;
}

/// Segments among the `born` first ones, as bits.
uint32_t segmentsBorn(const Ranks& ranks, uint32_t pairs, uint32_t born) {
    uint32_t word = 0;
    for (uint32_t j = 0; j < pairs; ++j) {
        word |= static_cast<uint32_t>(ranks[j] < born) << j;
    }
    return word;
}

} // namespace

uint32_t capacityIndexFor(float level) {
    const auto* const found = std::find_if(kCapacities.begin(), kCapacities.end(),
                                           [&](uint32_t capacity) { return static_cast<float>(capacity) >= level; });
    return static_cast<uint32_t>(std::min<std::ptrdiff_t>(found - kCapacities.begin(), kCapacities.size() - 1));
}

LevelPair levelPair(float level) {
    return {(level - 1.0f) * 0.5f, 1.0f / level};
}

Parameter parameter(uint32_t capacity, uint32_t i, LevelPair level) {
    const uint32_t pairs = pairsOf(capacity);
    const Ranks ranks = birthRanks(pairs);
    const uint32_t whole = std::min(static_cast<uint32_t>(level.a), pairs);
    const uint32_t full = segmentsBorn(ranks, pairs, whole);
    const uint32_t fresh = segmentsBorn(ranks, pairs, std::min(whole + 1, pairs)) ^ full;
    const float growing = level.a - static_cast<float>(whole);

    const bool near = 2 * i <= capacity;
    const uint32_t passed = (1U << (near ? i : capacity - i)) - 1;
    const float x =
        (static_cast<float>(std::popcount(full & passed)) + ((fresh & passed) != 0 ? growing : 0.0f)) * level.inverse;
    const float y = 1.0f - x;
    return near ? Parameter{x, y} : Parameter{y, x};
}

std::vector<uint32_t> patternWords() {
    std::vector<uint32_t> words;
    for (const uint32_t capacity : kCapacities) {
        const uint32_t pairs = pairsOf(capacity);
        const Ranks ranks = birthRanks(pairs);
        for (uint32_t born = 0; born <= pairs; ++born) {
            words.push_back(segmentsBorn(ranks, pairs, born));
        }
    }
    return words;
}

} // namespace supple::surface::lod
