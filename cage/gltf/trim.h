// Trims of a glTF file: material.extras.trim, and the tiles that vertices of a primitive name. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/gltf/mesh.h"
#include "cage/message.h"

#include <cstddef>
#include <optional>
#include <span>

namespace supple::cage::gltf {

/// Nothing where the material has none. Throws Refusal: what is trimmed by a wrong trim is the shape itself.
[[nodiscard]] std::optional<Trim> readTrim(const Document& document, size_t material, Warnings& warnings);

/// Fills trimTiles of the primitive, and refuses one that lacks what its material's trim needs.
void readTrimTiles(const Document& document, const file::Primitive& from, std::span<const Material> materials,
                   split::Primitive& primitive);

} // namespace supple::cage::gltf
