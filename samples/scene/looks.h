// What figures look like: the materials and textures of their files, and the tints of each. Draws find their material
// and their figure by number; draws with the same textures are issued together.
#pragma once

#include "host/pipelines.h"
#include "market.h"

namespace market {

/// shaders/figure.glsl
struct Material {
    glm::vec4 baseColor{1.0f};
    float metallic = 0.0f, roughness = 0.6f;
    uint32_t tint = static_cast<uint32_t>(Tint::none);
    uint32_t unused = 0;
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
    /// Color and surface (roughness, metal), with which some draws are issued together.
    struct Textures {
        uint32_t color = 0, surface = 0; ///< numbers of images; 0 is white
        bool operator==(const Textures&) const = default;
    };
    [[nodiscard]] const std::vector<Textures>& textureSets() const { return textureSets_; }
    /// Which of these a figure's material has.
    [[nodiscard]] uint32_t textureSetOf(uint32_t figure, uint32_t material) const;
    [[nodiscard]] Write textureWrite(uint32_t binding, uint32_t texture) const;

private:
    /// A file's materials, behind the others; returns its Look, without tints.
    Look addMaterials(Device& device, const supple::Asset& asset);
    /// Gives the material that was added last its textures.
    void addTextureSet(Textures textures);
    /// The number of its image.
    uint32_t addTexture(Device& device, const supple::Asset& asset, const SuppleTextureInfo& texture, bool isColor);

    std::vector<Material> materials_;
    std::vector<uint32_t> setOfMaterial_; ///< one of materials_
    std::vector<Look> looks_;             ///< one a figure
    std::vector<Image> textures_;
    std::vector<Textures> textureSets_;
    std::vector<std::pair<uint32_t, uint32_t>> known_; ///< images of the file that is being read, and their numbers
    Buffer materialBuffer_, lookBuffer_;
    VkSampler sampler_ = VK_NULL_HANDLE;
};

} // namespace market
