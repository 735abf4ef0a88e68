#include "runtime/arrays/material_arrays.h"

#include "cage/image_header.h"
#include "cage/materials.h"
#include "cage/trim.h"
#include "runtime/material_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace supple::runtime {

namespace {

constexpr float kUnbounded = std::numeric_limits<float>::max();

/// One material of the host's.
class MaterialArrayReader {
public:
    MaterialArrayReader(const SuppleMaterialInfo& from, std::span<const cage::Image> images, Faults& faults,
                        cage::Warnings& warnings)
        : from_(from), images_(images), faults_(faults), warnings_(warnings) {}

    cage::Material read() {
        cage::Material material;
        material.name = orEmpty(from_.name);
        material.doubleSided = from_.doubleSided != 0;
        material.unlit = from_.unlit != 0;
        if (rawValue(from_.alphaMode) > SUPPLE_ALPHA_BLEND) {
            faults_.add("no such alphaMode", ErrorCode::range);
        } else {
            material.alphaMode = static_cast<cage::AlphaMode>(from_.alphaMode);
        }
        for (int c = 0; c < 4; ++c) {
            material.baseColorFactor[c] = number(from_.baseColorFactor[c], "baseColorFactor", 0.0f, 1.0f);
        }
        for (int c = 0; c < 3; ++c) {
            material.emissiveFactor[c] = number(from_.emissiveFactor[c], "emissiveFactor", 0.0f, 1.0f);
        }
        material.alphaCutoff = number(from_.alphaCutoff, "alphaCutoff", 0.0f, kUnbounded);
        material.metallicFactor = number(from_.metallicFactor, "metallicFactor", 0.0f, 1.0f);
        material.roughnessFactor = number(from_.roughnessFactor, "roughnessFactor", 0.0f, 1.0f);
        material.normalScale = number(from_.normalScale, "normalScale", -kUnbounded, kUnbounded);
        material.occlusionStrength = number(from_.occlusionStrength, "occlusionStrength", 0.0f, 1.0f);
        material.emissiveStrength = number(from_.emissiveStrength, "emissiveStrength", 0.0f, kUnbounded);
        material.baseColorTexture = texture(from_.baseColor, "baseColor");
        material.metallicRoughnessTexture = texture(from_.metallicRoughness, "metallicRoughness");
        material.normalTexture = texture(from_.normal, "normal");
        material.occlusionTexture = texture(from_.occlusion, "occlusion");
        material.emissiveTexture = texture(from_.emissive, "emissive");
        readTrim(material);
        return material;
    }

    /// What the host says beyond that.
    void readLayers(const SuppleMaterialLayers& from, cage::MaterialLayers& layers) {
        for (size_t i = 0; i < cage::kLayerNumbers.size(); ++i) {
            const cage::LayerNumber& row = cage::kLayerNumbers[i];
            layers.*row.member = number(from.*kLayerNumberMembers[i], row.name, row.low, row.high);
        }
        layers.clearcoatNormalScale =
            number(from.clearcoatNormalScale, "clearcoatNormalScale", -kUnbounded, kUnbounded);
        for (size_t i = 0; i < cage::kLayerColors.size(); ++i) {
            const cage::LayerColor& row = cage::kLayerColors[i];
            for (int c = 0; c < 3; ++c) {
                (layers.*row.member)[c] = number((from.*kLayerColorMembers[i])[c], row.name, 0.0f, row.high);
            }
        }
        for (size_t i = 0; i < cage::kLayerTextures.size(); ++i) {
            const cage::LayerTexture& row = cage::kLayerTextures[i];
            layers.*row.member = texture(from.*kLayerTextureMembers[i], row.name);
        }
    }

private:
    float number(float given, const char* what, float low, float high) {
        if (!std::isfinite(given)) {
            faults_.add(std::string(what) + " is not finite");
            return low;
        }
        const float inside = std::clamp(given, low, high);
        if (inside != given) {
            cage::warn(warnings_, faults_.element() + " " + what,
                       cage::shortNumber(given) + " is out of range; " + cage::shortNumber(inside) + " taken");
        }
        return inside;
    }

    bool isSound(const SuppleTextureInfo& from, const std::string& what) {
        const bool images = (from.image == SUPPLE_NO_IMAGE || from.image < images_.size()) &&
                            (from.alternateImage == SUPPLE_NO_IMAGE || from.alternateImage < images_.size());
        const bool values = rawValue(from.wrap[0]) <= SUPPLE_WRAP_MIRROR &&
                            rawValue(from.wrap[1]) <= SUPPLE_WRAP_MIRROR &&
                            rawValue(from.magFilter) <= SUPPLE_FILTER_LINEAR &&
                            rawValue(from.minFilter) <= SUPPLE_FILTER_LINEAR_MIPMAP_LINEAR && from.uvSet <= 1;
        const float numbers[] = {from.offset[0], from.offset[1], from.rotation, from.scale[0], from.scale[1]};
        const bool finite =
            std::all_of(std::begin(numbers), std::end(numbers), [](float n) { return std::isfinite(n); });
        if (!images) {
            faults_.add(what + ": image " + std::to_string(from.image) + " or alternateImage " +
                        std::to_string(from.alternateImage) + " of " + std::to_string(images_.size()));
        }
        if (!values) {
            faults_.add(what + ": no such wrap, magFilter, minFilter or uvSet", ErrorCode::range);
        }
        if (!finite) {
            faults_.add(what + ": offset, rotation or scale is not finite");
        }
        return images && values && finite;
    }

