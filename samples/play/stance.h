// A body that stands or walks: feet on the ground, hips as low as they need, eyes on what the player points at.
#pragma once

#include "ground.h"
#include "hero.h"

namespace play {

class Stance {
public:
    /// Sets the modifiers. They take hold bit by bit.
    void begin(const Hero& hero, glm::vec3 lookAt);
    /// Their targets: the ground under the feet, and where to look.
    void update(const Hero& hero, glm::vec3 lookAt, float seconds);

    [[nodiscard]] float weight() const { return weight_; }
    /// What the left and the right foot were told to stand on.
    [[nodiscard]] const Footing& footing(uint32_t foot) const { return footings_[foot]; }

private:
    void setTargets(const Hero& hero) const;

    std::array<Footing, 2> footings_;
    glm::vec3 lookAt_{0.0f};
    float weight_ = 0.0f;
};

} // namespace play
