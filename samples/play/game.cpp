#include "game.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace play {

namespace {

constexpr glm::vec2 kStartPlace{-2.5f, 0.45f};
constexpr float kStartHeading = 1.2f;

constexpr const char* kClips[] = {"idle", "walk", "run"}; ///< by Gait
/// A part of the walk's cycle at which one foot passes the other, as in standing.
constexpr double kPassing = 0.22;

constexpr double kStandTransition = 0.5;
constexpr float kSettleSeconds = 0.1f;

} // namespace

Game::Game(Hero& hero) : hero_(hero), walker_(kStartPlace, kStartHeading) {
    hero.setTime(0.0);
    hero.setTransform(walker_.transform());
    hero.play("idle", {});
    stance_.begin(hero, onGround(kStartPlace));
    pose_ = hero.pose();
}

bool Game::isAtRest() const {
    return state_ == State::walks && gait_ == Gait::stand && walker_.speed() == 0.0f &&
           hero_.time() - gaitStart_ > kStandTransition;
}

void Game::update(const Input& input, float seconds) {
    hero_.setTime(hero_.time() + static_cast<double>(seconds));
    if (input.push && state_ != State::falls && seconds > 0.0f)
        beHit(input, seconds);
    switch (state_) {
    case State::walks:
        walk(input, seconds);
        break;
    case State::falls:
        fall(input, seconds);
        break;
    case State::rises:
        rise(input);
        break;
    }
    pose_ = hero_.pose();
}

void Game::place() {
    hero_.setTransform(glm::translate(glm::mat4(1.0f), {0.0f, lift_, 0.0f}) * walker_.transform());
}

void Game::walk(const Input& input, float seconds) {
    if (input.goal)
        walker_.goTo(*input.goal);
    walker_.update(seconds);
    lift_ *= std::exp(-seconds / kSettleSeconds);
    place();
    if (walker_.gait() != gait_)
        changeGait(walker_.gait());
    stance_.update(hero_, input.lookAt, seconds);
}

/// Steps go on where they are: the walk's cycle and the run's begin with the same foot.
void Game::changeGait(Gait gait) {
    const double duration = hero_.duration(kClips[static_cast<uint32_t>(gait)]);
    double part = kPassing;
    if (gait == Gait::stand)
        part = 0.0;
    else if (gait_ != Gait::stand)
        part = std::fmod(gaitOffset_ + hero_.time() - gaitStart_, hero_.duration(kClips[static_cast<uint32_t>(gait_)])) /
               hero_.duration(kClips[static_cast<uint32_t>(gait_)]);
    gait_ = gait;
    gaitStart_ = hero_.time();
    gaitOffset_ = part * duration;
    hero_.play(kClips[static_cast<uint32_t>(gait)], {.offset = gaitOffset_, .transition = kGaitSeconds});
}

void Game::beHit(const Input& input, float seconds) {
    fall_.emplace(hero_, pose_, seconds, *input.push);
    state_ = State::falls;
}

void Game::fall(const Input&, float seconds) {
    fall_->update(hero_, seconds);
    if (fall_->isOver())
        getUp();
}

/// The order matters: first the character is where it will stand, then the body is handed over there once more, so that
/// it lies where it lay; the transition starts from that.
void Game::getUp() {
    const Standing standing = fall_->standing();
    walker_.put(standing.place, standing.heading);
    lift_ = 0.0f;
    place();
    fall_->handOver(hero_);
    rise_.emplace(hero_);
    fall_.reset();
    state_ = State::rises;
}

/// Joints go from lying to standing by themselves. What of the body is lowest stays on the ground.
void Game::rise(const Input& input) {
    rise_->update(hero_);
    lift_ += Rise::toGround(hero_);
    place();
    if (rise_->isOver(hero_))
        standUp(input);
}

void Game::standUp(const Input& input) {
    rise_.reset();
    hero_.play("idle", {.transition = kStandTransition});
    gait_ = Gait::stand;
    gaitStart_ = hero_.time();
    stance_.begin(hero_, input.lookAt);
    state_ = State::walks;
}

} // namespace play
