#include "cage/gltf/texture.h"

#include "cage/refusal.h"

#include <algorithm>
#include <limits>
#include <span>

namespace supple::cage::gltf {
namespace {

Wrap readWrap(const Json& sampler, const char* key, const std::string& element, Warnings& warnings) {
    switch (const uint64_t value = unsignedMember(sampler, key, element, 10497)) {
    case 33071:
        return Wrap::clampToEdge;
    case 33648:
        return Wrap::mirroredRepeat;
    case 10497:
        return Wrap::repeat;
    default:
        warn(warnings, within(element, key), std::to_string(value) + " is unknown; repeat");
        return Wrap::repeat;
    }
}

/// glTF has no default: where a file says nothing, the host chooses.
Filter readFilter(const Json& sampler, const char* key, const std::string& element, bool mipmaps, Warnings& warnings) {
    if (member(sampler, key) == nullptr) {
        return Filter::any;
    }
    const uint64_t value = unsignedMember(sampler, key, element, std::nullopt);
    switch (value) {
    case 9728:
        return Filter::nearest;
    case 9729:
        return Filter::linear;
    default:
        break;
    }
    if (mipmaps && value >= 9984 && value <= 9987) {
        return static_cast<Filter>(static_cast<uint64_t>(Filter::nearestMipmapNearest) + (value - 9984));
    }
    warn(warnings, within(element, key), std::to_string(value) + " is unknown; left to the host");
    return Filter::any;
}

Texture readSampler(const Json& sampler, const std::string& element, Warnings& warnings) {
    Texture read;
    checkString(sampler, "name", element);
    read.wrapU = readWrap(sampler, "wrapS", element, warnings);
    read.wrapV = readWrap(sampler, "wrapT", element, warnings);
    read.magFilter = readFilter(sampler, "magFilter", element, false, warnings);
    read.minFilter = readFilter(sampler, "minFilter", element, true, warnings);
    return read;
}

/// The members of an object's extension; null where it has none of that name.
const Json* extensionOf(const Json& object, const char* name, const std::string& element) {
    return hasExtension(object, name) ? objectMember(object.at("extensions"), name, element) : nullptr;
}

uint32_t readSource(const Json& object, const std::string& element, size_t imageCount) {
    checkIndexMember(object, "source", element, "image", imageCount);
    const Json* source = member(object, "source");
    return source == nullptr ? kNone : static_cast<uint32_t>(source->index());
}

void readTransform(const Json& transform, const std::string& element, Texture& texture) {
    const auto readPair = [&](const char* key, glm::vec2& pair) {
        checkNumbers(transform, key, element, 2);
        if (const Json* values = member(transform, key)) {
            pair = {(*values)[0].real(), (*values)[1].real()};
        }
    };
    readPair("offset", texture.offset);
    readPair("scale", texture.scale);
    if (const Json* rotation = member(transform, "rotation")) {
        if (!rotation->isNumber() || !isFiniteFloat(*rotation)) {
            refuse(within(element, "rotation"), "not a finite number");
        }
        texture.rotation = rotation->real();
    }
}

Texture readTexture(const Json& from, const std::string& element, std::span<const Texture> sampled, size_t imageCount) {
    checkIndexMember(from, "sampler", element, "sampler", sampled.size());
    const Json* sampler = member(from, "sampler");
    Texture texture = sampler == nullptr ? Texture{} : sampled[sampler->index()];
    texture.image = readSource(from, element, imageCount);
    const auto readOther = [&](const char* name) {
        const Json* extension = extensionOf(from, name, element);
        return extension == nullptr ? kNone : readSource(*extension, within(element, name), imageCount);
    };
    const uint32_t basis = readOther("KHR_texture_basisu"), webp = readOther("EXT_texture_webp");
    if (texture.image == kNone && basis != kNone) {
        texture.image = webp; // which more programs decode
    }
    texture.alternateImage = basis != kNone ? basis : webp;
    return texture;
}

uint32_t readTexCoord(const Json& object, const std::string& element, uint32_t fallback) {
    const uint64_t value = unsignedMember(object, "texCoord", element, fallback);
    return static_cast<uint32_t>(std::min<uint64_t>(value, std::numeric_limits<uint32_t>::max()));
}

} // namespace

std::vector<Texture> readTextures(const Json& root, Leniency& leniency, Warnings& warnings) {
    const Json images = table(root, "images");
    const Json samplers = table(root, "samplers");
    const Json textures = table(root, "textures");
    std::vector<Texture> sampled;
    for (size_t i = 0; i < samplers.size(); ++i) {
        sampled.emplace_back();
        leniency.leaveOut([&] { sampled.back() = readSampler(samplers[i], at("sampler", i), warnings); });
    }
    std::vector<Texture> read;
    for (size_t i = 0; i < textures.size(); ++i) {
        read.emplace_back();
        leniency.leaveOut([&] { read.back() = readTexture(textures[i], at("texture", i), sampled, images.size()); });
    }
    return read;
}

Texture readTextureInfo(const Document& document, const Json& info, const std::string& element) {
    checkIndexMember(info, "index", element, "texture", document.textures.size(), true);
    Texture texture = document.textures[info.at("index").index()];
    texture.uvSet = readTexCoord(info, element, 0);
    if (const Json* transform = extensionOf(info, "KHR_texture_transform", element)) {
        const std::string place = within(element, "KHR_texture_transform");
        readTransform(*transform, place, texture);
        texture.uvSet = readTexCoord(*transform, place, texture.uvSet);
    }
    return texture;
}

} // namespace supple::cage::gltf
