// Equation numbers are those of "Fast Parallel Construction of Smooth Surfaces from Meshes with Tri/Quad/Pent Facets";
// docs/pm.md says where we depart from the print. Written from the formulas, without the weights of the GPU's tables,
// so that it checks them. Arithmetic must round as written: the bits of shared borders depend on it.
#include "tools/reference/pm.h"

#include "cpu/grid_sample.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace supple::surface::pm {
namespace {

using cage::kNone;

template <class T>
using Vec3 = glm::vec<3, T>;

template <class T>
Vec3<T> unitOrZero(const Vec3<T>& v) {
    const T length = glm::length(v);
    return length > T(0) ? v / length : Vec3<T>(T(0));
}

/// Cubic Bernstein weights of a pair (t, 1 - t); the pair exchanged gives them in reverse, bit for bit.
template <class T>
std::array<T, 4> cubic(glm::vec<2, T> t) {
    return {(t.y * t.y) * t.y, T(3) * ((t.y * t.y) * t.x), T(3) * ((t.x * t.x) * t.y), (t.x * t.x) * t.x};
}

template <class T>
std::array<T, 3> quadratic(glm::vec<2, T> t) {
    return {t.y * t.y, T(2) * (t.x * t.y), t.x * t.x};
}

/// Reads the same backwards.
template <class T>
Vec3<T> sum4(const std::array<T, 4>& w, const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c, const Vec3<T>& d) {
    return (w[0] * a + w[3] * d) + (w[1] * b + w[2] * c);
}

template <class T>
Vec3<T> sum3(const std::array<T, 3>& w, const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) {
    return (w[0] * a + w[2] * c) + w[1] * b;
}

template <class T>
Sample<T> evaluateTensor(const Patch<T>& patch, const DomainPoint<T>& at) {
    const bool polar = patch.patchClass == PatchClass::polar;
    const auto g = [&](size_t i, size_t j) { return patch.c[polar && j == 3 ? 12 : i + 4 * j]; };
    const std::array<T, 4> bu = cubic(at.u);
    const std::array<T, 4> bv = cubic(at.v);
    const auto row = [&](size_t j) { return sum4(bu, g(0, j), g(1, j), g(2, j), g(3, j)); };
    const auto column = [&](size_t i) { return sum4(bv, g(i, 0), g(i, 1), g(i, 2), g(i, 3)); };

    Sample<T> sample;
    if (at.u.x == T(0) || (polar && at.v.x == T(1))) {
        sample.position = column(0);
    } else if (at.u.x == T(1)) {
        sample.position = column(3);
    } else if (at.v.x == T(0)) {
        sample.position = row(0);
    } else if (at.v.x == T(1)) {
        sample.position = row(3);
    } else {
        sample.position = sum4(bu, column(0), column(1), column(2), column(3));
    }

    const std::array<T, 3> qu = quadratic(at.u);
    const std::array<T, 3> qv = quadratic(at.v);
    const auto rowSlope = [&](size_t j) { return sum3(qu, g(1, j) - g(0, j), g(2, j) - g(1, j), g(3, j) - g(2, j)); };
    const auto columnSlope = [&](size_t i) {
        return sum3(qv, g(i, 1) - g(i, 0), g(i, 2) - g(i, 1), g(i, 3) - g(i, 2));
    };
    // A polar patch's rows all carry the factor 1 - v, which says nothing about the direction: without it the apex is a
    // point like others.
    const Vec3<T> du =
        polar ? sum3({qv[0], T(3) * (at.v.x * at.v.y), T(3) * qv[2]}, rowSlope(0), rowSlope(1), rowSlope(2))
              : sum4(bv, rowSlope(0), rowSlope(1), rowSlope(2), rowSlope(3));
    const Vec3<T> dv = sum4(bu, columnSlope(0), columnSlope(1), columnSlope(2), columnSlope(3));
    sample.normal = unitOrZero(glm::cross(du, dv));
    return sample;
}

/// A sector's quartic by de Casteljau, relative to its first corner.
template <class T>
struct SectorPoint {
    Vec3<T> position, d1, d2;
};

template <class T>
SectorPoint<T> evaluateSector(const Patch<T>& patch, uint32_t i, const Vec3<T>& weights) {
    const SectorView<Vec3<T>> s(patch.c, patch.sides, patch.c[1 + 6 * i]);
    std::array<Vec3<T>, 15> b = quarticOf(s, i);
    for (size_t degree = 4; degree > 1; --degree) {
        size_t from = 0;
        size_t to = 0;
        for (size_t length = degree; length > 0; --length) { // of the row to come, one less than the row's own
            for (size_t k = 0; k < length; ++k) {
                b[to++] = weights.x * b[from + k] + weights.y * b[from + k + 1] + weights.z * b[from + length + 1 + k];
            }
            from += length + 1;
        }
    }
    return {weights.x * b[0] + weights.y * b[1] + weights.z * b[2], T(4) * (b[1] - b[0]), T(4) * (b[2] - b[0])};
}

template <class T>
Sample<T> evaluatePm(const Patch<T>& patch, const DomainPoint<T>& at) {
    const uint32_t i = at.sector;
    const uint32_t next = (i + 1) % patch.sides;
    const SectorPoint<T> point = evaluateSector(patch, i, at.weights);
    Sample<T> sample;
    if (at.weights.z == T(0)) {
        const Vec3<T>* const b = &patch.c[1 + 6 * i];
        sample.position =
            sum4(cubic<T>({at.weights.y, at.weights.x}), b[k300], b[k210], b[k120], patch.c[1 + 6 * next]);
    } else {
        sample.position = patch.c[1 + 6 * i] + point.position;
    }
    sample.normal = unitOrZero(glm::cross(point.d1, point.d2));
    if ((at.weights.x == T(1) && patch.singularCorner[i]) || (at.weights.y == T(1) && patch.singularCorner[next])) {
        const Vec3<T> inside = at.weights + T(kNormalStep) * (Vec3<T>(T(1.0 / 3.0)) - at.weights);
        const SectorPoint<T> near = evaluateSector(patch, i, inside);
        sample.normal = unitOrZero(glm::cross(near.d1, near.d2));
    }
    return sample;
}

} // namespace

