#include "host/webp_decoder.h"

#include <cstring>

#ifdef SUPPLE_HAS_WEBP
#include <webp/decode.h>
#endif

namespace supple::host {

bool isWebp(std::span<const std::byte> bytes) {
    return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
           std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

#ifdef SUPPLE_HAS_WEBP

Result<Picture> decodeWebp(std::span<const std::byte> bytes, uint64_t mostPixels, const std::string& name) {
    const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK || features.width <= 0 ||
        features.height <= 0) {
        return Error{ErrorCode::asset, name + ": damaged"};
    }
    if (features.has_animation != 0) {
        return Error{ErrorCode::asset, name + ": an animated WebP"};
    }
    const auto width = static_cast<uint32_t>(features.width), height = static_cast<uint32_t>(features.height);
    if (uint64_t{width} * height > mostPixels) {
        return Error{ErrorCode::asset, name + ": more than " + std::to_string(mostPixels) + " pixels"};
    }
    Picture picture = Picture::blank(width, height);
    if (WebPDecodeRGBAInto(data, bytes.size(), picture.rgba.data(), picture.rgba.size(), static_cast<int>(width * 4)) ==
        nullptr) {
        return Error{ErrorCode::asset, name + ": damaged"};
    }
    return picture;
}

#else

Result<Picture> decodeWebp(std::span<const std::byte>, uint64_t, const std::string& name) {
    return Error{ErrorCode::asset, name + ": WebP, and supple was built without libwebp"};
}

#endif

} // namespace supple::host
