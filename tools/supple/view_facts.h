// What a figure has of what views show.
#pragma once

#include "host/figure.h"

#include <cstdint>
#include <optional>
#include <string>

namespace supple::tools {

struct ViewFacts {
    bool uvs = false, secondUvs = false;
    bool vertexColors = false;
    bool normalMaps = false, occlusionMaps = false, emission = false;
    uint32_t patchClasses = 0; ///< a bit for each SupplePatchClass
    std::string joint;         ///< whose weights are shown
    bool jointMoves = false;   ///< it moves some vertex
};

/// `joint`: of the view "weights", whose values the group has.
[[nodiscard]] ViewFacts viewFactsOf(const host::FigureGroup& group, uint32_t joint);

} // namespace supple::tools
