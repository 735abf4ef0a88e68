// A tube with a clip that bends it, for tests of what is asked of posed surfaces.
#pragma once

#include "tests/support/rigged_tube.h"

#include <glm/gtc/quaternion.hpp>

namespace supple::test {

/// Its clip turns the second joint by 0.9 radians within a second.
inline cage::Character bentTube(uint32_t sides = 7) {
    cage::Character tube = riggedTube({.segments = 5, .sides = sides});
    tube.name = "tube";
    const glm::quat turn = glm::angleAxis(0.9f, glm::vec3(0, 0, 1));
    tube.clips.push_back(
        clipOf({channel(2, cage::ChannelPath::rotation, {0, 1}, {0, 0, 0, 1, turn.x, turn.y, turn.z, turn.w})}));
    return tube;
}

} // namespace supple::test
