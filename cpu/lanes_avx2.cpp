// Compiled with -mavx2 for this file alone, so it includes nothing whose inline functions the linker could give to
// others.
#include "cpu/lanes.h"

#include <math.h>

namespace supple::cpu {

#ifdef __AVX2__
namespace {
#include "cpu/lane_kernels.h"
} // namespace

const LaneKernels* avx2LaneKernels() {
    return &kKernels;
}
#else
const LaneKernels* avx2LaneKernels() {
    return nullptr;
}
#endif

} // namespace supple::cpu
