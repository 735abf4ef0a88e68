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

/// Dead blending: what was shown goes on turning by at most 30 degrees. kTransitionReach times this speed is the
/// tangent of a quarter of that.
constexpr float kMostSpin = 0.1316525f / kTransitionReach;
/// Quintic: the difference of speeds turns a joint by at most 10 degrees: the tangent of a quarter of that, over the
/// largest value of the polynomial.
constexpr float kMostDrift = 0.0436609f / 0.1975309f;

/// The tangent of a quarter of the angle of a unit quaternion, along its axis. `sign` chooses one of its two angles.
glm::vec3 quarterTangent(const glm::vec4& q, float sign) {
    return glm::vec3(q) * (sign / (1.0f + sign * q.w));
}
/// That of the smaller angle.
float signOf(const glm::vec4& q) {
    return q.w < 0.0f ? -1.0f : 1.0f;
}
/// What turns `from` into `to`.
glm::vec4 between(const glm::vec4& from, const glm::vec4& to) {
    return shared::unit(shared::turned(shared::unit(to), shared::conjugated(shared::unit(from))));
}

template <class T>
T speedBetween(const T& before, const T& now) {
    return (now - before) * (1.0f / kTransitionStep);
}
glm::vec3 spinBetween(const glm::vec4& before, const glm::vec4& now) {
    const glm::vec4 turn = between(before, now);
    return quarterTangent(turn, signOf(turn)) * (1.0f / kTransitionStep);
}

/// The speed of the first of two steps beside each other, unless it is so much faster than the second that a clip jumps
/// there: at a STEP key, or where a loop ends.
template <class T>
T speedOf(const T& first, const T& second) {
    constexpr float kJump = 4.0f;
    return glm::dot(first, first) <= kJump * kJump * glm::dot(second, second) ? first : second;
}

struct Rates {
    glm::vec3 speed, spin;
};
Rates ratesOf(const std::array<SampledPose, 3>& poses, size_t node) {
    const Local &first = poses[0].locals[node], &second = poses[1].locals[node], &third = poses[2].locals[node];
    return {speedOf(speedBetween(first.translation, second.translation),
                    speedBetween(second.translation, third.translation)),
            speedOf(spinBetween(first.rotation, second.rotation), spinBetween(second.rotation, third.rotation))};
}
glm::vec4 ratesOfWeights(const std::array<SampledPose, 3>& poses, size_t quad) {
    glm::vec4 speed;
    for (int i = 0; i < 4; ++i) {
        speed[i] = speedOf(speedBetween(poses[0].weights[quad][i], poses[1].weights[quad][i]),
                           speedBetween(poses[1].weights[quad][i], poses[2].weights[quad][i]));
    }
    return speed;
}

/// What a transition keeps of a node, and of four weights.
using NodeElements = std::array<glm::vec4, kTransitionElements>;
using WeightElements = std::array<glm::vec4, 2>;

NodeElements deadBlendingElements(const Local& now, Rates rates) {
    const float size = glm::length(rates.spin);
    rates.spin *= size > kMostSpin ? kMostSpin / size : 1.0f;
    return {shared::unit(now.rotation), glm::vec4(rates.spin, now.scale.x), glm::vec4(now.translation, now.scale.y),
            glm::vec4(rates.speed, now.scale.z)};
}

/// The speed of the rotation that turns what is played into what was shown, where both turn on as they do now. `sign`:
/// as of `turn`, which is that rotation.
glm::vec3 spinOfDifference(const Local& now, const glm::vec3& spin, const Local& played, const glm::vec3& ownSpin,
                           const glm::vec4& turn, float sign) {
    const glm::vec4 later = shared::turned(quarterTangentTurn(spin * kTransitionStep), shared::unit(now.rotation));
    const glm::vec4 ownLater =
        shared::turned(quarterTangentTurn(ownSpin * kTransitionStep), shared::unit(played.rotation));
    glm::vec4 turnLater = between(ownLater, later);
    turnLater *= glm::dot(turnLater, turn) < 0.0f ? -1.0f : 1.0f;
    return speedBetween(quarterTangent(turn, sign), quarterTangent(turnLater, sign));
}

NodeElements quinticElements(const Local& now, const Rates& rates, const Local& played, const Rates& own,
                             float seconds) {
    const glm::vec4 turn = between(played.rotation, now.rotation);
    const float sign = signOf(turn);
    const glm::vec3 spin = spinOfDifference(now, rates.spin, played, own.spin, turn, sign);
    const float size = glm::length(spin);
    const float drift = size > 0.0f ? std::min(seconds, kMostDrift / size) : seconds;
    const glm::vec3 scale = now.scale - played.scale;
    return {glm::vec4(quarterTangent(turn, sign), drift), glm::vec4(spin, scale.x),
            glm::vec4(now.translation - played.translation, scale.y), glm::vec4(rates.speed - own.speed, scale.z)};
}

/// Writes elements one after the other.
class Words {
public:
    explicit Words(std::span<uint32_t> words) : words_(words) {}
    void put(uint32_t word) { words_[next_++] = word; }
    void putAll(std::span<const glm::vec4> elements) {
        for (const glm::vec4& element : elements) {
            for (int i = 0; i < 4; ++i) {
                put(bits(element[i]));
            }
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

double transitionStart(std::span<const uint32_t> words) {
    return joinedTime(std::bit_cast<float>(words[0]), std::bit_cast<float>(words[1]));
}

void writeTransition(const Transition& transition, const TransitionEnds& ends, std::span<uint32_t> words) {
    const SampledPose &now = ends.shown[ends.now], &played = ends.played[0];
    assert(words.size() == 4 * size_t{transitionElements(static_cast<uint32_t>(now.locals.size()),
                                                         static_cast<uint32_t>(4 * now.weights.size()))});
    const bool blends = transition.kind == TransitionKind::deadBlending;
    const SplitTime start = splitTime(transition.start);
    Words out(words);
    out.put(bits(start.high));
    out.put(bits(start.low));
    out.put(bits(transition.seconds));
    out.put(static_cast<uint32_t>(transition.kind));
    for (size_t node = 0; node < now.locals.size(); ++node) {
        const Rates rates = ratesOf(ends.shown, node);
        out.putAll(blends ? deadBlendingElements(now.locals[node], rates)
                          : quinticElements(now.locals[node], rates, played.locals[node], ratesOf(ends.played, node),
                                            transition.seconds));
    }
    for (size_t quad = 0; quad < now.weights.size(); ++quad) {
        WeightElements kept{now.weights[quad], ratesOfWeights(ends.shown, quad)};
        if (!blends) {
            kept[0] -= played.weights[quad];
            kept[1] -= ratesOfWeights(ends.played, quad);
        }
        out.putAll(kept);
    }
}

} // namespace supple::skinning