    cage::Texture texture(const SuppleTextureInfo& from, const std::string& what) {
        if ((from.image == SUPPLE_NO_IMAGE && from.alternateImage == SUPPLE_NO_IMAGE) || !isSound(from, what)) {
            return {};
        }
        cage::Texture texture;
        texture.image = from.image;
        texture.alternateImage = from.alternateImage;
        texture.uvSet = from.uvSet;
        texture.wrapU = static_cast<cage::Wrap>(from.wrap[0]);
        texture.wrapV = static_cast<cage::Wrap>(from.wrap[1]);
        texture.magFilter = static_cast<cage::Filter>(from.magFilter);
        texture.minFilter = static_cast<cage::Filter>(from.minFilter);
        texture.offset = {from.offset[0], from.offset[1]};
        texture.rotation = from.rotation;
        texture.scale = {from.scale[0], from.scale[1]};
        cage::dropMissingImages(texture, images_); // which have warnings of their own
        return texture;
    }

    void readTrim(cage::Material& material) {
        if (rawValue(from_.trimDomain) > SUPPLE_TRIM_FACE) {
            faults_.add("no such trimDomain", ErrorCode::range);
            return;
        }
        if (from_.trimDomain == SUPPLE_TRIM_NONE || from_.trimAlpha != 0) {
            return;
        }
        cage::Trim trim;
        trim.texture = texture(from_.trim, "trim");
        trim.texture.alternateImage = cage::kNone;
        if (!trim.texture.exists()) {
            faults_.add("trim: no image");
        }
        if (from_.trimDomain == SUPPLE_TRIM_FACE) {
            trim.domain = cage::TrimDomain::face;
            trim.texture.uvSet = 0;
            trim.tiles = from_.trimTiles;
            if (from_.trimTiles == 0 || from_.trimTiles > cage::kMaxTrimTiles) {
                faults_.add("trimTiles is not 1.." + std::to_string(cage::kMaxTrimTiles), ErrorCode::range);
            }
        }
        trim.channel = from_.trimChannel;
        trim.cutoff = from_.trimCutoff;
        if (from_.trimChannel > 3 || !(from_.trimCutoff >= 0.0f && from_.trimCutoff <= 1.0f)) {
            faults_.add("trimChannel is not 0..3, or trimCutoff not 0..1", ErrorCode::range);
        }
        material.trim = trim;
    }

    const SuppleMaterialInfo& from_;
    std::span<const cage::Image> images_;
    Faults& faults_;
    cage::Warnings& warnings_;
};

} // namespace

std::vector<cage::Image> readImageArrays(const SuppleCharacterDesc& desc, cage::Refusals& refusals,
                                         cage::Warnings& warnings) {
    Faults all(refusals, "");
    std::vector<cage::Image> images;
    for (const SuppleImageInfo& from : takeArray(desc.images, desc.imageCount, "images", all)) {
        const std::string element = cage::at("image", images.size());
        cage::Image& image = images.emplace_back();
        image.name = orEmpty(from.name);
        image.mimeType = orEmpty(from.mimeType);
        if (from.bytes == nullptr || from.byteCount == 0) {
            cage::warn(warnings, element, "no bytes; left out");
            continue;
        }
        const auto* first = static_cast<const std::byte*>(from.bytes);
        image.bytes = std::vector<std::byte>(first, first + from.byteCount);
        const char* type = cage::imageType(image.bytes);
        if (image.mimeType.empty() && type != nullptr) {
            image.mimeType = type;
        }
    }
    return images;
}

namespace {

/// What an older caller lacks is zero. That is an image, and black.
void addLaterMembers(SuppleMaterialLayers& layers) {
    std::fill_n(layers.diffuseTransmissionColorFactor, 3, 1.0f);
    std::fill_n(layers.attenuationColor, 3, 1.0f);
    for (SuppleTextureInfo* texture :
         {&layers.diffuseTransmission, &layers.diffuseTransmissionColor, &layers.thickness}) {
        texture->image = texture->alternateImage = SUPPLE_NO_IMAGE;
        texture->scale[0] = texture->scale[1] = 1.0f;
    }
}

} // namespace

std::vector<cage::Material> readMaterialArrays(const SuppleCharacterDesc& desc, std::span<const cage::Image> images,
                                               cage::Refusals& refusals, cage::Warnings& warnings) {
    Faults all(refusals, "");
    std::vector<cage::Material> materials;
    std::vector<SuppleMaterialLayers> layers;
    if (desc.materialLayers != nullptr) {
        layers = takeArray(desc.materialLayers, desc.materialCount, "materialLayers", all);
        if (!layers.empty() && desc.materialLayers->structSize < sizeof(SuppleMaterialLayers)) {
            std::for_each(layers.begin(), layers.end(), addLaterMembers);
        }
    }
    for (const SuppleMaterialInfo& from : takeArray(desc.materials, desc.materialCount, "materials", all)) {
        Faults faults(refusals, cage::at("material", materials.size()));
        MaterialArrayReader reader(from, images, faults, warnings);
        materials.push_back(reader.read());
        if (materials.size() <= layers.size()) {
            reader.readLayers(layers[materials.size() - 1], materials.back().layers);
        }
    }
    return materials;
}

} // namespace supple::runtime
