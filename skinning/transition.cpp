#include "skinning/transition.h"

#include "skinning/bits.h"
#include "skinning/split_time.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace supple::skinning {

namespace {

using namespace shared;
using Local = shared::Transform; // Transform of this namespace is in doubles

/// What was shown goes on turning by at most 30 degrees: 0.072 times this speed is the tangent of a quarter of that.
constexpr float kMostSpin = 0.1316525f / kTransitionReach;
/// By the quintic, the difference of speeds turns a joint by at most 10 degrees: the tangent of a quarter of that, over
/// the largest value of the polynomial.
constexpr float kMostDrift = 0.0436609f / 0.1975309f;

/// The tangent of a quarter of the angle of a unit quaternion, the shorter way, along its axis.
glm::vec3 quarterTangent(const glm::vec4& q) {
    const float sign = q.w < 0.0f ? -1.0f : 1.0f;
    return glm::vec3(q) * (sign / (1.0f + sign * q.w));
}

/// What turns `from` into `to`.
glm::vec3 turnBetween(const glm::vec4& from, const glm::vec4& to) {
    return quarterTangent(shared::unit(shared::turned(shared::unit(to), shared::conjugated(shared::unit(from)))));
}

template <class T>
T speedBetween(const T& before, const T& now) {
    return (now - before) * (1.0f / kTransitionStep);
}

/// Of a node or of four weights, the elements that a transition keeps.
using NodeElements = std::array<glm::vec4, kTransitionElements>;
using WeightElements = std::array<glm::vec4, 2>;

NodeElements goingOn(const Local& before, const Local& now) {
    glm::vec3 spin = turnBetween(before.rotation, now.rotation) * (1.0f / kTransitionStep);
    const float size = glm::length(spin);
    spin *= size > kMostSpin ? kMostSpin / size : 1.0f;
    const glm::vec3 speed = speedBetween(before.translation, now.translation);
    return {shared::unit(now.rotation), glm::vec4(spin, now.scale.x), glm::vec4(now.translation, now.scale.y),
            glm::vec4(speed, now.scale.z)};
}

/// Differences of what was shown to what is played, which goes from `played` to `after`.
NodeElements differing(const Local& before, const Local& now, const Local& played, const Local& after, float seconds) {
    const glm::vec3 turn = turnBetween(played.rotation, now.rotation);
    // The difference a step ago, had what is played moved before as it does now.
    const glm::vec4 back =
        shared::turned(shared::conjugated(shared::unit(shared::turned(
                           shared::unit(after.rotation), shared::conjugated(shared::unit(played.rotation))))),
                       shared::unit(played.rotation));
    const glm::vec3 spin = speedBetween(turnBetween(back, before.rotation), turn);
    const float size = glm::length(spin);
    const float drift = size > 0.0f ? std::min(seconds, kMostDrift / size) : seconds;
    const glm::vec3 scale = now.scale - played.scale;
    const glm::vec3 speed =
        speedBetween(before.translation, now.translation) - speedBetween(played.translation, after.translation);
    return {glm::vec4(turn, drift), glm::vec4(spin, scale.x), glm::vec4(now.translation - played.translation, scale.y),
            glm::vec4(speed, scale.z)};
}

/// Writes elements one after the other.
class Words {
public:
    explicit Words(std::span<uint32_t> words) : words_(words) {}
    void put(const glm::vec4& element) {
        for (int i = 0; i < 4; ++i) {
            put(bits(element[i]));
        }
    }
    void put(uint32_t word) { words_[next_++] = word; }
    void putAll(std::span<const glm::vec4> elements) {
        for (const glm::vec4& element : elements) {
            put(element);
        }
    }

private:
    std::span<uint32_t> words_;
    size_t next_ = 0;
};

} // namespace

uint32_t transitionElements(uint32_t nodeCount, uint32_t morphCount) {
    return 1 + kTransitionElements * nodeCount + 2 * ((morphCount + 3) / 4);
}

void writeTransition(const Transition& transition, const TransitionEnds& ends, std::span<uint32_t> words) {
    assert(words.size() == 4 * size_t{transitionElements(static_cast<uint32_t>(ends.shown.locals.size()),
                                                         static_cast<uint32_t>(4 * ends.shown.weights.size()))});
    const bool goesOn = transition.kind == TransitionKind::deadBlending;
    const SplitTime start = splitTime(transition.start);
    Words out(words);
    out.put(bits(start.high));
    out.put(bits(start.low));
    out.put(bits(transition.seconds));
    out.put(static_cast<uint32_t>(transition.kind));
    for (size_t node = 0; node < ends.shown.locals.size(); ++node) {
        const Local &before = ends.before.locals[node], &now = ends.shown.locals[node];
        out.putAll(goesOn
                       ? goingOn(before, now)
                       : differing(before, now, ends.played.locals[node], ends.after.locals[node], transition.seconds));
    }
    for (size_t quad = 0; quad < ends.shown.weights.size(); ++quad) {
        const glm::vec4 &before = ends.before.weights[quad], &now = ends.shown.weights[quad];
        const glm::vec4 speed = speedBetween(before, now);
        const glm::vec4 played = goesOn ? glm::vec4(0.0f) : ends.played.weights[quad];
        const glm::vec4 ofPlayed = goesOn ? glm::vec4(0.0f) : speedBetween(played, ends.after.weights[quad]);
        out.putAll(WeightElements{now - played, speed - ofPlayed});
    }
}

} // namespace supple::skinning
