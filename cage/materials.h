// What readers, writers and tools do with materials alike.
#pragma once

#include "cage/character.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace supple::cage {

/// All that a material looks up, but its trim.
[[nodiscard]] inline std::array<const Texture*, 5> texturesOf(const Material& material) {
    return {&material.baseColorTexture, &material.metallicRoughnessTexture, &material.normalTexture,
            &material.occlusionTexture, &material.emissiveTexture};
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

/// A material of which only the name is known. glTF's own defaults are a rough metal, which few characters are made of.
[[nodiscard]] inline Material namedMaterial(std::string name) {
    Material material;
    material.name = std::move(name);
    material.metallicFactor = 0.0f;
    material.roughnessFactor = 0.6f;
    return material;
}

} // namespace supple::cage
