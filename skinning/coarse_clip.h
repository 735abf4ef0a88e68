// The coarse twin of a packed clip (skinning/packed_clip.h) as a clip of its own: what plays while segments are
// missing.
#pragma once

#include "cage/character.h"
#include "skinning/clip_table.h"

#include <optional>

namespace supple::skinning {

/// With the clip's channels that are not packed. Nothing if the clip has no twin. Its words must be sound.
[[nodiscard]] std::optional<cage::Clip> coarseClip(const NodeOrder& order, const cage::Clip& clip);

} // namespace supple::skinning
