// Skinning data of a glTF file: joints, inverse bind matrices, weights of vertices. Private to cage/gltf/. All of these
// throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/vertex_weights.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// The skin of a node; where it has none, the node itself as the only joint. `restPlaces`: by node
/// (cage/skeleton.h), for joints whose inverse bind matrices are missing.
[[nodiscard]] Skin readSkin(const Document& document, std::span<const glm::dmat4> restPlaces, uint32_t meshNode);

/// The accessors of JOINTS_n and WEIGHTS_n, n = 0, 1, ...
struct SkinSets {
    std::vector<int> joints;
    std::vector<int> weights;
};

/// Whether a primitive has the set 0, without which no skin moves it.
[[nodiscard]] bool hasSkinSets(const file::Primitive& primitive);

/// The sets that continue from 0. None: the primitive is not skinned, and hangs on its node.
[[nodiscard]] SkinSets findSkinSets(const Document& document, const file::Primitive& primitive,
                                    const std::string& element);

/// Appends the influences of vertices of a skin of `jointCount` joints. Appends nothing if it throws.
void appendWeights(const Document& document, const SkinSets& sets, size_t count, size_t jointCount,
                   const std::string& element, VertexWeights& weights);

} // namespace supple::cage::gltf
