// Writes how delta mush smooths a part as SUPPLE_deformers has it. Private to tools/gltf/.
#pragma once

#include "cage/character.h"
#include "tools/gltf/packer.h"

namespace supple::cage::gltf {

/// The attribute with SkinWeights::mushMask.
inline constexpr const char* kMushMaskAttribute = "_SUPPLE_MUSH";

/// Whether a character of one part says something of it.
[[nodiscard]] bool saysSmoothing(const Character& part);
/// `smoothing` of its mesh.
[[nodiscard]] json writeSmoothing(const Character& part);

} // namespace supple::cage::gltf
