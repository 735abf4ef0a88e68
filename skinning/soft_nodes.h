// What steps of soft vertices, which jiggle or are cloth, need of poses.
#pragma once

#include "cage/character.h"
#include "skinning/clip_table.h"

#include <cstdint>
#include <vector>

namespace supple::skinning {

/// Vertices that jiggle: painted as such, and not as cloth.
[[nodiscard]] bool jiggles(const cage::Character& character, uint32_t vertex);

/// What it takes to deform each vertex of the cage, however it is skinned: displacements of morph targets, and pairs of
/// influences or, with delta mush, as many as a vertex may have of these.
[[nodiscard]] std::vector<uint32_t> deformWork(const cage::Character& character);

/// Tells the nodes of a clip table which of them soft vertices need: joints that move them or what they hang on, joints
/// of cloths' colliders, what these hang on, and what drivers look at.
void markSoftNodes(const cage::Character& character, ClipTable& table);

} // namespace supple::skinning
