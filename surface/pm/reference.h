// P_m on the CPU, in float or double, straight from the formulas: for tests and comparisons, not part of the runtime.
// Paper: A. Myles, T. Ni, J. Peters, SGP 2008 (see mesh.h); formulas in the corrected form of docs/pm.md.
#pragma once

#include "surface/grid.h"
#include "surface/pm/mesh.h"

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::pm {

/// Output of the vertex stage, (13)-(16): limitPoints, tau1, tau2 one a sector; tangents (t_j) and faceCoefficients
/// (f_j) one a slot (the last slot of an open sector carries no f).
template <class T>
struct Coefficients {
    using Vec = glm::vec<3, T>;
    std::vector<Vec> limitPoints; ///< v
    std::vector<Vec> tau1, tau2;
    std::vector<Vec> tangents;
    std::vector<Vec> faceCoefficients;
};

/// One patch. Coefficients in the order of docs/pm.md: ordinary 16 (4 row + col), polar 13, P_m 6 m + 1
/// (b004, then b300 b210 b120 b211 b121 b112 a sector). Patch corner i is facet corner (firstCorners + i) % sides.
template <class T>
struct Patch {
    using Vec = glm::vec<3, T>;
    FacetClass facetClass = FacetClass::ordinary;
    uint32_t sides = 4;
    uint32_t count = 16;
    std::array<Vec, 31> c{};
    T apexCosine = 0; ///< polar: cos(2 pi / n) of the apex
    /// Patch corners at which the derivatives are parallel: crease sectors of one facet. P_m patches alone have them.
    std::array<bool, kMaxSides> singularCorner{};
};

template <class T>
struct Sample {
    using Vec = glm::vec<3, T>;
    Vec position;
    Vec normal; ///< outwards, of unit length; zero where the surface has none
};

template <class T>
[[nodiscard]] Coefficients<T> construct(const Mesh& mesh, std::span<const glm::vec<3, T>> positions);

template <class T>
[[nodiscard]] Patch<T> gatherPatch(const Mesh& mesh, const Coefficients<T>& c, uint32_t facet);

[[nodiscard]] Domain domainOf(FacetClass facetClass);

/// A point of the domain: the pairs (u, 1 - u) and (v, 1 - v) on ordinary and polar patches; on P_m patches a sector
/// and the weights of its first corner, its second corner and the centre.
template <class T>
struct DomainPoint {
    glm::vec<2, T> u{}, v{};
    uint32_t sector = 0;
    glm::vec<3, T> weights{};
};
/// Of a grid sample, from integer counts, every parameter correctly rounded: triangles by their smallest weight, P_4 by
/// the square's diagonals.
template <class T>
[[nodiscard]] DomainPoint<T> domainPoint(FacetClass facetClass, uint32_t rate, uint32_t sample);

/// Position and exact normal. Points on a border (v or u in {0, 1}; centre weight 0) are evaluated by the border cubic
/// alone, (w^3 b0 + u^3 b3) + (3 w^2 u b1 + 3 u^2 w b2), so that both sides give the same bits. At a singular corner
/// the normal is that of a point kNormalStep further in.
inline constexpr double kNormalStep = 1e-3;
template <class T>
[[nodiscard]] Sample<T> evaluate(const Patch<T>& patch, const DomainPoint<T>& at);

/// First derivatives at a point of one sector of a P_m patch, along corner -> next corner and corner -> centre; for the
/// tests of smoothness.
template <class T>
struct Derivatives {
    glm::vec<3, T> d1, d2;
};
template <class T>
[[nodiscard]] Derivatives<T> derivatives(const Patch<T>& patch, const DomainPoint<T>& at);

} // namespace supple::surface::pm
