#include "wren_stance.h"

#include "dangle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature::wren {

const Hand kOnShoulder{{-0.222, 1.105, 0.150}, {-0.62, -1, -0.30}, {0.05, 0.72, 0.66}, {-0.26, 0.40, -0.88}};
const Hand kOnScabbard{{0.240, 1.008, -0.022}, {0.85, -0.10, -0.70}, {-0.22, -0.74, 0.62}, {-0.45, 0.60, 0.60}};

Hand between(const std::vector<HandKey>& keys, double time) {
    const auto value = [&](Vec3 Hand::*member, int axis) {
        std::vector<std::pair<double, double>> list;
        for (const HandKey& key : keys) {
            list.push_back({key.time, (key.hand.*member)[axis]});
        }
        return Curve(list)(time);
    };
    const auto vector = [&](Vec3 Hand::*member) { return Vec3{value(member, 0), value(member, 1), value(member, 2)}; };
    return {vector(&Hand::wrist), vector(&Hand::pole), vector(&Hand::fingers), vector(&Hand::thumb)};
}

void place(Pose& pose, const std::string& side, const Hand& hand) {
    const Pose::Placed chest = pose.placed(pose.skeleton.index("chest"));
    const Vec3 wrist = chest.position + chest.rotation * (hand.wrist - kChest);
    const Vec3 thumb = glm::normalize(chest.rotation * hand.thumb);
    const Vec3 fingers = chest.rotation * hand.fingers;
    const Vec3 square = glm::normalize(fingers - thumb * glm::dot(fingers, thumb));
    Vec3 rest = glm::normalize((kKnuckles - kWrist) * Vec3{1, 1, 0});
    rest.x *= side == ".L" ? 1 : -1;
    pose.reach(side, wrist, chest.rotation * hand.pole, turnBetween(rest, {0, 0, 1}, square, thumb));
}

void curl(Pose& pose, const std::string& side, double fingers, double thumb) {
    const double way = side == ".L" ? -1 : 1;
    for (const char* name : {"index", "middle", "ring", "pinky"}) {
        const double spread = name[0] == 'i' ? -7 : (name[0] == 'p' ? 9 : (name[0] == 'r' ? 4 : -2));
        pose.turn(std::string(name) + "A" + side, 0, spread * fingers * (side == ".L" ? -1 : 1) * 0.6,
                  way * 66 * fingers);
        pose.turn(std::string(name) + "B" + side, 0, 0, way * 88 * fingers);
        pose.turn(std::string(name) + "C" + side, 0, 0, way * 52 * fingers);
    }
    // The thumb closes over the fingers.
    pose.turn("thumbA" + side, 20 * thumb, way * -6 * thumb, way * 34 * thumb);
    pose.turn("thumbB" + side, 26 * thumb, way * -18 * thumb, way * 10 * thumb);
    pose.turn("thumbC" + side, 20 * thumb, way * -22 * thumb, 0);
}

void stand(Pose& pose, const std::string& side, const Vec3& shift, double heel, double yaw) {
    const bool left = side == ".L";
    const Vec3 ball = (left ? kBall : kBall * Vec3{-1, 1, 1}) + shift;
    pose.plant(side, ball, eulerDegrees(0, left ? yaw : -yaw, 0) * eulerDegrees(heel, 0, 0), -heel);
}

void drape(Pose& pose) {
    const Quat hips = pose.rotations[static_cast<size_t>(pose.skeleton.index("hips"))];
    for (const std::string side : {".L", ".R"}) {
        const double out = side == ".L" ? 1 : -1;
        const size_t thigh = static_cast<size_t>(pose.skeleton.index("thigh" + side));
        const Vec3 way = pose.rotations[thigh] * glm::normalize(kKnee - kThigh);
        const double forward = std::atan2(way.z, -way.y) * 180 / kPi;
        const double aside = std::atan2(way.x, -way.y) * 180 / kPi * out;
        // Where it hangs by its weight, when the hips lean.
        const Vec3 down = glm::inverse(hips) * Vec3{0, -1, 0};
        const double lean = std::atan2(down.z, -down.y) * 180 / kPi * 0.6;
        pose.turn("skirtFront" + side, -std::max({0.0, 0.82 * forward, lean}), 0, out * std::max(0.0, 0.5 * aside));
        pose.turn("skirtBack" + side, -std::min({0.0, 0.82 * forward, lean}), 0, out * std::max(0.0, 0.5 * aside));
    }
}

void hang(Clip& clip, const Skeleton& skeleton, bool loops, double wind) {
    if (skeleton.springs) {
        return;
    }
    const Links tail = skeleton.links("ponytail"), scarf = skeleton.links("scarf");
    dangle(clip, skeleton, {tail.joints, tail.places.back(), 0.22, 0.22, {0, -0.0010, -wind * 0.5}}, loops);
    dangle(clip, skeleton, {scarf.joints, scarf.places.back(), 0.10, 0.20, {0, -0.0012, -0.0003 - wind}}, loops);
}

} // namespace supple::creature::wren
