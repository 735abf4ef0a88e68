// The ways of skinning that a host can name, for tests that go through them.
#pragma once

#include "runtime/group.h"
#include "skinning/deform_kernels.h"
#include "supple/supple.h"

namespace supple::test {

inline constexpr SuppleSkinning kSkinnings[] = {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION,
                                                SUPPLE_SKINNING_CENTERS_OF_ROTATION, SUPPLE_SKINNING_DELTA_MUSH,
                                                SUPPLE_SKINNING_DELTA_MUSH_LIGHT};
inline const char* skinningName(SuppleSkinning skinning) {
    constexpr const char* kNames[] = {"linear", "dual quaternions", "centers of rotation", "delta mush",
                                      "light delta mush"};
    return kNames[skinning];
}

/// The table that the deform pass of a group reads, made anew.
inline skinning::DeformTable deformTableOf(const runtime::Group& group) {
    const runtime::Asset& asset = group.asset();
    return skinning::buildDeformTable(asset.character, asset.skinning(group.instances().skinning()));
}

} // namespace supple::test
