#include "skinning/root_motion.h"

#include "skinning/rotation.h"

#include <algorithm>
#include <cmath>

namespace supple::skinning {
namespace {

glm::dvec3 turned(double yaw, const glm::dvec3& p) {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
}

struct RootFrame {
    glm::dmat4 parent{1.0}; ///< global transform of what the root hangs on
    glm::dvec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
};

/// `localOf(node)` gives a node's local transform.
template <class LocalOf>
RootFrame rootFrame(const cage::Skeleton& skeleton, uint32_t root, LocalOf&& localOf) {
    RootFrame frame;
    for (uint32_t node = skeleton.nodes[root].parent; node != cage::kNone; node = skeleton.nodes[node].parent) {
        frame.parent = localMatrix(skeleton.nodes[node], localOf(node)) * frame.parent;
    }
    const glm::dmat4 global = frame.parent * localMatrix(skeleton.nodes[root], localOf(root));
    frame.position = glm::dvec3(global[3]);
    frame.rotation = nearestRotation(glm::dmat3(global));
    return frame;
}

RootFrame rootFrameAt(const cage::Character& character, const cage::Clip& clip, uint32_t root, double time) {
    return rootFrame(character.skeleton, root,
                     [&](uint32_t node) { return sampleNode(character.skeleton, clip, time, node); });
}

RootMotion motionBetween(const RootFrame& start, const RootFrame& now, uint32_t axes) {
    RootMotion motion;
    if ((axes & kRootYaw) != 0) {
        const glm::dquat turn = now.rotation * glm::conjugate(start.rotation);
        motion.yaw = std::remainder(2.0 * std::atan2(turn.y, turn.w), kTurn);
    }
    const glm::dvec3 way = now.position - turned(motion.yaw, start.position);
    if ((axes & kRootGround) != 0) {
        motion.translation.x = way.x;
        motion.translation.z = way.z;
    }
    if ((axes & kRootHeight) != 0) {
        motion.translation.y = way.y;
    }
    return motion;
}

/// `motion`, `count` times over.
RootMotion repeated(RootMotion motion, double count) {
    if (count < 0.0) {
        motion = inverse(motion);
    }
    RootMotion result;
    for (double rest = std::abs(count); rest >= 1.0; rest = std::floor(rest / 2.0)) {
        if (std::fmod(rest, 2.0) == 1.0) {
            result = result * motion;
        }
        motion = motion * motion;
    }
    return result;
}

bool moves(const cage::Channel& channel) {
    if (channel.path != cage::ChannelPath::translation && channel.path != cage::ChannelPath::rotation) {
        return false;
    }
    const size_t width = channel.path == cage::ChannelPath::rotation ? 4 : 3;
    const bool cubic = channel.interpolation == cage::Interpolation::cubicSpline;
    for (size_t i = 0; i < channel.values.size(); ++i) {
        const bool tangent = cubic && i / width % 3 != 1;
        const float still = tangent ? 0.0f : channel.values[(cubic ? width : 0) + i % width];
        if (channel.values[i] != still) {
            return true;
        }
    }
    return false;
}

} // namespace

RootMotion operator*(const RootMotion& a, const RootMotion& b) {
    return {turned(a.yaw, b.translation) + a.translation, a.yaw + b.yaw};
}

RootMotion inverse(const RootMotion& motion) {
    return {-turned(-motion.yaw, motion.translation), -motion.yaw};
}

glm::dmat4 toMatrix(const RootMotion& motion) {
    return {glm::dvec4(turned(motion.yaw, {1.0, 0.0, 0.0}), 0.0), glm::dvec4(0.0, 1.0, 0.0, 0.0),
            glm::dvec4(turned(motion.yaw, {0.0, 0.0, 1.0}), 0.0), glm::dvec4(motion.translation, 1.0)};
}

LoopTime loopTime(double time, double duration) {
    if (!(duration > 0.0)) {
        return {};
    }
    double rest = std::fmod(time, duration);
    if (rest < 0.0) {
        rest += duration;
    }
    if (rest >= duration) { // rounded up from just below 0
        rest = 0.0;
    }
    return {rest, std::round((time - rest) / duration)};
}

uint32_t findRoot(const cage::Character& character) {
    if (character.clipRoot != cage::kNone) {
        return character.clipRoot;
    }
    const cage::Skeleton& skeleton = character.skeleton;
    std::vector<bool> moving(skeleton.nodes.size(), false);
    for (const cage::Clip& clip : character.clips) {
        for (const cage::Channel& channel : clip.channels) {
            moving[channel.node] = moving[channel.node] || moves(channel);
        }
    }
    // The topmost moving node at or above every joint.
    std::vector<uint32_t> joints(skeleton.nodes.size(), 0);
    for (const uint32_t joint : character.skin.joints) {
        uint32_t top = cage::kNone;
        for (uint32_t node = joint; node != cage::kNone; node = skeleton.nodes[node].parent) {
            top = moving[node] ? node : top;
        }
        if (top != cage::kNone) {
            ++joints[top];
        }
    }
    const auto most = std::max_element(joints.begin(), joints.end());
    return most == joints.end() || *most == 0 ? cage::kNone : static_cast<uint32_t>(most - joints.begin());
}

RootPlace rootPlaceAt(const cage::Character& character, const cage::Clip& clip, uint32_t node, double time) {
    const RootFrame frame = rootFrameAt(character, clip, node, time);
    return {frame.position, frame.rotation};
}

void removeRootMotion(const cage::Character& character, const cage::Clip& clip, const RootSelection& root, Pose& pose) {
    if (root.axes == 0 || root.node == cage::kNone) {
        return;
    }
    const RootFrame start = rootFrameAt(character, clip, root.node, 0.0);
    const RootFrame now =
        rootFrame(character.skeleton, root.node, [&](uint32_t node) -> Transform { return pose.locals[node]; });
    const RootMotion motion = motionBetween(start, now, root.axes);
    if (glm::determinant(now.parent) == 0.0) {
        return; // whatever the root does, nobody sees it
    }
    Transform& local = pose.locals[root.node];
    const RootMotion back = inverse(motion);
    const glm::dvec3 position = turned(back.yaw, now.position) + back.translation;
    local.translation = glm::dvec3(glm::inverse(now.parent) * glm::dvec4(position, 1.0));
    if (motion.yaw != 0.0) {
        const glm::dquat parent = nearestRotation(glm::dmat3(now.parent));
        const glm::dquat turn(std::cos(0.5 * back.yaw), 0.0, std::sin(0.5 * back.yaw), 0.0);
        local.rotation = glm::conjugate(parent) * turn * parent * unit(local.rotation);
    }
}

RootMotion rootMotionBetween(const cage::Character& character, const cage::Clip& clip, const RootSelection& root,
                             double from, double to, bool loop) {
    if (root.axes == 0 || root.node == cage::kNone) {
        return {};
    }
    const RootFrame start = rootFrameAt(character, clip, root.node, 0.0);
    const auto motionAt = [&](double time) {
        return motionBetween(start, rootFrameAt(character, clip, root.node, time), root.axes);
    };
    RootMotion motion;
    if (loop) {
        const LoopTime first = loopTime(from, clip.duration), last = loopTime(to, clip.duration);
        const RootMotion whole = repeated(motionAt(clip.duration), last.loops - first.loops);
        motion = inverse(motionAt(first.time)) * whole * motionAt(last.time);
    } else {
        motion = inverse(motionAt(from)) * motionAt(to);
    }
    motion.yaw = std::remainder(motion.yaw, kTurn);
    return motion;
}

} // namespace supple::skinning
