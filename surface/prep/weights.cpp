// Equation numbers are those of "GPU Conversion of Quad Meshes to Smooth Surfaces"; docs/prep.md says where we depart
// from the print.
#include "surface/prep/weights.h"

#include "surface/valence.h"

#include <cassert>
#include <cstddef>

namespace supple::surface::prep {
namespace {

/// w of eq. (3).
double spokeWeight(double rho) {
    return 16.0 * rho - 4.0;
}

/// K_n, the length of e1 and e2. Every positive value gives the same tangent plane and a G1 surface; 1/36 at n = 4.
double tangentLength(uint32_t n, double c, TangentMode mode) {
    const double rho = subdominant(n);
    const double w = spokeWeight(rho);
    if (mode == TangentMode::standard && n >= 6) {
        // sigma_n of eq. (3) makes the tangents grow with n, away from Catmull-Clark; hold them at 0.9 of a fan of
        // parallelograms' natural length.
        return 0.6 / (n * (w + 2.0 + 2.0 * c));
    }
    const double sigma = n == 3 ? 0.53 : 1.0 / (4.0 * rho);
    return sigma / (3.0 * (2.0 + w));
}

ValenceClass interiorClass(uint32_t n, const Options& options) {
    ValenceClass k;
    k.sectors = n;
    k.c = turn(1, n).first;
    // Eq. (2): the limit point of Catmull-Clark subdivision.
    const double valence = n;
    k.limitCenter = valence / (valence + 5.0);
    k.limitEdge.assign(n, 4.0 / (valence * (valence + 5.0)));
    k.limitFace.assign(n, 1.0 / (valence * (valence + 5.0)));
    // Eq. (3): the limit tangents.
    const double w = spokeWeight(subdominant(n));
    const double length = tangentLength(n, k.c, options.tangentMode);
    for (uint32_t i = 0; i < n; ++i) {
        const auto [cosine, sine] = turn(i, n);
        const auto [nextCosine, nextSine] = turn(i + 1, n);
        k.cosines.push_back(cosine);
        k.sines.push_back(sine);
        k.e1Edge.push_back(length * w * cosine);
        k.e2Edge.push_back(length * w * sine);
        k.e1Face.push_back(length * (cosine + nextCosine));
        k.e2Face.push_back(length * (sine + nextSine));
    }
    return k;
}

ValenceClass boundaryClass(uint32_t m, const Options& options) {
    ValenceClass k;
    k.sectors = m;
    k.boundary = true;
    k.sharpCorner = m == 1 && options.cornerRule == CornerRule::sharp;
    k.c = turn(1, 2 * m).first;
    k.limitEdge = k.e1Edge = k.e2Edge = std::vector<double>(m + 1, 0.0);
    k.limitFace = k.e1Face = k.e2Face = std::vector<double>(m, 0.0);
    for (uint32_t i = 0; i <= m; ++i) {
        const auto [cosine, sine] = turn(i, 2 * m);
        k.cosines.push_back(cosine);
        k.sines.push_back(sine);
    }
    if (k.sharpCorner) {
        k.limitCenter = 1.0;
        k.e1Center = k.e2Center = -1.0 / 3.0;
        k.e1Edge[0] = k.e2Edge[1] = 1.0 / 3.0;
        return k;
    }
    // The boundary curve is the cubic B-spline of the boundary polygon: limit point and tangent.
    k.limitCenter = 4.0 / 6.0;
    k.limitEdge[0] = k.limitEdge[m] = 1.0 / 6.0;
    k.e1Edge[0] = 1.0 / 6.0;
    k.e1Edge[m] = -1.0 / 6.0;
    if (m == 1) {
        // Du and Dv are parallel to e1 at a smooth corner with one face; e2 only serves the normal there.
        k.e2Center = -2.0 / 6.0;
        k.e2Edge[0] = k.e2Edge[1] = 1.0 / 6.0;
        return k;
    }
    // The cross tangent: left eigenvector of Catmull-Clark's boundary rules for the eigenvalue rho_2m.
    const double c = k.c;
    const double s = k.sines[1];
    const double rho = subdominant(2 * m);
    const double w = spokeWeight(rho);
    const double scale = 2.0 / (3.0 * m * (w + 2.0 + 2.0 * c));
    const double q = (1.0 + c) / s;
    const double end = (q * (6.0 * rho - 1.0) + rho * s * (8.0 * rho - 6.0)) / (2.0 * (4.0 * rho - 1.0) * (rho - 1.0));
    const double center = 8.0 * ((rho - 0.5) * end - rho * s);
    k.e2Center = scale * center;
    k.e2Edge[0] = k.e2Edge[m] = scale * end;
    for (uint32_t i = 1; i < m; ++i) {
        k.e2Edge[i] = scale * w * k.sines[i];
    }
    for (uint32_t i = 0; i < m; ++i) {
        k.e2Face[i] = scale * (k.sines[i] + k.sines[i + 1]);
    }
    return k;
}

using Row = std::array<double, 6>; ///< over {A, tA, tB, B, SA, SB}

/// The same row seen from the other end of the edge.
Row exchanged(const Row& row) {
    return {row[3], row[2], row[1], row[0], row[5], row[4]};
}

Row combined(double scale, const Row& row, double x, const Row& a, double y, const Row& b) {
    Row result;
    for (size_t i = 0; i < row.size(); ++i) {
        result[i] = scale * row[i] + (x * a[i] + y * b[i]);
    }
    return result;
}

constexpr Row kZero{};

/// <n,4>: A irregular, B regular, eq. (8).
EdgeWeights mixedWeights(double c) {
    const Row h20 = combined(3.0 / 40.0, {-2.0, 6.0 - 6.0 / c, -4.0, 0.0, 3.0 / c, 0.0}, 0.0, kZero, 0.0, kZero);
    const Row h21 =
        combined(3.0 / 100.0, {2.0 * c, 12.0 - 6.0 * c, 2.0 * c, 2.0 * c, -6.0, 0.0}, 1.0 - 0.4 * c, h20, 0.0, kZero);
    const Row h31 = combined(3.0 / 100.0, {0.0, 6.0, -2.0 * c, 2.0 * c, -3.0, 0.0}, 1.0, h20, 0.0, kZero);
    return {h20, h20, h21, h31};
}

/// <n0,n1>, eq. (9), first line: h20, with the near end's cosine first. The far end's h30 is the same row exchanged.
Row nearWeights(double cNear, double cFar) {
    return combined(3.0 / 40.0, {-2.0 * cFar / cNear, 4.0 + (2.0 * cFar - 6.0) / cNear, -4.0, 0.0, 3.0 / cNear, 0.0},
                    0.0, kZero, 0.0, kZero);
}

/// <n0,n1>, eq. (9), second line: h21.
Row nearInnerWeights(double cNear, double cFar, const Row& near, const Row& far) {
    return combined(3.0 / 100.0,
                    {4.0 * cFar, 12.0 - 8.0 * cNear, 6.0 + 6.0 * cNear - 4.0 * cFar, 2.0 * cNear, -6.0, -3.0},
                    1.0 - 0.6 * cNear - 0.4 * cFar, near, 0.6 * cNear, far);
}

} // namespace

ValenceClass makeValenceClass(uint32_t sectors, bool boundary, const Options& options) {
    assert(sectors >= (boundary ? 1u : 3u));
    return boundary ? boundaryClass(sectors, options) : interiorClass(sectors, options);
}

bool isPerturbed(const cage::Cage& cage, const cage::Topology& topology, uint32_t edge) {
    const auto [corner, twin] = topology.edges[edge];
    return twin != cage::kNone && (topology.effectiveValence(cage.faceVertices[corner]) != 4 ||
                                   topology.effectiveValence(cage.faceVertices[twin]) != 4);
}

EdgeWeights makeEdgeWeights(double cA, double cB) {
    // Comparing with 0 is sound: regular classes store it exactly.
    if (cA == 0.0 && cB == 0.0) {
        return {};
    }
    if (cB == 0.0) {
        return mixedWeights(cA);
    }
    if (cA == 0.0) {
        const EdgeWeights fromB = mixedWeights(cB);
        return {exchanged(fromB[1]), exchanged(fromB[0]), exchanged(fromB[3]), exchanged(fromB[2])};
    }
    const Row h20 = nearWeights(cA, cB);
    const Row farH20 = nearWeights(cB, cA); // h30 as B sees it
    const Row h21 = nearInnerWeights(cA, cB, h20, exchanged(farH20));
    const Row farH21 = nearInnerWeights(cB, cA, farH20, exchanged(h20));
    return {h20, exchanged(farH20), h21, exchanged(farH21)};
}

} // namespace supple::surface::prep
