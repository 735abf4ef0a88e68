// The bodies of the kernels of cpu/lanes.h. Each file that is compiled for a set of instructions includes this once, in
// an anonymous namespace of its own, behind <math.h>.

#if defined(__GNUC__)
/// Eight lanes as one value: two of SSE, one of AVX.
typedef float Eight __attribute__((vector_size(4 * kLanes), may_alias));
#else
struct alignas(32) Eight {
    float at[kLanes];
};
template <class Operation>
inline Eight laneByLane(const Eight& a, const Eight& b, Operation operation) {
    Eight out;
    for (unsigned l = 0; l < kLanes; ++l) {
        out.at[l] = operation(a.at[l], b.at[l]);
    }
    return out;
}
inline Eight operator+(const Eight& a, const Eight& b) {
    return laneByLane(a, b, [](float x, float y) { return x + y; });
}
inline Eight operator-(const Eight& a, const Eight& b) {
    return laneByLane(a, b, [](float x, float y) { return x - y; });
}
inline Eight operator*(const Eight& a, const Eight& b) {
    return laneByLane(a, b, [](float x, float y) { return x * y; });
}
#endif

inline const Eight& eight(const float (&lanes)[kLanes]) {
    return *reinterpret_cast<const Eight*>(lanes);
}
inline Eight& eight(float (&lanes)[kLanes]) {
    return *reinterpret_cast<Eight*>(lanes);
}

/// A sum of N terms that reads the same backwards: the outer pair first. `stride` between the points that are summed,
/// of a net or of a row.
template <unsigned N>
inline void sum3(Lanes3& out, const float (&weights)[N][kLanes], const Lanes3* first, unsigned stride) {
    for (unsigned axis = 0; axis < 3; ++axis) {
        const auto pair = [&](unsigned k) {
            return eight(weights[k]) * eight(first[k * stride].at[axis]) +
                   eight(weights[N - 1 - k]) * eight(first[(N - 1 - k) * stride].at[axis]);
        };
        Eight sum = pair(0) + pair(1);
        if constexpr (N == 6) {
            sum = sum + pair(2);
        }
        eight(out.at[axis]) = sum;
    }
}

template <unsigned N>
void evaluateTensors(const TensorLanes<N>& patches, const WeightLanes<N>& u, const WeightLanes<N>& v, JetLanes& out) {
    Lanes3 value[N], slope[N], bend[N]; // of columns, by v
    for (unsigned i = 0; i < N; ++i) {
        sum3<N>(value[i], v.value, &patches.net[i], N);
        sum3<N>(slope[i], v.slope, &patches.net[i], N);
        sum3<N>(bend[i], v.bend, &patches.net[i], N);
    }
    sum3<N>(out.position, u.value, value, 1);
    sum3<N>(out.du, u.slope, value, 1);
    sum3<N>(out.dv, u.value, slope, 1);
    sum3<N>(out.duu, u.bend, value, 1);
    sum3<N>(out.duv, u.slope, slope, 1);
    sum3<N>(out.dvv, u.value, bend, 1);
}

template <unsigned N>
void collapseRows(const TensorLanes<N>& patches, const WeightLanes<N>& v, RowLanes<N>& out) {
    for (unsigned i = 0; i < N; ++i) {
        sum3<N>(out.value[i], v.value, &patches.net[i], N);
        sum3<N>(out.slope[i], v.slope, &patches.net[i], N);
    }
}

/// As unitNormal() of cpu/normals.h. Whether all of them exist.
inline bool unitNormals(const Lanes3& u, const Lanes3& v, Lanes3& out) {
    const auto& x = u.at;
    const auto& y = v.at;
    const auto part = [&](unsigned a, unsigned b) { return eight(x[a]) * eight(y[b]) - eight(x[b]) * eight(y[a]); };
    const auto square = [](const auto& p) {
        return (eight(p[0]) * eight(p[0]) + eight(p[1]) * eight(p[1])) + eight(p[2]) * eight(p[2]);
    };
    Lanes3 normal;
    eight(normal.at[0]) = part(1, 2);
    eight(normal.at[1]) = part(2, 0);
    eight(normal.at[2]) = part(0, 1);
    alignas(32) float length[kLanes], lengths[kLanes], scale[kLanes];
    eight(length) = square(normal.at);
    eight(lengths) = square(x) * square(y);
    float least = 1.0f;
    for (unsigned l = 0; l < kLanes; ++l) {
        constexpr float kSine = 1e-5f;
        const bool exists = length[l] > kSine * kSine * lengths[l];
        scale[l] = exists ? 1.0f / sqrtf(exists ? length[l] : 1.0f) : 0.0f;
        least = scale[l] < least ? scale[l] : least;
    }
    for (unsigned axis = 0; axis < 3; ++axis) {
        eight(out.at[axis]) = eight(normal.at[axis]) * eight(scale);
    }
    return least > 0.0f;
}

