// KHR_draco_mesh_compression: primitives whose vertices and triangles are encoded. Private to cage/gltf/.
#pragma once

#include "cage/gltf/document.h"

namespace supple::cage::gltf {

inline constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Decodes the primitives of document.model that have no bytes of their own: the model gets accessors, bufferViews and
/// buffers behind the file's own, and these primitives name them. One that cannot be decoded becomes broken. One
/// warning in all. Throws Refusal.
void decodeDraco(Document& document);

} // namespace supple::cage::gltf
