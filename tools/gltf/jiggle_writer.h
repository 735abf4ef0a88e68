// Writes what jiggles as SUPPLE_deformers has it. Private to tools/gltf/.
#pragma once

#include "cage/character.h"
#include "tools/gltf/packer.h"

#include <cstddef>
#include <span>
#include <string>

namespace supple::cage::gltf {

/// The attribute with the weights of a mesh's own jiggle.
[[nodiscard]] std::string jiggleAttribute(size_t jiggle);
/// `jiggle` of a mesh, of its own.
[[nodiscard]] json writeJiggles(std::span<const Jiggle> jiggles);

} // namespace supple::cage::gltf
