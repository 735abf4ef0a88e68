// The game: what the player wants, and what the character does about it.
#pragma once

#include "fall.h"
#include "rise.h"
#include "stance.h"
#include "walker.h"

#include <optional>

namespace play {

/// What one frame asks for.
struct Input {
    std::optional<glm::vec2> goal; ///< go there
    std::optional<glm::vec3> push; ///< a blow: the speed that it gives
    glm::vec3 lookAt{0.0f};
};

class Game {
public:
    enum class State : uint8_t { walks, falls, rises };

    explicit Game(Hero& hero);

    /// One frame. `seconds` have passed since the last one; 0 in the first.
    void update(const Input& input, float seconds);

    [[nodiscard]] State state() const { return state_; }
    [[nodiscard]] const Walker& walker() const { return walker_; }
    [[nodiscard]] const Stance& stance() const { return stance_; }
    /// It stands, and nothing is left of how it came to that.
    [[nodiscard]] bool isAtRest() const;
    /// The pose that is shown.
    [[nodiscard]] const BodyPose& pose() const { return pose_; }

private:
    void setTransform();
    void walk(const Input& input, float seconds);
    void changeGait(Gait gait, double transition);
    /// Of the steps that are played, from 0 to 1.
    [[nodiscard]] double cyclePart() const;
    void beHit(const Input& input, float seconds);
    void fall(float seconds);
    void getUp();
    void rise(const Input& input);
    void standUp(const Input& input);

    Hero& hero_;
    State state_ = State::walks;
    Walker walker_;
    Stance stance_;
    std::optional<Fall> fall_;
    std::optional<Rise> rise_;
    Gait gait_ = Gait::stand; ///< whose clip is played
    double gaitStart_ = 0.0, gaitOffset_ = 0.0;
    float lift_ = 0.0f; ///< of the character above where it would stand
    BodyPose pose_{};
};

} // namespace play
