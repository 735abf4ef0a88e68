#include "tools/bench/write_bandwidth.h"

namespace supple::bench {

void writeAll(std::span<float> samples, uint32_t turn) {
    const float value = static_cast<float>(turn);
    for (float& sample : samples) {
        sample = value;
    }
}

} // namespace supple::bench
