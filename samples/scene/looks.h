// What figures look like: the materials and textures of their files, and the tints of each. All of it lies in buffers
// and in one array of textures, so that every draw finds its own by number.
#pragma once

#include "host/pipelines.h"
#include "market.h"

namespace market {

/// shaders/figure.frag has as many.
inline constexpr uint32_t kTextures = 16;

/// shaders/figure.glsl
struct Material {
    glm::vec4 baseColor{1.0f};
    float metallic = 0.0f, roughness = 0.6f;
    uint32_t colorTexture = 0, surfaceTexture = 0; ///< in the array; 0 is white
    uint32_t tint = static_cast<uint32_t>(Tint::none);
    uint32_t unused[3]{};
};
/// shaders/figure.glsl
struct Look {
    std::array<glm::vec4, kTints> tints{};
    uint32_t firstMaterial = 0;
    uint32_t lastMaterial = 0; ///< of faces without one
    uint32_t unused[2]{};
};

class Looks {
public:
    Looks(Device& device, const Market& market);

    [[nodiscard]] const Buffer& materials() const { return materialBuffer_; }
    /// One a figure.
    [[nodiscard]] const Buffer& looks() const { return lookBuffer_; }
    /// kTextures of them, of an array.
    [[nodiscard]] std::vector<Write> textureWrites(uint32_t binding) const;

private:
    /// A file's materials, behind the others; returns its Look, without tints.
    Look addMaterials(Device& device, const supple::Asset& asset);
    /// The number of a texture in the array.
    uint32_t addTexture(Device& device, const supple::Asset& asset, const SuppleTextureInfo& texture, bool isColor);

    std::vector<Material> materials_;
    std::vector<Image> textures_;
    std::vector<std::pair<uint32_t, uint32_t>> known_; ///< images of the file that is being read, and their numbers
    Buffer materialBuffer_, lookBuffer_;
    VkSampler sampler_ = VK_NULL_HANDLE;
};

} // namespace market
