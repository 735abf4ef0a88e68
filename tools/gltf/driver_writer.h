// Writes pose drivers as SUPPLE_deformers has them. Private to tools/gltf/.
#pragma once

#include "cage/character.h"
#include "tools/gltf/packer.h"

#include <span>

namespace supple::cage::gltf {

/// `drivers` of a mesh, whose own morph targets they name.
[[nodiscard]] json writeDrivers(std::span<const PoseDriver> drivers, Packer& packer);

} // namespace supple::cage::gltf
