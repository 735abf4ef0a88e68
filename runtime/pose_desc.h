// SupplePoseDesc: checked, and in the words of skinning/.
#pragma once

#include "base/result.h"
#include "runtime/asset.h"
#include "skinning/layers.h"
#include "supple/supple.h"

#include <cstddef>
#include <cstdint>

namespace supple::runtime {

/// What is wrong with a mask, or null.
[[nodiscard]] const char* maskFault(const float* mask, uint32_t count, size_t wanted);
/// Of SuppleRootMotionFlags and the joint that is named for the root, if any.
[[nodiscard]] Status checkRoot(const Asset& asset, uint32_t rootMotion, const uint32_t* rootJoint);
/// Success, or the first rule of supple.h that `desc` breaks.
[[nodiscard]] Status checkPose(const Asset& asset, const SupplePoseDesc& desc);
[[nodiscard]] Status checkJointMatrices(const Asset& asset, const SuppleJointMatricesDesc& desc);

// Of what checkPose takes.
[[nodiscard]] skinning::Layer layerOf(const Asset& asset, const SuppleClipLayer& layer);
[[nodiscard]] skinning::RootSelection rootSelection(const Asset& asset, const SupplePoseDesc& desc);
[[nodiscard]] skinning::RootMotion rootMotionOf(const Asset& asset, const SupplePoseDesc& desc);

} // namespace supple::runtime
