// SUPPLE_deformers of a glTF file: how a mesh is deformed. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"

#include <optional>
#include <string>
#include <vector>

namespace supple::cage::gltf {

inline constexpr const char* kDeformers = "SUPPLE_deformers";
/// The extension of a mesh; null: it has none, or no object.
[[nodiscard]] const Json* deformersOf(const Json& mesh);

/// `skinning`, if the mesh says it. Throws Refusal.
[[nodiscard]] std::optional<SkinningMode> readSkinningMode(const Json& mesh, const std::string& element);

/// `smoothing` of delta mush, if the mesh says it.
struct SmoothingFields {
    std::optional<Smoothing> numbers;
    std::string mask; ///< the attribute that has it; empty: there is none
};
/// Leaves out what is wrong, with a warning.
[[nodiscard]] SmoothingFields readSmoothing(const Document& document, size_t meshIndex);

/// Appends the mask of a primitive's `count` vertices, which begin at `firstVertex`: 1 where it has none. Weights that
/// cannot be read are left out, with a warning.
void appendMushMask(const Document& document, int accessor, size_t firstVertex, size_t count, const std::string& name,
                    std::vector<float>& mask);

} // namespace supple::cage::gltf
