// SupplePoseDesc: checked, and in the words of skinning/.
#pragma once

#include "base/result.h"
#include "runtime/asset.h"
#include "skinning/layers.h"
#include "supple/supple.h"

namespace supple::runtime {

/// Success, or the first rule of supple.h that `desc` breaks.
[[nodiscard]] Status checkPose(const Asset& asset, const SupplePoseDesc& desc);

// Of what checkPose takes.
[[nodiscard]] skinning::Layer layerOf(const Asset& asset, const SuppleClipLayer& layer);
[[nodiscard]] skinning::RootSelection rootSelection(const Asset& asset, const SupplePoseDesc& desc);
[[nodiscard]] skinning::RootMotion rootMotionOf(const Asset& asset, const SupplePoseDesc& desc);

} // namespace supple::runtime
