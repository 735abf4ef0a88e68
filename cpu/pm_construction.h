// P_m's construction for any kind of point (cpu/form.h). Paper: see surface/pm/mesh.h; equation numbers are the
// paper's, and docs/pm.md says where we depart from the print. Written from the formulas, without the weights of the
// GPU's tables, so that it checks them. Arithmetic must round as written: the bits of shared borders depend on it.
#pragma once

#include "cpu/form.h"
#include "surface/grid.h"
#include "surface/pm/mesh.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <span>
#include <vector>

namespace supple::surface::pm {

/// The output of the vertex stage, (13)-(16). There is one limit point, tau1 and tau2 per fan, and one tangent t_j
/// and face coefficient f_j per slot. The last slot of an open fan has no f.
template <class Point>
struct PointCoefficients {
    std::vector<Point> limitPoints; ///< v
    std::vector<Point> tau1, tau2;
    std::vector<Point> tangents;
    std::vector<Point> faceCoefficients;
};

/// One patch. Its coefficients have the order of docs/pm.md: 16 (4 row + column) for ordinary patches, 13 for polar
/// ones, 6 m + 1 for P_m: b004, then b300 b210 b120 b211 b121 b112 per sector. Patch corner i is facet corner
/// (firstCorners + i) % sides.
template <class Point>
struct PointPatch {
    PatchClass patchClass = PatchClass::regular;
    uint32_t sides = 4;
    uint32_t count = 16;
    std::array<Point, 31> c{};
    ScalarOf<Point> apexCosine = 0; ///< polar: cos(2 pi / n) of the apex
    /// Patch corners where the derivatives are parallel: crease fans with a single facet. Only P_m patches have
    /// them.
    std::array<bool, kMaxSides> singularCorner{};
};

/// cos(2 pi k / n) for k < n, exact at quarter turns: valence 4 must be a B-spline to the last bit.
inline double cosine(uint32_t k, uint32_t n) {
    if (4 * k == n || 4 * k == 3 * n) {
        return 0.0;
    }
    return k == 0 ? 1.0 : 2 * k == n ? -1.0 : std::cos(2.0 * std::numbers::pi * k / n);
}

inline double sine(uint32_t k, uint32_t n) {
    if (k == 0 || 2 * k == n) {
        return 0.0;
    }
    return 4 * k == n ? 1.0 : 4 * k == 3 * n ? -1.0 : std::sin(2.0 * std::numbers::pi * k / n);
}

/// Subdominant eigenvalue of Catmull-Clark subdivision, 1/2 for n = 4; in (15).
inline double lambda(uint32_t n) {
    const double c = cosine(1, n);
    return n == 4 ? 0.5 : (c + 5.0 + std::sqrt((c + 9.0) * (c + 1.0))) / 16.0;
}

/// The vertex stage of one fan. All is relative to the vertex p: a character is large beside its facets, and
/// differences keep the rounding of a float at the size of the ring.
template <class Point>
class FanStage {
    using T = ScalarOf<Point>;

public:
    FanStage(const Mesh& mesh, std::span<const Point> positions, const Fan& fan)
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

