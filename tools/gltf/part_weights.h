// The morph weights of a part as glTF has them: one channel for all its targets. Private to tools/gltf/.
#pragma once

#include "cage/character.h"

#include <optional>
#include <span>

namespace supple::cage::gltf {

/// Whether a channel of weights is one of some targets of the part.
[[nodiscard]] bool setsWeightsOf(const Channel& channel, const Part& part);

/// What a clip says of a part's targets; nothing if it says nothing. Packed clips have channels of a few targets, which
/// may be those of several parts: these become one with the keys of all. `rest`: the weights that no channel sets.
[[nodiscard]] std::optional<Channel> partWeights(const Clip& clip, const Part& part, std::span<const float> rest);

} // namespace supple::cage::gltf
