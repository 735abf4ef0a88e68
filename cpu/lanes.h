// Polynomials at eight places at a time, a place a lane. The compiler makes SIMD of the loops over lanes; no lane looks
// at another, so a place has the same bits in every lane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace supple::cpu {

inline constexpr size_t kLanes = 8;
using Lanes = std::array<float, kLanes>;
using Lanes3 = std::array<Lanes, 3>; ///< x, y, z

/// Position and derivatives.
struct JetLanes {
    alignas(32) Lanes3 position{}, du{}, dv{}, duu{}, duv{}, dvv{};
};

/// Bernstein polynomials of degree N - 1, and their first and second derivatives.
template <size_t N>
struct BernsteinLanes {
    alignas(32) std::array<Lanes, N> value{}, slope{}, bend{};
};
/// In one lane, at t; back = 1 - t. Reversed pairs give reversed values, bit for bit.
void setBernstein(BernsteinLanes<4>& weights, size_t lane, float t, float back);
void setBernstein(BernsteinLanes<6>& weights, size_t lane, float t, float back);

/// Patches of N x N coefficients, u fastest.
template <size_t N>
struct TensorLanes {
    alignas(32) std::array<Lanes3, N * N> net{};
};
template <size_t N>
void evaluateTensors(const TensorLanes<N>& patches, const BernsteinLanes<N>& u, const BernsteinLanes<N>& v,
                     JetLanes& out);

/// The curves v = const of patches: what all their places have in common.
template <size_t N>
struct RowLanes {
    alignas(32) std::array<Lanes3, N> value{}, slope{}; ///< slope: by v
};
template <size_t N>
void collapseRows(const TensorLanes<N>& patches, const BernsteinLanes<N>& v, RowLanes<N>& out);
/// Position, du and dv of a row.
template <size_t N>
void evaluateRows(const RowLanes<N>& rows, const BernsteinLanes<N>& u, JetLanes& out);

/// Triangles of degree 4, row by row from the side between corners 0 and 1 to corner 2: 5, 4, 3, 2, 1 coefficients.
struct QuarticLanes {
    alignas(32) std::array<Lanes3, 15> net{};
    alignas(32) Lanes3 weights{}; ///< of the corners
};
/// Derivatives are those by the weights of corners 1 and 2.
void evaluateQuartics(const QuarticLanes& triangles, JetLanes& out);

} // namespace supple::cpu
