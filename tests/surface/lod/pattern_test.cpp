#include "surface/lod/pattern.h"

#include "tests/support/lod_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>

namespace supple::surface::lod {
namespace {

constexpr uint32_t kLevelsEach = 400;

std::string traceOf(uint32_t capacity, float level) {
    return "capacity " + std::to_string(capacity) + ", level " + std::to_string(level);
}

/// Calls visit(capacity, level) for every capacity with random levels and the capacity itself.
template <class Visit>
void forLevels(Visit&& visit) {
    std::mt19937 random(1);
    for (const uint32_t capacity : kCapacities) {
        visit(capacity, static_cast<float>(capacity));
        for (uint32_t n = 0; n < kLevelsEach; ++n) {
            visit(capacity, randomLevel(random, static_cast<float>(capacity)));
        }
    }
}

std::set<uint32_t> distinctBits(uint32_t capacity, float level) {
    std::set<uint32_t> bits;
    for (uint32_t i = 0; i <= capacity; ++i) {
        bits.insert(std::bit_cast<uint32_t>(parameter(capacity, i, levelPair(level)).t));
    }
    return bits;
}

// What shaders/lod/facing.glsl takes for granted of the triangles between a border and the first inner row.
TEST(LodPattern, bordersAndRowsAreNotMoreAskewThanBackFacesAllow) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double worst = 0.0;
    for (uint32_t n = 0; n < 400'000; ++n) {
        const auto level = [&] { return std::exp(unit(random) * std::log(63.0)); };
        double border = level(), along = level(), across = level();
        border = n % 3 == 0 ? 1.0 : n % 3 == 1 ? 2.9 + 0.2 * unit(random) : border;
        const double least = std::min(std::max({border, along, across}), 3.0); // shaders/lod/place.comp
        along = std::max({along, border, least});
        across = std::max(across, least);
        uint32_t index = capacityIndexFor(static_cast<float>(std::max(along, across)));
        index = std::min<uint32_t>(index + n % 2, kCapacities.size() - 1);
        const uint32_t capacity = kCapacities[index], h = (capacity - 1) / 2;
        const auto at = [&](double l, uint32_t i) {
            return static_cast<double>(parameter(capacity, i, levelPair(static_cast<float>(l))).t);
        };
        const double distance = at(across, 1);
        if (distance <= 0.0) {
            continue; // no triangles
        }
        const double reach = std::min(3.4 * border / std::max(across, 3.0), 1.0);
        for (uint32_t i = 0; i < capacity; ++i) { // both triangles of a cell
            const bool before = i <= h;
            const auto askew = [&](double from, double to, double point) {
                worst = std::max(worst, to > from ? std::abs((point - from) * (point - to)) / distance * reach : 0.0);
            };
            askew(at(border, i), at(border, i + 1), at(along, before ? i + 1 : i));
            askew(at(along, i), at(along, i + 1), at(border, before ? i : i + 1));
        }
    }
    EXPECT_LT(worst, 1.0);
    EXPECT_GT(worst, 0.9);
}

TEST(LodPattern, takesTheSmallestCapacityThatSuffices) {
    EXPECT_EQ(capacityIndexFor(1.0f), 0U);
    EXPECT_EQ(capacityIndexFor(std::nextafter(1.0f, 2.0f)), 1U);
    EXPECT_EQ(capacityIndexFor(3.0f), 1U);
    EXPECT_EQ(capacityIndexFor(7.5f), 4U);
    EXPECT_EQ(capacityIndexFor(47.0f), 8U);
    EXPECT_EQ(capacityIndexFor(47.1f), 9U);
    EXPECT_EQ(capacityIndexFor(kMaxLevel), 9U);
}

TEST(LodPattern, wordsNestAndStartAtTheCorner) {
    const std::vector<uint32_t> words = patternWords();
    ASSERT_EQ(words.size(), 108U);
    for (uint32_t c = 0; c < kCapacities.size(); ++c) {
        const uint32_t h = (kCapacities[c] - 1) / 2;
        const uint32_t* word = &words[kFirstPatternWords[c]];
        for (uint32_t n = 0; n <= h; ++n) {
            EXPECT_EQ(std::popcount(word[n]), static_cast<int>(n)) << "capacity " << kCapacities[c];
            EXPECT_EQ(word[n] >> h, 0U);
            EXPECT_TRUE(n == 0 || (word[n - 1] & ~word[n]) == 0) << "a segment vanishes as the level rises";
            EXPECT_TRUE(n == 0 || (word[n] & 1U) != 0) << "the corner's segment is not the first";
        }
        if (c == 0) {
            continue;
        }
        // Without the segments it lacks, a larger capacity is the smaller one.
        const uint32_t fewer = (kCapacities[c - 1] - 1) / 2;
        const uint32_t* smaller = &words[kFirstPatternWords[c - 1]];
        for (uint32_t n = 0; n <= fewer; ++n) {
            uint32_t packed = 0;
            uint32_t count = 0;
            for (uint32_t j = 0; j < h; ++j) {
                if ((word[fewer] >> j & 1U) != 0) {
                    packed |= (word[n] >> j & 1U) << count++;
                }
            }
            EXPECT_EQ(packed, smaller[n]) << kCapacities[c - 1] << " in " << kCapacities[c] << ", word " << n;
        }
    }
}

TEST(LodPattern, birthsAreSpreadOverTheEdge) {
    const std::vector<uint32_t> words = patternWords();
    for (uint32_t n = 1; n <= 31; ++n) {
        const uint32_t word = words[kFirstPatternWords[9] + n];
        uint32_t longest = 0;
        uint32_t missing = 0;
        for (uint32_t j = 0; j < 31; ++j) {
            missing = (word >> j & 1U) != 0 ? 0 : missing + 1;
            longest = std::max(longest, missing);
        }
        EXPECT_LE(longest, 32 / std::bit_floor(n) - 1) << n << " born";
    }
}

TEST(LodPattern, samplesAreWhatTheWordsSay) {
    const std::vector<uint32_t> words = patternWords();
    for (uint32_t c = 0; c < kCapacities.size(); ++c) {
        const uint32_t capacity = kCapacities[c];
        for (uint32_t n = 0; 2 * n + 1 <= capacity; ++n) { // full levels: samples stand still on the other segments
            const uint32_t word = words[kFirstPatternWords[c] + n];
            const LevelPair level = levelPair(static_cast<float>(2 * n + 1));
            for (uint32_t j = 0; 2 * j + 1 < capacity; ++j) {
                EXPECT_EQ(parameter(capacity, j + 1, level).t > parameter(capacity, j, level).t, (word >> j & 1U) != 0)
                    << traceOf(capacity, static_cast<float>(2 * n + 1)) << ", segment " << j;
            }
        }
    }
}

TEST(LodPattern, parametersRiseFromCornerToCorner) {
    forLevels([](uint32_t capacity, float level) {
        const LevelPair pair = levelPair(level);
        EXPECT_EQ(parameter(capacity, 0, pair).t, 0.0f);
        EXPECT_EQ(parameter(capacity, 0, pair).s, 1.0f);
        EXPECT_EQ(parameter(capacity, capacity, pair).t, 1.0f);
        EXPECT_EQ(parameter(capacity, capacity, pair).s, 0.0f);
        for (uint32_t i = 0; i < capacity; ++i) {
            ASSERT_LE(parameter(capacity, i, pair).t, parameter(capacity, i + 1, pair).t) << traceOf(capacity, level);
            ASSERT_GE(parameter(capacity, i, pair).s, parameter(capacity, i + 1, pair).s) << traceOf(capacity, level);
        }
    });
}

TEST(LodPattern, isItsOwnMirrorImageBitForBit) {
    forLevels([](uint32_t capacity, float level) {
        for (uint32_t i = 0; i <= capacity; ++i) {
            const Parameter here = parameter(capacity, i, levelPair(level));
            const Parameter there = parameter(capacity, capacity - i, levelPair(level));
            ASSERT_EQ(std::bit_cast<uint32_t>(here.t), std::bit_cast<uint32_t>(there.s)) << traceOf(capacity, level);
            ASSERT_EQ(std::bit_cast<uint32_t>(here.s), std::bit_cast<uint32_t>(there.t)) << traceOf(capacity, level);
            ASSERT_NEAR(here.t + here.s, 1.0f, 1.2e-7f);
        }
    });
}

TEST(LodPattern, capacityDoesNotShow) {
    forLevels([](uint32_t capacity, float level) {
        const std::set<uint32_t> expected = distinctBits(capacity, level);
        for (const uint32_t larger : kCapacities) {
            if (larger > capacity) {
                ASSERT_EQ(distinctBits(larger, level), expected) << traceOf(larger, level) << ", not as " << capacity;
            }
        }
    });
}

TEST(LodPattern, oddLevelsAreEvenRates) {
    double worst = 0.0;
    for (uint32_t level = 1; level <= 63; level += 2) {
        const uint32_t capacity = kCapacities[capacityIndexFor(static_cast<float>(level))];
        const std::set<uint32_t> bits = distinctBits(capacity, static_cast<float>(level));
        ASSERT_EQ(bits.size(), level + 1);
        uint32_t k = 0;
        for (const uint32_t t : bits) { // bits of positive floats are ordered as they are
            worst = std::max(worst, std::abs(std::bit_cast<float>(t) - double(k++) / level));
        }
    }
    EXPECT_LE(worst, 6e-8);
    RecordProperty("largest_distance", std::to_string(worst));
}

TEST(LodPattern, segmentsHaveTheWidthsOfTheLevel) {
    // One in a level's parts each, one pair of the fraction; no other width.
    forLevels([](uint32_t capacity, float level) {
        const LevelPair pair = levelPair(level);
        uint32_t full = 0;
        uint32_t growing = 0;
        const double fraction = pair.a - std::floor(pair.a);
        for (uint32_t i = 0; i < capacity; ++i) {
            const double width = (double(parameter(capacity, i + 1, pair).t) - parameter(capacity, i, pair).t) * level;
            if (std::abs(width - 1.0) < 1e-5) {
                ++full;
            } else if (width != 0.0) {
                ASSERT_NEAR(width, fraction, 1e-5) << traceOf(capacity, level);
                ++growing;
            }
        }
        const auto whole = static_cast<uint32_t>(pair.a);
        if (fraction > 2e-5 && fraction < 1.0 - 2e-5) {
            EXPECT_EQ(full, 2 * whole + 1) << traceOf(capacity, level);
            EXPECT_EQ(growing, 2U) << traceOf(capacity, level);
        } else {
            EXPECT_GE(full, 2 * whole + 1) << traceOf(capacity, level);
        }
    });
}

TEST(LodPattern, movesWithoutJumps) {
    // A sample slides at most half a segment's share for each unit of level, wherever the level stands.
    double last[64] = {};
    double previous = 1.0;
    double worst = 0.0;
    for (uint32_t n = 0; n <= 60'000; ++n) {
        const float level = std::min(kMaxLevel, static_cast<float>(std::exp(n * std::log(63.0) / 60'000)));
        for (uint32_t i = 0; i <= 63; ++i) {
            const double t = parameter(63, i, levelPair(level)).t;
            if (n > 0) {
                worst = std::max(worst, (std::abs(t - last[i]) - 3e-7) * level / std::max(level - previous, 1e-9));
            }
            last[i] = t;
        }
        previous = level;
    }
    EXPECT_LE(worst, 0.5);
    EXPECT_GT(worst, 0.4);
}

} // namespace
} // namespace supple::surface::lod
