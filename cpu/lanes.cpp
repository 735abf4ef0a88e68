#include "cpu/lanes.h"

#include <array>
#include <math.h>

namespace supple::cpu {
namespace {
#include "cpu/lane_kernels.h"
} // namespace

const LaneKernels& plainLaneKernels() {
    return kKernels;
}

const LaneKernels& laneKernels() {
#if defined(__GNUC__) && defined(__x86_64__)
    if (avx2LaneKernels() != nullptr && __builtin_cpu_supports("avx2")) {
        return *avx2LaneKernels();
    }
#endif
    return plainLaneKernels();
}

void setBernstein(WeightLanes<4>& weights, unsigned lane, float t, float back) {
    const float tt = t * t, bb = back * back, tb = t * back;
    const std::array<float, 4> value{bb * back, 3.0f * (bb * t), 3.0f * (tt * back), tt * t};
    const std::array<float, 4> slope{-3.0f * bb, 3.0f * bb - 6.0f * tb, 6.0f * tb - 3.0f * tt, 3.0f * tt};
    const std::array<float, 4> bend{6.0f * back, 6.0f * (t - 2.0f * back), 6.0f * (back - 2.0f * t), 6.0f * t};
    for (unsigned k = 0; k < 4; ++k) {
        weights.value[k][lane] = value[k];
        weights.slope[k][lane] = slope[k];
        weights.bend[k][lane] = bend[k];
    }
}

void setBernstein(WeightLanes<6>& weights, unsigned lane, float t, float back) {
    const float tt = t * t, bb = back * back, ttt = tt * t, bbb = bb * back;
    const std::array<float, 6> value{bb * bbb,           5.0f * (t * (bb * bb)),    10.0f * (tt * bbb),
                                     10.0f * (ttt * bb), 5.0f * ((tt * tt) * back), tt * ttt};
    // Derivatives are differences of the polynomials of lower degree.
    const std::array<float, 7> quartic{0.0f,    bb * bb, 4.0f * (bbb * t), 6.0f * (bb * tt), 4.0f * (back * ttt),
                                       tt * tt, 0.0f};
    const std::array<float, 8> cubic{0.0f, 0.0f, bbb, 3.0f * (bb * t), 3.0f * (back * tt), ttt, 0.0f, 0.0f};
    for (unsigned k = 0; k < 6; ++k) {
        weights.value[k][lane] = value[k];
        weights.slope[k][lane] = 5.0f * (quartic[k] - quartic[k + 1]);
        weights.bend[k][lane] = 20.0f * ((cubic[k] + cubic[k + 2]) - 2.0f * cubic[k + 1]);
    }
}

} // namespace supple::cpu
