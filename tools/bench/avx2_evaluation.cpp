// Compiled with -mavx2 -mfma for this file alone, so it includes nothing whose inline functions the linker could give
// to others.
#include "tools/bench/avx2_evaluation.h"

#if defined(__x86_64__) && defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>
#endif

namespace supple::bench {

#if defined(__x86_64__) && defined(__AVX2__) && defined(__FMA__)

namespace {

constexpr uint32_t kLanes = 8;

/// Eight rows of eight floats become columns.
inline void transpose(__m256 (&r)[8]) {
    const __m256 a0 = _mm256_unpacklo_ps(r[0], r[1]), a1 = _mm256_unpackhi_ps(r[0], r[1]);
    const __m256 a2 = _mm256_unpacklo_ps(r[2], r[3]), a3 = _mm256_unpackhi_ps(r[2], r[3]);
    const __m256 a4 = _mm256_unpacklo_ps(r[4], r[5]), a5 = _mm256_unpackhi_ps(r[4], r[5]);
    const __m256 a6 = _mm256_unpacklo_ps(r[6], r[7]), a7 = _mm256_unpackhi_ps(r[6], r[7]);
    const __m256 b0 = _mm256_shuffle_ps(a0, a2, 0x44), b1 = _mm256_shuffle_ps(a0, a2, 0xEE);
    const __m256 b2 = _mm256_shuffle_ps(a1, a3, 0x44), b3 = _mm256_shuffle_ps(a1, a3, 0xEE);
    const __m256 b4 = _mm256_shuffle_ps(a4, a6, 0x44), b5 = _mm256_shuffle_ps(a4, a6, 0xEE);
    const __m256 b6 = _mm256_shuffle_ps(a5, a7, 0x44), b7 = _mm256_shuffle_ps(a5, a7, 0xEE);
    r[0] = _mm256_permute2f128_ps(b0, b4, 0x20);
    r[1] = _mm256_permute2f128_ps(b1, b5, 0x20);
    r[2] = _mm256_permute2f128_ps(b2, b6, 0x20);
    r[3] = _mm256_permute2f128_ps(b3, b7, 0x20);
    r[4] = _mm256_permute2f128_ps(b0, b4, 0x31);
    r[5] = _mm256_permute2f128_ps(b1, b5, 0x31);
    r[6] = _mm256_permute2f128_ps(b2, b6, 0x31);
    r[7] = _mm256_permute2f128_ps(b3, b7, 0x31);
}

/// w0 a + w1 b + w2 c + w3 d in two chains, which run side by side.
inline __m256 sum4(const __m256 (&w)[4], __m256 a, __m256 b, __m256 c, __m256 d) {
    return _mm256_add_ps(_mm256_fmadd_ps(w[3], d, _mm256_mul_ps(w[0], a)),
                         _mm256_fmadd_ps(w[2], c, _mm256_mul_ps(w[1], b)));
}

struct Row {
    __m256 c[4][3], cv[4][3]; ///< the row's four control points and their derivatives along v
};

inline void load(__m256 (&w)[4], const float (&table)[4][kMaxSide], uint32_t k) {
    for (int i = 0; i < 4; ++i) {
        w[i] = _mm256_broadcast_ss(&table[i][k]);
    }
}

/// Position and unit normal of eight patches at one sample.
inline void evaluate(const Row& row, const BicubicWeights& weights, uint32_t i, __m256 (&r)[6]) {
    __m256 b[4], d[4], du[3], dv[3];
    load(b, weights.b, i);
    load(d, weights.d, i);
    for (int axis = 0; axis < 3; ++axis) {
        const __m256 c0 = row.c[0][axis], c1 = row.c[1][axis], c2 = row.c[2][axis], c3 = row.c[3][axis];
        r[axis] = sum4(b, c0, c1, c2, c3);
        du[axis] = sum4(d, c0, c1, c2, c3);
        dv[axis] = sum4(b, row.cv[0][axis], row.cv[1][axis], row.cv[2][axis], row.cv[3][axis]);
    }
    const __m256 nx = _mm256_fmsub_ps(du[1], dv[2], _mm256_mul_ps(du[2], dv[1]));
    const __m256 ny = _mm256_fmsub_ps(du[2], dv[0], _mm256_mul_ps(du[0], dv[2]));
    const __m256 nz = _mm256_fmsub_ps(du[0], dv[1], _mm256_mul_ps(du[1], dv[0]));
    __m256 square = _mm256_fmadd_ps(nx, nx, _mm256_fmadd_ps(ny, ny, _mm256_mul_ps(nz, nz)));
    square = _mm256_max_ps(square, _mm256_set1_ps(1e-30f));
    // 12 bits from the table, then one step of Newton's.
    const __m256 guess = _mm256_rsqrt_ps(square);
    const __m256 half = _mm256_mul_ps(_mm256_mul_ps(_mm256_set1_ps(0.5f), square), guess);
    const __m256 scale = _mm256_mul_ps(guess, _mm256_fnmadd_ps(half, guess, _mm256_set1_ps(1.5f)));
    r[3] = _mm256_mul_ps(nx, scale);
    r[4] = _mm256_mul_ps(ny, scale);
    r[5] = _mm256_mul_ps(nz, scale);
}

/// Four rows of eight floats become the four floats of eight patches, two patches a register.
inline void transpose4(__m256 (&r)[4]) {
    const __m256 a0 = _mm256_unpacklo_ps(r[0], r[1]), a1 = _mm256_unpackhi_ps(r[0], r[1]);
    const __m256 a2 = _mm256_unpacklo_ps(r[2], r[3]), a3 = _mm256_unpackhi_ps(r[2], r[3]);
    r[0] = _mm256_shuffle_ps(a0, a2, 0x44); // patches 0 and 4
    r[1] = _mm256_shuffle_ps(a0, a2, 0xEE); // 1 and 5
    r[2] = _mm256_shuffle_ps(a1, a3, 0x44); // 2 and 6
    r[3] = _mm256_shuffle_ps(a1, a3, 0xEE); // 3 and 7
}

/// Two neighboring samples, 48 bytes a patch.
inline void storePair(float* out, size_t stride, uint32_t count, const __m256 (&first)[6], const __m256 (&second)[6]) {
    __m256 head[8] = {first[0], first[1], first[2], first[3], first[4], first[5], second[0], second[1]};
    __m256 tail[4] = {second[2], second[3], second[4], second[5]};
    transpose(head);
    transpose4(tail);
    for (uint32_t lane = 0; lane < count; ++lane) {
        float* const sample = out + lane * stride;
        _mm256_storeu_ps(sample, head[lane]);
        const __m256 pair = tail[lane % 4];
        _mm_storeu_ps(sample + 8, lane < 4 ? _mm256_castps256_ps128(pair) : _mm256_extractf128_ps(pair, 1));
    }
}

inline void storeOne(float* out, size_t stride, uint32_t count, const __m256 (&values)[6]) {
    const __m256 zero = _mm256_setzero_ps();
    __m256 r[8] = {values[0], values[1], values[2], values[3], values[4], values[5], zero, zero};
    transpose(r);
    for (uint32_t lane = 0; lane < count; ++lane) {
        float* const sample = out + lane * stride;
        _mm_storeu_ps(sample, _mm256_castps256_ps128(r[lane]));
        _mm_storel_pi(reinterpret_cast<__m64*>(sample + 4), _mm256_extractf128_ps(r[lane], 1));
    }
}

/// Eight patches; `count` of them are stored, the others are repeats of the last. Inlined, so that the common count of
/// eight is a constant.
__attribute__((always_inline)) inline void evaluateEight(const float* const (&g)[kLanes], uint32_t count, uint32_t rate,
                                                         const BicubicWeights& weights, float* samples) {
    const uint32_t side = rate + 1;
    const size_t patchFloats = size_t{6} * side * side;
    __m256 coefficient[16][3];
    for (int pair = 0; pair < 8; ++pair) {
        __m256 r[8];
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            r[lane] = _mm256_loadu_ps(g[lane] + 8 * pair);
        }
        transpose(r);
        for (int axis = 0; axis < 3; ++axis) {
            coefficient[2 * pair][axis] = r[axis];
            coefficient[2 * pair + 1][axis] = r[axis + 4];
        }
    }
    float* out = samples;
    for (uint32_t j = 0; j < side; ++j) {
        __m256 b[4], d[4];
        load(b, weights.b, j);
        load(d, weights.d, j);
        Row row;
        for (int i = 0; i < 4; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const __m256 g0 = coefficient[i][axis], g1 = coefficient[4 + i][axis];
                const __m256 g2 = coefficient[8 + i][axis], g3 = coefficient[12 + i][axis];
                row.c[i][axis] = sum4(b, g0, g1, g2, g3);
                row.cv[i][axis] = sum4(d, g0, g1, g2, g3);
            }
        }
        __m256 first[6], second[6];
        uint32_t i = 0;
        for (; i + 1 < side; i += 2, out += 12) {
            evaluate(row, weights, i, first);
            evaluate(row, weights, i + 1, second);
            storePair(out, patchFloats, count, first, second);
        }
        if (i < side) {
            evaluate(row, weights, i, first);
            storeOne(out, patchFloats, count, first);
            out += 6;
        }
    }
}

} // namespace

bool hasAvx2Evaluation() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

void evaluateAvx2(const float* coefficients, size_t patches, uint32_t rate, const BicubicWeights& weights,
                  float* samples) {
    if (!hasAvx2Evaluation()) {
        return;
    }
    const size_t patchFloats = size_t{6} * (rate + 1) * (rate + 1);
    for (size_t first = 0; first < patches; first += kLanes) {
        const uint32_t count = patches - first < kLanes ? static_cast<uint32_t>(patches - first) : kLanes;
        const float* lanes[kLanes];
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            lanes[lane] = coefficients + 64 * (first + (lane < count ? lane : count - 1));
        }
        float* const out = samples + first * patchFloats;
        if (count == kLanes) {
            evaluateEight(lanes, kLanes, rate, weights, out);
        } else {
            evaluateEight(lanes, count, rate, weights, out);
        }
    }
}

#else

bool hasAvx2Evaluation() {
    return false;
}

void evaluateAvx2(const float*, size_t, uint32_t, const BicubicWeights&, float*) {}

#endif

} // namespace supple::bench
