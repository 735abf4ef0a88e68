// Inputs made of inputs, in the terms of the format: what a mutator of bytes alone takes years to find.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace supple::fuzz {

using Random = std::minstd_rand;

/// Changes the JSON of a GLB or glTF in some places, or numbers in its binary chunk. The file stays well-formed.
/// Returns nothing where the input has no JSON that can be parsed.
[[nodiscard]] std::vector<uint8_t> mutateGltf(const uint8_t* data, size_t size, Random& random);

/// Changes words of lines, and lines.
[[nodiscard]] std::vector<uint8_t> mutateLines(const uint8_t* data, size_t size, Random& random);

/// Changes bytes.
[[nodiscard]] std::vector<uint8_t> mutateBytes(const uint8_t* data, size_t size, Random& random);

} // namespace supple::fuzz
