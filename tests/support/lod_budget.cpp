#include "tests/support/lod_budget.h"

#include "tests/support/lod_levels.h"

#include <algorithm>
#include <cmath>

namespace supple::surface::lod::budget {

using namespace shared;

namespace {

/// Highest octave that is told apart, short of where its last bin ends.
constexpr double kHighest = 7.99;
constexpr double kLowest = -double(kOctavesBelow);
/// Guards the device's rounding of log2 and exp2, in bins.
constexpr double kGuard = 1.0 / 16.0;

/// Sum over all forms, priorities and bins of patches * vertices of the capacity at x.
template <class Patches>
uint64_t weigh(std::span<const Priority> priorities, double x, Patches&& patches) {
    uint64_t sum = 0;
    for (const Priority& priority : priorities) {
        for (uint32_t bin = 0; bin < kLodBins; ++bin) {
            const uint32_t capacity = kCapacities[capacityOfBin(bin, priority.elasticity, x)];
            for (uint32_t form = 0; form < kLodForms; ++form) {
                sum += uint64_t{patches(priority.forms[form])[bin]} * sampleCount(Form{form}, capacity);
            }
        }
    }
    return sum;
}

} // namespace

double edgeLevel(const std::array<glm::dvec3, 4>& cubic, const Measure& measure) {
    const auto& [x0, t0, t1, x1] = cubic;
    // Sums that read the same from both ends.
    const double polygon = (glm::length(t0 - x0) + glm::length(x1 - t1)) + glm::length(t1 - t0);
    const double length = 0.5 * (polygon + glm::length(x1 - x0));
    const double bend = std::max(glm::length((x0 + t1) - 2.0 * t0), glm::length((x1 + t0) - 2.0 * t1));
    const double distance = std::max(glm::length(0.5 * (x0 + x1) - measure.camera) - 0.5 * length, measure.nearest);
    const double pixels = measure.focal / distance;
    const double level = length * pixels / measure.edgeLength;
    if (measure.chordError <= 0.0) {
        return level;
    }
    return std::min(level, std::sqrt(0.75 * bend * pixels / measure.chordError)); // sag of a cubic cut into L parts
}

Place placeOf(double level) {
    const double octave = std::clamp(std::log2(std::max(level, std::exp2(kLowest))), kLowest, kHighest);
    const double at = (octave - kLowest) * kBinsPerOctave;
    const double bin = std::floor(at);
    return {static_cast<uint32_t>(bin), static_cast<uint32_t>((at - bin) * kSplitUnit)};
}

void Histogram::add(double level) {
    const Place place = placeOf(level);
    ++counts[place.bin];
    split[place.bin] += kSplitUnit - place.share;
    split[place.bin + 1] += place.share;
}

void Rates::add(double level, uint32_t firstRate, std::span<const uint32_t> vertices) {
    coarsest += vertices[0];
    for (size_t r = 1; r < vertices.size(); ++r) {
        const double enough = firstRate << (r - 1);
        const double at = std::log2(std::max(level, 1e-30) / enough) * kBinsPerOctave + 1.0 + kGuard;
        if (at <= 0.0) {
            return;
        }
        const double clamped = std::min(at, kRatedBins - 1.5), bin = std::floor(clamped);
        const uint32_t step = vertices[r] - vertices[r - 1];
        const auto next = static_cast<uint64_t>((clamped - bin) * step);
        more[static_cast<size_t>(bin)] += step - next;
        more[static_cast<size_t>(bin) + 1] += next;
    }
}

double scaledBy(double elasticity, double x) {
    return SUPPLE_LOD_SCALED(elasticity, x);
}

uint32_t capacityOfBin(uint32_t bin, double elasticity, double x) {
    const double octave = (bin + 1.0 + kGuard - scaledBy(elasticity, x)) / kBinsPerOctave + kLowest;
    const double level = std::exp2(octave);
    uint32_t index = 0;
    while (index + 1 < kCapacities.size() && kCapacities[index] < level) {
        ++index;
    }
    return index;
}

double scaledLevel(double level, double elasticity, double x) {
    return std::clamp(level * std::exp2(-scaledBy(elasticity, x) / kBinsPerOctave), 1.0, double(kMaxLevel));
}

uint64_t demand(std::span<const Priority> priorities, double x) {
    uint64_t sum = weigh(
        priorities, x, [](const Histogram& histogram) -> const auto& { return histogram.split; });
    for (const Priority& priority : priorities) {
        sum += priority.rates.coarsest * kSplitUnit;
        for (uint32_t bin = 0; bin < kRatedBins; ++bin) {
            sum += bin > scaledBy(priority.elasticity, x) ? priority.rates.more[bin] * kSplitUnit : 0;
        }
    }
    return sum;
}

uint64_t vertexCount(std::span<const Priority> priorities, double x) {
    return weigh(
        priorities, x, [](const Histogram& histogram) -> const auto& { return histogram.counts; });
}

Solution solve(std::span<const Priority> priorities, uint64_t limit) {
    const uint64_t room = limit * kSplitUnit;
    // Interpolating between the step before the first that fits and that one, and then going a step further down, makes
    // x continuous and keeps it on the side that fits.
    uint64_t before = demand(priorities, -1.0);
    if (before <= room) {
        return {};
    }
    for (uint32_t step = 0; step <= kBudgetSteps; ++step) {
        const uint64_t here = demand(priorities, step);
        if (here <= room) {
            return {step + static_cast<double>(before - room) / static_cast<double>(before - here), true};
        }
        before = here;
    }
    return {kBudgetSteps + 1.0, false};
}

} // namespace supple::surface::lod::budget
