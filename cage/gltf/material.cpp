#include "cage/gltf/material.h"

#include "cage/gltf/specular_glossiness.h"
#include "cage/gltf/texture.h"
#include "cage/gltf/trim.h"
#include "cage/materials.h"
#include "cage/refusal.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace supple::cage::gltf {
namespace {

constexpr float kUnbounded = std::numeric_limits<float>::max();

struct Range {
    float low = 0.0f;
    float high = 1.0f;
};

float clamped(float value, Range range, const std::string& element, Warnings& warnings) {
    const float inside = std::clamp(value, range.low, range.high);
    if (inside != value) {
        warn(warnings, element, shortNumber(value) + " is out of range; " + shortNumber(inside) + " taken");
    }
    return inside;
}

/// One material of the file.
class MaterialReader {
public:
    MaterialReader(const Document& document, size_t index, Warnings& warnings)
        : document_(document), from_(document.materials[index]), element_(at("material", index)), warnings_(warnings) {}

    Material read() {
        material_.name = text("name");
        material_.doubleSided = readFlag("doubleSided");
        readAlpha();
        readBase();
        material_.normalTexture = readTexture(from_, "normalTexture");
        if (const Json* normal = member(from_, "normalTexture")) {
            material_.normalScale = readNumber(*normal, "scale", 1.0f, {-kUnbounded, kUnbounded}, " normalTexture");
        }
        material_.occlusionTexture = readTexture(from_, "occlusionTexture");
        if (const Json* occlusion = member(from_, "occlusionTexture")) {
            material_.occlusionStrength = readNumber(*occlusion, "strength", 1.0f, {}, " occlusionTexture");
        }
        readEmission();
        material_.unlit = hasExtension(from_, "KHR_materials_unlit");
        readLayers();
        return std::move(material_);
    }

private:
    /// What a material says wrongly is as if it had not said it: its shape is that of its mesh.
    template <class Read>
    void leaveOut(Read&& read) {
        document_.leniency->leaveOut(read);
    }

    /// Empty where it is absent or no string.
    std::string text(const char* key) {
        std::string read;
        leaveOut([&] { read = stringMember(from_, key, element_); });
        return read;
    }

    /// Null where it is absent or no object.
    const Json* part(const Json& object, const char* key) {
        const Json* found = nullptr;
        leaveOut([&] { found = objectMember(object, key, element_); });
        return found;
    }

    void readBase() {
        const Json* pbr = part(from_, "pbrMetallicRoughness");
        if (hasExtension(from_, kSpecularGlossiness)) {
            if (pbr == nullptr || pbr->members().empty() || isRequired(document_, kSpecularGlossiness)) {
                if (const Json* extension = part(from_.at("extensions"), kSpecularGlossiness)) {
                    readSpecularGlossiness(*extension);
                    return;
                }
            } else {
                warn(warnings_, element_,
                     std::string(kSpecularGlossiness) + " is not read: pbrMetallicRoughness is taken");
            }
        }
        if (pbr != nullptr) {
            readColor(*pbr, "baseColorFactor", material_.baseColorFactor);
            material_.baseColorTexture = readTexture(*pbr, "baseColorTexture");
            material_.metallicFactor = readNumber(*pbr, "metallicFactor", 1.0f, {});
            material_.roughnessFactor = readNumber(*pbr, "roughnessFactor", 1.0f, {});
            material_.metallicRoughnessTexture = readTexture(*pbr, "metallicRoughnessTexture");
        }
    }

    /// Factors are converted. A texture of specular colors would have to be converted pixel by pixel. The factors of
    /// one that is left out say little of the material: it counts as no metal, half as glossy as its factor.
    void readSpecularGlossiness(const Json& from) {
        SpecularGlossiness read;
        readColor(from, "diffuseFactor", read.diffuse);
        readColor(from, "specularFactor", read.specular);
        read.glossiness = readNumber(from, "glossinessFactor", 1.0f, {});
        std::string how = " is converted to metallic and roughness factors";
        MetallicRoughness converted = toMetallicRoughness(read);
        if (member(from, "specularGlossinessTexture") != nullptr) {
            converted = {read.diffuse, 0.0f, 1.0f - 0.5f * read.glossiness};
            how += "; its specularGlossinessTexture is left out";
        }
        material_.baseColorFactor = converted.baseColor;
        material_.metallicFactor = converted.metallic;
        material_.roughnessFactor = converted.roughness;
        material_.baseColorTexture = readTexture(from, "diffuseTexture");
        warn(warnings_, element_, kSpecularGlossiness + how);
    }

