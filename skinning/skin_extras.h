// What some ways of skinning need of a character beside its skin weights, found once.
#pragma once

#include "base/result.h"
#include "skinning/centers.h"
#include "skinning/delta_mush.h"
#include "skinning/skinning_mode.h"

#include <optional>

namespace supple::skinning {

struct SkinExtras {
    std::optional<Centers> centers;
    std::optional<DeltaMush> mush;

    [[nodiscard]] bool has(SkinExtra extra) const;
    /// Finds it, if it is not there. Refuses cages that delta mush would take too long for.
    [[nodiscard]] Status find(const cage::Character& character, SkinExtra extra);
};

} // namespace supple::skinning
