#include "tests/support/lod_budget.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace supple::surface::lod::budget {
using namespace shared;

namespace {

constexpr double kShort = 1.0 / (1u << 20);

std::array<glm::dvec3, 4> reversed(const std::array<glm::dvec3, 4>& cubic) {
    return {cubic[3], cubic[2], cubic[1], cubic[0]};
}

/// A quarter of a circle of this radius, to 3e-4 of it.
std::array<glm::dvec3, 4> quarterCircle(double radius) {
    const double k = 0.5522847498;
    return {glm::dvec3(radius, 0, 0), glm::dvec3(radius, k * radius, 0), glm::dvec3(k * radius, radius, 0),
            glm::dvec3(0, radius, 0)};
}

TEST(LodLevel, isTheSameFromBothEnds) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (uint32_t n = 0; n < 20'000; ++n) {
        std::array<glm::dvec3, 4> cubic;
        for (glm::dvec3& point : cubic) {
            point = {normal(random), normal(random), normal(random)};
        }
        Measure measure;
        measure.camera = {5.0 * normal(random), 5.0 * normal(random), 5.0 * normal(random)};
        measure.focal = 900.0;
        measure.chordError = n % 2 == 0 ? 0.25 : 0.0;
        ASSERT_EQ(edgeLevel(cubic, measure), edgeLevel(reversed(cubic), measure));
    }
}

TEST(LodLevel, keepsTheChordErrorAndTheShortestSegment) {
    // Seen from so far that all of it is as near: the sag of an arc cut into L chords is radius (1 - cos(pi / 4L)).
    const double distance = 1e6;
    for (const double error : {0.1, 0.25, 1.0}) {
        for (const double radius : {20.0, 100.0, 1000.0}) { // pixels
            Measure measure;
            measure.camera = {0.0, 0.0, distance};
            measure.focal = distance;
            measure.chordError = error;
            measure.edgeLength = kShort;
            const double level = edgeLevel(quarterCircle(radius), measure);
            EXPECT_NEAR(radius * (1.0 - std::cos(std::acos(-1.0) / 4.0 / level)) / error, 1.0, 0.15) << level;
            measure.edgeLength = 8.0;
            const double shorter = edgeLevel(quarterCircle(radius), measure);
            EXPECT_DOUBLE_EQ(
                shorter, std::min(level, edgeLevel(quarterCircle(radius), {measure.camera, distance, 0.01, 0.0, 8.0})));
            EXPECT_GE(std::acos(-1.0) / 2.0 * radius / shorter, 7.9);
        }
    }
    Measure inside; // the camera on the edge: finite
    inside.focal = 900.0;
    EXPECT_TRUE(std::isfinite(edgeLevel(quarterCircle(1.0), inside)));
    EXPECT_EQ(edgeLevel({}, inside), 0.0);
}

TEST(LodBudget, binsCoverEveryLevel) {
    EXPECT_EQ(placeOf(0.0).bin, 0U);
    EXPECT_EQ(placeOf(std::exp2(-6.0)).bin, 0U);
    EXPECT_EQ(placeOf(1.0).bin, 384U);
    EXPECT_EQ(placeOf(std::exp2(0.5 / 64)).bin, 384U);
    EXPECT_EQ(placeOf(std::exp2(0.5 / 64)).share, 128U);
    EXPECT_EQ(placeOf(1e30).bin, 895U);
    EXPECT_EQ(placeOf(HUGE_VAL).bin, 895U);
    EXPECT_LT(placeOf(1e30).bin + 1, kLodBins);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> octave(-8.0, 7.99), step(0.0, kBudgetSteps + 1.0);
    for (uint32_t n = 0; n < 200'000; ++n) {
        const double level = std::exp2(octave(random));
        const double x = step(random), elasticity = n % 3 * 0.5;
        const uint32_t bin = placeOf(level).bin;
        const double drawn = scaledLevel(level, elasticity, x);
        ASSERT_GE(kCapacities[capacityOfBin(bin, elasticity, x)], drawn) << level << " at " << x;
        // Not wastefully: the capacity below would not hold the largest level of the bin.
        const uint32_t index = capacityOfBin(bin, elasticity, x);
        ASSERT_TRUE(index == 0 || kCapacities[index - 1] < drawn * std::exp2(1.1 / kBinsPerOctave));
    }
}

