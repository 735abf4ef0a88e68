// What channels of KHR_animation_pointer move. Private to cage/gltf/.
#pragma once

#include "cage/gltf/model.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace supple::cage::gltf {

/// A channel of which `pointer` moves a node's translation, rotation, scale or weights becomes one that names the node
/// and the path. Every other one is left as it is. Throws Refusal if there is no such node.
void resolvePointer(size_t nodeCount, const std::string& element, file::AnimationChannel& channel);

/// The pointer with * in place of each index: what kind of thing it moves.
[[nodiscard]] std::string kindOfPointer(std::string_view pointer);

} // namespace supple::cage::gltf
