// Skinning data of a glTF file: joints, inverse bind matrices, weights of vertices. Private to cage/gltf/. All of these
// throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <cstddef>
#include <cstdint>
#include <span>
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

/// The influences of vertices that are appended one after the other: by joint, normalised, at least one a vertex.
class VertexWeights {
public:
    /// Vertices of a mesh without a skin: bound to joint 0.
    void appendUnskinned(size_t count);
    /// Vertices of a skin of `jointCount` joints.
    void append(const Document& document, const SkinSets& sets, size_t count, size_t jointCount,
                const std::string& element);

    [[nodiscard]] std::span<const Influence> of(uint32_t vertex) const;

    /// Warns of what had to be repaired.
    void report(const std::string& element, Warnings& warnings) const;

private:
    void closeVertex() { starts_.push_back(static_cast<uint32_t>(influences_.size())); }

    std::vector<uint32_t> starts_{0};
    std::vector<Influence> influences_;
    size_t renormalised_ = 0;
    size_t unweighted_ = 0;
    double largestDeviation_ = 0.0;
};

} // namespace supple::cage::gltf
