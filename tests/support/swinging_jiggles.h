// A sample that both swings and jiggles.
#pragma once

#include "tests/support/crowd.h"
#include "tests/support/soft_assets.h"
#include "tools/gltf/writer.h"

#include <gtest/gtest.h>

namespace supple::test {

/// The jiggling Wren with Wren's springs. Characters are written without springs, so these go into the file.
inline SuppleAsset swingingAndJigglingWren(CrowdContext& context) {
    const Result<cage::GlbFile> glb = cage::writeGlb(jigglingWren());
    EXPECT_TRUE(glb.ok());
    return glb ? context.createAsset(withExtensions(glb->bytes, kWrenSprings), "wren") : SuppleAsset{};
}

} // namespace supple::test
