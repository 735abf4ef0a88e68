// Equation numbers are those of "Fast Parallel Construction of Smooth Surfaces from Meshes with Tri/Quad/Pent Facets";
// docs/pm.md says where we depart from the print. Written from the formulas, without the weights of the GPU's tables,
// so that it checks them. Arithmetic must round as written: the bits of shared borders depend on it.
#include "tools/reference/pm.h"

#include "tools/reference/grid.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace supple::surface::pm {
namespace {

using cage::kNone;

template <class T>
using Vec3 = glm::vec<3, T>;

/// cos(2 pi k / n) for k < n, exact at quarter turns: valence 4 must be a B-spline to the last bit.
double cosine(uint32_t k, uint32_t n) {
    if (4 * k == n || 4 * k == 3 * n) {
        return 0.0;
    }
    return k == 0 ? 1.0 : 2 * k == n ? -1.0 : std::cos(2.0 * std::numbers::pi * k / n);
}

double sine(uint32_t k, uint32_t n) {
    if (k == 0 || 2 * k == n) {
        return 0.0;
    }
    return 4 * k == n ? 1.0 : 4 * k == 3 * n ? -1.0 : std::sin(2.0 * std::numbers::pi * k / n);
}

/// Subdominant eigenvalue of Catmull-Clark subdivision, 1/2 for n = 4; in (15).
double lambda(uint32_t n) {
    const double c = cosine(1, n);
    return n == 4 ? 0.5 : (c + 5.0 + std::sqrt((c + 9.0) * (c + 1.0))) / 16.0;
}

template <class T>
Vec3<T> unitOrZero(const Vec3<T>& v) {
    const T length = glm::length(v);
    return length > T(0) ? v / length : Vec3<T>(T(0));
}

/// The vertex stage of one fan. All is relative to the vertex p: a character is large beside its facets, and
/// differences keep the rounding of a float at the size of the ring.
template <class T>
class FanStage {
public:
    FanStage(const Mesh& mesh, std::span<const Vec3<T>> positions, const Fan& fan)
        : mesh_(mesh), positions_(positions), fan_(fan), p_(positions[fan.vertex]) {
        const uint32_t facets = fan.facets;
        for (uint32_t j = 0; j < facets; ++j) {
            f_.push_back(faceCoefficient(j, j + 1 < fan.edges() ? j + 1 : 0));
        }
        e_.resize(facets); // of an open fan, e_0 is not used
        for (uint32_t j = fan.closed() ? 0 : 1; j < facets; ++j) {
            e_[j] = (f_[j] + f_[j > 0 ? j - 1 : facets - 1]) / T(2);
        }
        if (fan.closed()) {
            closedFrame();
        } else {
            openFrame();
        }
    }

    void store(uint32_t index, Coefficients<T>& out) const {
        const Vec3<T> moved = fan_.pinned ? v_ : Vec3<T>(T(0));
        out.limitPoints[index] = p_ + (v_ - moved);
        out.tau1[index] = tau1_;
        out.tau2[index] = tau2_;
        for (uint32_t j = 0; j < fan_.edges(); ++j) {
            const bool end = !fan_.closed() && (j == 0 || j == fan_.facets);
            // The ends belong to both sides of a hard edge: from the edge alone.
            out.tangents[fan_.firstSlot + j] = p_ + (end ? endTangent(j) : (v_ - moved) + turned(j)); // (16)
        }
        for (uint32_t j = 0; j < fan_.facets; ++j) {
            out.faceCoefficients[fan_.firstSlot + j] = p_ + (f_[j] - moved);
        }
    }

private:
    [[nodiscard]] uint32_t spokeSlot(uint32_t j) const { return mesh_.slotSpokes[fan_.firstSlot + j]; }

    [[nodiscard]] Vec3<T> spoke(uint32_t j) const {
        return positions_[mesh_.topology.spokeVertices[spokeSlot(j)]] - p_;
    }

