// The materials of a character: base color, that is a factor, a texture that Qt decodes, and the color of the vertices,
// which the shader has; metallic and roughness as factors. Whatever else glTF knows is left out.
#pragma once

#include "memory.h"

#include <QImage>

#include <algorithm>
#include <array>
#include <vector>

namespace qt_quick {

struct Material {
    std::array<float, 4> factor{1.0f, 1.0f, 1.0f, 1.0f};
    std::array<float, 8> uvRows{1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f}; ///< two rows of u, v, 1 and a rest
    float metallic = 0.0f;
    float roughness = 0.42f;
    bool doubleSided = true;
    Image texture;
    VkSampler sampler = VK_NULL_HANDLE;
};

class Materials {
public:
    /// Of all materials of the asset, and behind them one for faces without a material.
    Materials(const Gpu& gpu, const supple::Asset& asset, uint32_t count);

    /// Records what is still to be copied into the textures; their staging memory goes after this frame.
    void upload(VkCommandBuffer commands, Retired& retired, uint64_t frame);
    void destroy(); ///< the device has done with them

    const Material& of(uint32_t index) const { return all_[std::min<size_t>(index, all_.size() - 1)]; }
    size_t count() const { return all_.size(); }

private:
    struct Upload {
        VkImage image = VK_NULL_HANDLE;
        VkExtent2D extent{};
        uint32_t levels = 1;
        Buffer staging;
    };

    Material read(const supple::Asset& asset, const SuppleMaterialInfo& info);
    void setTexture(Material& material, const QImage& picture, const SuppleTextureInfo& info);

    Gpu gpu_;
    std::vector<Material> all_;
    std::vector<Upload> uploads_;
};

} // namespace qt_quick
