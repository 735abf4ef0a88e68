// Where clips have feet on the ground: found once, so that a foot can be held there at any time, without a memory of
// what it did.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::skinning {

/// The end of a limb that hangs down to the ground in the rest pose. A joint below another foot is a toe and does not
/// count. Lengths are those of the rest pose.
struct Foot {
    uint32_t node = cage::kNone;
    double leg = 0.0;    ///< from the root of the limb to its end, along the bones
    double height = 0.0; ///< of the joint over its sole: the lowest vertex that follows it or what hangs on it
    double sole = 0.0;   ///< of the sole over model space's origin
};

/// A time in which a foot stands. Its place is that of model space as the clip has it, on the ground: x and z.
struct Contact {
    /// Seconds of the clip. A contact that spans the end of a loop is stored twice; each copy reaches beyond the clip.
    double begin = 0.0, end = 0.0;
    glm::dvec2 place{0.0}; ///< at the clip's time 0
    glm::dvec2 drift{0.0}; ///< a second: what the ground moves by where the character walks in place
};

struct Contacts {
    std::vector<Foot> feet;
    std::vector<std::vector<Contact>> ofClips; ///< one run for every foot of a clip; by rising time

    [[nodiscard]] const std::vector<Contact>& of(size_t clip, size_t foot) const {
        return ofClips[clip * feet.size() + foot];
    }
};

/// At most so many feet.
constexpr size_t kMostFeet = 16;

/// A foot stands while its joint is no more than 5 % of the leg higher than where the clip has it lowest, slower than
/// 0.4 legs a second against the ground, and within 5 % of the leg of the place where it stands. The ground rests,
/// unless the feet that are so low move: then it moves as the median of them. Where a clip never comes near the height
/// of the rest pose, say where it swims, nothing stands; nor in clips of more than five minutes, or once two million
/// poses of nodes have been looked at.
[[nodiscard]] Contacts findContacts(const cage::Character& character);

} // namespace supple::skinning
