// Checked reads of glTF accessors: ranges, strides, sparse substitution, dequantisation. Private to cage/gltf/.
#pragma once

#include "cage/gltf/document.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// An accessor without a bufferView is all zeros whatever the file's size; a longer one is refused.
inline constexpr uint64_t kMaxZeroElements = 1u << 24;

/// Component types a use allows, as bits.
enum ComponentTypes : uint32_t {
    kFloat = 1u << 0,
    kNormalizedU8 = 1u << 1,
    kNormalizedU16 = 1u << 2,
    kNormalizedS8 = 1u << 3,
    kNormalizedS16 = 1u << 4,
    kU8 = 1u << 5,
    kU16 = 1u << 6,
    kU32 = 1u << 7,
    kS8 = 1u << 8,
    kS16 = 1u << 9,
};

// What indices and joints are stored as.
inline constexpr uint32_t kIntegers = kU8 | kU16 | kU32;

// What a use allows in files with KHR_mesh_quantization.
inline constexpr uint32_t kQuantizedSigned = kNormalizedS8 | kNormalizedS16 | kS8 | kS16;
inline constexpr uint32_t kQuantized = kQuantizedSigned | kNormalizedU8 | kNormalizedU16 | kU8 | kU16;

/// Elements of `type` (file::ElementType) as floats, element after element; normalized integers are divided by their
/// largest value, others are taken as they are. Throws Refusal that names `element` when type or component type are not
/// allowed there or the data is out of range.
/// `quantized`: component types that are allowed besides in files with KHR_mesh_quantization. Integers that lack the
/// flag `normalized`, and those of an extension that the file forgot to name, are mended.
[[nodiscard]] std::vector<float> readFloats(const Document& document, int accessor, int type, uint32_t allowed,
                                            const std::string& element, uint32_t quantized = 0);

/// Whether a sparse accessor's values take the place of those below them.
enum class Sparse { applied, ignored };

/// Elements of `type` as unsigned integers.
[[nodiscard]] std::vector<uint32_t> readIntegers(const Document& document, int accessor, int type, uint32_t allowed,
                                                 const std::string& element, Sparse sparse = Sparse::applied);

/// The largest number of the accessor's component type: no index, but the mark between strips and loops.
[[nodiscard]] uint32_t restartIndex(const Document& document, int accessor);

/// How far apart the numbers are that an accessor of integers can hold, as readFloats() reads them; 0: it has floats.
[[nodiscard]] float integerStep(const Document& document, int accessor);

/// Number of elements; none of an accessor that cannot be read.
[[nodiscard]] size_t accessorCount(const Document& document, int accessor);

/// Refuses an attribute that does not have one element a vertex.
void checkVertexCount(const Document& document, int accessor, size_t vertexCount, const std::string& element);

} // namespace supple::cage::gltf
