// Which tables a surface of a group needs: what the group's description, the view's flags and the file say of it.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "gpu/mapping.h"
#include "supple/supple.h"
#include "surface/recipe.h"
#include "surface/scheme.h"
#include "surface/schemes.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace supple::runtime {

/// The row that draws parts of this scheme. Of fragments it depends on the group's rules.
[[nodiscard]] surface::SchemeId schemeIdOf(const SuppleGroupDesc& group, SuppleScheme scheme);

struct SurfaceWish {
    const cage::Character& character;
    std::span<const uint32_t> parts; ///< that the surface is made of
    const cage::Cage& cage;          ///< of these parts
    const SuppleGroupDesc& group;
    surface::SchemeId scheme = surface::SchemeId::pm; ///< schemeIdOf() the group, or of one of what AUTO chose
    bool schemeChosen = false;                        ///< the host left it to Supple: what the scheme lacks is left out
    std::optional<uint32_t> viewFlags;                ///< of a group of a view
    gpu::Mapping mapping;
};

/// The rate that a group asks for.
[[nodiscard]] inline uint32_t askedRate(const SuppleGroupDesc& group) {
    return group.rate == 0 ? 8 : group.rate;
}

/// SuppleGroupFlags of a group, without those that a scheme goes without: DIRECT, and what one lacks that Supple has
/// chosen.
[[nodiscard]] uint32_t surfaceFlags(uint32_t groupFlags, surface::SchemeId scheme, bool schemeChosen);

struct SurfaceRecipe {
    surface::Recipe recipe;
    std::string uvNote; ///< why texture coordinates are linear though the file says otherwise, or empty
};
/// Refuses texture coordinates that the host has asked for and the scheme does not have.
[[nodiscard]] Result<SurfaceRecipe> surfaceRecipe(const SurfaceWish& wish);

/// The recipes of all rates that instances of a group of a view may have, if the scheme has rates there. `tables` are
/// those of `finest`, which comes last.
[[nodiscard]] std::vector<surface::Recipe> ratesBelow(const surface::Recipe& finest, const surface::Tables& tables);

} // namespace supple::runtime
