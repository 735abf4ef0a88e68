#include "tools/gltf/material_writer.h"

#include "cage/image_header.h"
#include "cage/material_layers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

namespace supple::cage::gltf {
namespace {

/// The decimal number with the fewest digits that reads as the float: 0.6, not 0.6000000238418579.
double shortest(float value) {
    char text[32];
    const char* const end = std::to_chars(text, text + sizeof text, value).ptr;
    double number = 0.0;
    std::from_chars(text, end, number);
    return number;
}

/// Left out where it is glTF's default.
void writeNumber(json& object, const char* key, float value, float byDefault) {
    if (value != byDefault) {
        object[key] = shortest(value);
    }
}

int wrapValue(Wrap wrap) {
    switch (wrap) {
    case Wrap::clampToEdge:
        return 33071;
    case Wrap::mirroredRepeat:
        return 33648;
    case Wrap::repeat:
        break;
    }
    return 10497;
}

int filterValue(Filter filter) {
    switch (filter) {
    case Filter::nearest:
        return 9728;
    case Filter::linear:
        return 9729;
    default:
        return 9984 + static_cast<int>(filter) - static_cast<int>(Filter::nearestMipmapNearest);
    }
}

class MaterialWriter {
public:
    MaterialWriter(std::span<const Image> images, Packer& packer, Warnings& warnings)
        : sources_(images), packer_(packer), warnings_(warnings) {}

    void write(std::span<const Material> from, json& root) {
        json materials = json::array();
        for (const Material& material : from) {
            materials.push_back(writeMaterial(material));
        }
        for (auto [key, list] : {std::pair("materials", &materials),
                                 {"textures", &textures_},
                                 {"samplers", &samplers_},
                                 {"images", &images_}}) {
            if (!list->empty()) {
                root[key] = std::move(*list);
            }
        }
        for (const auto& [key, names] : {std::pair("extensionsUsed", &used_), {"extensionsRequired", &required_}}) {
            for (const std::string& name : *names) {
                root[key].push_back(name);
            }
        }
    }

private:
    json writeMaterial(const Material& from) {
        json material = json::object();
        if (!from.name.empty()) {
            material["name"] = from.name;
        }
        json surface = json::object();
        if (from.baseColorFactor != glm::vec4(1.0f)) {
            surface["baseColorFactor"] = numbers(glm::clamp(from.baseColorFactor, 0.0f, 1.0f));
        }
        writeNumber(surface, "metallicFactor", from.metallicFactor, 1.0f);
        writeNumber(surface, "roughnessFactor", from.roughnessFactor, 1.0f);
        writeInfo(surface, "baseColorTexture", from.baseColorTexture);
        writeInfo(surface, "metallicRoughnessTexture", from.metallicRoughnessTexture);
        if (!surface.empty()) {
            material["pbrMetallicRoughness"] = std::move(surface);
        }
        if (writeInfo(material, "normalTexture", from.normalTexture)) {
            writeNumber(material["normalTexture"], "scale", from.normalScale, 1.0f);
        }
        if (writeInfo(material, "occlusionTexture", from.occlusionTexture)) {
            writeNumber(material["occlusionTexture"], "strength", from.occlusionStrength, 1.0f);
        }
        writeInfo(material, "emissiveTexture", from.emissiveTexture);
        if (from.emissiveFactor != glm::vec3(0.0f)) {
            material["emissiveFactor"] = numbers(glm::clamp(from.emissiveFactor, 0.0f, 1.0f));
        }
        if (from.emissiveStrength != 1.0f) {
            addExtension(material, "KHR_materials_emissive_strength")["emissiveStrength"] =
                shortest(from.emissiveStrength);
        }
        if (from.unlit) {
            addExtension(material, "KHR_materials_unlit");
        }
        for (const std::string_view extension : kLayerExtensions) {
            if (hasLayer(from.layers, extension)) {
                writeLayer(from.layers, extension, material);
            }
        }
        writeVisibility(from, material);
        return material;
    }

    void writeLayer(const MaterialLayers& from, std::string_view extension, json& material) {
        const MaterialLayers none;
        json& layer = addExtension(material, std::string(extension).c_str());
        for (const LayerNumber& row : kLayerNumbers) {
            if (row.extension == extension) {
                writeNumber(layer, row.name, from.*row.member, none.*row.member);
            }
        }
        for (const LayerColor& row : kLayerColors) {
            if (row.extension == extension && from.*row.member != none.*row.member) {
                layer[row.name] = numbers(from.*row.member);
            }
        }
        for (const LayerTexture& row : kLayerTextures) {
            if (row.extension == extension && writeInfo(layer, row.name, from.*row.member) && row.scale != nullptr) {
                writeNumber(layer[row.name], "scale", from.*row.scale, 1.0f);
            }
        }
    }

    void writeVisibility(const Material& from, json& material) {
        if (from.alphaMode == AlphaMode::mask) {
            material["alphaMode"] = "MASK";
            material["alphaCutoff"] = shortest(std::max(from.alphaCutoff, 0.0f));
        } else if (from.alphaMode == AlphaMode::blend) {
            material["alphaMode"] = "BLEND";
        }
        if (from.doubleSided) {
            material["doubleSided"] = true;
        }
        if (from.trim) {
            writeTrim(*from.trim, material);
        }
    }

