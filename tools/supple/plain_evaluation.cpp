#include "tools/supple/plain_evaluation.h"

#include <algorithm>
#include <cmath>

namespace supple::tools {

namespace {

struct Weights {
    float b[4], d[4];
};

Weights weightsAt(uint32_t k, uint32_t rate) {
    const float t = static_cast<float>(k) / static_cast<float>(rate);
    const float s = static_cast<float>(rate - k) / static_cast<float>(rate);
    const float tt = t * t, ss = s * s, ts = t * s;
    return {{ss * s, 3.0f * (t * ss), 3.0f * (s * tt), tt * t},
            {-3.0f * ss, 3.0f * ss - 6.0f * ts, 6.0f * ts - 3.0f * tt, 3.0f * tt}};
}

} // namespace

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

void evaluatePlain(std::span<const float> coefficients, uint32_t rate, std::vector<float>& samples) {
    const uint32_t side = rate + 1;
    const size_t patches = coefficients.size() / 64;
    samples.resize(patches * side * side * 6);
    float* out = samples.data();
    Weights weights[65];
    for (uint32_t k = 0; k <= rate; ++k) {
        weights[k] = weightsAt(k, rate);
    }
    for (size_t p = 0; p < patches; ++p) {
        const float* g = coefficients.data() + 64 * p;
        for (uint32_t j = 0; j < side; ++j) {
            const Weights& v = weights[j];
            float row[4][3], rowV[4][3];
            for (int i = 0; i < 4; ++i) {
                for (int axis = 0; axis < 3; ++axis) {
                    const float a = g[4 * i + axis], b = g[16 + 4 * i + axis];
                    const float c = g[32 + 4 * i + axis], d = g[48 + 4 * i + axis];
                    row[i][axis] = (v.b[0] * a + v.b[3] * d) + (v.b[1] * b + v.b[2] * c);
                    rowV[i][axis] = (v.d[0] * a + v.d[3] * d) + (v.d[1] * b + v.d[2] * c);
                }
            }
            for (uint32_t i = 0; i < side; ++i) {
                const Weights& u = weights[i];
                float p3[3], du[3], dv[3];
                for (int axis = 0; axis < 3; ++axis) {
                    p3[axis] = (u.b[0] * row[0][axis] + u.b[3] * row[3][axis]) +
                               (u.b[1] * row[1][axis] + u.b[2] * row[2][axis]);
                    du[axis] = (u.d[0] * row[0][axis] + u.d[3] * row[3][axis]) +
                               (u.d[1] * row[1][axis] + u.d[2] * row[2][axis]);
                    dv[axis] = (u.b[0] * rowV[0][axis] + u.b[3] * rowV[3][axis]) +
                               (u.b[1] * rowV[1][axis] + u.b[2] * rowV[2][axis]);
                }
                const float nx = du[1] * dv[2] - du[2] * dv[1];
                const float ny = du[2] * dv[0] - du[0] * dv[2];
                const float nz = du[0] * dv[1] - du[1] * dv[0];
                const float length = 1.0f / std::sqrt(std::max(nx * nx + ny * ny + nz * nz, 1e-30f));
                out[0] = p3[0];
                out[1] = p3[1];
                out[2] = p3[2];
                out[3] = nx * length;
                out[4] = ny * length;
                out[5] = nz * length;
                out += 6;
            }
        }
    }
}

} // namespace supple::tools
