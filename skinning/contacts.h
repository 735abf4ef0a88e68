// Where clips have feet on the ground: found once, so that a foot can be held there at any time, without a memory of
// what it did.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::skinning {

/// A joint with two above it, a leg, that is near the ground in the rest pose; toes, which hang on one, are none.
/// Lengths are those of the rest pose.
struct Foot {
    uint32_t node = cage::kNone;
    double leg = 0.0;    ///< from the root of the limb to its end, along the bones
    double height = 0.0; ///< of the joint over its sole: the lowest vertex that follows it or what hangs on it
    double sole = 0.0;   ///< of the sole over model space's origin
};

/// A time in which a foot stands. Its place is that of model space as the clip has it, on the ground: x and z.
struct Contact {
    /// Seconds of the clip. One that goes on over the end of a loop is there twice, and leaves the clip at one end.
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

/// A foot stands while its joint is no more than 5 % of the leg higher than where the clip has it lowest, and slower
/// than kContactSpeed legs a second against the ground. The ground moves as the median of all feet that are so low
/// does. Where a clip never comes near the height of the rest pose, say where it swims, nothing stands.
[[nodiscard]] Contacts findContacts(const cage::Character& character);

} // namespace supple::skinning
