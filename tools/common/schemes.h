// The surface schemes, as the command line and reports name them.
#pragma once

#include <string_view>
#include <supple/supple.h>

namespace supple::tools {

struct Scheme {
    const char* name;
    SuppleScheme scheme;
    bool coefficients; ///< its patches have coefficients to read (SUPPLE_GROUP_PATCHES)
    bool smooth;       ///< a smooth surface, sampled in grids
};

inline constexpr Scheme kSchemes[] = {{"catmull-clark", SUPPLE_SCHEME_CATMULL_CLARK, false, true},
                                      {"pm", SUPPLE_SCHEME_PM, true, true},
                                      {"prep", SUPPLE_SCHEME_PREP, true, true},
                                      {"loop", SUPPLE_SCHEME_LOOP, false, true},
                                      {"blend", SUPPLE_SCHEME_BLEND, false, true},
                                      {"fragments", SUPPLE_SCHEME_FRAGMENTS, false, true},
                                      {"polygons", SUPPLE_SCHEME_POLYGONS, false, false}};

[[nodiscard]] constexpr const char* schemeName(SuppleScheme scheme) {
    for (const Scheme& known : kSchemes) {
        if (known.scheme == scheme) {
            return known.name;
        }
    }
    return scheme == SUPPLE_SCHEME_CAGE ? "cage" : "auto";
}

/// "auto", "cage" (no surface) and the names above; anything else is auto.
[[nodiscard]] constexpr SuppleScheme schemeOf(std::string_view name) {
    for (const Scheme& known : kSchemes) {
        if (name == known.name) {
            return known.scheme;
        }
    }
    return name == "cage" ? SUPPLE_SCHEME_CAGE : SUPPLE_SCHEME_AUTO;
}

} // namespace supple::tools
