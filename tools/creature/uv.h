// Texture coordinates: the cage is cut into charts, each is laid flat like a sewing pattern, and they are packed.
#pragma once

#include "modeller.h"

#include <vector>

namespace supple::creature {

struct Atlas {
    std::vector<int> chart;                 // of each face
    std::vector<std::vector<Vec2>> corners; // of each face, in [0, 1]
};

Atlas unwrap(const Cage& cage);

} // namespace supple::creature