    /// Of a sharp edge that ends the fan, relative to p.
    [[nodiscard]] Vec3<T> endTangent(uint32_t j) const {
        const FanEnd& end = fan_.ends[j == 0 ? 0 : 1];
        if (end.partner == kNone) {
            return T(end.own) * spoke(j);
        }
        const Vec3<T> other = positions_[mesh_.topology.spokeVertices[mesh_.slotSpokes[end.partner]]] - p_;
        return T(end.own) * spoke(j) - T(end.other) * other;
    }

    /// Q_j: the mean of the corners of facet j that are not the vertex or its neighbours; of a triangle, of these.
    [[nodiscard]] Vec3<T> farMean(uint32_t j) const {
        const uint32_t corner = mesh_.topology.sectorCorners[spokeSlot(j)];
        const uint32_t facet = mesh_.topology.cornerFaces[corner];
        const uint32_t first = mesh_.cage.faceStarts[facet];
        const uint32_t sides = mesh_.cage.sides(facet);
        const auto at = [&](uint32_t steps) {
            return positions_[mesh_.cage.faceVertices[first + (corner - first + steps) % sides]] - p_;
        };
        return sides == 3 ? (at(1) + at(2)) / T(2) : sides == 4 ? at(2) : (at(2) + at(3)) / T(2);
    }

    /// (14), which is (13) where both alphas are 2/3, and between two semi-sharp edges the rim.
    [[nodiscard]] Vec3<T> faceCoefficient(uint32_t j, uint32_t next) const {
        const T a = T(mesh_.slotAlphas[fan_.firstSlot + j]);
        const T b = T(mesh_.slotAlphas[fan_.firstSlot + next]);
        const Vec3<T> x = spoke(j);
        const Vec3<T> y = spoke(next);
        return ((T(1) - a) * b * x + a * (T(1) - b) * y) / T(2) + a * b * ((x + y) + farMean(j)) / T(4) +
               T(mesh_.slotRims[fan_.firstSlot + j]) * (x + y);
    }

    [[nodiscard]] Vec3<T> turned(uint32_t j) const {
        const FacetAngle angle = fan_.angle();
        return tau1_ * T(cosine(j * angle.part, angle.whole)) + tau2_ * T(sine(j * angle.part, angle.whole));
    }

    void closedFrame() {
        const uint32_t n = fan_.facets;
        for (const Vec3<T>& f : f_) {
            v_ += f;
        }
        v_ *= T(9.0 / (double(n) * (n + 5.0))); // (13)
        for (uint32_t j = 0; j < n; ++j) {      // (15)
            tau1_ += T(cosine(j, n)) * e_[j];
            tau2_ += T(sine(j, n)) * e_[j];
        }
        tau1_ *= T(1.0 / (n * lambda(n)));
        tau2_ *= T(1.0 / (n * lambda(n)));
    }

    void openFrame() {
        const Vec3<T> a = spoke(0);
        const Vec3<T> b = spoke(fan_.facets);
        if (fan_.kind == FanKind::corner) {
            // t_0 and t_q are given: tau2 is what makes t_q of (16).
            tau1_ = endTangent(0);
            tau2_ = (endTangent(fan_.facets) - tau1_ * T(cosine(fan_.width, 12))) / T(sine(fan_.width, 12));
            return;
        }
        v_ = (a + b) * T(1.0 / 6.0); // the same bits from both sides of a hard edge
        tau1_ = (a - b) * T(1.0 / 6.0);
        const uint32_t n = 2 * fan_.facets;
        for (uint32_t j = 1; j < fan_.facets; ++j) {
            tau2_ += T(sine(j, n)) * (e_[j] - v_);
        }
        tau2_ *= T(1.0 / (fan_.facets * lambda(n)));
        if (fan_.kind == FanKind::straight) {
            v_ = Vec3<T>(T(0));
            tau1_ = endTangent(0);
        }
    }

