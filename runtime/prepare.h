// What groups will need of a character, built before there are any: no device, no context.
#pragma once

#include "gpu/mapping.h"
#include "runtime/part_schemes.h"
#include "runtime/prepared.h"
#include "supple/supple.h"

#include <cstdint>
#include <optional>

namespace supple::runtime {

/// A group that is to come.
struct PlannedGroup {
    const SuppleGroupDesc& desc;       ///< checked; asset, capacity, view and instancesOf do not matter
    std::optional<uint32_t> viewFlags; ///< of its view, if it will have one
};

/// A surface of a group that is to come.
struct PlannedSurface {
    std::shared_ptr<const PreparedPiece> piece; ///< null: all parts
    surface::Recipe recipe;                     ///< of its tables or, if it has rates, of the finest
    uint32_t groupFlags = 0;                    ///< surfaceFlags()
    bool hasRates = false;                      ///< its instances have one of several rates: ratesBelow()
};
[[nodiscard]] Result<PlannedSurface> plannedSurface(const Prepared& prepared, const PlannedGroup& group,
                                                    const SchemeParts& parts,
                                                    std::shared_ptr<const PreparedPiece> piece,
                                                    const gpu::Mapping& mapping);

/// Adds what the group will need and `prepared` does not have. Refuses what creating the group would refuse of the
/// character.
[[nodiscard]] Status prepareFor(Prepared& prepared, const PlannedGroup& group, bool wide);

} // namespace supple::runtime
