// Samples with springs, as assets.
#pragma once

#include "tests/support/crowd.h"
#include "tests/support/spring_files.h"

namespace supple::test {

inline SuppleAsset wrenWithSprings(CrowdContext& context) {
    return context.createAsset(withExtensions(kWren, kWrenSprings), "wren");
}
inline SuppleAsset pipWithSprings(CrowdContext& context) {
    return context.createAsset(withExtensions(kPip, kPipSprings), "pip");
}

} // namespace supple::test
