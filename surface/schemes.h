// The list of surface schemes. A new one is a folder beside prep/ and pm/, kernels in surface/passes.cpp, and a line
// here.
#pragma once

#include "base/result.h"
#include "surface/prep/weights.h"
#include "surface/scheme.h"

#include <bit>

namespace supple::surface {

enum class SchemeId : uint32_t { prep = 1, pm = 2, catmullClark = 3, loop = 4 }; ///< values of SuppleScheme

/// What tables depend on besides the cage.
struct Recipe {
    SchemeId scheme = SchemeId::pm;
    prep::Options prep;
    uint32_t depth = 0; ///< subdivision kernel: steps from the cage to the surface's samples; 0 for the others

    bool operator==(const Recipe&) const = default;
};

/// "p-rep", "P_m", "Catmull-Clark", "Loop".
[[nodiscard]] const char* schemeName(SchemeId scheme);

/// Whether it is one of the subdivision kernel's.
[[nodiscard]] constexpr bool subdivides(SchemeId scheme) {
    return scheme == SchemeId::catmullClark || scheme == SchemeId::loop;
}

/// The depth at which the subdivision kernel has at least `rate` segments along an edge of the cage: 2^depth.
[[nodiscard]] constexpr uint32_t depthFor(uint32_t rate) {
    return static_cast<uint32_t>(std::bit_width(rate - 1));
}

/// Builds the scheme's tables, or says why it cannot take the cage: "face 12 has 5 sides: p-rep takes quads only".
[[nodiscard]] Result<Tables> buildTables(const Recipe& recipe, const cage::Cage& cage);

} // namespace supple::surface
