// A body that was knocked over: the ragdoll has its joints, until it gets up.
#pragma once

#include "hero.h"
#include "ragdoll.h"

namespace play {

/// Where somebody who gets up comes to stand.
struct Standing {
    glm::vec2 place;
    float heading;
};

class Fall {
public:
    /// From now on the joints are where the ragdoll has them. `before`: the pose of some seconds ago.
    Fall(const Hero& hero, const BodyPose& before, float seconds, glm::vec3 push);
    void update(const Hero& hero, float seconds);

    [[nodiscard]] bool isOver() const;
    [[nodiscard]] bool isOnBack() const { return ragdoll_.facing().y > 0.0f; }
    /// Above its feet, about, and the way that these point.
    [[nodiscard]] Standing standing() const;
    /// Hands all joints over, in the character's model space as it is now.
    void handOver(const Hero& hero) const;

private:
    Ragdoll ragdoll_;
};

} // namespace play
