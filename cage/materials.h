// What readers, writers and tools do with materials alike.
#pragma once

#include "cage/character.h"
#include "cage/material_layers.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage {

/// All that a material looks up, but its trim.
[[nodiscard]] inline std::array<const Texture*, 5 + kLayerTextures.size()> texturesOf(const Material& material) {
    std::array<const Texture*, 5 + kLayerTextures.size()> textures{
        &material.baseColorTexture, &material.metallicRoughnessTexture, &material.normalTexture,
        &material.occlusionTexture, &material.emissiveTexture};
    std::transform(kLayerTextures.begin(), kLayerTextures.end(), textures.begin() + 5,
                   [&](const LayerTexture& row) { return &(material.layers.*row.member); });
    return textures;
}

/// Leaves out what a texture names of images that have no bytes; an alternate image then takes the place of the image.
/// A texture without an image is none.
inline void dropMissingImages(Texture& texture, std::span<const Image> images) {
    const auto present = [&](uint32_t image) { return image != kNone && !images[image].bytes.empty() ? image : kNone; };
    const uint32_t core = present(texture.image);
    const uint32_t alternate = present(texture.alternateImage);
    texture.image = core != kNone ? core : alternate;
    texture.alternateImage = core != kNone ? alternate : kNone;
    if (!texture.exists()) {
        texture = {};
    }
}

/// How many UV sets its textures and its trim need.
[[nodiscard]] inline uint32_t uvSetsOf(const Material& material) {
    uint32_t sets = 0;
    for (const Texture* texture : texturesOf(material)) {
        sets = std::max(sets, texture->exists() ? texture->uvSet + 1 : 0);
    }
    const bool trimmed = material.trim && material.trim->domain == TrimDomain::uv;
    return std::max(sets, trimmed ? material.trim->texture.uvSet + 1 : 0);
}

/// How a normal map lies: the texture coordinates of its own frame are turn() of those of a UV set. They have the
/// direction and the hand of those that it is looked up at, but not their scale.
struct MapFrame {
    uint32_t uvSet = 0;
    glm::vec2 down{0.0f, 1.0f}; ///< a unit vector: the second of its coordinates grows this way. Zero: none does
    float hand = 1.0f;          ///< -1: KHR_texture_transform mirrors it. 0: it has no area

    [[nodiscard]] glm::vec2 turn(const glm::vec2& uv) const {
        return {hand * (down.y * uv.x - down.x * uv.y), down.x * uv.x + down.y * uv.y};
    }
    bool operator==(const MapFrame&) const = default;
};

/// One for every material of a character. Empty if all are the first UV set as it is: then nobody needs to turn
/// anything. The frame of a map on a UV set that the cage lacks has no direction.
[[nodiscard]] std::vector<MapFrame> mapFramesOf(const Character& character);

/// That of a material; `frames`: mapFramesOf(). What is no material has the first UV set as it is.
[[nodiscard]] inline MapFrame mapFrameOf(std::span<const MapFrame> frames, uint32_t material) {
    return material < frames.size() ? frames[material] : MapFrame{};
}

/// The texture coordinates that tangents follow, one per corner; `frames`: mapFramesOf(). Empty if the cage has none.
[[nodiscard]] std::vector<glm::vec2> mapUvs(const Cage& cage, std::span<const MapFrame> frames);

/// A material of which only the name is known. glTF's own defaults are a rough metal, which few characters are made of.
[[nodiscard]] inline Material namedMaterial(std::string name) {
    Material material;
    material.name = std::move(name);
    material.metallicFactor = 0.0f;
    material.roughnessFactor = 0.6f;
    return material;
}

} // namespace supple::cage
