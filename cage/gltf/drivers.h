// Pose drivers of a glTF file: `drivers` of SUPPLE_deformers. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"
#include "cage/parts.h"

#include <span>
#include <vector>

namespace supple::cage::gltf {

/// Those of a mesh, with its own morph targets, of which there are `targetCount`.
[[nodiscard]] std::vector<PoseDriver> readDrivers(const Document& document, size_t meshIndex, size_t targetCount,
                                                  const Skeleton& skeleton);

/// Leaves out those that look at joints of springs, which swing after drivers have looked, those without a solution,
/// and what all parts have together beyond kMaxDriverWork. Warns of poses that are hard to tell apart. Drivers of parts
/// that will share their morph targets count once. The character has its nodes, springs and clips.
void checkDrivers(const Document& document, const Character& character, std::span<PartCage> parts, Warnings& warnings);

} // namespace supple::cage::gltf
