// A body that goes limp: points that keep their distances (Verlet integration; Jakobsen, Advanced Character Physics,
// 2001). A game would ask its physics.
#pragma once

#include "body.h"

#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace play {

class Ragdoll {
public:
    /// Goes on from a pose, as fast as the body has moved since the pose `before`, which was `seconds` ago. `push`: a
    /// speed that the blow adds, most of it above the hips.
    Ragdoll(const BodyPose& pose, const BodyPose& before, float seconds, glm::vec3 push);

    void update(float seconds);

    /// Where the joints are now: those below kMoved.
    [[nodiscard]] glm::vec3 place(Point point) const { return points_[point]; }
    [[nodiscard]] glm::quat rotation(Point point) const { return turns_[point] * rotations_[point]; }
    /// Seconds since the blow.
    [[nodiscard]] float age() const { return age_; }
    /// It hardly moves any more.
    [[nodiscard]] bool lies() const;
    /// Where the chest faces, and how the spine points towards the head.
    [[nodiscard]] glm::vec3 facing() const { return rotation(kChest) * glm::vec3(0.0f, 0.0f, 1.0f); }
    [[nodiscard]] glm::vec3 spine() const { return glm::normalize(points_[kNeck] - points_[kHips]); }

private:
    /// Two points and how far they may be from each other.
    struct Stick {
        Point a, b;
        float least, most;
        float stiffness; ///< the part of what is wrong that a step mends
    };

    void addStick(Point a, Point b, float stiffness = 1.0f);
    void addLimit(Point a, Point b, float least, float most);
    void addSkeleton();
    void addLimits();
    void step();
    void satisfy(const Stick& stick, float stiffness);
    /// Not the wrong way.
    void bendKnee(Point thigh, Point shin, Point foot);
    void stopAtGround();
    void keepLengths();
    void move(Point point, glm::vec3 to);
    void turn();

    BodyPoints points_, before_;
    BodyPoints start_;
    std::array<glm::quat, kMoved> rotations_; ///< at the start
    std::array<glm::quat, kMoved> turns_;     ///< since then
    std::array<float, kPoints> lengths_{};    ///< from the parent
    std::vector<Stick> sticks_;
    std::vector<Stick> tone_; ///< muscles that give way in the first moments
    float age_ = 0.0f;
    float owed_ = 0.0f; ///< seconds that no step has taken yet
};

} // namespace play