    void writeTrim(const Trim& from, json& material) {
        constexpr std::array kChannels{"r", "g", "b", "a"};
        json trim = {{"channel", kChannels[from.channel]}, {"cutoff", from.cutoff}};
        Texture texture = from.texture;
        const bool face = from.domain == TrimDomain::face;
        trim["domain"] = face ? "face" : "uv";
        if (face) {
            trim["tiles"] = from.tiles;
            texture.uvSet = 0;
        }
        if (writeInfo(trim, "texture", texture)) {
            material["extras"] = {{"trim", std::move(trim)}};
        }
    }

    /// An object of the extension's members, which are still to be filled in.
    json& addExtension(json& object, const char* name) {
        used_.insert(name);
        return object["extensions"][name] = json::object();
    }

    /// False: there is no such texture, or its image cannot be written.
    bool writeInfo(json& object, const char* key, const Texture& from) {
        const uint32_t image = from.exists() ? writeImage(from.image) : kNone;
        if (image == kNone) {
            return false;
        }
        json info = {{"index", writeTexture(from, image)}};
        if (from.uvSet != 0) {
            info["texCoord"] = from.uvSet;
        }
        if (from.offset != glm::vec2(0.0f) || from.rotation != 0.0f || from.scale != glm::vec2(1.0f)) {
            json& transform = addExtension(info, "KHR_texture_transform");
            transform = {{"offset", numbers(from.offset)}, {"scale", numbers(from.scale)}};
            writeNumber(transform, "rotation", from.rotation, 0.0f);
        }
        object[key] = std::move(info);
        return true;
    }

    /// glTF's image, kNone where it cannot be one.
    uint32_t writeImage(uint32_t index) {
        const auto [known, isNew] = writtenImages_.try_emplace(index, kNone);
        if (!isNew) {
            return known->second;
        }
        const Image& from = sources_[index];
        const char* type = imageType(from.bytes);
        if (type == nullptr) {
            warn(warnings_, at("image", index), "is neither PNG, JPEG, WebP nor KTX2; left out");
            return kNone;
        }
        json image = {{"bufferView", packer_.addBytes(from.bytes)}, {"mimeType", type}};
        if (!from.name.empty()) {
            image["name"] = from.name;
        }
        known->second = static_cast<uint32_t>(images_.size());
        images_.push_back(std::move(image));
        return known->second;
    }

    /// Of an image that is written: of the core if it is PNG or JPEG, else of the extension for its format.
    void writeSource(json& texture, uint32_t image, bool alone) {
        const std::string type = images_[image]["mimeType"];
        if (type == "image/png" || type == "image/jpeg") {
            texture["source"] = image;
            return;
        }
        const char* name = type == "image/webp" ? "EXT_texture_webp" : "KHR_texture_basisu";
        addExtension(texture, name)["source"] = image;
        if (alone) {
            required_.insert(name);
        }
    }

    size_t writeTexture(const Texture& from, uint32_t image) {
        const uint32_t alternate = from.alternateImage != kNone ? writeImage(from.alternateImage) : kNone;
        const Sampling sampling{from.wrapU, from.wrapV, from.magFilter, from.minFilter};
        const auto [known, isNew] = writtenTextures_.try_emplace({image, alternate, sampling}, textures_.size());
        if (isNew) {
            json texture = {{"sampler", writeSampler(sampling)}};
            writeSource(texture, image, alternate == kNone);
            if (alternate != kNone) {
                writeSource(texture, alternate, false);
            }
            textures_.push_back(std::move(texture));
        }
        return known->second;
    }

    using Sampling = std::tuple<Wrap, Wrap, Filter, Filter>;

    size_t writeSampler(const Sampling& sampling) {
        const auto [known, isNew] = writtenSamplers_.try_emplace(sampling, samplers_.size());
        if (isNew) {
            const auto& [wrapU, wrapV, magFilter, minFilter] = sampling;
            json sampler = {{"wrapS", wrapValue(wrapU)}, {"wrapT", wrapValue(wrapV)}};
            for (const auto& [key, filter] : {std::pair("magFilter", magFilter), {"minFilter", minFilter}}) {
                if (filter != Filter::any) {
                    sampler[key] = filterValue(filter);
                }
            }
            samplers_.push_back(std::move(sampler));
        }
        return known->second;
    }

    const std::span<const Image> sources_;
    Packer& packer_;
    Warnings& warnings_;
    json textures_ = json::array();
    json samplers_ = json::array();
    json images_ = json::array();
    std::set<std::string> used_; ///< extensions
    std::set<std::string> required_;
    std::map<uint32_t, uint32_t> writtenImages_;
    std::map<std::tuple<uint32_t, uint32_t, Sampling>, size_t> writtenTextures_;
    std::map<Sampling, size_t> writtenSamplers_;
};

} // namespace

void writeMaterials(std::span<const Material> materials, std::span<const Image> images, Packer& packer, json& root,
                    Warnings& warnings) {
    MaterialWriter(images, packer, warnings).write(materials, root);
}

} // namespace supple::cage::gltf
