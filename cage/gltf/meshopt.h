// EXT_meshopt_compression and KHR_meshopt_compression: bufferViews that hold their bytes in encoded form. Private to
// cage/. All of these throw Refusal.
#pragma once

#include "cage/gltf/document.h"
#include "cage/gltf/json.h"

#include <cstdint>
#include <vector>

namespace supple::cage::gltf {

/// Per buffer: 1 where it stands in for the decoded bytes, and is not read.
[[nodiscard]] std::vector<uint8_t> findPlaceholders(const Json& root);

/// Decodes what is compressed, gives every such bufferView a buffer of its own in the document, and fills
/// document.decodedInto. One warning in all.
void decodeMeshopt(const Json& root, Document& document);

} // namespace supple::cage::gltf
