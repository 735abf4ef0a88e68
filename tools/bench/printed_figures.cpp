#include "tools/bench/printed_figures.h"

#include <array>

namespace supple::bench {
namespace {

using At = PrintedRow::At;
constexpr At kPrepFrog[] = {{5, 247}, {9, 205}, {17, 102}, {33, 41}};
constexpr At kPrepShaft[] = {{5, 811}, {9, 590}, {17, 262}, {33, 87}};
constexpr At kPrepDonuts[] = {{5, 524}, {9, 456}, {17, 249}, {33, 104}};
constexpr At kPmFrog[] = {{5, 650}, {9, 510}, {17, 230}, {33, 79}, {65, 22}};
constexpr At kPmDodecahedra[] = {{5, 780}, {9, 780}, {17, 675}, {33, 265}, {65, 72}};
constexpr std::array<PrintedRow, 5> kRows = {{
    {"p-rep, 2008", "GeForce 8800 GTX", "frog, 1,292 quads", "frog", "prep", kPrepFrog},
    {"p-rep, 2008", "GeForce 8800 GTX", "shaft, 1,105 quads, 90.6 % B-quads", "shaft", "prep", kPrepShaft},
    {"p-rep, 2008", "GeForce 8800 GTX", "10 triple donuts, 440 quads", "triple donuts", "prep", kPrepDonuts},
    {"P_m, 2008", "GeForce 8800 GT", "frog", "frog", "pm", kPmFrog},
    {"P_m, 2008", "GeForce 8800 GT", "10 dodecahedra, 120 pentagons", "dodecahedra", "pm", kPmDodecahedra},
}};
constexpr std::array<PrintedBlend, 3> kBlend = {{{442, 30.1, 1.48}, {179, 73.0, 3.84}, {32, 438.0, 25.4}}};

} // namespace

std::span<const PrintedRow> printedRows() {
    return kRows;
}

std::span<const PrintedBlend> printedBlend() {
    return kBlend;
}

} // namespace supple::bench
