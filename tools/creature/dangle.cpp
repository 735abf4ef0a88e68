#include "dangle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature {

namespace {

// The shortest turn that takes one direction to another.
Quat arc(const Vec3& from, const Vec3& to) {
    const Vec3 axis = glm::cross(from, to);
    return glm::normalize(Quat(1 + glm::dot(from, to), axis.x, axis.y, axis.z));
}

} // namespace

void dangle(Clip& clip, const Skeleton& skeleton, const Chain& chain, bool loops) {
    std::vector<size_t> joints;
    for (const std::string& name : chain.joints) {
        joints.push_back(static_cast<size_t>(skeleton.index(name)));
    }
    const size_t count = joints.size();
    std::vector<Vec3> bones; // each bone's way at rest
    for (size_t i = 0; i < count; ++i) {
        const Vec3 to = i + 1 < count ? skeleton.joints[joints[i + 1]].rest : chain.end;
        bones.push_back(to - skeleton.joints[joints[i]].rest);
    }
    std::vector<Vec3> at(count), before(count);
    const size_t frames = clip.frames.size();
    const size_t cycle = loops ? frames - 1 : frames;
    const size_t rounds = loops ? 6 : 1;
    // Before the beginning it hangs still.
    const size_t still = loops ? 0 : 30;
    bool placed = false;
    for (size_t step = 0; step < still + rounds * cycle + (loops ? 1 : 0); ++step) {
        Pose& pose = clip.frames[step < still ? 0 : (step - still) % cycle];
        const Pose::Placed parent = pose.placed(skeleton.joints[joints[0]].parent);
        Vec3 origin = parent.position + parent.rotation * skeleton.offset(static_cast<int>(joints[0]));
        Quat turn = parent.rotation;
        for (size_t i = 0; i < count; ++i) {
            const Vec3 rest = origin + turn * bones[i];
            if (!placed) {
                at[i] = before[i] = rest;
            }
            const Vec3 speed = (at[i] - before[i]) * (1 - chain.damp);
            before[i] = at[i];
            at[i] += speed + (rest - at[i]) * chain.stiff + chain.wind * static_cast<double>(i + 1);
            const Vec3 way = glm::normalize(at[i] - origin);
            at[i] = origin + way * glm::length(bones[i]);
            const Quat local = arc(glm::normalize(bones[i]), glm::inverse(turn) * way);
            pose.rotations[joints[i]] = local;
            turn = turn * local;
            origin = at[i];
        }
        placed = true;
    }
    if (loops) {
        for (const size_t joint : joints) {
            clip.frames.back().rotations[joint] = clip.frames.front().rotations[joint];
        }
    }
}

} // namespace supple::creature
