// Getting up: the transition from lying to a clip, and what a body does besides.
#pragma once

#include "hero.h"

namespace play {

/// How a joint is turned while the transition is under way: the body curls up with it, instead of rising like a board.
struct Bend {
    Point point;
    float angle; ///< about +X, in radians: positive leans forwards
};

class Rise {
public:
    /// The transition starts from what the modifiers have made of the pose, and takes their place.
    Rise(const Hero& hero, bool isOnBack);
    void update(const Hero& hero);

    [[nodiscard]] bool isOver(const Hero& hero) const;
    /// How far the character has to go up so that its lowest point lies on the ground.
    [[nodiscard]] static float toGround(const Hero& hero);

private:
    std::span<const Bend> bends_;
    double start_;
};

} // namespace play