    void readAlpha() {
        const std::string mode = text("alphaMode");
        if (mode == "MASK") {
            material_.alphaMode = AlphaMode::mask;
        } else if (mode == "BLEND") {
            material_.alphaMode = AlphaMode::blend;
        } else if (!mode.empty() && mode != "OPAQUE") {
            warn(warnings_, element_ + " alphaMode", quoted(mode) + " is unknown; opaque");
        }
        material_.alphaCutoff = readNumber(from_, "alphaCutoff", 0.5f, {0.0f, kUnbounded});
    }

    void readEmission() {
        readColor(from_, "emissiveFactor", material_.emissiveFactor);
        material_.emissiveTexture = readTexture(from_, "emissiveTexture");
        constexpr const char* kName = "KHR_materials_emissive_strength";
        if (!hasExtension(from_, kName)) {
            return;
        }
        if (const Json* extension = part(from_.at("extensions"), kName)) {
            material_.emissiveStrength = readNumber(*extension, "emissiveStrength", 1.0f, {0.0f, kUnbounded});
        }
    }

    void readLayers() {
        for (const char* extension : kLayerExtensions) {
            const Json* from = hasExtension(from_, extension) ? part(from_.at("extensions"), extension) : nullptr;
            if (from != nullptr) {
                readLayer(*from, extension);
            }
        }
    }

    void readLayer(const Json& from, std::string_view extension) {
        MaterialLayers& layers = material_.layers;
        for (const LayerNumber& row : kLayerNumbers) {
            if (row.extension == extension) {
                layers.*row.member = readNumber(from, row.name, layers.*row.member, {row.low, row.high});
            }
        }
        for (const LayerColor& row : kLayerColors) {
            if (row.extension == extension) {
                readColor(from, row.name, layers.*row.member, {0.0f, row.high});
            }
        }
        for (const LayerTexture& row : kLayerTextures) {
            if (row.extension != extension) {
                continue;
            }
            layers.*row.member = readTexture(from, row.name);
            const Json* info = member(from, row.name);
            if (info != nullptr && row.scale != nullptr) {
                layers.*row.scale =
                    readNumber(*info, "scale", 1.0f, {-kUnbounded, kUnbounded}, " clearcoatNormalTexture");
            }
        }
    }

    bool readFlag(const char* key) {
        const Json* value = member(from_, key);
        leaveOut([&] {
            if (value != nullptr && !value->isBoolean()) {
                refuse(within(element_, key), "not a boolean");
            }
        });
        return value != nullptr && value->boolean();
    }

    float readNumber(const Json& object, const char* key, float fallback, Range range, const char* part = "") {
        const Json* value = member(object, key);
        if (value == nullptr) {
            return fallback;
        }
        const std::string place = within(element_ + part, key);
        float read = fallback;
        leaveOut([&] {
            if (!value->isNumber() || !isFiniteFloat(*value)) {
                refuse(place, "not a finite number");
            }
            read = clamped(value->real(), range, place, warnings_);
        });
        return read;
    }

    template <class Color>
    void readColor(const Json& object, const char* key, Color& color, Range range = {}) {
        leaveOut([&] {
            checkNumbers(object, key, element_, static_cast<size_t>(Color::length()));
            if (const Json* values = member(object, key)) {
                for (int k = 0; k < Color::length(); ++k) {
                    const auto channel = static_cast<size_t>(k);
                    color[k] =
                        clamped((*values)[channel].real(), range, item(within(element_, key), channel), warnings_);
                }
            }
        });
    }

    Texture readTexture(const Json& object, const char* key) {
        const Json* info = part(object, key);
        const std::string place = within(element_, key);
        Texture texture;
        if (info == nullptr ||
            !document_.leniency->leaveOut([&] { texture = readTextureInfo(document_, *info, place); })) {
            return {};
        }
        if (texture.uvSet > 1) {
            warn(warnings_, place,
                 "texCoord " + std::to_string(texture.uvSet) + ": only TEXCOORD_0 and TEXCOORD_1 are read; left out");
            return {};
        }
        if (texture.image == kNone && texture.alternateImage == kNone) {
            warn(warnings_, at("texture", info->at("index").index()), "no image in a format that is read; left out");
            return {};
        }
        dropMissingImages(texture, document_.images); // which have warnings of their own
        return texture;
    }

    const Document& document_;
    const Json& from_;
    const std::string element_;
    Warnings& warnings_;
    Material material_;
};

} // namespace

std::vector<Material> readMaterials(const Document& document, Warnings& warnings) {
    std::vector<Material> materials(document.materials.size());
    for (size_t i = 0; i < materials.size(); ++i) {
        materials[i] = MaterialReader(document, i, warnings).read();
        document.leniency->gather([&] { materials[i].trim = readTrim(document, i, warnings); });
    }
    return materials;
}

} // namespace supple::cage::gltf
