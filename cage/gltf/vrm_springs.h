// The spring bones of VRM files. Private to cage/gltf/.
#pragma once

#include "cage/gltf/document.h"

namespace supple::cage::gltf {

/// Those of VRM 1.0 (VRMC_springBone) or, where there are none, of 0.x (secondaryAnimation), whose bones stand for all
/// that is below them. They are data: nothing moves by them yet. The skeleton must be read. Entries that make no sense
/// are left out, with a warning for each list.
[[nodiscard]] SpringBones readSpringBones(const Document& document, const Skeleton& skeleton, Warnings& warnings);

} // namespace supple::cage::gltf
