// The characters of samples/assets, embedded in the program.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace supple::bench {

struct SampleFile {
    const char* name; ///< without folder and ending
    std::span<const uint8_t> bytes;
};

/// pip, pip_quads, helmet, wren.
[[nodiscard]] const std::array<SampleFile, 4>& sampleFiles();

} // namespace supple::bench
