// What shaders are told of a material.
#pragma once

#include "host/shaders/draw.h"

#include <supple/supple.h>

namespace supple::host {

/// `uv1`: there is a second UV set to look anything up on.
[[nodiscard]] shared::MaterialUniforms materialUniforms(const SuppleMaterialInfo& material,
                                                        const SuppleMaterialLayers& layers, bool uv1);
/// What it has: shared::kMaterial...
[[nodiscard]] uint32_t materialFlags(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers, bool uv1);
/// Light goes through it, as through thin glass.
[[nodiscard]] bool isGlass(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers);

} // namespace supple::host
