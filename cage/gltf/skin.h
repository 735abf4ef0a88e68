// Skinning data of a glTF file: joints, inverse bind matrices, weights of vertices. Private to cage/gltf/. All of these
// throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/vertex_weights.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// The skin of a node; where it has none, the node itself as the only joint.
[[nodiscard]] Skin readSkin(const Document& document, uint32_t meshNode);

/// The accessors of JOINTS_n and WEIGHTS_n, n = 0, 1, ...
struct SkinSets {
    std::vector<int> joints;
    std::vector<int> weights;
};

/// At least one set; refuses numbers that do not continue from 0.
[[nodiscard]] SkinSets findSkinSets(const file::Primitive& primitive, const std::string& element);

/// Appends the influences of vertices of a skin of `jointCount` joints.
void appendWeights(const Document& document, const SkinSets& sets, size_t count, size_t jointCount,
                   const std::string& element, VertexWeights& weights);

} // namespace supple::cage::gltf
