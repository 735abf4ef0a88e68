// Getting up: the transition from lying to a clip, and what a body does besides.
#pragma once

#include "hero.h"

namespace play {

class Rise {
public:
    /// The transition starts from what the modifiers have made of the pose, and takes their place.
    explicit Rise(const Hero& hero);
    void update(const Hero& hero);

    [[nodiscard]] bool isOver(const Hero& hero) const;
    /// How far the character has to go up so that its lowest point lies on the ground.
    [[nodiscard]] static float toGround(const Hero& hero);

private:
    double start_;
};

} // namespace play
