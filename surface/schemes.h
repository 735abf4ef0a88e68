// The list of surface schemes. A new one is a folder beside prep/ and pm/, kernels in surface/passes.cpp, and a line
// here.
#pragma once

#include "base/result.h"
#include "surface/blend/mesh.h"
#include "surface/prep/weights.h"
#include "surface/scheme.h"

namespace supple::surface {

enum class SchemeId : uint32_t { prep = 1, pm = 2, catmullClark = 3, loop = 4, blend = 5 }; ///< values of SuppleScheme

/// What tables depend on besides the cage.
struct Recipe {
    SchemeId scheme = SchemeId::pm;
    prep::Options prep;
    blend::Options blend;
    uint32_t rate = 0;      ///< segments along an edge of the cage; 0 for schemes whose tables serve all rates
    bool attributes = true; ///< with the corner attributes
    bool lod = false;       ///< with what level of detail needs
    bool shared = false;    ///< samples that patches share are stored once

    bool operator==(const Recipe&) const = default;
};

/// "p-rep", "P_m", "Catmull-Clark", "Loop", "blend".
[[nodiscard]] const char* schemeName(SchemeId scheme);

/// Whether it is one of the subdivision kernel's: rates are then rounded up to powers of two.
[[nodiscard]] constexpr bool subdivides(SchemeId scheme) {
    return scheme == SchemeId::catmullClark || scheme == SchemeId::loop;
}

/// Whether its tables are made for one rate, but for those with levels.
[[nodiscard]] constexpr bool hasRate(SchemeId scheme) {
    return subdivides(scheme) || scheme == SchemeId::blend;
}

/// Whether its patches can be drawn at real-valued levels, and whether they can share their samples.
[[nodiscard]] constexpr bool hasLevels(SchemeId scheme) {
    return !subdivides(scheme);
}

/// Builds the scheme's tables, or says why it cannot take the cage: "face 12 has 5 sides: p-rep takes quads only".
[[nodiscard]] Result<Tables> buildTables(const Recipe& recipe, const cage::Cage& cage);

} // namespace supple::surface
