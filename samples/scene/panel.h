// The panel over the picture: the budget, and what a frame costs. Dear ImGui.
#pragma once

#include "market.h"

#include <cstdint>
#include <vector>

namespace market {

struct PanelFacts {
    uint32_t figures = 0;
    uint32_t mostVertices = 0; ///< of the budget
    uint32_t drawCount = 0;    ///< commands of the view
    uint32_t callCount = 0;    ///< indirect calls that draw figures into the picture
    SuppleViewStatistics statistics{};
    SuppleMemoryUse memory{};
    std::vector<PassMilliseconds> supple, drawing; ///< on the device
    double frameMilliseconds = 0.0;
};

/// What the user sets.
struct PanelSettings {
    uint32_t budget = 0; ///< surface vertices a frame
    bool paint = false;  ///< capacities as colors
    bool moves = true;
};

void showPanel(const PanelFacts& facts, PanelSettings& settings);

} // namespace market
