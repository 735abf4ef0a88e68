// Samples with springs, as assets.
#pragma once

#include "tests/support/crowd.h"
#include "tests/support/spring_files.h"

namespace supple::test {

inline SuppleAsset wrenWithSprings(CrowdContext& context) {
    return context.createAsset(withExtensions(kWren, kWrenSprings), "wren");
}
/// Wren anew, with these extensions.
inline void reloadWren(CrowdContext& context, SuppleAsset asset, const std::string& extensions) {
    const std::vector<std::byte> glb = withExtensions(kWren, extensions);
    SuppleAssetDesc desc{};
    desc.structSize = sizeof desc;
    desc.name = "wren";
    desc.bytes = glb.data();
    desc.byteCount = glb.size();
    EXPECT_EQ(suppleReloadAsset(context.handle(), asset, &desc), SUPPLE_OK);
}
inline SuppleAsset pipWithSprings(CrowdContext& context) {
    return context.createAsset(withExtensions(kPip, kPipSprings), "pip");
}

} // namespace supple::test
