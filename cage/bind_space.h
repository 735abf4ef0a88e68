// Where meshes without a skin stand in the bind pose.
#pragma once

#include "cage/character.h"
#include "cage/parts.h"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace supple::cage {

/// What the mesh of a node is bound to.
struct MeshBinding {
    uint32_t node = 0;
    bool skinned = false; ///< else `skin` is the node itself, as the only joint
    Skin skin;
};
/// The binding of a mesh without a skin.
[[nodiscard]] MeshBinding bindToNode(uint32_t node);

/// The vertices of a skinned mesh are given in the bind pose, where its joints stand as their inverse bind matrices
/// say. A mesh without a skin is given in the space of its node. If a character has both, or several of the latter,
/// they must stand side by side in one pose: so such a mesh is taken to where its node stands in the bind pose, under
/// the nearest joint above it, or else at rest.
class BindSpace {
public:
    /// The skeleton must outlive the object.
    BindSpace(const Skeleton& skeleton, std::span<const MeshBinding> meshes);

    /// Takes a part without a skin to its place: positions, displacements, faces where the place is mirrored, and the
    /// inverse bind matrix. Does nothing to parts with a skin, and to a mesh that is alone and not mirrored.
    /// Returns false, and does nothing, if numbers would not be coordinates any more (kMaxCoordinate).
    [[nodiscard]] bool place(PartCage& part, MeshBinding& mesh) const;

private:
    [[nodiscard]] glm::dmat4 placeOf(uint32_t node) const;

    const Skeleton& skeleton_;
    bool alone_ = false;
    std::map<uint32_t, glm::dmat4> joints_; ///< where joints stand, by node
};

} // namespace supple::cage
