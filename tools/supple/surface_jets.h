// The surface of a posed group on the CPU, in double, with second derivatives, by the samples of its patches.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cpu/jet.h"

#include <supple/supple.h>

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::tools {

/// What a surface depends on besides its cage: of SuppleGroupDesc.
struct SurfaceRules {
    SuppleCreaseMode creases = SUPPLE_CREASES_CUT;
    float sharpThreshold = 1.0f;
    SuppleFragmentRules fragments = SUPPLE_RULES_CATMULL_CLARK;
};

/// A surface of a group as the device has it.
struct JetSource {
    SuppleScheme scheme = SUPPLE_SCHEME_AUTO;
    uint32_t rate = 0;                        ///< along a patch
    std::span<const SupplePatchInfo> patches; ///< in the order of the device; faces and corners are the cage's
    SurfaceRules rules;
};

/// The surface at a sample of a patch. `inside`: moved by this share of the way to the middle of the patch, or of its
/// sector. At corners some surfaces have no derivatives, so these are zero there, or not finite.
using Jets = std::function<surface::SurfaceJet(uint32_t patch, uint32_t sample, double inside)>;

/// `cage` is the surface's own, and `positions` its deformed vertices. All that it needs is copied. Refuses the scheme
/// polygons. Any number of threads may call the result.
[[nodiscard]] Result<Jets> surfaceJets(const JetSource& source, const cage::Cage& cage,
                                       std::span<const glm::dvec3> positions);

/// At a sample. Where the surface has no curvature, that of a point a thousandth of the way to the middle.
[[nodiscard]] surface::Curvature curvatureAt(const Jets& jets, uint32_t patch, uint32_t sample);

} // namespace supple::tools
