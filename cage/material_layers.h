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

inline constexpr std::array<const char*, 9> kLayerExtensions{
    "KHR_materials_clearcoat",    "KHR_materials_sheen",
    "KHR_materials_transmission", "KHR_materials_ior",
    "KHR_materials_specular",     "KHR_materials_iridescence",
    "KHR_materials_anisotropy",   "KHR_materials_diffuse_transmission",
    "KHR_materials_volume"};

// The members, each once: X(which of kLayerExtensions, name, what else its row has). A texture's member is its name and
// "Texture". SuppleMaterialLayers has members of these names (runtime/material_layers.h).
#define SUPPLE_LAYER_NUMBERS(X)                                                                                        \
    X(0, clearcoatFactor)                                                                                              \
    X(0, clearcoatRoughnessFactor)                                                                                     \
    X(1, sheenRoughnessFactor)                                                                                         \
    X(2, transmissionFactor)                                                                                           \
    X(3, ior, 0.0f, kUnboundedLayer)                                                                                   \
    X(4, specularFactor)                                                                                               \
    X(5, iridescenceFactor)                                                                                            \
    X(5, iridescenceIor, 1.0f, kUnboundedLayer)                                                                        \
    X(5, iridescenceThicknessMinimum, 0.0f, kUnboundedLayer)                                                           \
    X(5, iridescenceThicknessMaximum, 0.0f, kUnboundedLayer)                                                           \
    X(6, anisotropyStrength)                                                                                           \
    X(6, anisotropyRotation, -kUnboundedLayer, kUnboundedLayer)                                                        \
    X(7, diffuseTransmissionFactor)                                                                                    \
    X(8, thicknessFactor, 0.0f, kUnboundedLayer)                                                                       \
    X(8, attenuationDistance, 0.0f, kUnboundedLayer)
#define SUPPLE_LAYER_COLORS(X)                                                                                         \
    X(1, sheenColorFactor)                                                                                             \
    X(4, specularColorFactor, kUnboundedLayer)                                                                         \
    X(7, diffuseTransmissionColorFactor)                                                                               \
    X(8, attenuationColor)
#define SUPPLE_LAYER_TEXTURES(X)                                                                                       \
    X(0, clearcoat)                                                                                                    \
    X(0, clearcoatRoughness)                                                                                           \
    X(0, clearcoatNormal, &MaterialLayers::clearcoatNormalScale)                                                       \
    X(1, sheenColor)                                                                                                   \
    X(1, sheenRoughness)                                                                                               \
    X(2, transmission)                                                                                                 \
    X(4, specular)                                                                                                     \
    X(4, specularColor)                                                                                                \
    X(5, iridescence)                                                                                                  \
    X(5, iridescenceThickness)                                                                                         \
    X(6, anisotropy)                                                                                                   \
    X(7, diffuseTransmission)                                                                                          \
    X(7, diffuseTransmissionColor)                                                                                     \
    X(8, thickness)

#define SUPPLE_ROW(extension, name, ...)                                                                               \
    {kLayerExtensions[extension], #name, &MaterialLayers::name __VA_OPT__(, ) __VA_ARGS__},
inline constexpr auto kLayerNumbers = std::to_array<LayerNumber>({SUPPLE_LAYER_NUMBERS(SUPPLE_ROW)});
inline constexpr auto kLayerColors = std::to_array<LayerColor>({SUPPLE_LAYER_COLORS(SUPPLE_ROW)});
#undef SUPPLE_ROW
#define SUPPLE_ROW(extension, name, ...)                                                                               \
    {kLayerExtensions[extension], #name "Texture", &MaterialLayers::name##Texture __VA_OPT__(, ) __VA_ARGS__},
inline constexpr auto kLayerTextures = std::to_array<LayerTexture>({SUPPLE_LAYER_TEXTURES(SUPPLE_ROW)});
#undef SUPPLE_ROW

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
