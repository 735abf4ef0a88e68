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

uint32_t componentBit(int componentType, bool normalized) {
    switch (componentType) {
    case file::kByte:
        return normalized ? kNormalizedS8 : kS8;
    case file::kUnsignedByte:
        return normalized ? kNormalizedU8 : kU8;
    case file::kShort:
        return normalized ? kNormalizedS16 : kS16;
    case file::kUnsignedShort:
        return normalized ? kNormalizedU16 : kU16;
    case file::kUnsignedInt:
        return normalized ? 0u : kU32;
    case file::kFloat:
        return normalized ? 0u : kFloat;
    default:
        return 0;
    }
}

/// Whether the components are normalized: as the accessor says, unless that is not allowed and the opposite is.
bool readsNormalized(const Document& document, const Accessor& accessor, uint32_t allowed, uint32_t quantized,
                     const std::string& element) {
    const uint32_t own = componentBit(accessor.componentType, accessor.normalized);
    const bool isDeclared = isUsed(document, "KHR_mesh_quantization");
    if ((own & (isDeclared ? allowed | quantized : allowed)) != 0) {
        return accessor.normalized;
    }
    const std::string what = componentName(accessor) + " components ";
    if ((componentBit(accessor.componentType, !accessor.normalized) & allowed) != 0) {
        document.leniency->mend(
            element, accessor.normalized ? what + "are not allowed here" : what + "without \"normalized\": true",
            accessor.normalized ? "read as if they were not normalized" : "read as if they were normalized");
        return !accessor.normalized;
    }
    if ((own & quantized) == 0) {
        refuse(element, what + "are not allowed here");
    }
    document.leniency->mend(element, what + "need KHR_mesh_quantization, which the file does not declare",
                            "read as if it did");
    return accessor.normalized;
}

/// An accessor that can be read.
const Accessor& soundAccessor(const Document& document, int index, const std::string& element) {
    const Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
    if (accessor.broken) {
        refuse(element, at("accessor", static_cast<size_t>(index)) + " cannot be read");
    }
    return accessor;
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
    if (bufferView.broken) {
        refuse(element, at("bufferView", static_cast<size_t>(view)) + " cannot be read");
    }
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
    bool rises = true;
    for (uint64_t i = 0; i < sparseCount; ++i) {
        const uint64_t target = loadInteger(indexBytes.data() + i * indexSize, indices.componentType);
        if (target >= count) {
            refuse(element + " sparse indices", std::to_string(target) + " is out of range: the accessor has " +
                                                    std::to_string(count) + " elements");
        }
        rises = rises && (i == 0 || target > previous);
        previous = target;
        std::memcpy(bytes.data() + target * elementSize, valueBytes.data() + i * elementSize, elementSize);
    }
    if (!rises) {
        document.leniency->mend(element + " sparse indices", "not strictly increasing", "the last value counts");
    }
}

/// What normalized integers are divided by.
float largestOf(int componentType) {
    switch (componentType) {
    case file::kByte:
        return 127.0f;
    case file::kUnsignedByte:
        return 255.0f;
    case file::kShort:
        return 32767.0f;
    case file::kUnsignedShort:
        return 65535.0f;
    default:
        return 1.0f;
    }
}

void checkType(const Accessor& accessor, int type, const std::string& element) {
    if (accessor.type != type) {
        refuse(element, std::string(file::kTypeNames[accessor.type]) + " instead of " + file::kTypeNames[type]);
    }
}

/// All elements, packed. The accessor is sound.
std::vector<std::byte> packed(const Document& document, const Accessor& accessor, const std::string& element,
                              Sparse sparse) {
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

std::vector<float> readFloats(const Document& document, int index, int type, uint32_t allowed,
                              const std::string& element, uint32_t quantized) {
    const Accessor& accessor = soundAccessor(document, index, element);
    checkType(accessor, type, element);
    const bool normalized = readsNormalized(document, accessor, allowed, quantized, element);
    const std::vector<std::byte> bytes = packed(document, accessor, element, Sparse::applied);
    const int componentType = accessor.componentType;
    const size_t size = file::componentSize(componentType);
    const float largest = largestOf(componentType);
    std::vector<float> values(bytes.size() / size);
    for (size_t i = 0; i < values.size(); ++i) {
        const std::byte* from = bytes.data() + i * size;
        switch (componentType) {
        case file::kByte:
            values[i] = load<int8_t>(from);
            break;
        case file::kUnsignedByte:
            values[i] = load<uint8_t>(from);
            break;
        case file::kShort:
            values[i] = load<int16_t>(from);
            break;
        case file::kUnsignedShort:
            values[i] = load<uint16_t>(from);
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

std::vector<uint32_t> readIntegers(const Document& document, int index, int type, uint32_t allowed,
                                   const std::string& element, Sparse sparse) {
    const Accessor& accessor = soundAccessor(document, index, element);
    checkType(accessor, type, element);
    (void)readsNormalized(document, accessor, allowed, 0, element); // they are read as they are
    const std::vector<std::byte> bytes = packed(document, accessor, element, sparse);
    const int componentType = accessor.componentType;
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

float integerStep(const Document& document, int accessor) {
    const Accessor& of = document.model.accessors[static_cast<size_t>(accessor)];
    return of.componentType == file::kFloat ? 0.0f : of.normalized ? 1.0f / largestOf(of.componentType) : 1.0f;
}

size_t accessorCount(const Document& document, int accessor) {
    return static_cast<size_t>(document.model.accessors[static_cast<size_t>(accessor)].count);
}

void checkVertexCount(const Document& document, int accessor, size_t vertexCount, const std::string& element) {
    const auto count = static_cast<size_t>(soundAccessor(document, accessor, element).count);
    if (count != vertexCount) {
        refuse(element, counted(count, "element", "elements") + " for " + counted(vertexCount, "vertex", "vertices"));
    }
}

} // namespace supple::cage::gltf
