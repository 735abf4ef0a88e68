// What shaders are told of a material.
#pragma once

#include "host/shaders/draw.h"

#include <array>
#include <supple/supple.h>

namespace supple::host {

using LayerSlots = std::array<uint32_t, 2>;

/// The textures that are looked up, in the order of shared::kBaseColor and so on.
template <class Info, class Layers>
[[nodiscard]] auto texturesOf(Info& material, Layers& layers) {
    const std::array textures{&material.baseColor,
                              &material.metallicRoughness,
                              &material.normal,
                              &material.occlusion,
                              &material.emissive,
                              &material.trim,
                              &layers.clearcoat,
                              &layers.clearcoatRoughness,
                              &layers.clearcoatNormal,
                              &layers.sheenColor,
                              &layers.sheenRoughness,
                              &layers.transmission,
                              &layers.anisotropy,
                              &layers.diffuseTransmissionColor,
                              &layers.specular,
                              &layers.specularColor,
                              &layers.iridescence,
                              &layers.iridescenceThickness,
                              &layers.diffuseTransmission,
                              &layers.thickness};
    static_assert(textures.size() == shared::kTextureCount);
    return textures;
}

/// `uv1`: there is a second UV set to look anything up on.
[[nodiscard]] shared::MaterialUniforms materialUniforms(const SuppleMaterialInfo& material,
                                                        const SuppleMaterialLayers& layers, bool uv1);
/// What it has: shared::kMaterial...
[[nodiscard]] uint32_t materialFlags(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers, bool uv1);
/// Where its layers' textures are, in the order of shared::kClearcoat and so on: see shared::kLayerSlotsPerWord. Those
/// that are one too many have no place.
[[nodiscard]] LayerSlots layerSlots(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers);
/// The same of one of them; none: shared::kNoLayerSlot.
[[nodiscard]] uint32_t layerSlotOf(const LayerSlots& slots, uint32_t texture);
/// It is looked at along tangents of the surface.
[[nodiscard]] bool needsTangents(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers);
/// Light goes through it, as through thin glass.
[[nodiscard]] bool isGlass(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers);

} // namespace supple::host
