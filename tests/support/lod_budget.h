// The levels of a view and their budget on the CPU, in double. Tests compare the device's passes with it.
//
// Levels are multiplied by beta^e so that the vertices of a frame stay below a limit. e is the elasticity of the
// patch's priority (1: the crowd, 0: reduced last), and beta = 2^(-x / kBinsPerOctave) up to x = kElasticSteps. Beyond
// that all levels are scaled alike, down to 1.
//
// Patches are counted in bins of log2 level. A patch takes its capacity from its bin, so that what is counted is what
// is written. x is solved with a second histogram, in which each patch is divided between two bins. Its demand is a
// continuous function of the levels and never less than the exact count.
#pragma once

#include "surface/lod/grid.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::lod::budget {

/// How the levels of edges are measured, in pixels.
struct Measure {
    glm::dvec3 camera{0.0};
    double focal = 1.0; ///< pixels per unit at distance 1
    double nearest = 0.01;
    double chordError = 0.25; ///< 0: only lengths count
    double edgeLength = 3.0;  ///< of the shortest segment
};
/// The level of an edge with this border cubic before the budget, 0 or more. Reversing the cubic changes no bit.
[[nodiscard]] double edgeLevel(const std::array<glm::dvec3, 4>& cubic, const Measure& measure);

/// Where a patch is counted: kSplitUnit - share in `bin`, and `share` in the next bin.
struct Place {
    uint32_t bin = 0;
    uint32_t share = 0;
};
[[nodiscard]] Place placeOf(double level);

/// The patches of one form and priority.
struct Histogram {
    std::vector<uint32_t> counts = std::vector<uint32_t>(shared::kLodBins, 0);
    std::vector<uint32_t> split = std::vector<uint32_t>(shared::kLodBins, 0);
    void add(double level);
};
/// The instances of one priority that have one of several rates each. Their vertex count falls in steps.
struct Rates {
    uint64_t coarsest = 0; ///< vertices of all instances at the coarsest rate
    /// The vertices that finer rates add. The bin tells how far the level is above what the rate below is enough for;
    /// it counts while the bin is above scaledBy().
    std::vector<uint64_t> more = std::vector<uint64_t>(shared::kRatedBins, 0);
    /// `vertices`: of an instance, one entry per rate. The first rate is firstRate, and each next one is twice as fine.
    void add(double level, uint32_t firstRate, std::span<const uint32_t> vertices);
};
struct Priority {
    double elasticity = 1.0;
    std::array<Histogram, shared::kLodForms> forms;
    Rates rates;
};

/// By how many bins levels are scaled down at x.
[[nodiscard]] double scaledBy(double elasticity, double x);
/// The index of the capacity that patches of a bin take at x. It is enough for their scaled level.
[[nodiscard]] uint32_t capacityOfBin(uint32_t bin, double elasticity, double x);
/// The level that is drawn at x, 1..kMaxLevel.
[[nodiscard]] double scaledLevel(double level, double elasticity, double x);

/// The demand for vertices at x by the divided histogram, in units of 1 / kSplitUnit.
[[nodiscard]] uint64_t demand(std::span<const Priority> priorities, double x);
/// The vertices that patches write at x, without the padding of draws.
[[nodiscard]] uint64_t vertexCount(std::span<const Priority> priorities, double x);

struct Solution {
    double x = 0.0;
    bool fits = true; ///< false: even with all levels at 1 the limit is exceeded, and whole instances have to go
};
[[nodiscard]] Solution solve(std::span<const Priority> priorities, uint64_t limit);

} // namespace supple::surface::lod::budget
