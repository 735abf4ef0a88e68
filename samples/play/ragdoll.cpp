#include "ragdoll.h"

#include "ground.h"

#include <algorithm>
#include <cmath>

namespace play {

namespace {

constexpr float kFallStep = 1.0f / 240.0f;
constexpr int kRounds = 10; ///< in which sticks are mended, a step
constexpr float kGravity = 9.81f;
constexpr float kFastest = 7.0f;   ///< a point, in units a second
constexpr float kDrag = 0.5f;      ///< part of the speed that a second takes
constexpr float kFriction = 0.35f; ///< part of the speed along the ground that a touch takes
constexpr float kToneSeconds = 0.22f;
constexpr float kTone = 0.12f;
constexpr float kBuckled = 0.9f;   ///< a leg whose knee gives way, as a part of its length
constexpr float kBuckling = 0.03f; ///< slower than other muscles, so that feet stay on the ground
constexpr float kLyingSpeed = 0.3f;
constexpr float kUnbounded = 1e9f;

glm::vec3 along(glm::vec3 from, glm::vec3 to) {
    return glm::normalize(to - from);
}

/// The axes of a body part: x along `left`, y near `up`.
glm::quat frameOf(glm::vec3 left, glm::vec3 up) {
    const glm::vec3 x = glm::normalize(left), z = glm::normalize(glm::cross(x, up));
    return glm::quat_cast(glm::mat3(x, glm::cross(z, x), z));
}

/// The shortest turn after `turn` that points `start` along `now`.
glm::quat swung(const glm::quat& turn, glm::vec3 start, glm::vec3 now) {
    return glm::normalize(glm::quat(turn * start, now) * turn);
}

} // namespace

Ragdoll::Ragdoll(const BodyPose& pose, const BodyPose& before, float seconds, glm::vec3 push)
    : points_(pointsOf(pose)), start_(points_) {
    const BodyPoints earlier = pointsOf(before);
    for (uint32_t i = 0; i < kPoints; ++i) {
        const glm::vec3 speed = (points_[i] - earlier[i]) / seconds + kBody[i].push * push;
        before_[i] = points_[i] - kFallStep * speed;
        lengths_[i] = glm::distance(points_[i], points_[kBody[i].parent]);
    }
    for (uint32_t i = 0; i < kMoved; ++i) {
        rotations_[i] = glm::normalize(glm::quat_cast(glm::mat3(pose[i])));
        turns_[i] = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
    }
    addSkeleton();
    addLimits();
}

void Ragdoll::addStick(Point a, Point b, float stiffness) {
    const float length = glm::distance(points_[a], points_[b]);
    sticks_.push_back({a, b, length, length, stiffness});
}

void Ragdoll::addLimit(Point a, Point b, float least, float most) {
    sticks_.push_back({a, b, least, most, 0.5f});
}

/// Bones, and what keeps shoulders and hips in shape.
void Ragdoll::addSkeleton() {
    for (uint32_t i = 1; i < kPoints; ++i)
        addStick(kBody[i].parent, static_cast<Point>(i));
    for (const auto& [a, b] :
         {std::pair(kUpperArmL, kUpperArmR), std::pair(kNeck, kUpperArmL), std::pair(kNeck, kUpperArmR),
          std::pair(kThighL, kThighR), std::pair(kSpine, kThighL), std::pair(kSpine, kThighR)})
        addStick(a, b);
    // The trunk bends and twists a little.
    for (const auto& [a, b] :
         {std::pair(kSpine, kUpperArmL), std::pair(kSpine, kUpperArmR), std::pair(kThighL, kUpperArmL),
          std::pair(kThighR, kUpperArmR), std::pair(kThighL, kUpperArmR), std::pair(kThighR, kUpperArmL)})
        addStick(a, b, 0.12f);
    for (const auto& [a, b] :
         {std::pair(kUpperArmL, kKnucklesL), std::pair(kUpperArmR, kKnucklesR), std::pair(kHips, kShinL),
          std::pair(kHips, kShinR), std::pair(kChest, kForeArmL), std::pair(kChest, kForeArmR),
          std::pair(kChest, kHead), std::pair(kChest, kShinL), std::pair(kChest, kShinR)}) {
        const float length = glm::distance(points_[a], points_[b]);
        tone_.push_back({a, b, length, length, kTone});
    }
    for (const auto& [thigh, foot] : {std::pair(kThighL, kFootL), std::pair(kThighR, kFootR)}) {
        const float length = kBuckled * glm::distance(points_[thigh], points_[foot]);
        tone_.push_back({thigh, foot, length, length, kBuckling});
    }
}

/// How far joints bend: a distance that may not become shorter, or longer.
void Ragdoll::addLimits() {
    const float leg = lengths_[kShinL] + lengths_[kFootL], arm = lengths_[kForeArmL] + lengths_[kKnucklesL];
    const float trunk = lengths_[kSpine] + lengths_[kChest] + lengths_[kNeck];
    for (const auto& [thigh, shin, foot, toes] :
         {std::array{kThighL, kShinL, kFootL, kToesL}, std::array{kThighR, kShinR, kFootR, kToesR}}) {
        addLimit(thigh, foot, 0.5f * leg, 0.995f * leg);
        addLimit(kChest, shin, 0.55f * trunk, kUnbounded);
        addLimit(shin, toes, 0.92f * lengths_[foot], lengths_[foot] + 0.6f * lengths_[toes]);
    }
    for (const auto& [upper, fore, hand] :
         {std::array{kUpperArmL, kForeArmL, kKnucklesL}, std::array{kUpperArmR, kForeArmR, kKnucklesR}}) {
        addLimit(upper, hand, 0.45f * arm, 0.99f * arm);
        addLimit(kHips, hand, 0.2f, kUnbounded);
        addLimit(kSpine, fore, 0.2f, kUnbounded);
        addLimit(kChest, fore, 0.2f, kUnbounded);
        addLimit(kHead, hand, 0.25f, kUnbounded);
        addLimit(kCrown, hand, 0.3f, kUnbounded);
    }
    addStick(kCrown, kTail);
    addLimit(kHead, kTailTip, 0.22f, kUnbounded);
    addLimit(kShinL, kShinR, 0.13f, 0.6f);
    addLimit(kFootL, kFootR, 0.13f, 0.8f);
    addLimit(kHips, kNeck, 0.9f * trunk, kUnbounded);
    addLimit(kChest, kHead, 0.93f * (lengths_[kNeck] + lengths_[kHead]), kUnbounded);
    addLimit(kChest, kCrown, 0.85f * glm::distance(start_[kChest], start_[kCrown]), kUnbounded);
    for (const Point arm_ : {kUpperArmL, kUpperArmR})
        addLimit(kCrown, arm_, 0.3f, kUnbounded);
}

void Ragdoll::update(float seconds) {
    for (owed_ += seconds; owed_ >= kFallStep; owed_ -= kFallStep)
        step();
    keepLengths();
    turn();
    age_ += seconds;
}

void Ragdoll::step() {
    for (uint32_t i = 0; i < kPoints; ++i) {
        const glm::vec3 now = points_[i], moved = now - before_[i];
        // What is mended in one step would be a speed in the next.
        const float slower = std::min(1.0f, kFastest * kFallStep / std::max(glm::length(moved), 1e-6f));
        points_[i] += slower * (1.0f - kDrag * kFallStep) * moved;
        points_[i].y -= kGravity * kFallStep * kFallStep;
        before_[i] = now;
    }
    const float left = std::exp(-age_ / kToneSeconds);
    for (const Stick& stick : tone_)
        satisfy(stick, left * stick.stiffness);
    for (int round = 0; round < kRounds; ++round) {
        for (const Stick& stick : sticks_)
            satisfy(stick, stick.stiffness);
        bendKnee(kThighL, kShinL, kFootL);
        bendKnee(kThighR, kShinR, kFootR);
        stopAtGround();
    }
}

void Ragdoll::satisfy(const Stick& stick, float stiffness) {
    const glm::vec3 between = points_[stick.b] - points_[stick.a];
    const float length = glm::length(between);
    const float wanted = std::clamp(length, stick.least, stick.most);
    if (wanted == length || length < 1e-6f)
        return;
    const float lightA = 1.0f / kBody[stick.a].mass, lightB = 1.0f / kBody[stick.b].mass;
    const glm::vec3 mended = between * (stiffness * (wanted - length) / (length * (lightA + lightB)));
    points_[stick.a] -= lightA * mended;
    points_[stick.b] += lightB * mended;
}

void Ragdoll::bendKnee(Point thigh, Point shin, Point foot) {
    const glm::vec3 left = points_[kThighL] - points_[kThighR];
    const glm::vec3 front = glm::cross(left, points_[thigh] - points_[foot]);
    if (glm::dot(front, front) < 1e-8f)
        return;
    const glm::vec3 ahead = glm::normalize(front);
    const float behind = -glm::dot(ahead, points_[shin] - points_[thigh]);
    if (behind <= 0.0f)
        return;
    // What the knee gets, its neighbors lose: a push from nowhere would make the body jump.
    const float part = 0.2f * behind;
    points_[shin] += part * ahead;
    points_[thigh] -= 0.5f * part * kBody[shin].mass / kBody[thigh].mass * ahead;
    points_[foot] -= 0.5f * part * kBody[shin].mass / kBody[foot].mass * ahead;
}

void Ragdoll::stopAtGround() {
    for (uint32_t i = 0; i < kPoints; ++i) {
        const glm::vec2 place = placeOf(points_[i]);
        const float below = heightAt(place) + kBody[i].radius - points_[i].y;
        if (below <= 0.0f)
            continue;
        const glm::vec3 normal = normalAt(place);
        points_[i] += below * normal.y * normal; // out of a step's side sideways, not up to its edge
        const glm::vec3 moved = points_[i] - before_[i];
        const glm::vec3 slid = moved - glm::dot(moved, normal) * normal;
        before_[i] = points_[i] - (1.0f - kFriction) * slid; // it does not bounce
    }
}

/// What rounds have left: from the hips outwards every bone gets its length to the bit of a float, so that no limb is
/// stretched.
void Ragdoll::keepLengths() {
    for (uint32_t i = 1; i < kPoints; ++i) {
        const glm::vec3 parent = points_[kBody[i].parent];
        move(static_cast<Point>(i), parent + lengths_[i] * along(parent, points_[i]));
    }
}

/// Its speed stays.
void Ragdoll::move(Point point, glm::vec3 to) {
    before_[point] += to - points_[point];
    points_[point] = to;
}

/// Points have no rotations: hips and chest have axes by their shoulders, a limb turns by the shortest way from the
/// part that it hangs on.
void Ragdoll::turn() {
    const auto frame = [](const BodyPoints& p, Point left, Point right, Point low, Point high) {
        return frameOf(p[left] - p[right], p[high] - p[low]);
    };
    const auto frameTurn = [&](Point left, Point right, Point low, Point high) {
        return glm::normalize(frame(points_, left, right, low, high) *
                              glm::conjugate(frame(start_, left, right, low, high)));
    };
    const auto limbTurn = [&](const glm::quat& parent, Point from, Point to) {
        return swung(parent, along(start_[from], start_[to]), along(points_[from], points_[to]));
    };
    turns_[kHips] = frameTurn(kThighL, kThighR, kHips, kSpine);
    turns_[kChest] = frameTurn(kUpperArmL, kUpperArmR, kChest, kNeck);
    turns_[kSpine] = limbTurn(glm::slerp(turns_[kHips], turns_[kChest], 0.5f), kSpine, kChest);
    turns_[kNeck] = limbTurn(turns_[kChest], kNeck, kHead);
    turns_[kHead] = limbTurn(turns_[kNeck], kHead, kCrown);
    for (const auto& [trunk, upper, middle, lower] :
         {std::array{kChest, kUpperArmL, kForeArmL, kKnucklesL}, std::array{kChest, kUpperArmR, kForeArmR, kKnucklesR},
          std::array{kHips, kThighL, kShinL, kFootL}, std::array{kHips, kThighR, kShinR, kFootR}}) {
        turns_[upper] = limbTurn(turns_[trunk], upper, middle);
        turns_[middle] = limbTurn(turns_[upper], middle, lower);
    }
    // The ponytail has grown on: it takes all of the head, not only the distance.
    const glm::vec3 root = points_[kHead] + turns_[kHead] * (start_[kTail] - start_[kHead]);
    move(kTailTip, root + lengths_[kTailTip] * along(root, points_[kTailTip]));
    move(kTail, root);
    turns_[kTail] = limbTurn(turns_[kHead], kTail, kTailTip);
    turns_[kFootL] = limbTurn(turns_[kShinL], kFootL, kToesL);
    turns_[kFootR] = limbTurn(turns_[kShinR], kFootR, kToesR);
}

bool Ragdoll::lies() const {
    float fastest = 0.0f;
    for (const Point i : {kHips, kChest, kCrown, kKnucklesL, kKnucklesR, kFootL, kFootR})
        fastest = std::max(fastest, glm::distance(points_[i], before_[i]) / kFallStep);
    return fastest < kLyingSpeed;
}

} // namespace play
