// Limbs of characters with one joint turned, and what is known of how the ways of skinning keep them.
#pragma once

#include "tests/support/bend.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace supple::test {

struct LimbMeasure {
    double volume = 0.0; ///< per cent
    std::array<double, 2> thickness{};
    uint32_t turnedOver = 0;
};
[[nodiscard]] LimbMeasure measured(const Bend& bend, std::span<const glm::dvec3> skinned);

struct RigBend {
    const char* file; ///< "characters/FILE.glb" of the shared assets
    const char* name;
    Turn turn;
    LimbMeasure linear, dual, centers;
    LimbMeasure mush, lightMush; ///< lambda 1, 8 iterations, cut as the library does (body 13k: at 0.005)
};
/// Found by the same formulas in another language, with numpy: centers of cages cut once, of body 13k uncut. Half a
/// turn goes either way: a hair less or more says which.
[[nodiscard]] std::span<const RigBend> rigBends();

/// How far a measure may be off: per cent, parts, triangles.
struct LimbTolerance {
    double volume, thickness, turnedOver;
};
/// Prints what was measured of the limb, and compares it.
void expectMeasure(const RigBend& bend, const LimbMeasure& own, const LimbMeasure& wanted,
                   const LimbTolerance& tolerance);

} // namespace supple::test
