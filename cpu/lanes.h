// Polynomials at eight places at a time, a place a lane. The compiler makes SIMD of the loops over lanes; no lane looks
// at another, so a place has the same bits in every lane, and in every set of instructions: none contracts products and
// sums. Plain arrays alone: what is compiled for one set of instructions may share no inline function with the rest.
#pragma once

namespace supple::cpu {

inline constexpr unsigned kLanes = 8;

/// x, y, z
struct alignas(32) Lanes3 {
    float at[3][kLanes];
};

/// Position and derivatives.
struct JetLanes {
    Lanes3 position, du, dv, duu, duv, dvv;
};

/// N polynomials, and their first and second derivatives.
template <unsigned N>
struct alignas(32) WeightLanes {
    float value[N][kLanes], slope[N][kLanes], bend[N][kLanes];
};

/// Patches of N x N coefficients, u fastest.
template <unsigned N>
struct TensorLanes {
    Lanes3 net[N * N];
};

/// The curves v = const of patches: what all their places have in common.
template <unsigned N>
struct RowLanes {
    Lanes3 value[N], slope[N]; ///< slope: by v
};

/// What a place of a grid gets.
struct VertexLanes {
    Lanes3 position, normal; ///< of unit length, or zero where du and dv are parallel
    bool lacksNormals;       ///< one of them is zero
};

/// Triangles of degree 4, row by row from the side between corners 0 and 1 to corner 2: 5, 4, 3, 2, 1 coefficients.
struct QuarticLanes {
    Lanes3 net[15];
    Lanes3 weights; ///< of the corners
};

/// N x N patches: 4 bicubic, 6 of degree 5.
template <unsigned N>
struct TensorKernels {
    void (*evaluate)(const TensorLanes<N>& patches, const WeightLanes<N>& u, const WeightLanes<N>& v, JetLanes& out);
    void (*collapse)(const TensorLanes<N>& patches, const WeightLanes<N>& v, RowLanes<N>& out);
    void (*vertices)(const RowLanes<N>& rows, const WeightLanes<N>& u, VertexLanes& out);
};

/// The kernels, compiled for a set of instructions.
struct LaneKernels {
    TensorKernels<4> cubic;
    TensorKernels<6> quintic;
    /// Derivatives are those by the weights of corners 1 and 2.
    void (*quartics)(const QuarticLanes& triangles, JetLanes& out);

    template <unsigned N>
    [[nodiscard]] const TensorKernels<N>& tensors() const {
        if constexpr (N == 4) {
            return cubic;
        } else {
            return quintic;
        }
    }
};

/// The fastest that this CPU has.
[[nodiscard]] const LaneKernels& laneKernels();
/// Those for what every CPU of the kind has.
[[nodiscard]] const LaneKernels& plainLaneKernels();
/// Those for AVX2, or null where they were not compiled.
[[nodiscard]] const LaneKernels* avx2LaneKernels();

/// Bernstein polynomials in one lane, at t; back = 1 - t. Reversed pairs give reversed values, bit for bit.
void setBernstein(WeightLanes<4>& weights, unsigned lane, float t, float back);
void setBernstein(WeightLanes<6>& weights, unsigned lane, float t, float back);

} // namespace supple::cpu