template <class T>
Coefficients<T> construct(const Mesh& mesh, std::span<const Vec3<T>> positions) {
    return constructPoints<Vec3<T>>(mesh, positions);
}

template <class T>
Patch<T> gatherPatch(const Mesh& mesh, const Coefficients<T>& c, uint32_t facet) {
    return gatherPoints<Vec3<T>>(mesh, c, facet);
}

template <class T>
DomainPoint<T> domainPoint(PatchClass patchClass, uint32_t rate, uint32_t sample) {
    const GridSample at = gridSample(domainOf(patchClass), rate, sample);
    const uint32_t i = at.i;
    const uint32_t j = at.j;
    const auto fraction = [rate](uint32_t count) { return T(count) / T(rate); };
    const auto pair = [&](uint32_t count) { return glm::vec<2, T>(fraction(count), fraction(rate - count)); };
    const auto inSector = [&](uint32_t sector, uint32_t first, uint32_t second, uint32_t center) {
        return DomainPoint<T>{{}, {}, sector, {fraction(first), fraction(second), fraction(center)}};
    };
    switch (patchClass) {
    case PatchClass::regular:
    case PatchClass::polar:
        return {pair(i), pair(j), 0, {}};
    case PatchClass::p3: {
        const uint32_t count[3] = {rate - i - j, i, j};
        uint32_t least = 0;
        for (uint32_t r = 1; r < 3; ++r) {
            least = count[r] < count[least] ? r : least;
        }
        const uint32_t first = (least + 1) % 3;
        const uint32_t second = (least + 2) % 3;
        return inSector(first, count[first] - count[least], count[second] - count[least], 3 * count[least]);
    }
    case PatchClass::p4:
        if (j <= i && i + j <= rate) {
            return inSector(0, rate - i - j, i - j, 2 * j);
        }
        if (j <= i) {
            return inSector(1, i - j, i + j - rate, 2 * (rate - i));
        }
        if (i + j >= rate) {
            return inSector(2, i + j - rate, j - i, 2 * (rate - j));
        }
        return inSector(3, j - i, rate - i - j, 2 * i);
    default:
        return inSector(at.sector, rate - i - j, i, j);
    }
}

