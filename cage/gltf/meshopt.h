// EXT_meshopt_compression and KHR_meshopt_compression: bufferViews that hold their bytes in encoded form. Private to
// cage/. All of these throw Refusal.
#pragma once

#include "cage/gltf/document.h"
#include "cage/gltf/json.h"

#include <cstdint>
#include <vector>

namespace supple::cage::gltf {

/// Per buffer: 1 where it stands in for the decoded bytes, and is not read.
[[nodiscard]] std::vector<uint8_t> findPlaceholders(const json& root);

/// Decodes what is compressed, gives every such bufferView of `root` a buffer of its own in the document, and takes the
/// extension off it: the rest of the reader sees plain bufferViews. One warning in all.
void decodeMeshopt(json& root, Document& document);

} // namespace supple::cage::gltf
