#include "walker.h"

#include "ground.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace play {

namespace {

constexpr float kWalkStep = 1.0f / 120.0f;
constexpr float kRunFrom = 2.2f;      ///< away from the goal; it walks the rest from half of that
constexpr float kAcceleration = 3.0f; ///< a gait is reached about when its clip has come over
constexpr float kTurnRate = 2.4f, kTurnGain = 5.0f;
constexpr float kNearTurnRate = 5.0f; ///< beside the goal, so that it does not circle round it
constexpr float kHeightSeconds = 0.12f;

/// An angle the shorter way round.
float shorter(float angle) {
    return std::remainder(angle, glm::two_pi<float>());
}

/// The mean of the ground under both feet, about.
float standingHeight(glm::vec2 place) {
    constexpr float kReach = 0.15f;
    float sum = 0.0f;
    for (const glm::vec2 aside :
         {glm::vec2(kReach, 0.0f), glm::vec2(-kReach, 0.0f), glm::vec2(0.0f, kReach), glm::vec2(0.0f, -kReach)})
        sum += 0.25f * heightAt(place + aside);
    return sum;
}

} // namespace

void Walker::teleport(glm::vec2 place, float heading) {
    place_ = place;
    heading_ = heading;
    speed_ = 0.0f;
    gait_ = Gait::stand;
    settle();
}

void Walker::settle() {
    height_ = standingHeight(place_);
}

void Walker::update(float seconds) {
    const int steps = std::max(1, static_cast<int>(std::lround(seconds / kWalkStep)));
    for (int i = 0; i < steps; ++i)
        step(seconds / static_cast<float>(steps));
}

void Walker::chooseGait() {
    const float away = goal_ ? glm::distance(*goal_, place_) : 0.0f;
    const float walk = speeds_[static_cast<uint32_t>(Gait::walk)];
    if (away < 0.5f * walk * walk / kAcceleration) // what she still goes while she stops
        goal_.reset();
    if (!goal_)
        gait_ = Gait::stand;
    else if (away > (gait_ == Gait::run ? 0.5f * kRunFrom : kRunFrom))
        gait_ = Gait::run;
    else
        gait_ = Gait::walk;
}

void Walker::step(float seconds) {
    chooseGait();
    if (goal_) {
        const glm::vec2 way = *goal_ - place_;
        const float off = shorter(std::atan2(way.x, way.y) - heading_);
        const float rate = glm::length(way) < 0.7f ? kNearTurnRate : kTurnRate;
        heading_ = shorter(heading_ + seconds * std::clamp(kTurnGain * off, -rate, rate));
    }
    const float wanted = speeds_[static_cast<uint32_t>(gait_)], most = kAcceleration * seconds;
    speed_ += std::clamp(wanted - speed_, -most, most);
    place_ += seconds * speed_ * glm::vec2(std::sin(heading_), std::cos(heading_));
    height_ += (standingHeight(place_) - height_) * (1.0f - std::exp(-seconds / kHeightSeconds));
}

glm::mat4 Walker::transform() const {
    return glm::rotate(glm::translate(glm::mat4(1.0f), {place_.x, height_, place_.y}), heading_,
                       glm::vec3(0.0f, 1.0f, 0.0f));
}

} // namespace play
