// Smooth skin weights.
#pragma once

#include "skeleton.h"

#include <array>
#include <vector>

namespace supple::creature {

struct Influences {
    std::array<int, 4> joints{};
    std::array<float, 4> weights{}; // descending, summing to one; unused slots are joint 0, weight 0
};

// The four strongest of one weight a joint.
Influences strongest(const std::vector<double>& weights);

// Pip: heat spreads over the cage from each point's nearest bone.
std::vector<Influences> skinWeights(const Cage& cage, const Skeleton& skeleton);

} // namespace supple::creature
