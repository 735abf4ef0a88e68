// Where meshes stand in the bind pose, those with a skin and those without.
#pragma once

#include "cage/character.h"
#include "cage/parts.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace supple::cage {

/// What the mesh of a node is bound to.
struct MeshBinding {
    uint32_t node = 0;
    bool skinned = false; ///< else `skin` is the node itself, as the only joint
    Skin skin;
    /// The last joint of `skin` is the node itself, for vertices that no joint of the file's moves. So it is until
    /// BindSpace::place() adds joints for what it turns.
    bool hasFollower = false;

    void addFollower();
    /// Joints that the file's skin has.
    [[nodiscard]] size_t skinJoints() const { return skin.joints.size() - (hasFollower ? 1 : 0); }
};
/// The binding of a mesh without a skin.
[[nodiscard]] MeshBinding bindToNode(uint32_t node);

/// Where meshes stand in the bind pose: side by side, in one space, and seen from outside.
///
/// A skinned mesh is given in a space of its own, from which its inverse bind matrices lead to the joints. The one with
/// most joints, the first if there are several, tells what the space of the character is. The others are taken to where
/// the joints stand there that both have, those with most of their weights first; if there are none, to where the rest
/// pose has their joints beside those. So meshes that were quantised on grids of their own fit together again. If a
/// mesh is mirrored as the skeleton rests, the bind pose shows its mirror image: faces are seen from outside in poses
/// then. The same holds for a piece of it whose joints mirror.
///
/// A mesh without a skin is given in the space of its node, and is taken to where the node stands in the bind pose,
/// under the nearest joint above it, or else beside the joints as the rest pose has it. Vertices of a skinned mesh's
/// follower are, too.
class BindSpace {
public:
    /// The skeleton must outlive the object. `parts`: those of `meshes`, one each. `alone`: the character has no other
    /// mesh.
    BindSpace(const Skeleton& skeleton, std::span<const MeshBinding> meshes, std::span<const PartCage> parts,
              bool alone);

    /// Takes a part to its place: positions, displacements, faces where the place is mirrored, and the inverse bind
    /// matrices. Does nothing to parts that stand there, and to a mesh without a skin that is alone and not mirrored.
    /// Returns false, and does nothing, if numbers would not be coordinates any more (kMaxCoordinate), or if inverse
    /// bind matrices of floats would lose the place where a joint takes the part.
    [[nodiscard]] bool place(size_t number, PartCage& part, MeshBinding& mesh) const;

private:
    /// A joint as the first mesh has it that names it.
    struct Joint {
        glm::dmat4 place;      ///< to the space of the character
        glm::mat4 inverseBind; ///< from there
    };

    [[nodiscard]] glm::dmat4 placeOf(uint32_t node) const;
    void addJoints(const MeshBinding& mesh, const glm::dmat4& space);
    [[nodiscard]] glm::dmat4 spaceOf(const MeshBinding& mesh, const PartCage& part);
    /// The space of a mesh that shares no joint with those before: the rest pose says where its joints stand beside
    /// theirs.
    [[nodiscard]] std::optional<glm::dmat4> spaceBesideJoints(const MeshBinding& mesh,
                                                              std::span<const uint32_t> order) const;
    [[nodiscard]] bool placeSkinned(const glm::dmat4& space, PartCage& part, MeshBinding& mesh) const;
    /// `placed`: corners of what the part takes in the space of the character.
    [[nodiscard]] glm::mat4 bindOf(uint32_t node, const glm::mat4& inverseBind, const glm::dmat4& space,
                                   std::span<const glm::dvec4> placed) const;

    const Skeleton& skeleton_;
    std::vector<glm::dmat4> rest_; ///< by node
    bool alone_ = false;
    std::map<uint32_t, Joint> joints_; ///< by node
    std::vector<glm::dmat4> spaces_;   ///< by mesh: to the space of the character; of those with a skin
    std::vector<glm::dmat4> known_;    ///< spaces that differ
};

} // namespace supple::cage
