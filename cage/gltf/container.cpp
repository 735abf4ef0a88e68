#include "cage/gltf/container.h"

#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <string>

namespace supple::cage::gltf {
namespace {

constexpr uint32_t kGlbMagic = 0x46546C67u;
constexpr uint32_t kGlbJson = 0x4E4F534Au;
constexpr uint32_t kGlbBinary = 0x004E4942u;

std::string_view textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Whether a chunk may begin there: it is one that glTF knows, and all of it is there.
bool isChunk(std::span<const std::byte> bytes, size_t offset) {
    if (offset > bytes.size() || bytes.size() - offset < 8) {
        return false;
    }
    const uint32_t type = readU32(bytes, offset + 4);
    return (type == kGlbJson || type == kGlbBinary) && readU32(bytes, offset) <= bytes.size() - offset - 8;
}

/// Where the chunk behind one that ends at `end` begins. Chunks are padded to multiples of four, and their lengths
/// count the padding. Some writers do not count it, others have none.
size_t nextChunk(std::span<const std::byte> bytes, size_t end, size_t chunk, Leniency& leniency) {
    const size_t padded = (end + 3) / 4 * 4;
    if (padded == end) {
        return end;
    }
    const bool unpadded = !isChunk(bytes, padded) && isChunk(bytes, end);
    if (unpadded || padded + 8 <= bytes.size()) { // the last one may end as it likes
        leniency.mend(at("GLB chunk", chunk),
                      unpadded ? "not padded: the next chunk does not begin on a multiple of 4"
                               : "its length is no multiple of 4",
                      "the next chunk is read where it begins");
    }
    return unpadded ? end : std::min(padded, bytes.size());
}

/// The chunks of a file with the magic of a GLB.
Container openGlb(std::span<const std::byte> bytes, Leniency& leniency) {
    Container container;
    container.isBinary = true;
    if (bytes.size() < 12) {
        refuse("GLB header", "truncated: " + std::to_string(bytes.size()) + " of 12 bytes");
    }
    const uint32_t version = readU32(bytes, 4);
    if (version != 2) {
        refuse("GLB header", "version " + std::to_string(version) + ", only 2 is supported");
    }
    const uint32_t length = readU32(bytes, 8);
    if (length > bytes.size()) {
        refuse("GLB header", "truncated: " + std::to_string(length) + " bytes announced, " +
                                 std::to_string(bytes.size()) + " present");
    }
    bool seenJson = false;
    bool seenBinary = false;
    size_t offset = 12;
    for (size_t chunk = 0; offset < length; ++chunk) {
        if (length - offset < 8) {
            refuse(at("GLB chunk", chunk), "truncated header");
        }
        const uint32_t chunkLength = readU32(bytes, offset);
        const uint32_t chunkType = readU32(bytes, offset + 4);
        offset += 8;
        if (chunkLength > length - offset) {
            refuse(at("GLB chunk", chunk), "truncated: " + std::to_string(chunkLength) + " bytes announced, " +
                                               std::to_string(length - offset) + " present");
        }
        if (chunk == 0 && chunkType != kGlbJson) {
            refuse("GLB chunk 0", "not the JSON chunk");
        }
        if (chunkType == kGlbJson && !seenJson) {
            seenJson = true;
            container.text = textOf(bytes.subspan(offset, chunkLength));
            // The padding is spaces, but some writers put zeros.
            container.text = container.text.substr(0, container.text.find_last_not_of('\0') + 1);
        } else if (chunkType == kGlbBinary && !seenBinary) {
            seenBinary = true;
            container.binary = bytes.subspan(offset, chunkLength);
        }
        offset = nextChunk(bytes.first(length), offset + chunkLength, chunk, leniency);
    }
    if (!seenJson) {
        refuse("GLB", "no JSON chunk");
    }
    return container;
}

} // namespace

uint32_t readU32(std::span<const std::byte> bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) {
        value |= static_cast<uint32_t>(bytes[offset + i]) << (8 * i);
    }
    return value;
}

Container openContainer(std::span<const std::byte> bytes, Leniency& leniency) {
    if (bytes.empty()) {
        refuse("file", "empty");
    }
    if (bytes.size() >= 4 && readU32(bytes, 0) == kGlbMagic) {
        return openGlb(bytes, leniency);
    }
    Container container;
    container.text = textOf(bytes);
    size_t first = container.text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    first = container.text.find_first_not_of(" \t\r\n", first);
    if (first == std::string_view::npos || container.text[first] != '{') {
        refuse("file", "neither GLB nor glTF JSON: no 'glTF' magic and no '{' at its start");
    }
    return container;
}

} // namespace supple::cage::gltf
