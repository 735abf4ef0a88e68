// KHR_materials_variants: other materials for the same primitives. Private to cage/gltf/.
#pragma once

#include "cage/gltf/document.h"

#include <string>
#include <vector>

namespace supple::cage::gltf {

/// Gives the primitives of document.model the materials that they have in a variant, and returns the names of all
/// variants of the file, each once. An empty name: the file's own materials. What is malformed is left out. Throws
/// Refusal, if there is no such variant.
[[nodiscard]] std::vector<std::string> chooseVariant(Document& document, const std::string& name);

} // namespace supple::cage::gltf