template <class T>
Sample<T> evaluate(const Patch<T>& patch, const DomainPoint<T>& at) {
    const bool tensor = patch.patchClass == PatchClass::regular || patch.patchClass == PatchClass::polar;
    return tensor ? evaluateTensor(patch, at) : evaluatePm(patch, at);
}

template <class T>
Derivatives<T> derivatives(const Patch<T>& patch, const DomainPoint<T>& at) {
    const SectorPoint<T> point = evaluateSector(patch, at.sector, at.weights);
    return {point.d1, point.d2};
}

SurfaceJet evaluateJet(const Patch<double>& patch, const DomainPoint<double>& at) {
    SurfaceJet sum;
    if (patch.patchClass == PatchClass::regular || patch.patchClass == PatchClass::polar) {
        const auto cubics = [](const Jet& s) {
            const Jet t = 1.0 - s;
            return std::array<Jet, 4>{t * t * t, 3.0 * (t * t * s), 3.0 * (t * s * s), s * s * s};
        };
        const std::array<Jet, 4> along = cubics(Jet::first(at.u.x)), across = cubics(Jet::second(at.v.x));
        for (size_t j = 0; j < 4; ++j) {
            for (size_t i = 0; i < 4; ++i) {
                const bool apex = patch.patchClass == PatchClass::polar && j == 3;
                sum.add(patch.c[apex ? 12 : i + 4 * j] - patch.c[0], along[i] * across[j]);
            }
        }
        sum.position += patch.c[0];
        return sum;
    }
    const glm::dvec3& origin = patch.c[1 + 6 * at.sector];
    const std::array<glm::dvec3, 15> b = quarticOf(SectorView<glm::dvec3>(patch.c, patch.sides, origin), at.sector);
    const std::array<Jet, 3> w = {(1.0 - Jet::first(at.weights.y)) - Jet::second(at.weights.z),
                                  Jet::first(at.weights.y), Jet::second(at.weights.z)};
    std::array<std::array<Jet, 5>, 3> powers;
    for (size_t k = 0; k < 3; ++k) {
        powers[k][0] = Jet::constant(1.0);
        for (size_t p = 1; p <= 4; ++p) {
            powers[k][p] = powers[k][p - 1] * w[k];
        }
    }
    constexpr double kFactorials[] = {1.0, 1.0, 2.0, 6.0, 24.0};
    size_t index = 0;
    for (size_t row = 0; row <= 4; ++row) {
        for (size_t k = 0; row + k <= 4; ++k) {
            const double count = 24.0 / (kFactorials[4 - row - k] * kFactorials[k] * kFactorials[row]);
            sum.add(b[index++], count * (powers[0][4 - row - k] * powers[1][k] * powers[2][row]));
        }
    }
    sum.position += origin;
    return sum;
}

template Coefficients<float> construct(const Mesh&, std::span<const glm::vec3>);
template Coefficients<double> construct(const Mesh&, std::span<const glm::dvec3>);
template Patch<float> gatherPatch(const Mesh&, const Coefficients<float>&, uint32_t);
template Patch<double> gatherPatch(const Mesh&, const Coefficients<double>&, uint32_t);
template DomainPoint<float> domainPoint(PatchClass, uint32_t, uint32_t);
template DomainPoint<double> domainPoint(PatchClass, uint32_t, uint32_t);
template Sample<float> evaluate(const Patch<float>&, const DomainPoint<float>&);
template Sample<double> evaluate(const Patch<double>&, const DomainPoint<double>&);
template Derivatives<float> derivatives(const Patch<float>&, const DomainPoint<float>&);
template Derivatives<double> derivatives(const Patch<double>&, const DomainPoint<double>&);

} // namespace supple::surface::pm
