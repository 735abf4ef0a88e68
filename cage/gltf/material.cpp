#include "cage/gltf/material.h"

#include "cage/gltf/trim.h"

#include <utility>

namespace supple::cage::gltf {
namespace {

using supple_tinygltf::Model;

Wrap wrapOf(int value) {
    return value == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clampToEdge
           : value == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirroredRepeat
                                                            : Wrap::repeat;
}

} // namespace

WrapModes wrapModesOf(const Document& document, size_t texture) {
    const int sampler = document.model.textures[texture].sampler;
    if (sampler < 0) {
        return {};
    }
    const auto& modes = document.model.samplers[static_cast<size_t>(sampler)];
    return {wrapOf(modes.wrapS), wrapOf(modes.wrapT)};
}

std::vector<Material> readMaterials(const Document& document, Warnings& warnings) {
    const Model& model = document.model;
    std::vector<Material> materials;
    for (size_t i = 0; i < model.materials.size(); ++i) {
        const auto& from = model.materials[i];
        Material material;
        material.name = from.name;
        const auto& pbr = from.pbrMetallicRoughness;
        for (int k = 0; k < 4; ++k) {
            material.baseColorFactor[k] = static_cast<float>(pbr.baseColorFactor[static_cast<size_t>(k)]);
        }
        material.doubleSided = from.doubleSided;
        material.alphaCutoff = static_cast<float>(from.alphaCutoff);
        if (from.alphaMode == "MASK") {
            material.alphaMode = AlphaMode::mask;
        } else if (from.alphaMode == "BLEND") {
            material.alphaMode = AlphaMode::blend;
        } else if (!from.alphaMode.empty() && from.alphaMode != "OPAQUE") {
            warn(warnings, at("material", i) + " alphaMode", quoted(from.alphaMode) + " is unknown; opaque");
        }
        if (pbr.baseColorTexture.index >= 0) {
            const auto& texture = model.textures[static_cast<size_t>(pbr.baseColorTexture.index)];
            const int uvSet = pbr.baseColorTexture.texCoord;
            if (pbr.baseColorTexture.extensions.count("KHR_texture_transform") != 0) {
                warn(warnings, at("material", i) + " baseColorTexture", "KHR_texture_transform is ignored");
            }
            if (uvSet != 0 && uvSet != 1) {
                warn(warnings, at("material", i) + " baseColorTexture",
                     "texCoord " + std::to_string(uvSet) + ": only TEXCOORD_0 and TEXCOORD_1 are read; left out");
            } else if (texture.source < 0) {
                warn(warnings, at("texture", static_cast<size_t>(pbr.baseColorTexture.index)),
                     "no image in a core format; left out");
            } else if (!document.images[static_cast<size_t>(texture.source)].bytes.empty()) {
                material.baseColorImage = static_cast<uint32_t>(texture.source);
                material.baseColorUvSet = static_cast<uint32_t>(uvSet);
            }
            const WrapModes wrap = wrapModesOf(document, static_cast<size_t>(pbr.baseColorTexture.index));
            material.wrapU = wrap.u;
            material.wrapV = wrap.v;
        }
        material.trim = readTrim(document, i, warnings);
        materials.push_back(std::move(material));
    }
    return materials;
}

} // namespace supple::cage::gltf
