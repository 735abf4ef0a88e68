// P_m on the CPU, in float or double, as the formulas have it. For tests and comparisons.
// Paper: see surface/pm/mesh.h. Formulas: docs/pm.md, where errors of the paper are corrected.
#pragma once

#include "cpu/jet.h"
#include "cpu/pm_construction.h"

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::pm {

template <class T>
using Coefficients = PointCoefficients<glm::vec<3, T>>;
template <class T>
using Patch = PointPatch<glm::vec<3, T>>;

template <class T>
struct Sample {
    using Vec = glm::vec<3, T>;
    Vec position;
    Vec normal; ///< outwards, of unit length; zero if the surface has none
};

template <class T>
[[nodiscard]] Coefficients<T> construct(const Mesh& mesh, std::span<const glm::vec<3, T>> positions);

template <class T>
[[nodiscard]] Patch<T> gatherPatch(const Mesh& mesh, const Coefficients<T>& c, uint32_t facet);

/// A point of the domain. Ordinary and polar patches: the pairs (u, 1 - u) and (v, 1 - v). P_m patches: a sector, and
/// the weights of its first corner, its second corner and the centre.
template <class T>
struct DomainPoint {
    glm::vec<2, T> u{}, v{};
    uint32_t sector = 0;
    glm::vec<3, T> weights{};
};
/// The domain point of a grid sample, computed from integers and correctly rounded. In triangles the smallest weight
/// decides the sector, in P_4 the diagonals of the square.
template <class T>
[[nodiscard]] DomainPoint<T> domainPoint(PatchClass patchClass, uint32_t rate, uint32_t sample);

/// Position and exact normal. A point on a border (u or v is 0 or 1, or the weight of the centre is 0) is evaluated
/// with the border cubic alone, (w^3 b0 + u^3 b3) + (3 w^2 u b1 + 3 u^2 w b2), so that both sides give the same bits.
/// The normal at a singular corner is that of a point kNormalStep further inside.
inline constexpr double kNormalStep = 1e-3;
template <class T>
[[nodiscard]] Sample<T> evaluate(const Patch<T>& patch, const DomainPoint<T>& at);

/// The first derivatives at a point in a sector of a P_m patch, along corner -> next corner and corner -> centre. For
/// tests of smoothness.
template <class T>
struct Derivatives {
    glm::vec<3, T> d1, d2;
};
template <class T>
[[nodiscard]] Derivatives<T> derivatives(const Patch<T>& patch, const DomainPoint<T>& at);

/// With second derivatives: by u and v, or of a P_m patch in the directions of Derivatives. Its sums have another order
/// than those of evaluate(). At a polar patch's apex du is zero.
[[nodiscard]] SurfaceJet evaluateJet(const Patch<double>& patch, const DomainPoint<double>& at);

} // namespace supple::surface::pm
