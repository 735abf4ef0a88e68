#include "cage/gltf/resources.h"

#include "cage/gltf/image_header.h"
#include "cage/gltf/uri.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace supple::cage::gltf {
namespace {

/// A problem is told with the URI it is about; data: URIs are too long for that.
Result<DataUri> fetch(const std::string& uri, const FileReader& readFile) {
    if (isDataUri(uri)) {
        return decodeDataUri(uri);
    }
    const auto about = [&](const Error& error) {
        return Error{error.code, quoted(uri.substr(0, 100)) + ": " + error.message};
    };
    const Result<std::string> path = relativePath(uri);
    if (!path) {
        return about(path.error());
    }
    Result<std::vector<std::byte>> bytes = readFile(*path);
    if (!bytes) {
        return about(bytes.error());
    }
    return DataUri{std::move(*bytes), ""};
}

/// The bytes of a buffer; owned by the document if they come from elsewhere than the container.
std::span<const std::byte> loadBuffer(const Json& buffer, size_t index, const Container& container,
                                      const FileReader& readFile, Document& document) {
    const std::string element = at("buffer", index);
    const uint64_t length = unsignedMember(buffer, "byteLength", element, std::nullopt);
    if (length == 0) {
        refuse(element + " byteLength", "zero");
    }
    std::span<const std::byte> bytes;
    const Json* uri = member(buffer, "uri");
    if (uri == nullptr) {
        if (index != 0 || !container.isBinary) {
            refuse(element, "no uri");
        }
        if (container.binary.empty()) {
            refuse(element, "the GLB has no binary chunk or an empty one");
        }
        bytes = container.binary;
    } else {
        Result<DataUri> read = fetch(stringMember(buffer, "uri", element), readFile);
        if (!read) {
            refuse(element + " uri", read.error().message, read.error().code);
        }
        document.owned[index] = std::move(read->bytes);
        bytes = document.owned[index];
    }
    if (bytes.size() < length) {
        refuse(element, "truncated: byteLength is " + std::to_string(length) + ", " + std::to_string(bytes.size()) +
                            " bytes present");
    }
    return bytes.first(static_cast<size_t>(length));
}

} // namespace

void loadBuffers(const Json& buffers, std::span<const uint8_t> placeholder, const Container& container,
                 const FileReader& readFile, Document& document) {
    document.owned.resize(buffers.size());
    document.buffers.resize(buffers.size());
    Refusals refusals;
    for (size_t i = 0; i < buffers.size(); ++i) {
        if (placeholder[i] == 0) {
            refusals.gather([&] { document.buffers[i] = loadBuffer(buffers[i], i, container, readFile, document); });
        }
    }
    refusals.raise();
}

/// A character without its texture is still a character: whatever is wrong with an image is a warning.
void loadImages(const Json& images, const FileReader& readFile, Document& document) {
    for (size_t i = 0; i < images.size(); ++i) {
        const std::string element = at("image", i);
        Image image;
        image.name = stringMember(images[i], "name", element);
        image.mimeType = stringMember(images[i], "mimeType", element);
        if (member(images[i], "bufferView") != nullptr) {
            const auto& views = document.model.bufferViews;
            checkIndexMember(images[i], "bufferView", element, "bufferView", views.size());
            const file::BufferView& view = views[images[i].at("bufferView").index()];
            const auto bytes = document.buffers[view.buffer].subspan(static_cast<size_t>(view.byteOffset),
                                                                     static_cast<size_t>(view.byteLength));
            image.bytes.assign(bytes.begin(), bytes.end());
        } else {
            const std::string uri = stringMember(images[i], "uri", element);
            Result<DataUri> read = fetch(uri, readFile);
            if (!read) {
                warn(document.warnings, within(element, "uri"), read.error().message + "; left out");
            } else {
                image.bytes = std::move(read->bytes);
                if (image.mimeType.empty()) {
                    image.mimeType = read->mimeType;
                }
                if (image.name.empty() && !isDataUri(uri)) {
                    image.name = uri;
                }
            }
        }
        const char* type = imageType(image.bytes);
        if (image.mimeType.empty() && type != nullptr) {
            image.mimeType = type;
        }
        document.images.push_back(std::move(image));
    }
}

} // namespace supple::cage::gltf
