// Wren's pieces, morph targets and clips as the library's plain data.
#pragma once

#include "clips.h"
#include "wren.h"

#include "cage/character.h"

namespace supple::creature::wren {

struct Piece {
    std::string name;
    Cage cage;
    std::vector<std::pair<std::string, Cage>> targets = {}; // the cage in each of its shapes
};

cage::Character assemble(const std::vector<Piece>& pieces, const Skeleton& skeleton, const std::vector<Clip>& clips);

} // namespace supple::creature::wren
