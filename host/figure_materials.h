// What a figure's materials look like: as Supple tells them, with their images decoded and on the device.
#pragma once

#include "host/context.h"
#include "host/shaders/draw.h"
#include "host/texture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace supple::host {

class FigureMaterials {
public:
    /// `path` begins the messages. A texture whose image cannot be read is left out, with a warning on stderr; only a
    /// trim's is an error, because it is part of the shape.
    [[nodiscard]] Status load(Context& context, SuppleAsset asset, const std::string& path);

    /// One a material, and one more at the end for what has none.
    [[nodiscard]] const std::vector<SuppleMaterialInfo>& infos() const { return infos_; }
    /// Of infos(); `material` may be SUPPLE_NO_MATERIAL.
    [[nodiscard]] size_t indexOf(uint32_t material) const { return std::min<size_t>(material, infos_.size() - 1); }
    [[nodiscard]] const SuppleMaterialInfo& of(uint32_t material) const { return infos_[indexOf(material)]; }
    /// What that one has beyond infos().
    [[nodiscard]] const SuppleMaterialLayers& layersAt(size_t index) const { return layers_[index]; }
    [[nodiscard]] const SuppleMaterialLayers& layersOf(uint32_t material) const { return layers_[indexOf(material)]; }
    /// `slot`: shared::kBaseColor and the others. White where the material of infos() has no such texture.
    [[nodiscard]] const Image& texture(size_t index, uint32_t slot) const {
        return textures_[slots_[index][slot]].image;
    }
    /// It has more textures than base color, metallic and roughness, and the trim, or highlights that are stretched.
    [[nodiscard]] bool hasMaps(uint32_t material) const;
    /// Any of them has a normal map.
    [[nodiscard]] bool hasNormalMaps() const;
    /// Any of them is looked at along tangents of the surface.
    [[nodiscard]] bool needTangents() const;
    /// The back of its faces is not drawn, because the file says so. What knows nothing of sides shows both.
    [[nodiscard]] bool isOneSided(uint32_t material) const {
        return !knowsNoSides_ && indexOf(material) + 1 < infos_.size() && of(material).doubleSided == 0;
    }
    /// The base color's mean: factor times texture, linear.
    [[nodiscard]] glm::vec3 averageColor(size_t index) const;

private:
    struct Texture {
        Image image;
        glm::vec3 average{1.0f}; ///< in linear light
    };

    [[nodiscard]] Status loadTextures(Context& context, SuppleAsset asset, const std::string& path);
    /// Which of textures_ a texture's image became, or its alternate image where the first cannot be decoded.
    [[nodiscard]] Result<size_t> load(Context& context, SuppleAsset asset, const std::string& path,
                                      const SuppleTextureInfo& texture, TextureKind kind, bool required);
    [[nodiscard]] Result<size_t> upload(Device& device, const Picture& picture, TextureKind kind);

    std::vector<SuppleMaterialInfo> infos_;
    std::vector<SuppleMaterialLayers> layers_;                     ///< one of infos_
    std::vector<std::array<size_t, shared::kTextureCount>> slots_; ///< one of infos_: which of textures_
    std::vector<Texture> textures_;                                ///< the first one is white
    bool knowsNoSides_ = false;                                    ///< OBJ
    std::map<std::pair<uint32_t, TextureKind>, size_t> known_;
    std::set<uint32_t> unread_; ///< images of which it was said
};

} // namespace supple::host