    const Mesh& mesh_;
    std::span<const Vec3<T>> positions_;
    const Fan& fan_;
    Vec3<T> p_;
    std::vector<Vec3<T>> f_, e_;
    Vec3<T> v_{T(0)}, tau1_{T(0)}, tau2_{T(0)};
};

/// A patch corner as the patch stage sees it.
template <class T>
struct CornerView {
    CornerView(const Mesh& mesh, const Coefficients<T>& c, uint32_t corner) {
        const FacetCorner& at = mesh.corners[corner];
        const Fan& fan = mesh.fans[at.fan];
        angle = fan.angle();
        v = c.limitPoints[at.fan];
        t0 = c.tangents[at.slot];
        t1 = c.tangents[at.slotBack];
        f = c.faceCoefficients[at.slot];
        a0 = T(mesh.slotAlphas[at.slot]);
        a1 = T(mesh.slotAlphas[at.slotBack]);
        const auto across = [&](uint32_t slot, const Vec3<T>& t, Vec3<T>& e, Vec3<T>& jump) {
            e = slot == kNone ? t : (f + c.faceCoefficients[slot]) / T(2);
            jump = slot == kNone ? T(2) * (f - t) : f - c.faceCoefficients[slot];
        };
        across(at.across, t0, e0, jump0);
        across(at.acrossBack, t1, e1, jump1);
    }
    FacetAngle angle;
    Vec3<T> v, f;
    // Towards the next and towards the previous corner:
    Vec3<T> t0, t1;
    Vec3<T> e0, e1;
    Vec3<T> jump0, jump1; ///< f - f_across
    T a0, a1;
};

template <class T>
void gatherOrdinary(const std::array<CornerView<T>, 4>& q, Patch<T>& patch) {
    patch.count = 16;
    patch.c = {q[0].v,  q[0].t0, q[1].t1, q[1].v,  //
               q[0].t1, q[0].f,  q[1].f,  q[1].t0, //
               q[3].t0, q[3].f,  q[2].f,  q[2].t1, //
               q[3].v,  q[3].t1, q[2].t0, q[2].v};
}

template <class T>
void gatherPolar(const std::array<CornerView<T>, 3>& q, Patch<T>& patch) {
    const CornerView<T>& apex = q[2];
    patch.count = 13;
    patch.apexCosine = T(cosine(apex.angle.part, apex.angle.whole));
    const Vec3<T> h02 = apex.t0;
    const Vec3<T> h32 = apex.t1;
    const T scale = T(1) / (T(2) + patch.apexCosine);
    Vec3<T> h12 = apex.v + (T(2) * (h02 - apex.v) + (h32 - apex.v)) * scale; // (18)
    Vec3<T> h22 = apex.v + ((h02 - apex.v) + T(2) * (h32 - apex.v)) * scale;
    h12 = h02 + T(1.5) * apex.a0 * (h12 - h02); // (19)
    h22 = h32 + T(1.5) * apex.a1 * (h22 - h32);
    patch.c = {q[0].v,  q[0].t0, q[1].t1, q[1].v,  //
               q[0].t1, q[0].f,  q[1].f,  q[1].t0, //
               h02,     h12,     h22,     h32,     //
               apex.v};
}

/// What of P_m depends on m alone.
struct SidesConstants {
    explicit SidesConstants(uint32_t sides)
        : m(sides), mu(1.0 - cosine(1, sides)), k0(0.5 / mu), k1(1.0 - 2.0 * k0), w(sides == 3   ? 2.0
                                                                                    : sides == 4 ? 1.0
                                                                                                 : -3.0) {}
    uint32_t m;
    double mu, k0, k1, w;
};

/// Offsets within a sector's six coefficients, which begin at 1 + 6 i.
enum SectorCoefficient : uint32_t { k300, k210, k120, k211, k121, k112 };

/// The coefficients of a P_m patch by sector, counted cyclically, and what (2) and (3) make of them. Relative to
/// `origin`: the weights of all that is derived sum to 1.
template <class T>
class SectorView {
public:
    SectorView(const std::array<Vec3<T>, 31>& c, uint32_t sides, const Vec3<T>& origin)
        : c_(c), k_(sides), origin_(origin) {}

