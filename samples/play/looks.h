// What the character looks like: the materials and textures of its file.
#pragma once

#include "host/pipelines.h"

#include <array>
#include <glm/glm.hpp>
#include <supple/supple.hpp>
#include <utility>
#include <vector>

namespace play {

using namespace supple::host;

/// Bindings of its descriptor set.
enum Texture : uint32_t { kColorTexture, kSurfaceTexture, kNormalTexture, kTextures };

struct Look {
    glm::vec4 baseColor{1.0f};
    float metallic = 0.0f, roughness = 0.6f;
    std::array<uint32_t, kTextures> textures{}; ///< numbers of images
};

class Looks {
public:
    Looks(Device& device, const supple::Asset& asset);

    /// One for each material of the file, and one for faces without a material.
    [[nodiscard]] const std::vector<Look>& all() const { return looks_; }
    [[nodiscard]] uint32_t indexOf(uint32_t material) const;
    [[nodiscard]] std::array<Write, kTextures> writes(const Look& look) const;

private:
    [[nodiscard]] uint32_t addTexture(Device& device, const supple::Asset& asset, const SuppleTextureInfo& texture,
                                      Texture kind);

    std::vector<Look> looks_;
    std::vector<Image> images_;                        ///< white first, then a normal map without bumps
    std::vector<std::pair<uint32_t, uint32_t>> known_; ///< images of the file, and their numbers here
    VkSampler sampler_ = VK_NULL_HANDLE;
};

} // namespace play
