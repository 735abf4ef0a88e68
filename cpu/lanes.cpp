#include "cpu/lanes.h"

namespace supple::cpu {
namespace {

/// sum += weight * value
void add(Lanes& sum, const Lanes& weight, const Lanes& value) {
    for (size_t l = 0; l < kLanes; ++l) {
        sum[l] += weight[l] * value[l];
    }
}

/// A sum of N terms that reads the same backwards: the outer pair first.
template <size_t N>
void symmetricSum(Lanes& out, const std::array<Lanes, N>& weights, const std::array<const Lanes*, N>& values) {
    const auto pair = [&](Lanes& sum, size_t k) {
        const Lanes &w = weights[k], &a = *values[k], &z = weights[N - 1 - k], &b = *values[N - 1 - k];
        for (size_t l = 0; l < kLanes; ++l) {
            sum[l] = w[l] * a[l] + z[l] * b[l];
        }
    };
    pair(out, 0);
    for (size_t k = 1; k < N / 2; ++k) {
        Lanes inner;
        pair(inner, k);
        for (size_t l = 0; l < kLanes; ++l) {
            out[l] += inner[l];
        }
    }
}

/// `stride` between the points that are summed, of a net or of a row.
template <size_t N>
void sum3(Lanes3& out, const std::array<Lanes, N>& weights, const Lanes3* first, size_t stride) {
    for (size_t axis = 0; axis < 3; ++axis) {
        std::array<const Lanes*, N> values;
        for (size_t k = 0; k < N; ++k) {
            values[k] = &first[k * stride][axis];
        }
        symmetricSum<N>(out[axis], weights, values);
    }
}

/// weights.x * a + weights.y * b + weights.z * c
void blend(Lanes3& out, const Lanes3& weights, const Lanes3& a, const Lanes3& b, const Lanes3& c) {
    for (size_t axis = 0; axis < 3; ++axis) {
        Lanes sum{};
        add(sum, weights[0], a[axis]);
        add(sum, weights[1], b[axis]);
        add(sum, weights[2], c[axis]);
        out[axis] = sum;
    }
}

/// factor * (a - b)
void difference(Lanes3& out, float factor, const Lanes3& a, const Lanes3& b) {
    for (size_t axis = 0; axis < 3; ++axis) {
        for (size_t l = 0; l < kLanes; ++l) {
            out[axis][l] = factor * (a[axis][l] - b[axis][l]);
        }
    }
}

/// factor * ((a - b) - (c - d))
void secondDifference(Lanes3& out, float factor, const Lanes3& a, const Lanes3& b, const Lanes3& c, const Lanes3& d) {
    for (size_t axis = 0; axis < 3; ++axis) {
        for (size_t l = 0; l < kLanes; ++l) {
            out[axis][l] = factor * ((a[axis][l] - b[axis][l]) - (c[axis][l] - d[axis][l]));
        }
    }
}

} // namespace

void setBernstein(BernsteinLanes<4>& weights, size_t lane, float t, float back) {
    const float tt = t * t, bb = back * back, tb = t * back;
    const std::array<float, 4> value{bb * back, 3.0f * (bb * t), 3.0f * (tt * back), tt * t};
    const std::array<float, 4> slope{-3.0f * bb, 3.0f * bb - 6.0f * tb, 6.0f * tb - 3.0f * tt, 3.0f * tt};
    const std::array<float, 4> bend{6.0f * back, 6.0f * (t - 2.0f * back), 6.0f * (back - 2.0f * t), 6.0f * t};
    for (size_t k = 0; k < 4; ++k) {
        weights.value[k][lane] = value[k];
        weights.slope[k][lane] = slope[k];
        weights.bend[k][lane] = bend[k];
    }
}

void setBernstein(BernsteinLanes<6>& weights, size_t lane, float t, float back) {
    const float tt = t * t, bb = back * back, ttt = tt * t, bbb = bb * back;
    const std::array<float, 6> value{bb * bbb,           5.0f * (t * (bb * bb)),    10.0f * (tt * bbb),
                                     10.0f * (ttt * bb), 5.0f * ((tt * tt) * back), tt * ttt};
    // Derivatives are differences of the polynomials of lower degree.
    const std::array<float, 7> quartic{0.0f,    bb * bb, 4.0f * (bbb * t), 6.0f * (bb * tt), 4.0f * (back * ttt),
                                       tt * tt, 0.0f};
    const std::array<float, 8> cubic{0.0f, 0.0f, bbb, 3.0f * (bb * t), 3.0f * (back * tt), ttt, 0.0f, 0.0f};
    for (size_t k = 0; k < 6; ++k) {
        weights.value[k][lane] = value[k];
        weights.slope[k][lane] = 5.0f * (quartic[k] - quartic[k + 1]);
        weights.bend[k][lane] = 20.0f * ((cubic[k] + cubic[k + 2]) - 2.0f * cubic[k + 1]);
    }
}

template <size_t N>
void evaluateTensors(const TensorLanes<N>& patches, const BernsteinLanes<N>& u, const BernsteinLanes<N>& v,
                     JetLanes& out) {
    std::array<Lanes3, N> value, slope, bend; // of columns, by v
    for (size_t i = 0; i < N; ++i) {
        sum3<N>(value[i], v.value, &patches.net[i], N);
        sum3<N>(slope[i], v.slope, &patches.net[i], N);
        sum3<N>(bend[i], v.bend, &patches.net[i], N);
    }
    sum3<N>(out.position, u.value, value.data(), 1);
    sum3<N>(out.du, u.slope, value.data(), 1);
    sum3<N>(out.dv, u.value, slope.data(), 1);
    sum3<N>(out.duu, u.bend, value.data(), 1);
    sum3<N>(out.duv, u.slope, slope.data(), 1);
    sum3<N>(out.dvv, u.value, bend.data(), 1);
}

template <size_t N>
void collapseRows(const TensorLanes<N>& patches, const BernsteinLanes<N>& v, RowLanes<N>& out) {
    for (size_t i = 0; i < N; ++i) {
        sum3<N>(out.value[i], v.value, &patches.net[i], N);
        sum3<N>(out.slope[i], v.slope, &patches.net[i], N);
    }
}

template <size_t N>
void evaluateRows(const RowLanes<N>& rows, const BernsteinLanes<N>& u, JetLanes& out) {
    sum3<N>(out.position, u.value, rows.value.data(), 1);
    sum3<N>(out.du, u.slope, rows.value.data(), 1);
    sum3<N>(out.dv, u.value, rows.slope.data(), 1);
}

template void evaluateTensors<4>(const TensorLanes<4>&, const BernsteinLanes<4>&, const BernsteinLanes<4>&, JetLanes&);
template void evaluateTensors<6>(const TensorLanes<6>&, const BernsteinLanes<6>&, const BernsteinLanes<6>&, JetLanes&);
template void collapseRows<4>(const TensorLanes<4>&, const BernsteinLanes<4>&, RowLanes<4>&);
template void collapseRows<6>(const TensorLanes<6>&, const BernsteinLanes<6>&, RowLanes<6>&);
template void evaluateRows<4>(const RowLanes<4>&, const BernsteinLanes<4>&, JetLanes&);
template void evaluateRows<6>(const RowLanes<6>&, const BernsteinLanes<6>&, JetLanes&);

void evaluateQuartics(const QuarticLanes& triangles, JetLanes& out) {
    std::array<Lanes3, 15> net = triangles.net;
    // De Casteljau: degree 4, 3, then the six coefficients of degree 2 that second derivatives are differences of.
    const auto lower = [&](size_t degree) {
        size_t from = 0, to = 0;
        for (size_t length = degree; length > 0; --length) { // of the row to come, one less than the row's own
            for (size_t k = 0; k < length; ++k) {
                blend(net[to++], triangles.weights, net[from + k], net[from + k + 1], net[from + length + 1 + k]);
            }
            from += length + 1;
        }
    };
    lower(4);
    lower(3);
    secondDifference(out.duu, 12.0f, net[2], net[1], net[1], net[0]);
    secondDifference(out.duv, 12.0f, net[4], net[3], net[1], net[0]);
    secondDifference(out.dvv, 12.0f, net[5], net[3], net[3], net[0]);
    lower(2);
    difference(out.du, 4.0f, net[1], net[0]);
    difference(out.dv, 4.0f, net[2], net[0]);
    lower(1);
    out.position = net[0];
}

} // namespace supple::cpu
