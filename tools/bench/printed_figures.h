// Figures that the papers print: frames a second, with drawing, on the graphics cards of their time. Figures that are
// not at hand are not here.
#pragma once

#include <cstdint>
#include <span>

namespace supple::bench {

struct PrintedRow {
    const char* paper;
    const char* device;
    const char* work;  ///< as the paper has it
    const char* model; ///< of ours, of the same make
    const char* scheme;
    struct At {
        uint32_t samples; ///< N: along an edge of a patch
        double framesPerSecond;
    };
    std::span<const At> figures;
};

[[nodiscard]] std::span<const PrintedRow> printedRows();

/// A GPU and a CPU side by side.
struct PrintedBlend {
    uint32_t faces;
    double gpu, cpu; ///< frames a second, 30 x 30 samples a face
};
[[nodiscard]] std::span<const PrintedBlend> printedBlend();

} // namespace supple::bench
