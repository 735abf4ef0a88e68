// Floats as the words of a table.
#pragma once

#include <bit>
#include <cstdint>

namespace supple::skinning {

[[nodiscard]] inline uint32_t bits(float value) {
    return std::bit_cast<uint32_t>(value);
}

} // namespace supple::skinning