    [[nodiscard]] Vec3<T> at(uint32_t sector, SectorCoefficient which) const {
        return c_[1 + 6 * (sector % k_.m) + which] - origin_;
    }
    [[nodiscard]] Vec3<T> center() const { return c_[0] - origin_; }

    /// Degree raising of the border, (2).
    [[nodiscard]] Vec3<T> b310(uint32_t i) const { return (at(i, k300) + T(3) * at(i, k210)) / T(4); }
    [[nodiscard]] Vec3<T> b220(uint32_t i) const { return (at(i, k210) + at(i, k120)) / T(2); }
    [[nodiscard]] Vec3<T> b130(uint32_t i) const { return (T(3) * at(i, k120) + at(i + 1, k300)) / T(4); }

    /// The ray from corner r to the centre, (3).
    [[nodiscard]] Vec3<T> b301(uint32_t r) const { return onRay(at(r, k300), b310(r), b130(r + k_.m - 1)); }
    [[nodiscard]] Vec3<T> b202(uint32_t r) const { return onRay(b301(r), at(r, k211), at(r + k_.m - 1, k121)); }
    [[nodiscard]] Vec3<T> b103(uint32_t r) const { return onRay(b202(r), at(r, k112), at(r + k_.m - 1, k112)); }

private:
    [[nodiscard]] Vec3<T> onRay(const Vec3<T>& middle, const Vec3<T>& a, const Vec3<T>& b) const {
        return T(k_.k1) * middle + T(k_.k0) * (a + b);
    }
    const std::array<Vec3<T>, 31>& c_;
    SidesConstants k_;
    Vec3<T> origin_;
};

template <class T>
void gatherPm(const Mesh& mesh, uint32_t facet, std::span<const CornerView<T>> q, Patch<T>& patch) {
    const auto m = static_cast<uint32_t>(q.size());
    const SidesConstants k(m);
    patch.count = 6 * m + 1;
    const auto coefficient = [&](uint32_t sector, SectorCoefficient which) -> Vec3<T>& {
        return patch.c[1 + 6 * sector + which];
    };
    const Vec3<T> origin = q[0].v;
    Vec3<T> center(T(0));
    for (uint32_t i = 0; i < m; ++i) {
        const CornerView<T>& a = q[i];
        const CornerView<T>& b = q[(i + 1) % m];
        const double chi0 = 1.0 + cosine(a.angle.part, a.angle.whole);
        const double chi1 = 1.0 + cosine(b.angle.part, b.angle.whole);
        const bool cut = mesh.features.hard(mesh.topology.cornerEdges[mesh.corner(facet, i)]);
        const double sines = cut ? 2.0 : sine(a.angle.part, a.angle.whole) + sine(b.angle.part, b.angle.whole);
        const T jump = T(3.0 / (8.0 * k.mu * sines));
        const Vec3<T> along = b.t1 - a.t0;
        coefficient(i, k300) = a.v;
        coefficient(i, k210) = a.t0;
        coefficient(i, k120) = b.t1;
        // (20), with b310 = v + 3/4 (t - v)
        coefficient(i, k211) = a.v + (T(0.75 + (2.0 * k.mu - chi1) / (8.0 * k.mu)) * (a.t0 - a.v) +
                                      T(chi0 / (4.0 * k.mu)) * along + jump * a.jump0);
        coefficient(i, k121) = b.v + (T(0.75 + (2.0 * k.mu - chi0) / (8.0 * k.mu)) * (b.t1 - b.v) -
                                      T(chi1 / (4.0 * k.mu)) * along + jump * b.jump1);
        center += T(k.w) * (a.v - origin) + T(3) * ((a.e0 - origin) + (a.e1 - origin)) + T(9) * (a.f - origin);
    }
    patch.c[0] = origin + center * T(1.0 / (m * (15.0 + k.w)));

    // (21), (22), relative to b004.
    const SectorView<T> s(patch.c, m, patch.c[0]);
    for (uint32_t i = 0; i < m; ++i) {
        Vec3<T> b112;
        if (m == 3) {
            b112 = T(-0.5) * s.b202(i + 2);
        } else if (m == 4) {
            b112 = T(3.0 / 16.0) * ((s.at(i, k211) + s.at(i, k121)) - (s.at(i + 1, k121) + s.at(i + 3, k211))) +
                   T(1.0 / 16.0) * ((s.at(i + 1, k211) + s.at(i + 3, k121)) - (s.at(i + 2, k211) + s.at(i + 2, k121)));
        } else {
            const double d = cosine(2, 5);
            b112 = T(k.mu / 5.0) * (s.b202(i + 3) - T(4.0 * d) * (s.b202(i) + s.b202(i + 1)) -
                                    T(4.0 * d * d) * (s.b202(i + 2) + s.b202(i + 4)));
        }
        coefficient(i, k112) = patch.c[0] + b112;
    }
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

/// The coefficients of a sector: rows parallel to the border, from it to the centre.
template <class T>
std::array<Vec3<T>, 15> quarticOf(const SectorView<T>& s, uint32_t i) {
    return {s.at(i, k300), s.b310(i),     s.b220(i),     s.b130(i),     s.at(i + 1, k300),
            s.b301(i),     s.at(i, k211), s.at(i, k121), s.b301(i + 1), //
            s.b202(i),     s.at(i, k112), s.b202(i + 1),                //
            s.b103(i),     s.b103(i + 1),                               //
            s.center()};
}

/// A sector's quartic by de Casteljau, relative to its first corner.
template <class T>
struct SectorPoint {
    Vec3<T> position, d1, d2;
};

template <class T>
SectorPoint<T> evaluateSector(const Patch<T>& patch, uint32_t i, const Vec3<T>& weights) {
    const SectorView<T> s(patch.c, patch.sides, patch.c[1 + 6 * i]);
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
    assert(positions.size() == mesh.cage.vertexCount());
    Coefficients<T> out;
    const Vec3<T> zero(T(0));
    out.limitPoints.assign(mesh.fans.size(), zero);
    out.tau1.assign(mesh.fans.size(), zero);
    out.tau2.assign(mesh.fans.size(), zero);
    out.tangents.assign(mesh.slotSpokes.size(), zero);
    out.faceCoefficients.assign(mesh.slotSpokes.size(), zero);
    for (uint32_t s = 0; s < mesh.fans.size(); ++s) {
        FanStage<T>(mesh, positions, mesh.fans[s]).store(s, out);
    }
    return out;
}

template <class T>
Patch<T> gatherPatch(const Mesh& mesh, const Coefficients<T>& c, uint32_t facet) {
    Patch<T> patch;
    patch.patchClass = mesh.classes[facet];
    patch.sides = mesh.cage.sides(facet);
    std::vector<CornerView<T>> corners;
    for (uint32_t i = 0; i < patch.sides; ++i) {
        corners.emplace_back(mesh, c, mesh.corner(facet, i));
        patch.singularCorner[i] = corners.back().angle == FacetAngle{1, 2};
    }
    switch (patch.patchClass) {
    case PatchClass::regular:
        gatherOrdinary<T>({corners[0], corners[1], corners[2], corners[3]}, patch);
        break;
    case PatchClass::polar:
        gatherPolar<T>({corners[0], corners[1], corners[2]}, patch);
        break;
    default:
        gatherPm<T>(mesh, facet, corners, patch);
    }
    return patch;
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
    const std::array<glm::dvec3, 15> b = quarticOf(SectorView<double>(patch.c, patch.sides, origin), at.sector);
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
