// The ways of skinning that a host can name, for tests that go through them.
#pragma once

#include "runtime/group.h"
#include "skinning/deform_kernels.h"
#include "supple/supple.h"

namespace supple::test {

inline constexpr SuppleSkinning kSkinnings[] = {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION,
                                                SUPPLE_SKINNING_CENTERS_OF_ROTATION};
inline const char* skinningName(SuppleSkinning skinning) {
    constexpr const char* kNames[] = {"linear", "dual quaternions", "centers of rotation"};
    return kNames[skinning];
}

/// The table that the deform pass of a group reads, made anew.
inline skinning::DeformTable deformTableOf(const runtime::Group& group) {
    const runtime::Asset& asset = group.asset();
    const cage::Character& character = asset.character;
    const bool centers = skinning::skinningRow(group.instances().skinning()).centers;
    return skinning::buildDeformTable(character.cage, character.weights, character.morphs,
                                      centers ? std::span<const glm::vec4>(asset.centers()->points)
                                              : std::span<const glm::vec4>());
}

} // namespace supple::test
