#include "cage/gltf/trim.h"

#include "cage/gltf/accessors.h"
#include "cage/gltf/texture.h"
#include "cage/image_header.h"
#include "cage/refusal.h"
#include "cage/trim.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage::gltf {
namespace {

/// The trim's texture, with an image that a host can decode.
Texture textureOf(const Document& document, const Json& info, TrimDomain domain, const std::string& element) {
    Texture texture = readTextureInfo(document, info, element);
    if (texture.uvSet > 1) {
        refuse(element, "texCoord " + std::to_string(texture.uvSet) + ": only TEXCOORD_0 and TEXCOORD_1 are read");
    }
    if (texture.image == kNone) {
        refuse(element, at("texture", info.at("index").index()) + " has no image in a core format");
    }
    const SharedBytes& bytes = document.images[texture.image].bytes;
    if (bytes.empty()) {
        refuse(element, at("image", texture.image) + " is missing");
    }
    if (!isCoreImage(bytes)) {
        refuse(element, at("image", texture.image) + " is neither PNG nor JPEG");
    }
    texture.alternateImage = kNone;
    if (domain == TrimDomain::face) {
        if (hasExtension(info, "KHR_texture_transform")) {
            refuse(element, "KHR_texture_transform on tiles of faces");
        }
        texture.uvSet = 0;
    }
    return texture;
}

float cutoffOf(const Json& trim, const std::string& element) {
    const Json* cutoff = member(trim, "cutoff");
    if (cutoff == nullptr) {
        return Trim{}.cutoff;
    }
    if (!cutoff->isNumber() || !(cutoff->number() >= 0.0 && cutoff->number() <= 1.0)) {
        refuse(element + " cutoff", "not a number from 0 to 1");
    }
    return cutoff->real();
}

uint32_t channelOf(const Json& trim, const std::string& element) {
    const std::string name = stringMember(trim, "channel", element);
    constexpr std::array kNames{"r", "g", "b", "a"};
    for (uint32_t channel = 0; channel < kNames.size(); ++channel) {
        if (name == kNames[channel]) {
            return channel;
        }
    }
    if (!name.empty()) {
        refuse(element + " channel", quoted(name) + " is none of r, g, b, a");
    }
    return Trim{}.channel;
}

TrimDomain domainOf(const Json& trim, const std::string& element) {
    const std::string name = stringMember(trim, "domain", element);
    if (!name.empty() && name != "uv" && name != "face") {
        refuse(element + " domain", quoted(name) + " is neither uv nor face");
    }
    return name == "face" ? TrimDomain::face : TrimDomain::uv;
}

/// As the trim says, else as many square tiles as the image is wide.
uint32_t tilesOf(const Document& document, const Json& trim, uint32_t image, const std::string& element) {
    if (const uint64_t given = unsignedMember(trim, "tiles", element, 0); given > 0) {
        if (given > kMaxTrimTiles) {
            refuse(element + " tiles", std::to_string(given) + ", more than " + std::to_string(kMaxTrimTiles));
        }
        return static_cast<uint32_t>(given);
    }
    const std::optional<ImageSize> size = imageSize(document.images[image].bytes);
    if (!size || size->width == 0 || size->height == 0) {
        refuse(element + " texture", at("image", image) + " has no size: cut off in its header");
    }
    if (size->width % size->height != 0 || size->width / size->height > kMaxTrimTiles) {
        refuse(element + " texture", at("image", image) + " is " + std::to_string(size->width) + " x " +
                                         std::to_string(size->height) +
                                         " pixels, no strip of square tiles, and tiles does not say how many");
    }
    return size->width / size->height;
}

} // namespace

std::optional<Trim> readTrim(const Document& document, size_t material, Warnings& warnings) {
    const Json* extras = member(document.materials[material], "extras");
    const Json* trim = extras != nullptr && extras->isObject() ? member(*extras, "trim") : nullptr;
    if (trim == nullptr) {
        return std::nullopt;
    }
    const std::string element = at("material", material) + " extras.trim";
    if (!trim->isObject()) {
        warn(warnings, element, "not an object; left out");
        return std::nullopt;
    }
    const Json* texture = objectMember(*trim, "texture", element);
    if (texture == nullptr) {
        refuse(element, "no texture");
    }
    const std::string textureElement = element + " texture";
    Trim read;
    read.domain = domainOf(*trim, element);
    read.texture = textureOf(document, *texture, read.domain, textureElement);
    read.channel = channelOf(*trim, element);
    read.cutoff = cutoffOf(*trim, element);
    if (read.domain == TrimDomain::face) {
        read.tiles = tilesOf(document, *trim, read.texture.image, element);
    }
    return read;
}

void readTrimTiles(const Document& document, const file::Primitive& from, std::span<const Material> materials,
                   split::Primitive& primitive) {
    if (primitive.material < 0 || !materials[static_cast<size_t>(primitive.material)].trim) {
        return;
    }
    const auto material = static_cast<size_t>(primitive.material);
    const Trim& trim = *materials[material].trim;
    const std::string whose = "the trim of " + at("material", material);
    if (trim.domain == TrimDomain::uv) {
        if ((trim.texture.uvSet == 0 ? primitive.uvs : primitive.uvs1).empty()) {
            refuse(primitive.element,
                   "no TEXCOORD_" + std::to_string(trim.texture.uvSet) + ", on which " + whose + " lies");
        }
        return;
    }
    const auto attribute = from.attributes.find("_TRIM_TILE");
    if (attribute == from.attributes.end()) {
        refuse(primitive.element, "no _TRIM_TILE, which names the tiles of " + whose);
    }
    const std::string name = primitive.element + " _TRIM_TILE";
    checkVertexCount(document, attribute->second, primitive.vertexCount, name);
    const std::vector<float> values =
        readFloats(document, attribute->second, file::kScalar, kFloat | kU8 | kU16 | kU32 | kS8 | kS16, name);
    std::vector<uint32_t> tiles; // all of them or, if one is refused, none
    tiles.reserve(values.size());
    for (size_t v = 0; v < values.size(); ++v) {
        // Written so that a NaN is refused too.
        if (!(values[v] >= -1.0f) || std::floor(values[v]) != values[v]) {
            refuse(item(name, v), "neither the number of a tile nor -1");
        }
        if (values[v] >= static_cast<float>(trim.tiles)) {
            refuse(item(name, v), "tile " + std::to_string(static_cast<uint64_t>(values[v])) +
                                      " is out of range: " + whose + " has " + counted(trim.tiles, "tile", "tiles"));
        }
        tiles.push_back(values[v] < 0.0f ? kNone : static_cast<uint32_t>(values[v]));
    }
    primitive.trimTiles = std::move(tiles);
}

} // namespace supple::cage::gltf
