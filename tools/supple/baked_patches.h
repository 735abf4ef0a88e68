// The patches behind a baked surface, as JSON.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "tools/supple/evaluation.h"
#include "tools/supple/options.h"

#include <string>
#include <vector>

namespace supple::tools {

enum class PatchBasis {
    stored, ///< as the device wrote them
    bezier  ///< tensor products in Bernstein-Bezier form (tools/supple/bezier_net.h)
};

/// Why --patches cannot be, or empty: which part has a scheme without coefficients.
[[nodiscard]] std::string whyNoPatches(const cage::Character& character, const SurfaceFlags& flags,
                                       const std::vector<SuppleScheme>& partSchemes);

/// Refuses patches that are not of this basis, and names them.
[[nodiscard]] Status checkBasis(const Evaluation& baked, PatchBasis basis);

/// Patches must be of this basis.
[[nodiscard]] Status writePatches(const std::string& path, const Evaluation& baked, PatchBasis basis);

} // namespace supple::tools
