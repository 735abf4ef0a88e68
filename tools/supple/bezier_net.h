// Patches as tensor products in Bernstein-Bezier form, which other programs read.
#pragma once

#include "surface/patch_class.h"

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace supple::tools {

/// sum_ij coefficients[i + (degree + 1) j] B_i(u) B_j(v), B the Bernstein polynomials of this degree.
struct BezierNet {
    uint32_t degree = 0; ///< in u and in v
    std::vector<glm::dvec3> coefficients;
};

/// The net of a patch, in double from the coefficients that the patch pass wrote (`stored`, as many as the class has).
/// A regular patch has its own 16, of degree 3; so has a polar one, whose last row is its apex four times. A perturbed
/// one has 36, of degree 5: its bicubic part raised by two degrees, and its perturbation, which has that form.
/// Nothing for classes that are no tensor products.
[[nodiscard]] std::optional<BezierNet> bezierNet(surface::PatchClass patchClass, std::span<const glm::vec3> stored);

/// Whether a class has such a net.
[[nodiscard]] bool hasBezierNet(surface::PatchClass patchClass);

} // namespace supple::tools
