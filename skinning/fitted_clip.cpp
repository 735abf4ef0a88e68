#include "skinning/fitted_clip.h"

#include "cage/limits.h"
#include "cage/skeleton.h"
#include "shaders/pose/limbs.h"
#include "skinning/pose.h"
#include "skinning/rotation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace supple::skinning {
namespace {

using cage::Channel;
using cage::ChannelPath;
using cage::Interpolation;
using cage::kNone;

constexpr double kLongestGap = 1.0 / 23.0; ///< seconds between two keys; longer ones get keys between
constexpr double kRateBetween = 30.0;      ///< of the keys between
constexpr double kEvenRate = 60.0;         ///< frames a second of clips whose keys are closer than twice that
constexpr float kAnkleSoft = 0.995f;       ///< the part of a leg's length from which on it stretches ever more slowly

constexpr uint64_t kLeastBudget = 250'000, kLargestBudget = 8'000'000; ///< poses of nodes

bool movesNode(const Channel& channel) {
    return channel.path != ChannelPath::weights;
}

/// When the fitted clip has keys.
struct KeyTimes {
    std::vector<double> times; ///< as floats, no two are alike
    bool isStepped = false;
    bool isCoarse = false; ///< fewer than the clip needs
};

/// Appends a time that is later than the last one, also as floats.
void append(std::vector<double>& times, double time) {
    if (times.empty() || static_cast<float>(time) > static_cast<float>(times.back())) {
        times.push_back(time);
    }
}

/// `count` of them, from the first to the last.
std::vector<double> evenTimes(double first, double last, size_t count) {
    std::vector<double> times;
    for (size_t k = 0; k < count; ++k) {
        const double part = count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 0.0;
        append(times, first + (last - first) * part);
    }
    return times;
}

/// The times, and more between those that are far apart: `rate` a second.
std::vector<double> closerTimes(const std::vector<double>& times, double rate, uint64_t most) {
    std::vector<double> closer;
    for (size_t k = 0; k + 1 < times.size() && closer.size() <= most; ++k) {
        const double gap = times[k + 1] - times[k];
        const double pieces =
            std::min(gap > kLongestGap ? std::ceil(gap * rate - 1e-6) : 1.0, static_cast<double>(most) + 1.0);
        for (double i = 0.0; i < pieces; ++i) {
            append(closer, times[k] + gap * i / pieces);
        }
    }
    append(closer, times.back());
    return closer;
}

/// No more than `most`, which is 2 or more: then keys are farther apart than they should be.
KeyTimes keyTimesOf(const cage::Clip& clip, uint64_t most) {
    KeyTimes keys;
    std::vector<double> times;
    keys.isStepped = true;
    for (const Channel& channel : clip.channels) {
        if (movesNode(channel)) {
            times.insert(times.end(), channel.times.begin(), channel.times.end());
            keys.isStepped = keys.isStepped && channel.interpolation == Interpolation::step;
        }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    keys.times = times;
    if (!times.empty() && !keys.isStepped) {
        const double length = times.back() - times.front();
        const double atMostRate = std::ceil(length * kEvenRate) + 1.0;
        keys.times = static_cast<double>(times.size()) > 2.0 * atMostRate
                         ? evenTimes(times.front(), times.back(), static_cast<size_t>(atMostRate))
                         : closerTimes(times, kRateBetween, most);
        for (double rate = kRateBetween / 2; keys.times.size() > most && rate > 1.0; rate /= 2) {
            keys.times = closerTimes(times, rate, most);
            keys.isCoarse = true;
        }
    }
    if (keys.times.size() > most) {
        keys.times = evenTimes(times.front(), times.back(), most);
        keys.isCoarse = true;
    }
    return keys;
}

glm::vec4 asVector(const glm::dquat& q) {
    return glm::vec4(q.x, q.y, q.z, q.w);
}
glm::dquat asRotation(const glm::vec4& q) {
    return unit(glm::dquat(q.w, q.x, q.y, q.z));
}

/// A clip that scales far may come to numbers that no file could have.
bool isWithinLimits(const cage::Clip& clip) {
    return std::all_of(clip.channels.begin(), clip.channels.end(), [](const Channel& channel) {
        return std::all_of(channel.values.begin(), channel.values.end(),
                           [](float value) { return std::abs(value) <= cage::kMaxCoordinate; });
    });
}

/// How a channel of vectors is written: each number of a key.
void append(std::vector<float>& values, const glm::dvec3& v) {
    for (int i = 0; i < 3; ++i) {
        values.push_back(static_cast<float>(v[i]));
    }
}

/// One key is enough where all are alike.
void addChannel(uint32_t node, ChannelPath path, const KeyTimes& keys, std::vector<float> values, cage::Clip& clip) {
    const size_t width = path == ChannelPath::rotation ? 4 : 3;
    constexpr float kAlike = 1e-7f;
    bool isConstant = true;
    for (size_t i = width; i < values.size() && isConstant; ++i) {
        const float first = values[i % width];
        isConstant = std::abs(values[i] - first) <= kAlike * std::max(1.0f, std::abs(first));
    }
    Channel channel{node, path, keys.isStepped ? Interpolation::step : Interpolation::linear, {}, {}, 0};
    if (isConstant) {
        values.resize(width);
    }
    channel.values = std::move(values);
    for (size_t k = 0; k < (isConstant ? 1 : keys.times.size()); ++k) {
        channel.times.push_back(static_cast<float>(keys.times[k]));
    }
    clip.channels.push_back(std::move(channel));
}

/// The poses of one clip.
class FittedFrames {
public:
    FittedFrames(const FittedSkeletons& of, const cage::Clip& clip, KeyTimes keys)
        : of_(of), followers_(of.followers), keys_(std::move(keys)) {
        source_.skeleton = of.from;
        clip_.channels = clip.channels;
        std::erase_if(clip_.channels, [](const Channel& channel) { return !movesNode(channel); });
        const size_t frames = keys_.times.size();
        turns_.resize(frames * followers_.turned.size());
        moves_.resize(frames * followers_.moved.size());
        hips_.resize(frames);
        places_.assign(of.to.nodes.size(), kNone);
        for (size_t i = 0; i < followers_.turned.size(); ++i) {
            places_[followers_.turned[i].node] = static_cast<uint32_t>(i);
        }
        moved_.assign(of.to.nodes.size(), kNone);
        for (size_t i = 0; i < followers_.moved.size(); ++i) {
            moved_[followers_.moved[i].node] = static_cast<uint32_t>(i);
        }
        for (size_t side = 0; side < 2; ++side) {
            goals_[side].resize(frames);
            axes_[side].resize(frames);
        }
        globals_.resize(of.to.nodes.size(), glm::dmat4(1.0));
        model_.resize(of.to.nodes.size(), glm::dquat(1.0, 0.0, 0.0, 0.0));
    }

    void follow() {
        for (size_t frame = 0; frame < keys_.times.size(); ++frame) {
            readSource(keys_.times[frame]);
            place(frame);
            noteLegs(frame);
        }
    }

    /// Returns how far a leg ends short of its goal, at most. If that is more than `most`, nothing is changed.
    [[nodiscard]] double placeFeet(double most) {
        const std::vector<glm::dquat> free = turns_;
        double miss = 0.0;
        for (size_t side = 0; side < 2; ++side) {
            if (canBend(followers_.legs[side])) {
                miss = std::max(miss, bend(followers_.legs[side]));
            }
        }
        if (miss > most) {
            turns_ = free;
        }
        return miss;
    }

    [[nodiscard]] cage::Clip write(const cage::Clip& as) const {
        cage::Clip clip;
        clip.name = as.name;
        clip.duration = as.duration;
        clip.markers = as.markers;
        clip.sharpness = as.sharpness;
        for (size_t i = 0; i < followers_.turned.size(); ++i) {
            writeTurns(i, clip);
        }
        const uint32_t hips = followers_.to[roleOf(BodyPart::hips)];
        std::vector<float> values;
        for (const glm::dvec3& place : hips_) {
            append(values, place);
        }
        addChannel(hips, ChannelPath::translation, keys_, std::move(values), clip);
        for (size_t i = 0; i < followers_.moved.size(); ++i) {
            values.clear();
            for (size_t frame = 0; frame < keys_.times.size(); ++frame) {
                append(values, moves_[frame * followers_.moved.size() + i]);
            }
            addMoves(followers_.moved[i].node, values, clip);
        }
        return clip;
    }

private:
    /// Where the joints of the clip are and how they are turned.
    void readSource(double time) {
        sampleClip(source_, clip_, time, pose_);
        const cage::Skeleton& skeleton = source_.skeleton;
        sourceGlobals_.resize(skeleton.nodes.size());
        sourceModel_.resize(skeleton.nodes.size());
        for (const uint32_t n : skeleton.parentsFirst) {
            const cage::Node& node = skeleton.nodes[n];
            const glm::dmat4 local = localMatrix(node, pose_.locals[n]);
            const glm::dquat own = node.hasMatrix ? nearestRotation(glm::dmat3(local)) : unit(pose_.locals[n].rotation);
            sourceGlobals_[n] = node.parent == kNone ? local : sourceGlobals_[node.parent] * local;
            sourceModel_[n] = node.parent == kNone ? own : sourceModel_[node.parent] * own;
        }
    }
    /// D, in the frame of the skeleton that follows.
    [[nodiscard]] glm::dquat turnOf(uint32_t leader) const {
        const glm::dquat& yaw = followers_.yaw;
        return unit(yaw * sourceModel_[leader] * glm::conjugate(of_.fromRest.turns[leader]) * glm::conjugate(yaw));
    }
    /// Where a joint of a role goes, by where the clip's goes from its rest.
    [[nodiscard]] glm::dvec3 goalOf(Role role) const {
        const uint32_t leader = followers_.from[role];
        const glm::dvec3 way = glm::dvec3(sourceGlobals_[leader][3]) - of_.fromRest.place(leader);
        return of_.toRest.place(followers_.to[role]) + followers_.yaw * way * followers_.scale;
    }

    /// Fills the locals of a frame, and globals_ and model_.
    void place(size_t frame) {
        for (size_t i = 0; i < followers_.moved.size(); ++i) {
            const MoveFollower& moved = followers_.moved[i];
            const glm::dvec3 way =
                pose_.locals[moved.leader].translation - glm::dvec3(source_.skeleton.nodes[moved.leader].translation);
            moves_[frame * followers_.moved.size() + i] =
                glm::dvec3(of_.to.nodes[moved.node].translation) + moved.map * way;
        }
        poseTarget(
            frame,
            [&](uint32_t node, const glm::dquat& above) {
                const TurnFollower& own = followers_.turned[places_[node]];
                const glm::dquat turn = own.leader == own.next
                                            ? turnOf(own.leader)
                                            : unit(slerp(turnOf(own.leader), turnOf(own.next), own.share));
                return unit(glm::conjugate(above) * (turn * own.rest));
            },
            [&](const glm::dmat4& parent) { return hipsIn(parent); });
    }

    /// turn(node, rotation of its parent in model space): the local rotation of a node that follows. hips(matrix of
    /// their parent): where they are in its frame.
    template <class Turn, class Hips>
    void poseTarget(size_t frame, Turn&& turn, Hips&& placeOfHips) {
        const cage::Skeleton& to = of_.to;
        const uint32_t hips = followers_.to[roleOf(BodyPart::hips)];
        for (const uint32_t n : of_.needed) {
            const cage::Node& node = to.nodes[n];
            const glm::dquat above = node.parent == kNone ? glm::dquat(1.0, 0.0, 0.0, 0.0) : model_[node.parent];
            const glm::dmat4 parent = node.parent == kNone ? glm::dmat4(1.0) : globals_[node.parent];
            Transform local{node.translation, glm::dquat(node.rotation), node.scale};
            if (places_[n] != kNone) {
                local.rotation = turn(n, above);
                turns_[frame * followers_.turned.size() + places_[n]] = local.rotation;
            }
            if (n == hips) {
                local.translation = hips_[frame] = placeOfHips(parent);
            } else if (moved_[n] != kNone) {
                local.translation = moves_[frame * followers_.moved.size() + moved_[n]];
            }
            const glm::dmat4 matrix = localMatrix(node, local);
            globals_[n] = parent * matrix;
            model_[n] = above * (node.hasMatrix ? nearestRotation(glm::dmat3(matrix)) : unit(local.rotation));
        }
    }
    [[nodiscard]] glm::dvec3 hipsIn(const glm::dmat4& parent) const {
        const glm::dmat3 frame(parent);
        if (!(std::abs(glm::determinant(frame)) > 0.0)) {
            return glm::dvec3(of_.to.nodes[followers_.to[roleOf(BodyPart::hips)]].translation);
        }
        return glm::inverse(frame) * (goalOf(roleOf(BodyPart::hips)) - glm::dvec3(parent[3]));
    }

    [[nodiscard]] glm::dvec3 placeOf(uint32_t node) const { return glm::dvec3(globals_[node][3]); }
    [[nodiscard]] std::array<glm::dvec3, 3> jointsOf(const Leg& leg) const {
        return {placeOf(leg.path.front()), placeOf(leg.path[leg.shin]), placeOf(leg.path.back())};
    }

    /// Keeps where the ankles of a frame should go, and about which axes the knees bend.
    void noteLegs(size_t frame) {
        for (const Leg& leg : followers_.legs) {
            const auto [a, b, c] = jointsOf(leg);
            const glm::dvec3 axis = glm::cross(b - a, c - b);
            const double length = glm::length(axis);
            axes_[leg.side][frame] = length > 0.0 ? hingeFrame(leg) * axis / length : glm::dvec3(0.0);
            goals_[leg.side][frame] = goalOf(roleOf(BodyPart::foot, leg.side));
        }
    }

    /// To the knee's own frame: a character may turn round in a clip.
    [[nodiscard]] glm::dquat hingeFrame(const Leg& leg) const { return glm::conjugate(model_[leg.path[leg.shin]]); }

    /// All of a leg must be free to turn.
    [[nodiscard]] bool canBend(const Leg& leg) const {
        return leg.shin > 0 && leg.shin + 1 < leg.path.size() &&
               std::all_of(leg.path.begin(), leg.path.end(), [&](uint32_t node) { return places_[node] != kNone; });
    }

    /// The median of the axes about which the knee bends, in its frame; of a leg that is always straight, the way to
    /// the left as it rests.
    [[nodiscard]] glm::dvec3 hingeOf(const Leg& leg) const {
        glm::dvec3 hinge(0.0);
        for (int i = 0; i < 3; ++i) {
            std::vector<double> numbers;
            for (const glm::dvec3& axis : axes_[leg.side]) {
                numbers.push_back(axis[i]);
            }
            const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
            std::nth_element(numbers.begin(), middle, numbers.end());
            hinge[i] = *middle;
        }
        const glm::dvec3 left = of_.toRest.place(followers_.to[roleOf(BodyPart::thigh, kLeft)]) -
                                of_.toRest.place(followers_.to[roleOf(BodyPart::thigh, kRight)]);
        return glm::length(hinge) > 0.1 ? glm::normalize(hinge)
                                        : glm::conjugate(of_.toRest.turns[leg.path[leg.shin]]) * glm::normalize(left);
    }

    /// Brings the ankle to its goal in every frame; the foot keeps its rotation.
    [[nodiscard]] double bend(const Leg& leg) {
        const glm::dvec3 hinge = hingeOf(leg);
        const double height = hipsHeight(of_.toRest, followers_.to);
        double miss = 0.0;
        for (size_t frame = 0; frame < keys_.times.size(); ++frame) {
            poseTarget(
                frame,
                [&](uint32_t node, const glm::dquat&) {
                    return turns_[frame * followers_.turned.size() + places_[node]];
                },
                [&](const glm::dmat4&) { return hips_[frame]; });
            const auto [a, b, c] = jointsOf(leg);
            const glm::dvec3 goal = goals_[leg.side][frame];
            // About the thigh: so that floats are exact however far the clip has carried the character.
            const shared::LimbTurns turns =
                shared::bentLimb(glm::vec3(0.0f), glm::vec3(b - a), glm::vec3(c - a), glm::vec3(goal - a),
                                 glm::vec3(glm::conjugate(hingeFrame(leg)) * hinge), glm::vec3(0.0f), 0.0f, kAnkleSoft);
            miss = std::max(miss, glm::length(glm::dvec3(turns.end) - (goal - a)) / height);
            turnLeg(leg, frame, asRotation(turns.root), asRotation(turns.middle));
        }
        return miss;
    }
    void turnLeg(const Leg& leg, size_t frame, const glm::dquat& ofThigh, const glm::dquat& ofShin) {
        const uint32_t parent = of_.to.nodes[leg.path.front()].parent;
        glm::dquat above = parent == kNone ? glm::dquat(1.0, 0.0, 0.0, 0.0) : model_[parent];
        for (size_t i = 0; i < leg.path.size(); ++i) {
            const glm::dquat& was = model_[leg.path[i]];
            const glm::dquat now = i < leg.shin ? ofThigh * was : i + 1 < leg.path.size() ? ofShin * was : was;
            turns_[frame * followers_.turned.size() + places_[leg.path[i]]] = unit(glm::conjugate(above) * now);
            above = now;
        }
    }

    /// Keys that follow each other are on one side, so that what lies between is the short way.
    void writeTurns(size_t place, cage::Clip& clip) const {
        std::vector<float> values;
        glm::dquat last = glm::dquat(of_.to.nodes[followers_.turned[place].node].rotation);
        for (size_t frame = 0; frame < keys_.times.size(); ++frame) {
            glm::dquat q = turns_[frame * followers_.turned.size() + place];
            q = glm::dot(q, last) < 0.0 ? -q : q;
            last = q;
            const glm::vec4 v = asVector(q);
            values.insert(values.end(), {v.x, v.y, v.z, v.w});
        }
        addChannel(followers_.turned[place].node, ChannelPath::rotation, keys_, std::move(values), clip);
    }
    /// A joint that is not moved has no channel.
    void addMoves(uint32_t node, const std::vector<float>& values, cage::Clip& clip) const {
        const glm::vec3 rest = of_.to.nodes[node].translation;
        const double most = 1e-6 * hipsHeight(of_.toRest, followers_.to);
        for (size_t i = 0; i < values.size(); ++i) {
            if (std::abs(static_cast<double>(values[i] - rest[static_cast<int>(i % 3)])) > most) {
                addChannel(node, ChannelPath::translation, keys_, values, clip);
                return;
            }
        }
    }

    const FittedSkeletons& of_;
    const Followers& followers_;
    KeyTimes keys_;
    cage::Character source_; ///< the clip's skeleton alone
    cage::Clip clip_;
    Pose pose_;
    std::vector<glm::dmat4> sourceGlobals_, globals_;
    std::vector<glm::dquat> sourceModel_, model_;         ///< rotations alone, in model space
    std::vector<glm::dquat> turns_;                       ///< by frame: local rotations of what follows
    std::vector<glm::dvec3> moves_, hips_;                ///< by frame: local translations
    std::vector<uint32_t> places_, moved_;                ///< by node: among those that turn, or are moved
    std::array<std::vector<glm::dvec3>, 2> goals_, axes_; ///< by side and frame
};

} // namespace

FittedSkeletons::FittedSkeletons(const cage::Skeleton& leading, const cage::Skeleton& own, const Followers& following)
    : from(leading), to(own), followers(following), fromRest(leading), toRest(own) {
    std::vector<bool> isNeeded(to.nodes.size(), false);
    const auto need = [&](uint32_t node) {
        for (; node != kNone && !isNeeded[node]; node = to.nodes[node].parent) {
            isNeeded[node] = true;
        }
    };
    for (const TurnFollower& follower : followers.turned) {
        need(follower.node);
    }
    for (const MoveFollower& follower : followers.moved) {
        need(follower.node);
    }
    need(followers.to[roleOf(BodyPart::hips)]);
    std::copy_if(to.parentsFirst.begin(), to.parentsFirst.end(), std::back_inserter(needed),
                 [&](uint32_t node) { return isNeeded[node]; });
}

ClipFitter::ClipFitter(const cage::Skeleton& from, const cage::Skeleton& to, const Followers& followers, uint64_t clips,
                       uint64_t numbers)
    : of_(from, to, followers), clipsLeft_(clips), left_(std::min(kLeastBudget + 8 * numbers, kLargestBudget)) {}

ClipFitter::Fitted ClipFitter::fit(const cage::Clip& clip, Feet feet, double mostMissed) {
    const uint64_t nodes = of_.from.nodes.size() + of_.needed.size();
    const uint64_t most = left_ / std::max<uint64_t>(clipsLeft_, 1) / nodes;
    clipsLeft_ -= clipsLeft_ > 0 ? 1 : 0;
    Fitted fitted;
    if (most < 2) {
        fitted.whyLeftOut = "no room for its poses";
        return fitted;
    }
    KeyTimes keys = keyTimesOf(clip, most);
    left_ -= keys.times.size() * nodes;
    fitted.isCoarse = keys.isCoarse;
    if (keys.times.empty()) {
        fitted.clip = clip;
        fitted.clip.channels.clear();
        return fitted;
    }
    FittedFrames frames(of_, clip, std::move(keys));
    frames.follow();
    if (feet == Feet::placed) {
        fitted.miss = frames.placeFeet(mostMissed);
    }
    fitted.clip = frames.write(clip);
    if (!isWithinLimits(fitted.clip)) {
        fitted.whyLeftOut = "numbers beyond the limit";
    }
    return fitted;
}

} // namespace supple::skinning
