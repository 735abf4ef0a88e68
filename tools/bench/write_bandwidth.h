// What the machine's memory takes: the bytes of the evaluation written and nothing computed.
#pragma once

#include <cstdint>
#include <span>

namespace supple::bench {

/// Writes every float once, each time other values. One thread.
void writeAll(std::span<float> samples, uint32_t turn);

} // namespace supple::bench
