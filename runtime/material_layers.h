// Which member of SuppleMaterialLayers is which of a material's (cage/material_layers.h): for what tells them to hosts
// and what reads them of hosts' arrays.
#pragma once

#include "cage/material_layers.h"
#include "supple/supple.h"

#include <array>

namespace supple::runtime {

// In the order of cage::kLayerNumbers, kLayerColors and kLayerTextures: of the same rows.
#define SUPPLE_MEMBER(extension, name, ...) &SuppleMaterialLayers::name,
inline constexpr auto kLayerNumberMembers =
    std::to_array<float SuppleMaterialLayers::*>({SUPPLE_LAYER_NUMBERS(SUPPLE_MEMBER)});
inline constexpr auto kLayerColorMembers =
    std::to_array<float (SuppleMaterialLayers::*)[3]>({SUPPLE_LAYER_COLORS(SUPPLE_MEMBER)});
inline constexpr auto kLayerTextureMembers =
    std::to_array<SuppleTextureInfo SuppleMaterialLayers::*>({SUPPLE_LAYER_TEXTURES(SUPPLE_MEMBER)});
#undef SUPPLE_MEMBER

} // namespace supple::runtime
