// Levels and their budget on the CPU, in double: the reference that tests hold the device's passes against.
//
// Levels are scaled by beta^e so that the vertices of a frame fit a limit; e is the elasticity of a patch's priority
// (1: the crowd, 0: reduced last), and beta = 2^(-x / kBinsPerOctave) up to kElasticSteps. Beyond, all levels are
// scaled alike, until they are 1. Patches are counted in bins of log2 level, and take their capacity from their bin, so
// that what is counted is what is written. x comes from a second histogram that shares each patch between two bins: it
// is a continuous function of the levels, and an upper bound of the exact count.
#pragma once

#include "surface/lod/grid.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::lod::budget {

/// What edges are measured by, in pixels.
struct Measure {
    glm::dvec3 camera{0.0};
    double focal = 1.0; ///< pixels a unit at distance 1
    double nearest = 0.01;
    double chordError = 0.25; ///< 0: lengths alone count
    double edgeLength = 3.0;  ///< of the shortest segment
};
/// Level of an edge with this boundary cubic before the budget; the same bits from either end. From 0 up.
[[nodiscard]] double edgeLevel(const std::array<glm::dvec3, 4>& cubic, const Measure& measure);

/// Where a level is counted: kSplitUnit - share in `bin`, `share` in the next one.
struct Place {
    uint32_t bin = 0;
    uint32_t share = 0;
};
[[nodiscard]] Place placeOf(double level);

/// Patches of one form and priority.
struct Histogram {
    std::vector<uint32_t> counts = std::vector<uint32_t>(shared::kLodBins, 0);
    std::vector<uint32_t> split = std::vector<uint32_t>(shared::kLodBins, 0);
    void add(double level);
};
/// Instances of one priority that have one of several rates each: what they take is counted whole, and falls in steps.
struct Rates {
    uint64_t coarsest = 0; ///< vertices of all at their coarsest
    /// What finer rates have more, by how far the level is above what a rate is enough for; counts where the bin is
    /// above scaledBy().
    std::vector<uint64_t> more = std::vector<uint64_t>(shared::kRatedBins, 0);
    /// `vertices`: of an instance, by rate; rates are firstRate and twice the one before.
    void add(double level, uint32_t firstRate, std::span<const uint32_t> vertices);
};
struct Priority {
    double elasticity = 1.0;
    std::array<Histogram, shared::kLodForms> forms;
    Rates rates;
};

/// How many bins further down x scales levels.
[[nodiscard]] double scaledBy(double elasticity, double x);
/// Index of the capacity that patches of a bin take at x: enough for their scaled level.
[[nodiscard]] uint32_t capacityOfBin(uint32_t bin, double elasticity, double x);
/// A level as it is drawn at x, 1..kMaxLevel.
[[nodiscard]] double scaledLevel(double level, double elasticity, double x);

/// Vertices at step x by the shared histogram, in 1 / kSplitUnit.
[[nodiscard]] uint64_t demand(std::span<const Priority> priorities, double x);
/// Vertices of patches that are written at x, without the filling of draws.
[[nodiscard]] uint64_t vertexCount(std::span<const Priority> priorities, double x);

struct Solution {
    double x = 0.0;
    bool fits = true; ///< else even the lowest step is over the limit, and whole instances have to go
};
[[nodiscard]] Solution solve(std::span<const Priority> priorities, uint64_t limit);

} // namespace supple::surface::lod::budget
