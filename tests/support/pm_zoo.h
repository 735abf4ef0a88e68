// Cages that between them bring every pair of P_m's facet classes together, smooth, creased and with boundaries.
#pragma once

#include "cage/character.h"

#include <string>
#include <vector>

namespace supple::test {

enum class PmVariant { plain, jittered, alphas, open, creased };
inline constexpr size_t kPmVariants = 5;
[[nodiscard]] const char* pmVariantName(PmVariant variant);

struct PmCage {
    std::string name;
    PmVariant variant = PmVariant::plain;
    cage::Cage cage;
};

/// Every cage plain; jittered; jittered with random crease scalars at all edge ends; three times with faces missing,
/// scalars and sharp vertices; three times with random hard and soft creases and sharp vertices; fans in a hard
/// ring.
[[nodiscard]] const std::vector<PmCage>& pmZoo();

} // namespace supple::test
