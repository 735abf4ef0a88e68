// Clips of one skeleton for another one: once, when a character is read, in double.
#pragma once

#include "cage/character.h"
#include "cage/clip_set.h"
#include "skinning/roles.h"

#include <optional>
#include <string>
#include <vector>

namespace supple::skinning {

/// In the order of SuppleRetargeting.
enum class Retargeting : uint8_t {
    differing, ///< retargets sets of clips whose skeleton is another one than the character's, if both are bipeds
    never,     ///< leaves all as they are: clips move nodes of their names
    all,       ///< retargets all sets, and refuses those of which it cannot be done
    freeFeet   ///< as `all`, and legs keep the angles of the clip: ankles go where these take them
};

/// A node of the clips' skeleton and its counterpart among the character's.
struct JointPair {
    std::optional<Role> role; ///< of both; none: the one turns as the other does
    std::string from, to;     ///< one may be empty if there is a role: then it is found
};

struct RetargetOptions {
    Retargeting retargeting = Retargeting::differing;
    std::vector<JointPair> pairs; ///< go before what names and structure say
    bool strict = false;          ///< refuses clips whose ankles a leg does not reach
};

/// Makes the clips of a set move `to`: afterwards the set's skeleton is `to`, and ClipSet::isFitted. Warnings of the
/// set tell what was done.
///
/// Some sets are left as they are: those of the same skeleton, that is, whose joints have the names of the character's,
/// in the same roles, with the same bones, each in its parent's frame; those of which one of the skeletons has no hips
/// above two legs, or does not stand upright (ClipSet::whyNotFitted). Who asks for retargeting, or gives pairs, gets
/// the first retargeted, and a Refusal of the others.
///
/// The formulas are those of model space. D is how a joint of the clip is turned from its rest; C0 is the yaw from the
/// one skeleton's left-to-right to the other's. A joint with a role is turned from its own rest by C0 D C0^-1, limbs
/// besides by C, from the direction of the bone in its rest to that of the other skeleton's: so arms that rest level
/// and arms that hang down come to the same place. Hands, and what hangs on a limb, take the C of the bone above them.
/// Joints between two of a limb turn as the upper one, those between hips and neck by their share of the way. Joints
/// without a role turn, and are moved, as the node of their name. The hips go where the clip's go from their rest, by
/// the ratio of the heights of the hips over the ankles. Then legs bend so that ankles go where those of the clip go,
/// by the same ratio, and feet keep their rotation. What has no counterpart stays at rest.
///
/// Keys lie where the clip has some, closer if these are far apart. Throws cage::Refusal.
void fitClips(const RetargetOptions& options, const cage::Skeleton& to, cage::ClipSet& set);

} // namespace supple::skinning