template <unsigned N>
void verticesOfRows(const RowLanes<N>& rows, const WeightLanes<N>& u, VertexLanes& out) {
    Lanes3 du, dv;
    sum3<N>(out.position, u.value, rows.value, 1);
    sum3<N>(du, u.slope, rows.value, 1);
    sum3<N>(dv, u.value, rows.slope, 1);
    out.lacksNormals = !unitNormals(du, dv, out.normal);
}

/// De Casteljau: the coefficients of the next lower degree.
template <unsigned Degree>
inline void lowerDegree(Lanes3* net, const Lanes3& weights) {
    unsigned from = 0, to = 0;
    for (unsigned length = Degree; length > 0; --length) { // of the row to come, one less than the row's own
        for (unsigned k = 0; k < length; ++k, ++to) {
            const Lanes3 &a = net[from + k], &b = net[from + k + 1], &c = net[from + length + 1 + k];
            for (unsigned axis = 0; axis < 3; ++axis) {
                eight(net[to].at[axis]) =
                    (eight(weights.at[0]) * eight(a.at[axis]) + eight(weights.at[1]) * eight(b.at[axis])) +
                    eight(weights.at[2]) * eight(c.at[axis]);
            }
        }
        from += length + 1;
    }
}

/// factors * ((a - b) - (c - d))
inline void secondDifference(Lanes3& out, const float (&factors)[kLanes], const Lanes3& a, const Lanes3& b,
                             const Lanes3& c, const Lanes3& d) {
    for (unsigned axis = 0; axis < 3; ++axis) {
        const Eight own = (eight(a.at[axis]) - eight(b.at[axis])) - (eight(c.at[axis]) - eight(d.at[axis]));
        eight(out.at[axis]) = eight(factors) * own;
    }
}

/// factors * (a - b)
inline void difference(Lanes3& out, const float (&factors)[kLanes], const Lanes3& a, const Lanes3& b) {
    for (unsigned axis = 0; axis < 3; ++axis) {
        eight(out.at[axis]) = eight(factors) * (eight(a.at[axis]) - eight(b.at[axis]));
    }
}

inline void evaluateQuartics(const QuarticLanes& triangles, JetLanes& out) {
    Lanes3 net[15];
    for (unsigned k = 0; k < 15; ++k) {
        net[k] = triangles.net[k];
    }
    alignas(32) constexpr float kTwelve[kLanes] = {12.0f, 12.0f, 12.0f, 12.0f, 12.0f, 12.0f, 12.0f, 12.0f};
    alignas(32) constexpr float kFour[kLanes] = {4.0f, 4.0f, 4.0f, 4.0f, 4.0f, 4.0f, 4.0f, 4.0f};
    // Second derivatives are differences of the six coefficients of degree 2.
    lowerDegree<4>(net, triangles.weights);
    lowerDegree<3>(net, triangles.weights);
    secondDifference(out.duu, kTwelve, net[2], net[1], net[1], net[0]);
    secondDifference(out.duv, kTwelve, net[4], net[3], net[1], net[0]);
    secondDifference(out.dvv, kTwelve, net[5], net[3], net[3], net[0]);
    lowerDegree<2>(net, triangles.weights);
    difference(out.du, kFour, net[1], net[0]);
    difference(out.dv, kFour, net[2], net[0]);
    lowerDegree<1>(net, triangles.weights);
    out.position = net[0];
}

constexpr LaneKernels kKernels{{&evaluateTensors<4>, &collapseRows<4>, &verticesOfRows<4>},
                               {&evaluateTensors<6>, &collapseRows<6>, &verticesOfRows<6>},
                               &evaluateQuartics};
