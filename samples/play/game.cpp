#include "game.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace play {

namespace {

constexpr glm::vec2 kStartPlace{-2.45f, 0.45f};
constexpr float kStartHeading = 1.2f;

const char* clipOf(Gait gait) {
    return gait == Gait::stand ? "idle" : gait == Gait::walk ? "walk" : "run";
}
GaitSpeeds gaitSpeeds(const Hero& hero) {
    GaitSpeeds speeds{};
    for (const Gait gait : {Gait::walk, Gait::run})
        speeds[static_cast<uint32_t>(gait)] = hero.groundSpeed(clipOf(gait));
    return speeds;
}
/// A part of the walk's cycle at which one foot passes the other, as in standing.
constexpr double kPassing = 0.22;

constexpr double kGaitTransition = 0.3, kStandTransition = 0.5;
constexpr float kSettleSeconds = 0.1f;

} // namespace

Game::Game(Hero& hero) : hero_(hero), walker_(gaitSpeeds(hero), kStartPlace, kStartHeading) {
    hero.setTime(0.0);
    hero.setTransform(walker_.transform());
    hero.play(clipOf(gait_), {});
    stance_.begin(hero, onGround(kStartPlace));
    pose_ = hero.pose();
}

bool Game::isAtRest() const {
    return state_ == State::walks && gait_ == Gait::stand && walker_.speed() == 0.0f &&
           hero_.time() - gaitStart_ > kStandTransition;
}

void Game::update(const Input& input, float seconds) {
    hero_.setTime(hero_.time() + static_cast<double>(seconds));
    if (input.goal)
        walker_.goTo(withinRoom(*input.goal));
    switch (state_) {
    case State::walks:
        walk(input, seconds);
        break;
    case State::falls:
        fall(seconds);
        break;
    case State::rises:
        rise(input);
        break;
    }
    if (input.push && state_ != State::falls && seconds > 0.0f)
        beHit(input, seconds);
    pose_ = hero_.pose();
}

void Game::setTransform() {
    hero_.setTransform(glm::translate(glm::mat4(1.0f), {0.0f, lift_, 0.0f}) * walker_.transform());
}

void Game::walk(const Input& input, float seconds) {
    walker_.update(seconds);
    lift_ *= std::exp(-seconds / kSettleSeconds);
    setTransform();
    if (walker_.gait() != gait_)
        changeGait(walker_.gait(), kGaitTransition);
    stance_.update(hero_, input.lookAt, seconds);
}

double Game::cyclePart() const {
    const double duration = hero_.duration(clipOf(gait_));
    return std::fmod(gaitOffset_ + hero_.time() - gaitStart_, duration) / duration;
}

/// Steps go on where they are: the cycles of walk and run begin with the same foot.
void Game::changeGait(Gait gait, double transition) {
    const bool walks = gait != Gait::stand, walked = gait_ != Gait::stand;
    const double part = walks && walked ? cyclePart() : walks ? kPassing : 0.0;
    gait_ = gait;
    gaitStart_ = hero_.time();
    gaitOffset_ = part * hero_.duration(clipOf(gait));
    hero_.play(clipOf(gait), {.offset = gaitOffset_, .transition = transition});
}

/// Behind the walk of the frame: so the poses of two frames have her speed. What the ragdoll does not move, as fingers
/// and eyes, comes to rest.
void Game::beHit(const Input& input, float seconds) {
    rise_.reset();
    fall_.emplace(hero_, pose_, seconds, *input.push);
    changeGait(Gait::stand, kGaitTransition);
    state_ = State::falls;
}

void Game::fall(float seconds) {
    fall_->update(hero_, seconds);
    if (fall_->isOver())
        getUp();
}

/// The order matters: first the character is where it will stand, then the body is handed over there once more, so that
/// it lies where it lay; the transition starts from that.
void Game::getUp() {
    const Standing standing = fall_->standing();
    walker_.teleport(standing.place, standing.heading);
    lift_ = 0.0f;
    setTransform();
    fall_->handOver(hero_);
    rise_.emplace(hero_, fall_->isOnBack());
    fall_.reset();
    state_ = State::rises;
}

/// Joints go from lying to standing by themselves. What of the body is lowest stays on the ground.
void Game::rise(const Input& input) {
    rise_->update(hero_);
    lift_ += Rise::toGround(hero_);
    setTransform();
    if (rise_->isOver(hero_))
        standUp(input);
}

void Game::standUp(const Input& input) {
    rise_.reset();
    changeGait(Gait::stand, kStandTransition);
    stance_.begin(hero_, input.lookAt);
    state_ = State::walks;
}

} // namespace play
