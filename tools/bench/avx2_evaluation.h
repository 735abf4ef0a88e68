// The yardstick on x86: bicubic patches by hand-written AVX2 and FMA, a patch a lane as the shader has it on a CPU
// device.
#pragma once

#include "tools/bench/bicubic_weights.h"

#include <cstddef>
#include <cstdint>

namespace supple::bench {

/// Whether the tool was compiled with it and this CPU runs it.
[[nodiscard]] bool hasAvx2Evaluation();

/// As evaluatePlain(). `patches` may be any number; pointers need no alignment. One thread. Does nothing where
/// hasAvx2Evaluation() is false.
void evaluateAvx2(const float* coefficients, size_t patches, uint32_t rate, const BicubicWeights& weights,
                  float* samples);

} // namespace supple::bench
