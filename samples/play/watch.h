// Looks at what is shown, and says afterwards what a test wants to know.
#pragma once

#include "game.h"

namespace play {

class Watch {
public:
    explicit Watch(const Game& game);
    /// After each frame. vertices: of the surface.
    void see(const Game& game, std::span<const glm::vec3> vertices, float seconds);
    /// A line each: a name and a number.
    void print() const;

private:
    void seeJoints(const Game& game, float seconds);
    void seeFeet(const Game& game);

    BodyPose last_;
    std::array<float, kPoints> lengths_{}; ///< from the parents, at first
    Game::State lastState_ = Game::State::walks;
    std::optional<glm::vec2> goal_;
    uint32_t arrivals_ = 0, falls_ = 0, rises_ = 0;
    uint32_t standing_ = 0; ///< feet that were looked at
    float fromGoal_ = 0.0f; ///< the farthest from a goal at which it stopped
    float sole_ = 0.0f;     ///< the farthest of a standing ankle from its height above the ground
    float stretch_ = 0.0f;  ///< the most that a bone has changed its length by, as a part of it
    float fastest_ = 0.0f;  ///< joint, in units a second
    float deepest_ = 0.0f;  ///< vertex below the ground
    float inGround_ = 0.0f; ///< the same while it walks
    float lying_ = 1e9f;    ///< the lowest height of the hips above the ground
    uint64_t words_ = 0;    ///< a hash of all poses
    bool finite_ = true;
};

} // namespace play
