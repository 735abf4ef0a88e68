// Pose drivers of a glTF file: `drivers` of SUPPLE_deformers. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"
#include "cage/parts.h"

#include <span>
#include <vector>

namespace supple::cage::gltf {

/// Those of a mesh, with its own morph targets, of which there are `targetCount`. Each that cannot be solved is left
/// out.
[[nodiscard]] std::vector<PoseDriver> readDrivers(const Document& document, size_t meshIndex, size_t targetCount,
                                                  const Skeleton& skeleton, Warnings& warnings);

/// Leaves out those that look at joints of springs, which swing after drivers have looked, and what all parts have
/// together beyond kMaxDriverWork.
void checkDrivers(const Document& document, const Skeleton& skeleton, const SpringBones& springs,
                  std::span<PartCage> parts);

} // namespace supple::cage::gltf
