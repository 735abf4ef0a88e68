// The controller: where the character stands, and how it comes to where it is sent.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

namespace play {

enum class Gait : uint8_t { stand, walk, run };
/// Units a second, of each gait.
using GaitSpeeds = std::array<float, 3>;

class Walker {
public:
    Walker(const GaitSpeeds& speeds, glm::vec2 place, float heading)
        : speeds_(speeds), place_(place), heading_(heading) {
        settle();
    }

    void goTo(glm::vec2 goal) { goal_ = goal; }
    /// Is somewhere else at once, and stands. The goal stays.
    void teleport(glm::vec2 place, float heading);
    void update(float seconds);

    [[nodiscard]] Gait gait() const { return gait_; }
    [[nodiscard]] glm::vec2 place() const { return place_; }
    [[nodiscard]] float speed() const { return speed_; }
    [[nodiscard]] float heading() const { return heading_; }
    [[nodiscard]] const std::optional<glm::vec2>& goal() const { return goal_; }
    /// Where the character's model space lies in the world.
    [[nodiscard]] glm::mat4 transform() const;

private:
    void step(float seconds);
    void chooseGait();
    /// At the height of the ground.
    void settle();

    GaitSpeeds speeds_;
    glm::vec2 place_;
    float heading_; ///< radians from +Z towards +X
    float height_ = 0.0f;
    float speed_ = 0.0f;
    Gait gait_ = Gait::stand;
    std::optional<glm::vec2> goal_;
};

} // namespace play
