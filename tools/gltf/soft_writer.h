// Writes what jiggles and what is cloth as SUPPLE_deformers has it. Private to tools/gltf/.
#pragma once

#include "cage/character.h"
#include "tools/gltf/packer.h"

#include <cstddef>
#include <span>
#include <string>

namespace supple::cage::gltf {

/// The attribute with the weights of a mesh's own jiggle or cloth.
[[nodiscard]] std::string jiggleAttribute(size_t jiggle);
[[nodiscard]] std::string clothAttribute(size_t cloth);
/// `jiggle` and `cloth` of a mesh, of its own.
[[nodiscard]] json writeJiggles(std::span<const Jiggle> jiggles);
[[nodiscard]] json writeCloths(std::span<const Cloth> cloths);

} // namespace supple::cage::gltf
