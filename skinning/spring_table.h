// The springs of a character in the layout that the pose pass reads (shaders/shared/pose.h).
#pragma once

#include "cage/character.h"
#include "skinning/clip_table.h"

#include <cstdint>

namespace supple::skinning {

/// Appends them to a table that has nodes, and tells these which are needed. Nothing if no joint swings. Joints swing
/// that have a tail, move a joint of the skin, and have no fixed matrix.
void putSprings(const cage::Character& character, ClipTable& table);

} // namespace supple::skinning
