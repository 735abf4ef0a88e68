#include "cage/gltf/meshopt.h"

#include "cage/gltf/structure.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <cstddef>
#ifndef SUPPLE_WITHOUT_MESHOPT
#include <meshoptimizer.h>
#endif
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace supple::cage::gltf {
namespace {

constexpr const char* kExtensions[] = {"KHR_meshopt_compression", "EXT_meshopt_compression"};

#ifdef SUPPLE_WITHOUT_MESHOPT
constexpr bool kCanDecode = false;
#else
constexpr bool kCanDecode = true;
#endif

// No codec makes more of a byte: of the attributes', two bits may stand for sixteen bytes.
constexpr uint64_t kMostDecodedPerByte = 64;
// Views may share their compressed bytes, so a small file can ask for much.
constexpr uint64_t kMaxDecodedBytes = 1u << 30;

/// The extension's object on a bufferView or buffer, and its name.
std::pair<const Json*, const char*> extensionOf(const Json& object) {
    for (const char* name : kExtensions) {
        if (hasExtension(object, name)) {
            return {&object.at("extensions").at(name), name};
        }
    }
    return {nullptr, nullptr};
}

struct Compressed {
    std::string element;
    size_t view = 0;
    std::span<const std::byte> bytes;
    uint64_t stride = 0;
    uint64_t count = 0;
    std::string mode;
    std::string filter;
};

/// Everything that can be checked before decoding.
Compressed readCompressed(const Json& object, const Json& view, const Document& document, const std::string& element) {
    Compressed compressed;
    compressed.element = element;
    checkIndexMember(object, "buffer", element, "buffer", document.buffers.size(), true);
    const auto buffer = document.buffers[object.at("buffer").index()];
    const uint64_t offset = unsignedMember(object, "byteOffset", element, 0);
    const uint64_t length = unsignedMember(object, "byteLength", element, std::nullopt);
    if (length == 0 || offset > buffer.size() || length > buffer.size() - offset) {
        refuse(element, "bytes " + std::to_string(offset) + " + " + std::to_string(length) +
                            " are out of range: the buffer has " + std::to_string(buffer.size()));
    }
    compressed.bytes = buffer.subspan(static_cast<size_t>(offset), static_cast<size_t>(length));
    compressed.stride = unsignedMember(object, "byteStride", element, std::nullopt);
    compressed.count = unsignedMember(object, "count", element, std::nullopt);
    compressed.mode = stringMember(object, "mode", element);
    compressed.filter = stringMember(object, "filter", element);

    const uint64_t stride = compressed.stride;
    const std::string& mode = compressed.mode;
    const bool attributes = mode == "ATTRIBUTES";
    if (!attributes && mode != "TRIANGLES" && mode != "INDICES") {
        refuse(element + " mode", quoted(mode) + " is not allowed");
    }
    const bool strideFits = attributes ? stride >= 4 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if (!strideFits) {
        refuse(element + " byteStride", std::to_string(stride) + " is not allowed in mode " + mode);
    }
    const std::string& filter = compressed.filter;
    const bool filtered = !filter.empty() && filter != "NONE";
    const bool filterFits = filter == "OCTAHEDRAL"   ? stride == 4 || stride == 8
                            : filter == "QUATERNION" ? stride == 8
                                                     : filter == "EXPONENTIAL";
    if (filtered && (!attributes || !filterFits)) {
        refuse(element + " filter", quoted(filter) + " is not supported in mode " + mode + " with a byteStride of " +
                                        std::to_string(stride));
    }
    if (mode == "TRIANGLES" && compressed.count % 3 != 0) {
        refuse(element + " count", std::to_string(compressed.count) + " is not a multiple of 3");
    }
    if (compressed.count == 0 || compressed.count > kMostDecodedPerByte * length / stride) {
        refuse(element + " count", std::to_string(compressed.count) + " elements cannot be in " +
                                       counted(static_cast<size_t>(length), "byte", "bytes"));
    }
    const uint64_t decoded = unsignedMember(view, "byteLength", element + " bufferView", std::nullopt);
    if (decoded != compressed.count * stride) {
        refuse(element, "decodes to " + std::to_string(compressed.count * stride) + " bytes, but its bufferView has " +
                            std::to_string(decoded));
    }
    return compressed;
}

#ifdef SUPPLE_WITHOUT_MESHOPT
std::vector<std::byte> decode(const Compressed&) {
    return {}; // not reached: decodeMeshopt has refused
}
#else
std::vector<std::byte> decode(const Compressed& compressed) {
    const std::string& element = compressed.element;
    const auto count = static_cast<size_t>(compressed.count);
    const auto stride = static_cast<size_t>(compressed.stride);
    const auto* source = reinterpret_cast<const unsigned char*>(compressed.bytes.data());
    std::vector<std::byte> bytes(count * stride);
    int failure = 0;
    if (compressed.mode == "ATTRIBUTES") {
        if (source[0] == 0xA1) {
            refuse(element, "version 1 of its vertex codec is not supported; export the mesh uncompressed");
        }
        failure = meshopt_decodeVertexBuffer(bytes.data(), count, stride, source, compressed.bytes.size());
    } else if (compressed.mode == "TRIANGLES") {
        failure = meshopt_decodeIndexBuffer(bytes.data(), count, stride, source, compressed.bytes.size());
    } else {
        failure = meshopt_decodeIndexSequence(bytes.data(), count, stride, source, compressed.bytes.size());
    }
    if (failure != 0) {
        refuse(element, "its compressed bytes are damaged");
    }
    if (compressed.filter == "OCTAHEDRAL") {
        meshopt_decodeFilterOct(bytes.data(), count, stride);
    } else if (compressed.filter == "QUATERNION") {
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
    } else if (compressed.filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(bytes.data(), count, stride);
    }
    return bytes;
}
#endif

} // namespace

std::vector<uint8_t> findPlaceholders(const Json& root) {
    const Json buffers = table(root, "buffers");
    std::vector<uint8_t> placeholder(buffers.size(), 0);
    // What is malformed here is refused where it is read.
    const auto of = [&](const Json& object) -> size_t {
        const Json* number = object.isObject() ? member(object, "buffer") : nullptr;
        return number != nullptr && number->isUnsigned() && number->unsignedInteger() < buffers.size() ? number->index()
                                                                                                       : buffers.size();
    };
    std::vector<uint8_t> needed(buffers.size() + 1, 0);
    std::vector<uint8_t> replaced(buffers.size() + 1, 0);
    for (const Json& view : table(root, "bufferViews")) {
        const Json* extension = extensionOf(view).first;
        if (extension == nullptr) {
            needed[of(view)] = 1;
        } else {
            replaced[of(view)] = 1;
            needed[of(*extension)] = 1;
        }
    }
    for (size_t i = 0; i < buffers.size(); ++i) {
        const Json* extension = extensionOf(buffers[i]).first;
        const Json* tag = extension != nullptr && extension->isObject() ? member(*extension, "fallback") : nullptr;
        const bool tagged = tag != nullptr && tag->isBoolean() && tag->boolean();
        placeholder[i] = needed[i] == 0 && (tagged || replaced[i] != 0) ? 1 : 0;
    }
    return placeholder;
}

void decodeMeshopt(const Json& root, Document& document) {
    const Json views = table(root, "bufferViews");
    document.decodedInto.assign(views.size(), -1);
    std::vector<Compressed> all;
    uint64_t total = 0;
    Leniency& leniency = *document.leniency;
    const auto add = [&](size_t i) {
        const auto [object, name] = extensionOf(views[i]);
        if (object == nullptr) {
            return;
        }
        const std::string element = at("bufferView", i) + " " + name;
        if (!kCanDecode) {
            leniency.gather([&] {
                refuse(element, "this build of Supple reads no meshopt-compressed files (SUPPLE_WITH_MESHOPT is off)");
            });
            return;
        }
        if (!object->isObject()) {
            refuse(element, "not an object");
        }
        all.push_back(readCompressed(*object, views[i], document, element));
        all.back().view = i;
        total += all.back().count * all.back().stride;
        if (total > kMaxDecodedBytes) {
            refuse(element,
                   "the file's compressed data decodes to more than " + std::to_string(kMaxDecodedBytes) + " bytes",
                   ErrorCode::limit);
        }
    };
    for (size_t i = 0; i < views.size(); ++i) {
        if (!leniency.leaveOut([&] { add(i); })) {
            document.decodedInto[i] = kNotDecoded;
        }
    }
    leniency.raise();
    if (all.empty()) {
        return;
    }
    warn(document.warnings, extensionOf(views[all[0].view]).second,
         counted(all.size(), "bufferView is", "bufferViews are") +
             " compressed: such files usually had their triangles and vertices reordered, and polygons that are read "
             "from that order are lost");
    for (const Compressed& compressed : all) {
        document.memory->take(compressed.count, compressed.stride, compressed.element);
        if (!leniency.leaveOut([&] { document.owned.emplace_back(decode(compressed)); })) {
            document.decodedInto[compressed.view] = kNotDecoded;
            continue;
        }
        document.buffers.emplace_back(document.owned.back());
        document.decodedInto[compressed.view] = static_cast<int>(document.buffers.size()) - 1;
    }
    leniency.raise();
}

} // namespace supple::cage::gltf
