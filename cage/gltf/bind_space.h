// Where meshes without a skin stand in the bind pose. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/parts.h"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace supple::cage::gltf {

/// The vertices of a skinned mesh are given in the bind pose, where its joints stand as their inverse bind matrices
/// say. A mesh without a skin is given in the space of its node. If a character has both, or several of the latter,
/// they must stand side by side in one pose: so such a mesh is taken to where its node stands in the bind pose, under
/// the nearest joint above it, or else at rest.
class BindSpace {
public:
    /// `nodes` carry the meshes; `skins`: one each. Both must outlive the object.
    BindSpace(const Document& document, const Skeleton& skeleton, std::span<const uint32_t> nodes,
              std::span<const Skin> skins);

    /// Takes a part without a skin to its place: positions, displacements, faces where the place is mirrored, and the
    /// inverse bind matrix. Does nothing to parts with a skin, and to a mesh that is alone and not mirrored.
    /// Returns false, and does nothing, if numbers would not be coordinates any more (kMaxCoordinate).
    [[nodiscard]] bool place(PartCage& part, Skin& skin) const;

private:
    [[nodiscard]] glm::dmat4 placeOf(uint32_t node) const;

    const Document& document_;
    const Skeleton& skeleton_;
    bool alone_ = false;
    std::map<uint32_t, glm::dmat4> joints_; ///< where joints stand, by node
};

} // namespace supple::cage::gltf
