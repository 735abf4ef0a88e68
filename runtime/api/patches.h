// The patches of a surface as hosts see them.
#pragma once

#include "supple/supple.h"
#include "surface/patch_class.h"
#include "surface/scheme.h"

#include <algorithm>
#include <span>

namespace supple::api {

/// Copies as many as fit and reports how many there are.
inline SuppleResult fillPatches(std::span<const surface::PatchInfo> patches, SupplePatchInfo* out, uint32_t* count) {
    const auto total = static_cast<uint32_t>(patches.size());
    const uint32_t n = out == nullptr ? 0 : std::min(*count, total);
    for (uint32_t i = 0; i < n; ++i) {
        out[i].face = patches[i].face;
        out[i].patchClass = static_cast<SupplePatchClass>(patches[i].patchClass);
        out[i].cornerCount = patches[i].cornerCount;
        out[i].coefficientCount = surface::rowOf(patches[i].patchClass).coefficients;
        std::copy(patches[i].corners.begin(), patches[i].corners.end(), out[i].corners);
    }
    *count = total;
    return out != nullptr && n < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
}

} // namespace supple::api
