// What a material has beyond metallic and roughness, member by member: for all that read, write, check or tell them.
#pragma once

#include "cage/character.h"

#include <array>
#include <limits>
#include <string_view>

namespace supple::cage {

inline constexpr float kUnboundedLayer = std::numeric_limits<float>::max();

// Names are glTF's: of the extension, and of its member. Numbers are in low..high.
struct LayerNumber {
    const char* extension;
    const char* name;
    float MaterialLayers::*member;
    float low = 0.0f;
    float high = 1.0f;
};
struct LayerColor {
    const char* extension;
    const char* name;
    glm::vec3 MaterialLayers::*member;
    float high = 1.0f;
};
struct LayerTexture {
    const char* extension;
    const char* name;
    Texture MaterialLayers::*member;
    float MaterialLayers::*scale = nullptr; ///< of a normal map
};

inline constexpr std::array<const char*, 7> kLayerExtensions{
    "KHR_materials_clearcoat", "KHR_materials_sheen",       "KHR_materials_transmission", "KHR_materials_ior",
    "KHR_materials_specular",  "KHR_materials_iridescence", "KHR_materials_anisotropy"};

inline constexpr std::array<LayerNumber, 12> kLayerNumbers{{
    {kLayerExtensions[0], "clearcoatFactor", &MaterialLayers::clearcoatFactor},
    {kLayerExtensions[0], "clearcoatRoughnessFactor", &MaterialLayers::clearcoatRoughnessFactor},
    {kLayerExtensions[1], "sheenRoughnessFactor", &MaterialLayers::sheenRoughnessFactor},
    {kLayerExtensions[2], "transmissionFactor", &MaterialLayers::transmissionFactor},
    {kLayerExtensions[3], "ior", &MaterialLayers::ior, 0.0f, kUnboundedLayer},
    {kLayerExtensions[4], "specularFactor", &MaterialLayers::specularFactor},
    {kLayerExtensions[5], "iridescenceFactor", &MaterialLayers::iridescenceFactor},
    {kLayerExtensions[5], "iridescenceIor", &MaterialLayers::iridescenceIor, 1.0f, kUnboundedLayer},
    {kLayerExtensions[5], "iridescenceThicknessMinimum", &MaterialLayers::iridescenceThicknessMinimum, 0.0f,
     kUnboundedLayer},
    {kLayerExtensions[5], "iridescenceThicknessMaximum", &MaterialLayers::iridescenceThicknessMaximum, 0.0f,
     kUnboundedLayer},
    {kLayerExtensions[6], "anisotropyStrength", &MaterialLayers::anisotropyStrength},
    {kLayerExtensions[6], "anisotropyRotation", &MaterialLayers::anisotropyRotation, -kUnboundedLayer, kUnboundedLayer},
}};
inline constexpr std::array<LayerColor, 2> kLayerColors{{
    {kLayerExtensions[1], "sheenColorFactor", &MaterialLayers::sheenColorFactor},
    {kLayerExtensions[4], "specularColorFactor", &MaterialLayers::specularColorFactor, kUnboundedLayer},
}};
inline constexpr std::array<LayerTexture, 11> kLayerTextures{{
    {kLayerExtensions[0], "clearcoatTexture", &MaterialLayers::clearcoatTexture},
    {kLayerExtensions[0], "clearcoatRoughnessTexture", &MaterialLayers::clearcoatRoughnessTexture},
    {kLayerExtensions[0], "clearcoatNormalTexture", &MaterialLayers::clearcoatNormalTexture,
     &MaterialLayers::clearcoatNormalScale},
    {kLayerExtensions[1], "sheenColorTexture", &MaterialLayers::sheenColorTexture},
    {kLayerExtensions[1], "sheenRoughnessTexture", &MaterialLayers::sheenRoughnessTexture},
    {kLayerExtensions[2], "transmissionTexture", &MaterialLayers::transmissionTexture},
    {kLayerExtensions[4], "specularTexture", &MaterialLayers::specularTexture},
    {kLayerExtensions[4], "specularColorTexture", &MaterialLayers::specularColorTexture},
    {kLayerExtensions[5], "iridescenceTexture", &MaterialLayers::iridescenceTexture},
    {kLayerExtensions[5], "iridescenceThicknessTexture", &MaterialLayers::iridescenceThicknessTexture},
    {kLayerExtensions[6], "anisotropyTexture", &MaterialLayers::anisotropyTexture},
}};

/// Whether anything of an extension of kLayerExtensions differs from what a material is without it.
[[nodiscard]] inline bool hasLayer(const MaterialLayers& layers, std::string_view extension) {
    const MaterialLayers none;
    bool differs = false;
    const auto compare = [&](const auto& table) {
        for (const auto& row : table) {
            differs = differs || (row.extension == extension && !(layers.*row.member == none.*row.member));
        }
    };
    compare(kLayerNumbers);
    compare(kLayerColors);
    compare(kLayerTextures);
    return differs;
}

} // namespace supple::cage
