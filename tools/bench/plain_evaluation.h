// The portable yardstick: a plain C++ evaluation of bicubic patches, compiled -O3, by the same row collapse as the
// shader.
#pragma once

#include <cstdint>
#include <span>

namespace supple::bench {

/// What the yardstick was compiled for: "x86-64" and the vector extensions the compiler was allowed to use.
[[nodiscard]] const char* plainEvaluationTarget();

/// Evaluates patches of 16 coefficients (x, y, z, unused each, i + 4 j) at (rate + 1)^2 samples, position and unit
/// normal, six floats a sample, which `samples` has room for. One thread.
void evaluatePlain(std::span<const float> coefficients, uint32_t rate, std::span<float> samples);

} // namespace supple::bench