/// A crowd: instances of 50 patches (40 quads, 5 triangles, 5 pentagons) that come closer frame by frame. Levels are
/// lengths in pixels over 8.
class Crowd {
public:
    static constexpr uint32_t kInstances = 1000, kPatches = 50, kHeroes = 5;
    explicit Crowd(uint32_t seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> depth(32.0, 230.0), aside(-60.0, 60.0), length(80.0, 400.0);
        for (uint32_t i = 0; i < kInstances; ++i) {
            depths_.push_back(i < kHeroes ? 32.0 + 28.0 * i / kHeroes : depth(random));
            asides_.push_back(i < kHeroes ? 0.05 * aside(random) : aside(random));
        }
        for (uint32_t p = 0; p < kPatches; ++p) {
            lengths_.push_back(length(random));
        }
    }
    static Form form(uint32_t patch) {
        return patch < 40 ? Form::quad : patch < 45 ? Form::triangleRings : Form::pentagonRings;
    }
    /// Level before the budget; 0 where the instance is not seen.
    [[nodiscard]] double level(uint32_t instance, uint32_t patch, double frame, bool turning) const {
        const double z = depths_[instance] - 0.072 * frame, x = asides_[instance];
        const double distance = std::hypot(z, x);
        const double turned = std::atan2(x, z) - 0.35 * std::sin(frame * 0.0314);
        if (turning && std::abs(turned) > 0.64 + 2.0 / distance) {
            return 0.0;
        }
        return lengths_[patch] / distance;
    }
    [[nodiscard]] std::vector<Priority> priorities(double frame, const std::vector<double>& elasticities,
                                                   bool turning = false) const {
        std::vector<Priority> result(elasticities.size());
        for (uint32_t p = 0; p < result.size(); ++p) {
            result[p].elasticity = elasticities[p];
        }
        for (uint32_t i = 0; i < kInstances; ++i) {
            Priority& own = result[i < kHeroes ? result.size() - 1 : 0];
            for (uint32_t p = 0; p < kPatches; ++p) {
                if (const double wanted = level(i, p, frame, turning); wanted > 0.0) {
                    own.forms[static_cast<uint32_t>(form(p))].add(wanted);
                }
            }
        }
        return result;
    }

private:
    std::vector<double> depths_, asides_, lengths_;
};

constexpr uint64_t kLimit = 500'000;
constexpr uint32_t kFrames = 400;

/// Vertices written, counted patch by patch.
uint64_t written(const Crowd& crowd, double frame, const std::vector<double>& elasticities, double x, bool turning) {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < Crowd::kInstances; ++i) {
        const double elasticity = i < Crowd::kHeroes ? elasticities.back() : elasticities.front();
        for (uint32_t p = 0; p < Crowd::kPatches; ++p) {
            if (const double level = crowd.level(i, p, frame, turning); level > 0.0) {
                sum += sampleCount(Crowd::form(p), kCapacities[capacityOfBin(placeOf(level).bin, elasticity, x)]);
            }
        }
    }
    return sum;
}

TEST(LodBudget, aCrowdComesCloserWithinItsLimitAndWithoutJumps) {
    const Crowd crowd(11);
    double last = 0.0, largestRise = 0.0, largestFall = 0.0;
    uint64_t least = ~0ULL, most = 0, leastWanted = ~0ULL, mostWanted = 0;
    uint32_t over = 0;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        const std::vector<Priority> priorities = crowd.priorities(frame, {1.0});
        const Solution solution = solve(priorities, kLimit);
        ASSERT_TRUE(solution.fits);
        const uint64_t count = vertexCount(priorities, solution.x);
        ASSERT_EQ(count, written(crowd, frame, {1.0}, solution.x, false));
        over += count > kLimit ? 1 : 0;
        least = std::min(least, count);
        most = std::max(most, count);
        leastWanted = std::min(leastWanted, vertexCount(priorities, 0.0));
        mostWanted = std::max(mostWanted, vertexCount(priorities, 0.0));
        if (frame > 0) {
            largestRise = std::max(largestRise, last - solution.x); // of beta: x falls
            largestFall = std::max(largestFall, solution.x - last);
        }
        last = solution.x;
    }
    RecordProperty("wanted", std::to_string(leastWanted) + ".." + std::to_string(mostWanted));
    RecordProperty("written", std::to_string(least) + ".." + std::to_string(most));
    RecordProperty("largest_fall_of_beta_percent",
                   std::to_string(100.0 * (std::exp2(largestFall / kBinsPerOctave) - 1.0)));
    EXPECT_GT(leastWanted, kLimit) << "nothing to do";
    EXPECT_EQ(over, 0U);
    EXPECT_GT(least, kLimit * 9 / 10) << "the limit is not used";
    EXPECT_EQ(largestRise, 0.0) << "levels rise while the crowd comes closer";
    EXPECT_LT(largestFall, 1.0) << "beta falls by more than a bin a frame";
}

