#include "tools/bench/bicubic_weights.h"

namespace supple::bench {

void fillBicubicWeights(BicubicWeights& weights, uint32_t rate) {
    for (uint32_t k = 0; k <= rate; ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(rate);
        const float s = static_cast<float>(rate - k) / static_cast<float>(rate);
        const float tt = t * t, ss = s * s, ts = t * s;
        const float b[4] = {ss * s, 3.0f * (t * ss), 3.0f * (s * tt), tt * t};
        const float d[4] = {-3.0f * ss, 3.0f * ss - 6.0f * ts, 6.0f * ts - 3.0f * tt, 3.0f * tt};
        for (int i = 0; i < 4; ++i) {
            weights.b[i][k] = b[i];
            weights.d[i][k] = d[i];
        }
    }
}

} // namespace supple::bench
