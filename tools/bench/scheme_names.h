// Names of schemes, as the command line has them.
#pragma once

#include <supple/supple.h>

namespace supple::bench {

[[nodiscard]] constexpr const char* schemeName(SuppleScheme scheme) {
    switch (scheme) {
    case SUPPLE_SCHEME_PREP:
        return "prep";
    case SUPPLE_SCHEME_CATMULL_CLARK:
        return "catmull-clark";
    case SUPPLE_SCHEME_LOOP:
        return "loop";
    case SUPPLE_SCHEME_BLEND:
        return "blend";
    case SUPPLE_SCHEME_CAGE:
        return "cage";
    default:
        return "pm";
    }
}

} // namespace supple::bench