TEST(LodBudget, isAFunctionOfTheFrameUnderTurningCamerasAndHeroes) {
    const Crowd crowd(12);
    for (const bool turning : {false, true}) {
        const std::vector<double> elasticities = turning ? std::vector<double>{1.0} : std::vector<double>{1.0, 0.25};
        double last = 0.0, largest = 0.0;
        for (uint32_t frame = 0; frame < kFrames; frame += 2) {
            const std::vector<Priority> priorities = crowd.priorities(frame, elasticities, turning);
            const Solution solution = solve(priorities, kLimit);
            ASSERT_TRUE(solution.fits);
            ASSERT_LE(written(crowd, frame, elasticities, solution.x, turning), kLimit) << "frame " << frame;
            largest = std::max(largest, frame > 0 ? std::abs(solution.x - last) : 0.0);
            last = solution.x;
        }
        RecordProperty(turning ? "turning" : "heroes", std::to_string(largest));
        EXPECT_LT(largest, 4.0);
    }
}

TEST(LodBudget, heroesKeepMoreOfTheirLevels) {
    const Crowd crowd(13);
    const std::vector<Priority> priorities = crowd.priorities(300, {1.0, 0.0});
    const Solution solution = solve(priorities, kLimit);
    ASSERT_TRUE(solution.fits);
    ASSERT_GT(solution.x, 0.0);
    EXPECT_DOUBLE_EQ(scaledLevel(20.0, 0.0, solution.x), 20.0);
    EXPECT_LT(scaledLevel(20.0, 1.0, solution.x), scaledLevel(20.0, 0.25, solution.x));
    EXPECT_LE(vertexCount(priorities, solution.x), kLimit);
}