    void store(uint32_t index, PointCoefficients<Point>& out) const {
        const Point moved = fan_.pinned ? v_ : Point(T(0));
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

    [[nodiscard]] Point spoke(uint32_t j) const { return positions_[mesh_.topology.spokeVertices[spokeSlot(j)]] - p_; }

    /// Of a sharp edge that ends the fan, relative to p.
    [[nodiscard]] Point endTangent(uint32_t j) const {
        const FanEnd& end = fan_.ends[j == 0 ? 0 : 1];
        if (end.partner == cage::kNone) {
            return T(end.own) * spoke(j);
        }
        const Point other = positions_[mesh_.topology.spokeVertices[mesh_.slotSpokes[end.partner]]] - p_;
        return T(end.own) * spoke(j) - T(end.other) * other;
    }

    /// Q_j: the mean of the corners of facet j that are not the vertex or its neighbors; of a triangle, of these.
    [[nodiscard]] Point farMean(uint32_t j) const {
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
    [[nodiscard]] Point faceCoefficient(uint32_t j, uint32_t next) const {
        const T a = T(mesh_.slotAlphas[fan_.firstSlot + j]);
        const T b = T(mesh_.slotAlphas[fan_.firstSlot + next]);
        const Point x = spoke(j);
        const Point y = spoke(next);
        return ((T(1) - a) * b * x + a * (T(1) - b) * y) / T(2) + a * b * ((x + y) + farMean(j)) / T(4) +
               T(mesh_.slotRims[fan_.firstSlot + j]) * (x + y);
    }

    [[nodiscard]] Point turned(uint32_t j) const {
        const FacetAngle angle = fan_.angle();
        return tau1_ * T(cosine(j * angle.part, angle.whole)) + tau2_ * T(sine(j * angle.part, angle.whole));
    }

    void closedFrame() {
        const uint32_t n = fan_.facets;
        for (const Point& f : f_) {
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
        const Point a = spoke(0);
        const Point b = spoke(fan_.facets);
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
            v_ = Point(T(0));
            tau1_ = endTangent(0);
        }
    }

    const Mesh& mesh_;
    std::span<const Point> positions_;
    const Fan& fan_;
    Point p_;
    std::vector<Point> f_, e_;
    Point v_{T(0)}, tau1_{T(0)}, tau2_{T(0)};
};

/// A patch corner as the patch stage sees it.
template <class Point>
struct CornerView {
    using T = ScalarOf<Point>;

    CornerView(const Mesh& mesh, const PointCoefficients<Point>& c, uint32_t corner) {
        const FacetCorner& at = mesh.corners[corner];
        const Fan& fan = mesh.fans[at.fan];
        angle = fan.angle();
        v = c.limitPoints[at.fan];
        t0 = c.tangents[at.slot];
        t1 = c.tangents[at.slotBack];
        f = c.faceCoefficients[at.slot];
        a0 = T(mesh.slotAlphas[at.slot]);
        a1 = T(mesh.slotAlphas[at.slotBack]);
        const auto across = [&](uint32_t slot, const Point& t, Point& e, Point& jump) {
            e = slot == cage::kNone ? t : (f + c.faceCoefficients[slot]) / T(2);
            jump = slot == cage::kNone ? T(2) * (f - t) : f - c.faceCoefficients[slot];
        };
        across(at.across, t0, e0, jump0);
        across(at.acrossBack, t1, e1, jump1);
    }
    FacetAngle angle;
    Point v, f;
    // Towards the next and towards the previous corner:
    Point t0, t1;
    Point e0, e1;
    Point jump0, jump1; ///< f - f_across
    T a0{}, a1{};
};

template <class Point>
void gatherOrdinary(const std::array<CornerView<Point>, 4>& q, PointPatch<Point>& patch) {
    patch.count = 16;
    patch.c = {q[0].v,  q[0].t0, q[1].t1, q[1].v,  //
               q[0].t1, q[0].f,  q[1].f,  q[1].t0, //
               q[3].t0, q[3].f,  q[2].f,  q[2].t1, //
               q[3].v,  q[3].t1, q[2].t0, q[2].v};
}

template <class Point>
void gatherPolar(const std::array<CornerView<Point>, 3>& q, PointPatch<Point>& patch) {
    using T = ScalarOf<Point>;
    const CornerView<Point>& apex = q[2];
    patch.count = 13;
    patch.apexCosine = T(cosine(apex.angle.part, apex.angle.whole));
    const Point h02 = apex.t0;
    const Point h32 = apex.t1;
    const T scale = T(1) / (T(2) + patch.apexCosine);
    Point h12 = apex.v + (T(2) * (h02 - apex.v) + (h32 - apex.v)) * scale; // (18)
    Point h22 = apex.v + ((h02 - apex.v) + T(2) * (h32 - apex.v)) * scale;
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
template <class Point>
class SectorView {
    using T = ScalarOf<Point>;

public:
    SectorView(const std::array<Point, 31>& c, uint32_t sides, const Point& origin)
        : c_(c), k_(sides), origin_(origin) {}

    [[nodiscard]] Point at(uint32_t sector, SectorCoefficient which) const {
        return c_[1 + 6 * (sector % k_.m) + which] - origin_;
    }
    [[nodiscard]] Point center() const { return c_[0] - origin_; }

    /// Degree raising of the border, (2).
    [[nodiscard]] Point b310(uint32_t i) const { return (at(i, k300) + T(3) * at(i, k210)) / T(4); }
    [[nodiscard]] Point b220(uint32_t i) const { return (at(i, k210) + at(i, k120)) / T(2); }
    [[nodiscard]] Point b130(uint32_t i) const { return (T(3) * at(i, k120) + at(i + 1, k300)) / T(4); }

    /// The ray from corner r to the centre, (3).
    [[nodiscard]] Point b301(uint32_t r) const { return onRay(at(r, k300), b310(r), b130(r + k_.m - 1)); }
    [[nodiscard]] Point b202(uint32_t r) const { return onRay(b301(r), at(r, k211), at(r + k_.m - 1, k121)); }
    [[nodiscard]] Point b103(uint32_t r) const { return onRay(b202(r), at(r, k112), at(r + k_.m - 1, k112)); }

private:
    [[nodiscard]] Point onRay(const Point& middle, const Point& a, const Point& b) const {
        return T(k_.k1) * middle + T(k_.k0) * (a + b);
    }
    const std::array<Point, 31>& c_;
    SidesConstants k_;
    Point origin_;
};

template <class Point>
void gatherPm(const Mesh& mesh, uint32_t facet, std::span<const CornerView<Point>> q, PointPatch<Point>& patch) {
    using T = ScalarOf<Point>;
    const auto m = static_cast<uint32_t>(q.size());
    const SidesConstants k(m);
    patch.count = 6 * m + 1;
    const auto coefficient = [&](uint32_t sector, SectorCoefficient which) -> Point& {
        return patch.c[1 + 6 * sector + which];
    };
    const Point origin = q[0].v;
    Point center(T(0));
    for (uint32_t i = 0; i < m; ++i) {
        const CornerView<Point>& a = q[i];
        const CornerView<Point>& b = q[(i + 1) % m];
        const double chi0 = 1.0 + cosine(a.angle.part, a.angle.whole);
        const double chi1 = 1.0 + cosine(b.angle.part, b.angle.whole);
        const bool cut = mesh.features.hard(mesh.topology.cornerEdges[mesh.corner(facet, i)]);
        const double sines = cut ? 2.0 : sine(a.angle.part, a.angle.whole) + sine(b.angle.part, b.angle.whole);
        const T jump = T(3.0 / (8.0 * k.mu * sines));
        const Point along = b.t1 - a.t0;
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
    const SectorView<Point> s(patch.c, m, patch.c[0]);
    for (uint32_t i = 0; i < m; ++i) {
        Point b112;
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

/// The coefficients of a sector: rows parallel to the border, from it to the centre.
template <class Point>
std::array<Point, 15> quarticOf(const SectorView<Point>& s, uint32_t i) {
    return {s.at(i, k300), s.b310(i),     s.b220(i),     s.b130(i),     s.at(i + 1, k300),
            s.b301(i),     s.at(i, k211), s.at(i, k121), s.b301(i + 1), //
            s.b202(i),     s.at(i, k112), s.b202(i + 1),                //
            s.b103(i),     s.b103(i + 1),                               //
            s.center()};
}

/// The output of the vertex stage. `positions` has one entry per vertex of the mesh.
template <class Point>
PointCoefficients<Point> constructPoints(const Mesh& mesh, std::span<const Point> positions) {
    using T = ScalarOf<Point>;
    assert(positions.size() == mesh.cage.vertexCount());
    PointCoefficients<Point> out;
    const Point zero(T(0));
    out.limitPoints.assign(mesh.fans.size(), zero);
    out.tau1.assign(mesh.fans.size(), zero);
    out.tau2.assign(mesh.fans.size(), zero);
    out.tangents.assign(mesh.slotSpokes.size(), zero);
    out.faceCoefficients.assign(mesh.slotSpokes.size(), zero);
    for (uint32_t s = 0; s < mesh.fans.size(); ++s) {
        FanStage<Point>(mesh, positions, mesh.fans[s]).store(s, out);
    }
    return out;
}

/// The patch of a facet.
template <class Point>
PointPatch<Point> gatherPoints(const Mesh& mesh, const PointCoefficients<Point>& c, uint32_t facet) {
    PointPatch<Point> patch;
    patch.patchClass = mesh.classes[facet];
    patch.sides = mesh.cage.sides(facet);
    std::vector<CornerView<Point>> corners;
    for (uint32_t i = 0; i < patch.sides; ++i) {
        corners.emplace_back(mesh, c, mesh.corner(facet, i));
        patch.singularCorner[i] = corners.back().angle == FacetAngle{1, 2};
    }
    switch (patch.patchClass) {
    case PatchClass::regular:
        gatherOrdinary<Point>({corners[0], corners[1], corners[2], corners[3]}, patch);
        break;
    case PatchClass::polar:
        gatherPolar<Point>({corners[0], corners[1], corners[2]}, patch);
        break;
    default:
        gatherPm<Point>(mesh, facet, corners, patch);
    }
    return patch;
}

} // namespace supple::surface::pm
