// The boxes of an asset's clips, each found when it is first asked for.
#pragma once

#include "cage/character.h"
#include "skinning/clip_bounds.h"
#include "supple/supple.h"

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>

namespace supple::runtime {

class ClipBounds {
public:
    /// The box of a clip, or of SUPPLE_BIND_POSE or SUPPLE_REST_POSE. Nothing if there is no such clip.
    [[nodiscard]] std::optional<SuppleBounds> of(const cage::Character& character, uint32_t clip,
                                                 const skinning::ClipBoundsDesc& desc);

private:
    using Key = std::tuple<uint32_t, skinning::SkinningMode, double>;
    std::map<Key, SuppleBounds> found_;
};

} // namespace supple::runtime
