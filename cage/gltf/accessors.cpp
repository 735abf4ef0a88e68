#include "cage/gltf/accessors.h"

#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace supple::cage::gltf {
namespace {

using file::Accessor;

std::string componentName(const Accessor& accessor) {
    std::string name;
    switch (accessor.componentType) {
    case file::kByte:
        name = "BYTE";
        break;
    case file::kUnsignedByte:
        name = "UNSIGNED_BYTE";
        break;
    case file::kShort:
        name = "SHORT";
        break;
    case file::kUnsignedShort:
        name = "UNSIGNED_SHORT";
        break;
    case file::kUnsignedInt:
        name = "UNSIGNED_INT";
        break;
    default:
        name = "FLOAT";
        break;
    }
    return accessor.normalized ? "normalized " + name : name;
}

uint32_t componentBit(const Accessor& accessor) {
    switch (accessor.componentType) {
    case file::kByte:
        return accessor.normalized ? kNormalizedS8 : kS8;
    case file::kUnsignedByte:
        return accessor.normalized ? kNormalizedU8 : kU8;
    case file::kShort:
        return accessor.normalized ? kNormalizedS16 : kS16;
    case file::kUnsignedShort:
        return accessor.normalized ? kNormalizedU16 : kU16;
    case file::kUnsignedInt:
        return accessor.normalized ? 0u : kU32;
    case file::kFloat:
        return accessor.normalized ? 0u : kFloat;
    default:
        return 0;
    }
}

template <class T>
T load(const std::byte* from) {
    // glTF is little-endian, as is every machine this runs on.
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

uint32_t loadInteger(const std::byte* from, int componentType) {
    switch (componentType) {
    case file::kUnsignedByte:
        return load<uint8_t>(from);
    case file::kUnsignedShort:
        return load<uint16_t>(from);
    default:
        return load<uint32_t>(from);
    }
}

/// The bytes of `count` elements that lie `stride` apart in a bufferView; null stride: packed.
std::span<const std::byte> viewBytes(const Document& document, int view, uint64_t offset, uint64_t count,
                                     uint64_t elementSize, uint64_t& stride, const std::string& element) {
    const auto& bufferView = document.model.bufferViews[static_cast<size_t>(view)];
    if (stride == 0) {
        stride = bufferView.byteStride != 0 ? bufferView.byteStride : elementSize;
    }
    if (stride < elementSize) {
        refuse(element, "byteStride " + std::to_string(stride) + " is less than the element's " +
                            std::to_string(elementSize) + " bytes");
    }
    const uint64_t available = bufferView.byteLength;
    // count > 0; nothing here can overflow: the quotient is formed instead of the product.
    if (offset > available || available - offset < elementSize ||
        count - 1 > (available - offset - elementSize) / stride) {
        refuse(element, std::to_string(count) + " elements at byte " + std::to_string(offset) +
                            " are out of range: bufferView " + std::to_string(view) + " has " +
                            std::to_string(available) + " bytes");
    }
    return document.buffers[bufferView.buffer].subspan(static_cast<size_t>(bufferView.byteOffset + offset),
                                                       static_cast<size_t>((count - 1) * stride + elementSize));
}

/// Puts a sparse accessor's values in place of those it changes.
void substitute(const Document& document, const Accessor& accessor, uint64_t elementSize, const std::string& element,
                std::vector<std::byte>& bytes) {
    const uint64_t count = accessor.count;
    const uint64_t sparseCount = accessor.sparseCount;
    const file::SparsePart& indices = accessor.sparseIndices;
    const file::SparsePart& values = accessor.sparseValues;
    const uint64_t indexSize = file::componentSize(indices.componentType);
    uint64_t indexStride = indexSize;
    uint64_t valueStride = elementSize;
    const auto indexBytes = viewBytes(document, indices.bufferView, indices.byteOffset, sparseCount, indexSize,
                                      indexStride, element + " sparse indices");
    const auto valueBytes = viewBytes(document, values.bufferView, values.byteOffset, sparseCount, elementSize,
                                      valueStride, element + " sparse values");
    uint64_t previous = 0;
    for (uint64_t i = 0; i < sparseCount; ++i) {
        const uint64_t target = loadInteger(indexBytes.data() + i * indexSize, indices.componentType);
        if (target >= count) {
            refuse(element + " sparse indices", std::to_string(target) + " is out of range: the accessor has " +
                                                    std::to_string(count) + " elements");
        }
        if (i > 0 && target <= previous) {
            refuse(element + " sparse indices", "not strictly increasing");
        }
        previous = target;
        std::memcpy(bytes.data() + target * elementSize, valueBytes.data() + i * elementSize, elementSize);
    }
}

/// All elements, packed.
std::vector<std::byte> packed(const Document& document, int index, int type, uint32_t allowed,
                              const std::string& element, Sparse sparse) {
    const Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
    if (accessor.type != type) {
        refuse(element, std::string(file::kTypeNames[accessor.type]) + " instead of " + file::kTypeNames[type]);
    }
    if ((componentBit(accessor) & allowed) == 0) {
        refuse(element, componentName(accessor) + " components are not allowed here");
    }
    const uint64_t elementSize =
        uint64_t{file::componentSize(accessor.componentType)} * file::componentsOf(accessor.type);
    const uint64_t count = accessor.count;
    // The bytes, numbers of four bytes each, and what is made of these.
    const uint64_t perElement = elementSize + 3 * sizeof(float) * file::componentsOf(accessor.type);
    std::vector<std::byte> bytes;
    if (accessor.bufferView < 0) {
        if (count > kMaxZeroElements) {
            refuse(element,
                   "accessor without bufferView: " + std::to_string(count) + " elements, at most " +
                       std::to_string(kMaxZeroElements) + " are read",
                   ErrorCode::limit);
        }
        document.memory->take(count, perElement, element);
        bytes.resize(static_cast<size_t>(count * elementSize));
    } else {
        uint64_t stride = 0;
        const auto source =
            viewBytes(document, accessor.bufferView, accessor.byteOffset, count, elementSize, stride, element);
        document.memory->take(count, perElement, element);
        bytes.resize(static_cast<size_t>(count * elementSize));
        for (uint64_t i = 0; i < count; ++i) {
            std::memcpy(bytes.data() + i * elementSize, source.data() + i * stride, elementSize);
        }
    }
    if (accessor.sparseCount > 0 && sparse == Sparse::applied) {
        substitute(document, accessor, elementSize, element, bytes);
    }
    return bytes;
}

} // namespace

std::vector<float> readFloats(const Document& document, int accessor, int type, uint32_t allowed,
                              const std::string& element) {
    const std::vector<std::byte> bytes = packed(document, accessor, type, allowed, element, Sparse::applied);
    const int componentType = document.model.accessors[static_cast<size_t>(accessor)].componentType;
    const bool normalized = document.model.accessors[static_cast<size_t>(accessor)].normalized;
    const size_t size = file::componentSize(componentType);
    std::vector<float> values(bytes.size() / size);
    for (size_t i = 0; i < values.size(); ++i) {
        const std::byte* from = bytes.data() + i * size;
        float largest = 1.0f;
        switch (componentType) {
        case file::kByte:
            values[i] = load<int8_t>(from);
            largest = 127.0f;
            break;
        case file::kUnsignedByte:
            values[i] = load<uint8_t>(from);
            largest = 255.0f;
            break;
        case file::kShort:
            values[i] = load<int16_t>(from);
            largest = 32767.0f;
            break;
        case file::kUnsignedShort:
            values[i] = load<uint16_t>(from);
            largest = 65535.0f;
            break;
        default:
            values[i] = load<float>(from);
            break;
        }
        if (normalized) {
            values[i] = std::max(values[i] / largest, -1.0f); // there is one more negative number than positive
        }
    }
    return values;
}

std::vector<uint32_t> readIntegers(const Document& document, int accessor, int type, uint32_t allowed,
                                   const std::string& element, Sparse sparse) {
    const std::vector<std::byte> bytes = packed(document, accessor, type, allowed, element, sparse);
    const int componentType = document.model.accessors[static_cast<size_t>(accessor)].componentType;
    const size_t size = file::componentSize(componentType);
    std::vector<uint32_t> values(bytes.size() / size);
    for (size_t i = 0; i < values.size(); ++i) {
        values[i] = loadInteger(bytes.data() + i * size, componentType);
    }
    return values;
}

uint32_t restartIndex(const Document& document, int accessor) {
    const int type = document.model.accessors[static_cast<size_t>(accessor)].componentType;
    return type == file::kUnsignedByte ? 0xFFu : type == file::kUnsignedShort ? 0xFFFFu : 0xFFFFFFFFu;
}

size_t accessorCount(const Document& document, int accessor) {
    return static_cast<size_t>(document.model.accessors[static_cast<size_t>(accessor)].count);
}

void checkVertexCount(const Document& document, int accessor, size_t vertexCount, const std::string& element) {
    const size_t count = accessorCount(document, accessor);
    if (count != vertexCount) {
        refuse(element, counted(count, "element", "elements") + " for " + counted(vertexCount, "vertex", "vertices"));
    }
}

} // namespace supple::cage::gltf
