// The spring bones of VRM files. Private to cage/gltf/.
#pragma once

#include "cage/gltf/document.h"

#include <cstdint>
#include <vector>

namespace supple::cage::gltf {

struct ReadSprings {
    SpringBones bones;
    std::vector<uint32_t> colliders; ///< SpringBones::colliders by the numbers of the file; kNone: it is left out
};

/// Those of VRM 1.0 (VRMC_springBone) or, where there are none, of 0.x (secondaryAnimation), whose bones stand for all
/// that is below them. The skeleton must be read. Entries that make no sense are left out, with a warning for each
/// list.
[[nodiscard]] ReadSprings readSpringBones(const Document& document, const Skeleton& skeleton, Warnings& warnings);

} // namespace supple::cage::gltf
