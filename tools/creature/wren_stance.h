// Wren's limbs, posed by where hands and feet are.
#pragma once

#include "clips.h"
#include "pose.h"
#include "wren.h"

namespace supple::creature::wren {

constexpr double kTurn = 2 * kPi;

// A hand, as the chest sees it at rest: its wrist, where the elbow points, where the fingers point when stretched, and
// where the thumb's side looks (there the blade goes).
struct Hand {
    Vec3 wrist, pole, fingers, thumb;
};
struct HandKey {
    double time;
    Hand hand;
};
Hand between(const std::vector<HandKey>& keys, double time);

// How Wren stands between actions: the sword on the right shoulder, the left hand on the scabbard.
extern const Hand kOnShoulder, kOnScabbard;

void place(Pose& pose, const std::string& side, const Hand& hand);
// 0 is the modelled hand, 1 a fist round the sword's grip.
void curl(Pose& pose, const std::string& side, double fingers, double thumb);
// A foot on the ground: `heel` degrees up on its ball, `yaw` degrees outward.
void stand(Pose& pose, const std::string& side, const Vec3& shift, double heel, double yaw);
// The skirt gives way to the thighs.
void drape(Pose& pose);
// Ponytail and scarf.
void hang(Clip& clip, const Skeleton& skeleton, bool loops, double wind);

std::vector<Clip> makeGaits(const Skeleton& skeleton);

} // namespace supple::creature::wren
