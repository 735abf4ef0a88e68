// The list of surface schemes. A new one is a folder beside prep/ and pm/, kernels in surface/passes.cpp, and a line
// here.
#pragma once

#include "base/result.h"
#include "surface/prep/weights.h"
#include "surface/scheme.h"

namespace supple::surface {

enum class SchemeId : uint32_t { prep = 1, pm = 2 }; ///< values of SuppleScheme

/// What tables depend on besides the cage.
struct Recipe {
    SchemeId scheme = SchemeId::pm;
    prep::Options prep;

    bool operator==(const Recipe&) const = default;
};

/// "p-rep", "P_m".
[[nodiscard]] const char* schemeName(SchemeId scheme);

/// Builds the scheme's tables, or says why it cannot take the cage: "face 12 has 5 sides: p-rep takes quads only".
[[nodiscard]] Result<Tables> buildTables(const Recipe& recipe, const cage::Cage& cage);

} // namespace supple::surface