TEST(LodBudget, xRisesWithEveryPatch) {
    std::mt19937 random(14);
    std::uniform_real_distribution<double> octave(-1.0, 5.0);
    std::vector<Priority> priorities(1);
    double last = 0.0, largest = 0.0;
    uint32_t limited = 0;
    for (uint32_t n = 0; n < 12'000; ++n) {
        priorities[0].forms[n % 4].add(std::exp2(octave(random)));
        if (n % 50 != 0) {
            continue;
        }
        const Solution solution = solve(priorities, 100'000);
        ASSERT_TRUE(solution.fits);
        ASSERT_LE(vertexCount(priorities, solution.x), 100'000U);
        ASSERT_GE(solution.x, last);
        largest = std::max(largest, solution.x - last);
        last = solution.x;
        limited += solution.x > 0.0 ? 1 : 0;
    }
    EXPECT_GT(limited, 100U);
    EXPECT_GT(last, 64.0);
    EXPECT_LT(largest, 16.0); // fifty patches more
}

TEST(LodBudget, xFollowsAContinuousChangeOfLevelsContinuously) {
    // All levels a 32nd of a bin up a step: x goes along, never back, and a whole bin costs a whole step. Levels spread
    // over octaves, and seven lumps of equal ones, which leave their bins all at once.
    for (const bool lumps : {false, true}) {
        std::mt19937 random(15);
        std::uniform_real_distribution<double> octave(0.0, 4.0);
        std::vector<double> octaves;
        for (uint32_t n = 0; n < 3000; ++n) {
            octaves.push_back(lumps ? 0.7 + n % 7 * 0.4143 : octave(random));
        }
        const auto risen = [&](uint32_t step) {
            std::vector<Priority> priorities(1);
            for (uint32_t n = 0; n < octaves.size(); ++n) {
                priorities[0].forms[n % 4].add(std::exp2(octaves[n] + step / 32.0 / kBinsPerOctave));
            }
            return priorities;
        };
        constexpr uint32_t kSteps = 640, kEnough = 100;
        // Off a plateau of the lumps' demand: there x is continuous too, but as steep as the limit is near it.
        const uint64_t limit = demand(risen(kEnough), -1.0) / kSplitUnit * 103 / 100;
        std::vector<double> xs;
        for (uint32_t step = 0; step <= kSteps; ++step) {
            xs.push_back(solve(risen(step), limit).x);
        }
        EXPECT_EQ(xs[kEnough / 2], 0.0);
        EXPECT_GT(xs[kSteps], 4.0);
        for (uint32_t step = 1; step <= kSteps; ++step) {
            ASSERT_GE(xs[step], xs[step - 1] - 1e-9) << step;
            ASSERT_LT(xs[step] - xs[step - 1], lumps ? 0.8 : 0.25) << step;
            if (step >= 32 && xs[step - 32] > 0.0) {
                ASSERT_NEAR(xs[step] - xs[step - 32], 1.0, 0.01) << step;
            }
        }
    }
}

TEST(LodBudget, theSharedHistogramBoundsTheCount) {
    std::mt19937 random(16);
    std::uniform_real_distribution<double> octave(-3.0, 6.5), step(0.0, 512.0);
    std::vector<Priority> priorities(2);
    priorities[1].elasticity = 0.25;
    for (uint32_t n = 0; n < 5000; ++n) {
        priorities[n % 2].forms[n / 2 % 4].add(std::exp2(octave(random)));
    }
    uint64_t last = demand(priorities, -1.0);
    for (uint32_t k = 0; k <= kBudgetSteps; ++k) {
        const uint64_t here = demand(priorities, k);
        ASSERT_LE(here, last);
        ASSERT_LE(vertexCount(priorities, k) * kSplitUnit, here);
        last = here;
    }
    uint64_t hard = 0;
    for (uint32_t n = 0; n < 200; ++n) { // any limit that can be kept is kept
        const auto limit = static_cast<uint64_t>(std::exp2(14.0 + n * 0.05));
        const Solution solution = solve(priorities, limit);
        if (solution.fits) {
            ASSERT_LE(vertexCount(priorities, solution.x), limit);
            ++hard;
        } else {
            ASSERT_GT(demand(priorities, kBudgetSteps), limit * kSplitUnit);
        }
    }
    EXPECT_GT(hard, 50U);
}

TEST(LodBudget, saysWhenNothingHelps) {
    std::vector<Priority> priorities(1);
    for (uint32_t n = 0; n < 1000; ++n) {
        priorities[0].forms[0].add(10.0);
    }
    EXPECT_FALSE(solve(priorities, 3999).fits);
    EXPECT_TRUE(solve(priorities, 4000).fits);
    EXPECT_EQ(solve(priorities, 1'000'000).x, 0.0);
    priorities[0].elasticity = 0.0;
    EXPECT_FALSE(solve(priorities, 3999).fits);
    EXPECT_TRUE(solve(priorities, 4000).fits);
    EXPECT_TRUE(solve({}, 0).fits);
}

TEST(LodBudget, whereElasticitiesAreUsedUpAllLevelsGoDownAlikeAndWithoutJumps) {
    // Heroes that nothing scales at first, and a crowd that is at its coarsest soon; the limit falls by a 50th a step.
    std::mt19937 random(17);
    std::uniform_real_distribution<double> octave(2.0, 6.0);
    std::vector<Priority> priorities(3);
    priorities[1].elasticity = 0.25;
    priorities[2].elasticity = 0.0;
    for (uint32_t n = 0; n < 6000; ++n) {
        priorities[n % 3].forms[n / 3 % 4].add(std::exp2(octave(random)));
    }
    const uint64_t free = demand(priorities, -1.0) / kSplitUnit, coarsest = vertexCount(priorities, kBudgetSteps);
    EXPECT_EQ(vertexCount(priorities, kBudgetSteps + 1.0), coarsest);
    double last = 0.0;
    uint32_t beyond = 0, alike = 0;
    for (auto limit = static_cast<double>(free); limit > static_cast<double>(coarsest); limit *= 0.98) {
        const Solution solution = solve(priorities, static_cast<uint64_t>(limit));
        ASSERT_TRUE(solution.fits);
        const auto used = static_cast<double>(vertexCount(priorities, solution.x));
        ASSERT_LE(used, limit);
        ASSERT_GE(solution.x, last);
        if (solution.x > kElasticSteps + 1.0) {
            if (last > kElasticSteps + 1.0) {
                // Four bins cost a fiftieth and more, until the limit is near the coarsest.
                ASSERT_LT(solution.x - last, used > 1.5 * static_cast<double>(coarsest) ? 4.0 : 30.0) << limit;
                if (scaledLevel(40.0, 0.25, solution.x) > 1.0) {
                    ASSERT_NEAR(scaledLevel(40.0, 0.0, solution.x) / scaledLevel(40.0, 0.0, last),
                                scaledLevel(40.0, 0.25, solution.x) / scaledLevel(40.0, 0.25, last), 1e-12);
                    ++alike;
                }
                ASSERT_GT(used, 0.85 * limit) << "the limit is not used";
            }
            ++beyond;
        }
        last = solution.x;
    }
    EXPECT_GT(beyond, 30U);
    EXPECT_GT(alike, 10U);
    EXPECT_GT(last, kElasticSteps + 64.0);
    EXPECT_NEAR(scaledBy(0.0, kBudgetSteps), kRatedBins, 0.0);
    EXPECT_NEAR(scaledBy(0.25, 600.0), 0.25 * 512 + 88.0, 0.0);
}

} // namespace
} // namespace supple::surface::lod::budget
