// Extensions of nodes that say what is drawn. Private to cage/gltf/.
#pragma once

#include "cage/gltf/json.h"
#include "cage/gltf/model.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage::gltf {

inline constexpr const char* kNodeVisibility = "KHR_node_visibility";

/// Throws Refusal if a node's KHR_node_visibility is wrong. The node is visible then.
void checkVisibility(const Json& node, const std::string& element);

/// Whether a checked node says that it is hidden, and all that is below it.
[[nodiscard]] bool saysHidden(const Json& node);

/// Per node the one that hides it, itself or one above; kNone where it is visible.
[[nodiscard]] std::vector<uint32_t> findHiders(const file::Model& model);

} // namespace supple::cage::gltf
