// Which bicubic patches surely show their back, on the CPU: what could be left out before levels are chosen.
//
// The normal Du x Dv of a bicubic patch is a sum, with weights that are not negative, of the 144 products of a
// difference along u and a difference along v of its control points; a cone round these holds all normals. After
// Shirman, Abi-Ezzi, "The cone of normals technique for fast processing of curved patches" (1993).
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace supple::surface::lod {

using BicubicNet = std::array<glm::dvec3, 16>; ///< g[i + 4 j]

/// Holds every normal of a patch. cosine <= 0: no cone narrower than a half-space was found, or a product vanishes.
struct NormalCone {
    glm::dvec3 axis{0.0};
    double cosine = -1.0;
};
/// From all products: the narrowest that is to be had round their mean.
[[nodiscard]] NormalCone coneOfProducts(const BicubicNet& g);
/// From a cone of the differences along u and one of those along v: 24 unit vectors instead of 144. Wider.
[[nodiscard]] NormalCone coneOfDifferences(const BicubicNet& g);

/// Whether every point of the patch shows its back to the camera, by its cone and the sphere round its control points.
[[nodiscard]] bool showsItsBack(const NormalCone& cone, const BicubicNet& g, const glm::dvec3& camera);
/// The same by all products and all points: the most that control points can tell.
[[nodiscard]] bool netShowsItsBack(const BicubicNet& g, const glm::dvec3& camera);

} // namespace supple::surface::lod
