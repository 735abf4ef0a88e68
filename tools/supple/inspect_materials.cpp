#include "tools/supple/inspect_materials.h"

#include "cage/materials.h"
#include "cage/trim.h"

#include <array>
#include <cstdio>
#include <optional>
#include <utility>

namespace supple::tools {
namespace {

using Json = nlohmann::ordered_json;

// As glTF names them.
constexpr std::array kAlphaModes{"OPAQUE", "MASK", "BLEND"};
constexpr std::array kWraps{"REPEAT", "CLAMP_TO_EDGE", "MIRRORED_REPEAT"};
constexpr std::array kFilters{"ANY",
                              "NEAREST",
                              "LINEAR",
                              "NEAREST_MIPMAP_NEAREST",
                              "LINEAR_MIPMAP_NEAREST",
                              "NEAREST_MIPMAP_LINEAR",
                              "LINEAR_MIPMAP_LINEAR"};

template <class Names, class Value>
const char* nameOf(const Names& names, Value value) {
    return names[static_cast<size_t>(value)];
}

template <class Vec>
Json numbers(const Vec& vector) {
    Json list = Json::array();
    for (int k = 0; k < vector.length(); ++k) {
        list.push_back(vector[k]);
    }
    return list;
}

Json imageNumber(uint32_t image) {
    return image == cage::kNone ? Json() : Json(image);
}

/// Null where there is none.
Json toJson(const cage::Texture& texture) {
    if (!texture.exists()) {
        return {};
    }
    Json json;
    json["image"] = texture.image;
    json["alternateImage"] = imageNumber(texture.alternateImage);
    json["uvSet"] = texture.uvSet;
    json["wrap"] = {nameOf(kWraps, texture.wrapU), nameOf(kWraps, texture.wrapV)};
    json["magFilter"] = nameOf(kFilters, texture.magFilter);
    json["minFilter"] = nameOf(kFilters, texture.minFilter);
    json["offset"] = numbers(texture.offset);
    json["rotation"] = texture.rotation;
    json["scale"] = numbers(texture.scale);
    return json;
}

/// As in material.extras.trim.
std::string channelName(uint32_t channel) {
    return std::string(1, "rgba"[channel]);
}

Json toJson(const cage::Trim& trim) {
    const bool face = trim.domain == cage::TrimDomain::face;
    Json json;
    json["domain"] = face ? "face" : "uv";
    json["texture"] = toJson(trim.texture);
    if (face) {
        json["tiles"] = trim.tiles;
    }
    json["channel"] = channelName(trim.channel);
    json["cutoff"] = trim.cutoff;
    return json;
}

std::string shortNumber(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", static_cast<double>(value));
    return text;
}

template <class Vec>
std::string shortNumbers(const Vec& vector) {
    std::string text;
    for (int k = 0; k < vector.length(); ++k) {
        text += (k == 0 ? "" : " ") + shortNumber(vector[k]);
    }
    return text;
}

std::string toText(const cage::Trim& trim) {
    const std::string image = std::to_string(trim.texture.image);
    const std::string where = trim.domain == cage::TrimDomain::face
                                  ? "faces' tiles, " + std::to_string(trim.tiles) + " in image " + image
                                  : "UV set " + std::to_string(trim.texture.uvSet) + ", image " + image;
    return "trimmed on " + where + ", channel " + channelName(trim.channel) + " below " + shortNumber(trim.cutoff);
}

std::string toText(const cage::Texture& texture) {
    std::string text = "image " + std::to_string(texture.image);
    if (texture.alternateImage != cage::kNone) {
        text += " or " + std::to_string(texture.alternateImage);
    }
    text += " on UV set " + std::to_string(texture.uvSet);
    if (texture.wrapU != cage::Wrap::repeat || texture.wrapV != cage::Wrap::repeat) {
        text += std::string(" ") + nameOf(kWraps, texture.wrapU) + "/" + nameOf(kWraps, texture.wrapV);
    }
    if (texture.offset != glm::vec2(0.0f) || texture.rotation != 0.0f || texture.scale != glm::vec2(1.0f)) {
        text += " (offset " + shortNumbers(texture.offset) + ", rotation " + shortNumber(texture.rotation) +
                ", scale " + shortNumbers(texture.scale) + ")";
    }
    return text;
}

/// By extension, those that the material has.
Json toJson(const cage::MaterialLayers& layers) {
    Json json = Json::object();
    for (const std::string_view extension : cage::kLayerExtensions) {
        if (!cage::hasLayer(layers, extension)) {
            continue;
        }
        Json& members = json[std::string(extension)];
        const auto add = [&](const auto& table, auto&& told) {
            for (const auto& row : table) {
                if (row.extension == extension) {
                    members[row.name] = told(layers.*row.member);
                }
            }
        };
        add(cage::kLayerNumbers, [](float number) { return Json(number); });
        add(cage::kLayerColors, [](const glm::vec3& color) { return numbers(color); });
        add(cage::kLayerTextures, [](const cage::Texture& texture) { return toJson(texture); });
    }
    if (layers.clearcoatNormalTexture.exists()) {
        json[cage::kLayerExtensions[0]]["clearcoatNormalScale"] = layers.clearcoatNormalScale;
    }
    return json;
}

/// "clearcoat: factor 1, roughness factor 0.1, texture image 2 on UV set 0"; empty without the extension.
std::string toText(const cage::MaterialLayers& layers, std::string_view extension) {
    constexpr std::string_view kFamily = "KHR_materials_";
    if (!cage::hasLayer(layers, extension)) {
        return {};
    }
    std::string text;
    const auto add = [&](const std::string& name, const std::string& value) {
        text += (text.empty() ? "" : ", ") + name + " " + value;
    };
    const cage::MaterialLayers none;
    const auto addTable = [&](const auto& table, auto&& told) {
        for (const auto& row : table) {
            if (row.extension == extension && !(layers.*row.member == none.*row.member)) {
                add(row.name, told(layers.*row.member));
            }
        }
    };
    addTable(cage::kLayerNumbers, [](float number) { return shortNumber(number); });
    addTable(cage::kLayerColors, [](const glm::vec3& color) { return shortNumbers(color); });
    addTable(cage::kLayerTextures, [](const cage::Texture& texture) { return toText(texture); });
    return std::string(extension.substr(kFamily.size())) + ": " + text;
}

} // namespace

Json materialJson(const cage::Material& material) {
    Json json;
    json["name"] = material.name;
    json["alphaMode"] = nameOf(kAlphaModes, material.alphaMode);
    json["alphaCutoff"] = material.alphaCutoff;
    json["doubleSided"] = material.doubleSided;
    json["unlit"] = material.unlit;
    json["baseColorFactor"] = numbers(material.baseColorFactor);
    json["baseColorTexture"] = toJson(material.baseColorTexture);
    json["metallicFactor"] = material.metallicFactor;
    json["roughnessFactor"] = material.roughnessFactor;
    json["metallicRoughnessTexture"] = toJson(material.metallicRoughnessTexture);
    json["normalScale"] = material.normalScale;
    json["normalTexture"] = toJson(material.normalTexture);
    json["occlusionStrength"] = material.occlusionStrength;
    json["occlusionTexture"] = toJson(material.occlusionTexture);
    json["emissiveFactor"] = numbers(material.emissiveFactor);
    json["emissiveStrength"] = material.emissiveStrength;
    json["emissiveTexture"] = toJson(material.emissiveTexture);
    if (const Json layers = toJson(material.layers); !layers.empty()) {
        json["layers"] = layers;
    }
    if (const std::optional<cage::Trim> trim = cage::trimOf(material)) {
        json["trim"] = toJson(*trim);
    }
    return json;
}

std::string materialText(const cage::Material& material) {
    std::string text = material.name;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "  ") + part; };
    add("base color " + shortNumbers(material.baseColorFactor));
    add("metallic " + shortNumber(material.metallicFactor));
    add("roughness " + shortNumber(material.roughnessFactor));
    if (material.emissiveFactor != glm::vec3(0.0f)) {
        add("emissive " + shortNumbers(material.emissiveFactor) +
            (material.emissiveStrength != 1.0f ? " times " + shortNumber(material.emissiveStrength) : ""));
    }
    constexpr std::array kUses{"base color", "metallic and roughness", "normals", "occlusion", "emission"};
    const auto textures = cage::texturesOf(material); // those of layers are behind the core's
    for (size_t i = 0; i < kUses.size(); ++i) {
        if (textures[i]->exists()) {
            add(std::string(kUses[i]) + ": " + toText(*textures[i]));
        }
    }
    for (const std::string_view extension : cage::kLayerExtensions) {
        if (const std::string layer = toText(material.layers, extension); !layer.empty()) {
            add(layer);
        }
    }
    if (material.unlit) {
        add("unlit");
    }
    if (material.alphaMode != cage::AlphaMode::opaque) {
        add(std::string("alpha ") + nameOf(kAlphaModes, material.alphaMode));
    }
    if (material.doubleSided) {
        add("double-sided");
    }
    if (const std::optional<cage::Trim> trim = cage::trimOf(material)) {
        add(toText(*trim));
    }
    return text;
}

} // namespace supple::tools
