// Equation numbers are those of "GPU Conversion of Quad Meshes to Smooth Surfaces"; docs/prep.md says where we depart
// from the print. Arithmetic here must round as written (no contraction, no reassociation): the bits of shared borders
// depend on it.
#include "tools/reference/prep.h"

#include <cassert>
#include <map>
#include <utility>

namespace supple::surface::prep {
namespace {

using cage::Cage;
using cage::kNone;
using cage::Topology;

template <class T>
using Vec3 = glm::vec<3, T>;

template <class T>
Vec3<T> unitOrZero(const Vec3<T>& v) {
    const T length = glm::length(v);
    return length > T(0) ? v / length : Vec3<T>(T(0));
}

/// A pair (t, 1 - t) and its Bernstein weights. Every weight's mirror image is the same expression with s and t
/// exchanged, so that the reversed pair gives the reversed weights bit for bit.
template <class T>
struct Weights {
    explicit Weights(glm::vec<2, T> pair) {
        const T s = pair.x;
        const T t = pair.y;
        const T ss = s * s;
        const T tt = t * t;
        const T ts = t * s;
        const T sss = ss * s;
        const T ttt = tt * t;
        cubic = {ttt, T(3) * (tt * s), T(3) * (ss * t), sss};
        cubicSlope = {T(-3) * tt, T(3) * tt - T(6) * ts, T(6) * ts - T(3) * ss, T(3) * ss};
        quintic0 = tt * ttt;
        quintic1 = T(5) * (s * (tt * tt));
        quintic2 = T(10) * (ss * ttt);
        quintic3 = T(10) * (sss * tt);
        quinticSlope0 = T(-5) * (tt * tt);
        quinticSlope1 = T(5) * (ttt * (t - T(4) * s));
        quinticSlope2 = T(10) * ((s * tt) * (T(2) * t - T(3) * s));
        quinticSlope3 = T(10) * ((ss * t) * (T(3) * t - T(2) * s));
    }
    std::array<T, 4> cubic, cubicSlope;
    T quintic0, quintic1, quintic2, quintic3;
    T quinticSlope0, quinticSlope1, quinticSlope2, quinticSlope3;
};

/// Outer pair first: reversing weights and points reverses nothing but the order of each commutative sum.
template <class T>
Vec3<T> sum4(const std::array<T, 4>& w, const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c, const Vec3<T>& d) {
    return (w[0] * a + w[3] * d) + (w[1] * b + w[2] * c);
}

} // namespace

template <class T>
Coefficients<T> construct(const Cage& cage, const Topology& topology, std::span<const Vec3<T>> positions,
                          const Options& options) {
    return constructPoints<Vec3<T>>(cage, topology, positions, options);
}

template <class T>
Patch<T> gatherPatch(const Cage& cage, const Topology& topology, const Coefficients<T>& c, uint32_t face,
                     const Options& options) {
    return gatherPoints<Vec3<T>>(cage, topology, c, face, options);
}

template <class T>
Sample<T> evaluate(const Patch<T>& patch, glm::vec<2, T> u, glm::vec<2, T> v) {
    using Vec = Vec3<T>;
    const Weights<T> wu(u);
    const Weights<T> wv(v);
    const auto& g = patch.g;
    // Row collapse: along v for each column, then along u. At an end the weights are exactly 0 and 1, so the tensor sum
    // becomes the border's own sum exactly.
    // The derivatives come from the coefficients' differences from one of them: their weights sum to zero, so nothing
    // changes but the rounding, which would otherwise be that of the coefficients' own size.
    Vec column[4];
    Vec relativeColumn[4];
    Vec columnSlope[4];
    for (size_t i = 0; i < 4; ++i) {
        const Vec r[4] = {g[i] - g[0], g[i + 4] - g[0], g[i + 8] - g[0], g[i + 12] - g[0]};
        column[i] = sum4(wv.cubic, g[i], g[i + 4], g[i + 8], g[i + 12]);
        relativeColumn[i] = sum4(wv.cubic, r[0], r[1], r[2], r[3]);
        columnSlope[i] = sum4(wv.cubicSlope, r[0], r[1], r[2], r[3]);
    }
    Sample<T> sample;
    sample.position = sum4(wu.cubic, column[0], column[1], column[2], column[3]);
    sample.du = sum4(wu.cubicSlope, relativeColumn[0], relativeColumn[1], relativeColumn[2], relativeColumn[3]);
    sample.dv = sum4(wu.cubic, columnSlope[0], columnSlope[1], columnSlope[2], columnSlope[3]);

    Vec h(T(0)), hu(T(0)), hv(T(0));
    if (patch.perturbed) {
        const Weights<T> mu({u.y, u.x}); // the pairs run backwards: edge e's own (a, b) of (u, v)
        const Weights<T> mv({v.y, v.x});
        const Weights<T>* const along[4] = {&wu, &wv, &mu, &mv};
        const Weights<T>* const inward[4] = {&wv, &mu, &mv, &wu};
        for (size_t e = 0; e < 4; ++e) {
            const Weights<T>& a = *along[e];
            const Weights<T>& b = *inward[e];
            const Vec* const he = &patch.h[4 * e]; // h20, h30, h21, h31
            const Vec outer = a.quintic2 * he[0] + a.quintic3 * he[1];
            const Vec inner = a.quintic2 * he[2] + a.quintic3 * he[3];
            const Vec outerSlope = a.quinticSlope2 * he[0] + a.quinticSlope3 * he[1];
            const Vec innerSlope = a.quinticSlope2 * he[2] + a.quinticSlope3 * he[3];
            const Vec ha = b.quintic0 * outerSlope + b.quintic1 * innerSlope;
            const Vec hb = b.quinticSlope0 * outer + b.quinticSlope1 * inner;
            h += b.quintic0 * outer + b.quintic1 * inner;
            // d(a, b)/d(u, v) of edge e's frame.
            hu += e == 0 ? ha : e == 1 ? -hb : e == 2 ? -ha : hb;
            hv += e == 0 ? hb : e == 1 ? ha : e == 2 ? -hb : -ha;
        }
    }
    // The perturbation's total comes last; it is added even where it is zero, which turns a -0 of the first sum into
    // the +0 that a perturbed neighbor gets.
    sample.position += h;
    sample.du += hu;
    sample.dv += hv;
    sample.normal = unitOrZero(glm::cross(sample.du, sample.dv));
    const glm::vec<2, T> corners[4] = {{T(0), T(0)}, {T(1), T(0)}, {T(1), T(1)}, {T(0), T(1)}};
    for (size_t j = 0; j < 4; ++j) {
        if (patch.useCornerNormal[j] && u.x == corners[j].x && v.x == corners[j].y) {
            sample.normal = patch.cornerNormals[j];
        }
    }
    return sample;
}

SurfaceJet evaluateJet(const Patch<double>& patch, double u, double v) {
    const Jet s[2] = {Jet::first(u), Jet::second(v)}, t[2] = {1.0 - s[0], 1.0 - s[1]};
    const auto cubics = [](const Jet& a, const Jet& b) {
        return std::array<Jet, 4>{b * b * b, 3.0 * (b * b * a), 3.0 * (b * a * a), a * a * a};
    };
    const std::array<Jet, 4> along = cubics(s[0], t[0]), across = cubics(s[1], t[1]);
    SurfaceJet sum;
    for (size_t j = 0; j < 4; ++j) {
        for (size_t i = 0; i < 4; ++i) {
            sum.add(patch.g[i + 4 * j] - patch.g[0], along[i] * across[j]);
        }
    }
    const Jet* const a[4] = {&s[0], &s[1], &t[0], &t[1]}; // along each edge, and inwards from it
    const Jet* const b[4] = {&s[1], &t[0], &t[1], &s[0]};
    for (size_t e = 0; e < 4 && patch.perturbed; ++e) {
        const Jet& x = *a[e];
        const Jet& y = *b[e];
        const Jet xx = x * x, rest = 1.0 - x, restY = 1.0 - y;
        const Jet quintic2 = 10.0 * (xx * (rest * rest * rest)), quintic3 = 10.0 * (xx * x * (rest * rest));
        const Jet fourth = (restY * restY) * (restY * restY);
        const Jet outer = restY * fourth, inner = 5.0 * (y * fourth);
        const glm::dvec3* const h = &patch.h[4 * e]; // h20, h30, h21, h31
        sum.add(h[0], quintic2 * outer);
        sum.add(h[1], quintic3 * outer);
        sum.add(h[2], quintic2 * inner);
        sum.add(h[3], quintic3 * inner);
    }
    sum.position += patch.g[0];
    return sum;
}

template Coefficients<float> construct<float>(const Cage&, const Topology&, std::span<const glm::vec3>, const Options&);
template Coefficients<double> construct<double>(const Cage&, const Topology&, std::span<const glm::dvec3>,
                                                const Options&);
template Patch<float> gatherPatch<float>(const Cage&, const Topology&, const Coefficients<float>&, uint32_t,
                                         const Options&);
template Patch<double> gatherPatch<double>(const Cage&, const Topology&, const Coefficients<double>&, uint32_t,
                                           const Options&);
template Sample<float> evaluate<float>(const Patch<float>&, glm::vec2, glm::vec2);
template Sample<double> evaluate<double>(const Patch<double>&, glm::dvec2, glm::dvec2);

} // namespace supple::surface::prep
