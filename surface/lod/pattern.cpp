#include "surface/lod/pattern.h"

namespace supple::surface::lod {

namespace {

constexpr uint32_t pairsOf(uint32_t capacity) {
    return (capacity - 1) / 2;
}

constexpr bool firstWordsFollow() {
    uint32_t next = 0;
    bool follow = true;
    for (uint32_t c = 0; c < kCapacities.size(); ++c) {
        follow = follow && SUPPLE_LOD_FIRST_WORD(c) == next && SUPPLE_LOD_CAPACITY(c) == kCapacities[c];
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
