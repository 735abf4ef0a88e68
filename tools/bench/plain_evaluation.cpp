#include "tools/bench/plain_evaluation.h"

#include "tools/bench/bicubic_weights.h"

#include <cmath>

namespace supple::bench {

const char* plainEvaluationTarget() {
#if defined(__AVX512F__)
    return "x86-64 with AVX-512";
#elif defined(__AVX2__)
    return "x86-64 with AVX2";
#elif defined(__x86_64__)
    return "x86-64 (SSE2)";
#elif defined(__aarch64__)
    return "aarch64";
#else
    return "this machine's default";
#endif
}

void evaluatePlain(std::span<const float> coefficients, uint32_t rate, std::span<float> samples) {
    const uint32_t side = rate + 1;
    const size_t patches = coefficients.size() / 64;
    float* out = samples.data();
    BicubicWeights w;
    fillBicubicWeights(w, rate);
    float row[6][kMaxSide]; // x, y, z, normal
    for (size_t p = 0; p < patches; ++p) {
        const float* g = coefficients.data() + 64 * p;
        for (uint32_t j = 0; j < side; ++j) {
            float c[4][3], cv[4][3];
            for (int i = 0; i < 4; ++i) {
                for (int axis = 0; axis < 3; ++axis) {
                    const float g0 = g[4 * i + axis], g1 = g[16 + 4 * i + axis];
                    const float g2 = g[32 + 4 * i + axis], g3 = g[48 + 4 * i + axis];
                    c[i][axis] = (w.b[0][j] * g0 + w.b[3][j] * g3) + (w.b[1][j] * g1 + w.b[2][j] * g2);
                    cv[i][axis] = (w.d[0][j] * g0 + w.d[3][j] * g3) + (w.d[1][j] * g1 + w.d[2][j] * g2);
                }
            }
            for (uint32_t i = 0; i < side; ++i) {
                float du[3], dv[3];
                for (int axis = 0; axis < 3; ++axis) {
                    row[axis][i] = (w.b[0][i] * c[0][axis] + w.b[3][i] * c[3][axis]) +
                                   (w.b[1][i] * c[1][axis] + w.b[2][i] * c[2][axis]);
                    du[axis] = (w.d[0][i] * c[0][axis] + w.d[3][i] * c[3][axis]) +
                               (w.d[1][i] * c[1][axis] + w.d[2][i] * c[2][axis]);
                    dv[axis] = (w.b[0][i] * cv[0][axis] + w.b[3][i] * cv[3][axis]) +
                               (w.b[1][i] * cv[1][axis] + w.b[2][i] * cv[2][axis]);
                }
                const float nx = du[1] * dv[2] - du[2] * dv[1];
                const float ny = du[2] * dv[0] - du[0] * dv[2];
                const float nz = du[0] * dv[1] - du[1] * dv[0];
                const float scale = 1.0f / std::sqrt(nx * nx + ny * ny + nz * nz + 1e-30f);
                row[3][i] = nx * scale;
                row[4][i] = ny * scale;
                row[5][i] = nz * scale;
            }
            for (uint32_t i = 0; i < side; ++i) {
                for (int k = 0; k < 6; ++k) {
                    *out++ = row[k][i];
                }
            }
        }
    }
}

} // namespace supple::bench
