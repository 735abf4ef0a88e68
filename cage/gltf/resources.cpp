#include "cage/gltf/resources.h"

#include "cage/gltf/uri.h"
#include "cage/image_header.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace supple::cage::gltf {
namespace {

/// The bytes of a buffer; owned by the document if they come from elsewhere than the container.
std::span<const std::byte> loadBuffer(const Json& buffer, size_t index, const Container& container,
                                      Resources& resources, Document& document) {
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
        Result<Resources::Found> read = resources.fetch(stringMember(buffer, "uri", element));
        if (!read) {
            refuse(element + " uri", read.error().message, read.error().code);
        }
        document.owned[index] = std::move(read->bytes);
        bytes = document.owned[index];
    }
    if (bytes.size() < length) {
        document.leniency->mend(element,
                                "truncated: byteLength is " + std::to_string(length) + ", " +
                                    std::to_string(bytes.size()) + " bytes present",
                                "it ends there"); // what lies beyond has a fault of its own
        return bytes;
    }
    return bytes.first(static_cast<size_t>(length));
}

/// Where the bytes of an image lie that is in a bufferView.
struct ViewBytes {
    size_t buffer;
    size_t begin, end;
    size_t image;
};

ViewBytes viewBytes(const file::BufferView& view, size_t image) {
    return {view.buffer, static_cast<size_t>(view.byteOffset), static_cast<size_t>(view.byteOffset + view.byteLength),
            image};
}

ViewBytes viewOfImage(const Document& document, const Json& image, size_t index) {
    const std::string element = at("image", index);
    checkIndexMember(image, "bufferView", element, "bufferView", document.model.bufferViews.size());
    const size_t view = image.at("bufferView").index();
    if (document.model.bufferViews[view].broken) {
        refuse(element, at("bufferView", view) + " cannot be read");
    }
    return viewBytes(document.model.bufferViews[view], index);
}

/// Copies what the images lie on once, however many lie there: the character outlives the file.
void shareViews(std::vector<ViewBytes> views, Document& document) {
    std::sort(views.begin(), views.end(), [](const ViewBytes& a, const ViewBytes& b) {
        return std::tie(a.buffer, a.begin) < std::tie(b.buffer, b.begin);
    });
    for (size_t first = 0, next = 0; first < views.size(); first = next) {
        size_t end = views[first].end;
        for (next = first + 1;
             next < views.size() && views[next].buffer == views[first].buffer && views[next].begin < end; ++next) {
            end = std::max(end, views[next].end);
        }
        const size_t begin = views[first].begin;
        const auto from = document.buffers[views[first].buffer].subspan(begin, end - begin);
        document.memory->take(from.size(), at("image", views[first].image));
        const SharedBytes copy(std::vector<std::byte>(from.begin(), from.end()));
        for (size_t i = first; i < next; ++i) {
            document.images[views[i].image].bytes = copy.part(views[i].begin - begin, views[i].end - views[i].begin);
        }
    }
}

} // namespace

Result<Resources::Found> Resources::fetch(const std::string& uri) {
    if (isDataUri(uri)) {
        Result<DataUri> data = decodeDataUri(uri);
        return data ? Result<Found>(Found{std::move(data->bytes), std::move(data->mimeType)}) : data.error();
    }
    const auto about = [&](const Error& error) {
        return Error{error.code, quoted(uri.substr(0, 100)) + ": " + error.message};
    };
    const Result<std::string> path = relativePath(uri);
    if (!path) {
        return about(path.error());
    }
    auto known = read_.find(*path);
    if (known == read_.end()) {
        Result<std::vector<std::byte>> bytes = readFile_(*path);
        if (bytes) {
            memory_.addFile(bytes->size());
        }
        known = read_.emplace(*path, bytes ? Result<SharedBytes>(std::move(*bytes)) : bytes.error()).first;
    }
    return known->second ? Result<Found>(Found{*known->second, ""}) : about(known->second.error());
}

void loadBuffers(const Json& buffers, std::span<const uint8_t> placeholder, const Container& container,
                 Resources& resources, Document& document) {
    document.owned.resize(buffers.size());
    document.buffers.resize(buffers.size());
    for (size_t i = 0; i < buffers.size(); ++i) {
        if (placeholder[i] == 0) {
            document.leniency->gather(
                [&] { document.buffers[i] = loadBuffer(buffers[i], i, container, resources, document); });
        }
    }
    document.leniency->raise();
}

/// A character without its texture is still a character: one that is missing is a warning by any
/// reading, and what is malformed is left out.
void loadImages(const Json& images, Resources& resources, Document& document) {
    std::vector<ViewBytes> views;
    for (size_t i = 0; i < images.size(); ++i) {
        const std::string element = at("image", i);
        Image& image = document.images.emplace_back();
        document.leniency->leaveOut([&] { image.name = stringMember(images[i], "name", element); });
        document.leniency->leaveOut([&] { image.mimeType = stringMember(images[i], "mimeType", element); });
        if (member(images[i], "bufferView") != nullptr) {
            document.leniency->leaveOut([&] { views.push_back(viewOfImage(document, images[i], i)); });
            continue;
        }
        std::string uri;
        if (!document.leniency->leaveOut([&] { uri = stringMember(images[i], "uri", element); })) {
            continue;
        }
        Result<Resources::Found> read = resources.fetch(uri);
        if (!read) {
            warn(document.warnings, within(element, "uri"), read.error().message + "; left out");
            continue;
        }
        image.bytes = std::move(read->bytes);
        if (image.mimeType.empty()) {
            image.mimeType = read->mimeType;
        }
        if (image.name.empty() && !isDataUri(uri)) {
            image.name = uri;
        }
    }
    shareViews(std::move(views), document);
    for (Image& image : document.images) {
        const char* type = imageType(image.bytes);
        if (image.mimeType.empty() && type != nullptr) {
            image.mimeType = type;
        }
    }
}

} // namespace supple::cage::gltf
