#include "watch.h"

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace play {

namespace {

/// The height of an ankle above its sole (samples/assets/README.md: the character stands on y = 0).
constexpr float kAnkleHeight = 0.095f;

/// No other joint is between it and its parent, as clavicles and wrists are, so that its length never changes.
bool isBone(Point point) {
    constexpr Point kNone[] = {kHips, kUpperArmL, kUpperArmR, kKnucklesL, kKnucklesR, kTailTip};
    return std::find(std::begin(kNone), std::end(kNone), point) == std::end(kNone);
}

std::array<float, kPoints> lengthsOf(const BodyPose& pose) {
    std::array<float, kPoints> lengths{};
    for (uint32_t i = 0; i < kJoints; ++i)
        lengths[i] = glm::distance(glm::vec3(pose[i][3]), glm::vec3(pose[kBody[i].parent][3]));
    return lengths;
}

} // namespace

Watch::Watch(const Game& game) : last_(game.pose()), lengths_(lengthsOf(game.pose())) {}

void Watch::see(const Game& game, std::span<const glm::vec3> vertices, float seconds) {
    falls_ += game.state() == Game::State::falls && lastState_ != Game::State::falls ? 1 : 0;
    rises_ += game.state() == Game::State::walks && lastState_ == Game::State::rises ? 1 : 0;
    lastState_ = game.state();
    if (game.walker().goal())
        goal_ = game.walker().goal();
    else if (goal_ && game.walker().speed() == 0.0f && game.state() == Game::State::walks) {
        fromGoal_ = std::max(fromGoal_, glm::distance(game.walker().place(), *goal_));
        ++arrivals_;
        goal_.reset();
    }
    seeJoints(game, seconds);
    if (game.state() == Game::State::walks && game.stance().weight() == 1.0f && game.isAtRest())
        seeFeet(game);
    for (const glm::vec3& vertex : vertices) {
        const float depth = heightAt(placeOf(vertex)) - vertex.y;
        deepest_ = std::max(deepest_, depth);
        if (game.state() == Game::State::walks && game.stance().weight() == 1.0f)
            inGround_ = std::max(inGround_, depth);
    }
    last_ = game.pose();
}

void Watch::seeJoints(const Game& game, float seconds) {
    const BodyPose& pose = game.pose();
    const std::array<float, kPoints> lengths = lengthsOf(pose);
    for (uint32_t i = 0; i < kJoints; ++i) {
        const glm::vec3 now(pose[i][3]);
        fastest_ = std::max(fastest_, glm::distance(now, glm::vec3(last_[i][3])) / seconds);
        if (isBone(static_cast<Point>(i)))
            stretch_ = std::max(stretch_, std::abs(lengths[i] / lengths_[i] - 1.0f));
        for (int k = 0; k < 16; ++k) {
            const float number = pose[i][k / 4][k % 4];
            finite_ = finite_ && std::isfinite(number);
            words_ = (words_ ^ std::bit_cast<uint32_t>(number)) * 0x100000001B3ull;
        }
    }
    const glm::vec3 hips(pose[kHips][3]);
    lying_ = std::min(lying_, hips.y - heightAt(placeOf(hips)));
}

void Watch::seeFeet(const Game& game) {
    for (uint32_t foot = 0; foot < 2; ++foot) {
        ++standing_;
        const Footing& footing = game.stance().footing(foot);
        const glm::vec3 ankle(game.pose()[foot == 0 ? kFootL : kFootR][3]);
        sole_ = std::max(sole_, std::abs(glm::dot(ankle - footing.point, footing.normal) - kAnkleHeight));
    }
}

void Watch::print() const {
    std::printf("arrivals %u\nfrom-goal %.4f\nfalls %u\nrises %u\n", arrivals_, static_cast<double>(fromGoal_), falls_,
                rises_);
    std::printf("standing %u\nsole %.4f\nstretch %.6f\nfastest %.3f\ndeepest %.4f\nin-ground %.4f\nlying %.3f\n",
                standing_, static_cast<double>(sole_), static_cast<double>(stretch_), static_cast<double>(fastest_),
                static_cast<double>(deepest_), static_cast<double>(inGround_), static_cast<double>(lying_));
    std::printf("finite %d\nwords %016" PRIx64 "\n", finite_ ? 1 : 0, words_);
}

} // namespace play
