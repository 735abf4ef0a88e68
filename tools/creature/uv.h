// Texture coordinates: the cage is cut into charts, each is laid flat like a sewing pattern, and they are packed.
#pragma once

#include "modeller.h"

#include <array>
#include <vector>

namespace supple::creature {

struct Atlas {
    std::vector<int> chart;                   // of each quad
    std::vector<std::array<Vec2, 4>> corners; // of each quad, in [0, 1]
};

Atlas unwrap(const Cage& cage);

} // namespace supple::creature
