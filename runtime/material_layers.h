// Which member of SuppleMaterialLayers is which of a material's (cage/material_layers.h): for what tells them to hosts
// and what reads them of hosts' arrays.
#pragma once

#include "cage/material_layers.h"
#include "supple/supple.h"

#include <array>

namespace supple::runtime {

/// In the order of cage::kLayerNumbers.
inline constexpr std::array<float SuppleMaterialLayers::*, cage::kLayerNumbers.size()> kLayerNumberMembers{
    &SuppleMaterialLayers::clearcoatFactor,
    &SuppleMaterialLayers::clearcoatRoughnessFactor,
    &SuppleMaterialLayers::sheenRoughnessFactor,
    &SuppleMaterialLayers::transmissionFactor,
    &SuppleMaterialLayers::ior,
    &SuppleMaterialLayers::specularFactor,
    &SuppleMaterialLayers::iridescenceFactor,
    &SuppleMaterialLayers::iridescenceIor,
    &SuppleMaterialLayers::iridescenceThicknessMinimum,
    &SuppleMaterialLayers::iridescenceThicknessMaximum,
    &SuppleMaterialLayers::anisotropyStrength,
    &SuppleMaterialLayers::anisotropyRotation,
};
/// In the order of cage::kLayerColors.
inline constexpr std::array<float (SuppleMaterialLayers::*)[3], cage::kLayerColors.size()> kLayerColorMembers{
    &SuppleMaterialLayers::sheenColorFactor, &SuppleMaterialLayers::specularColorFactor};
/// In the order of cage::kLayerTextures.
inline constexpr std::array<SuppleTextureInfo SuppleMaterialLayers::*, cage::kLayerTextures.size()>
    kLayerTextureMembers{&SuppleMaterialLayers::clearcoat,       &SuppleMaterialLayers::clearcoatRoughness,
                         &SuppleMaterialLayers::clearcoatNormal, &SuppleMaterialLayers::sheenColor,
                         &SuppleMaterialLayers::sheenRoughness,  &SuppleMaterialLayers::transmission,
                         &SuppleMaterialLayers::specular,        &SuppleMaterialLayers::specularColor,
                         &SuppleMaterialLayers::iridescence,     &SuppleMaterialLayers::iridescenceThickness,
                         &SuppleMaterialLayers::anisotropy};

} // namespace supple::runtime
