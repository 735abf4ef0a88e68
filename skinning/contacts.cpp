#include "skinning/contacts.h"

#include "skinning/layers.h"
#include "skinning/modifiers.h"
#include "skinning/pose.h"
#include "skinning/root_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace supple::skinning {
namespace {

constexpr double kContactHeight = 0.05, kContactRadius = 0.05; // legs
constexpr double kContactSpeed = 0.4;                          // legs a second
constexpr double kShortest = 0.05;                             // seconds: of a contact, and of a gap between two
constexpr double kRate = 60.0;                                 // samples a second
constexpr double kLongestClip = 300.0;                         // seconds
constexpr size_t kMostSamples = 2'000'000;                     // of nodes, in all clips
constexpr double kJoinDistance = 0.1; // legs: what the end of a loop and its beginning may differ by

glm::dvec2 onGround(const glm::dvec3& p) {
    return {p.x, p.z};
}

bool isFinite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

class FootFinder {
public:
    explicit FootFinder(const cage::Character& character)
        : character_(character), rig_(makeRig(character)), globals_(character.skeleton.nodes.size()) {
        restPose(character.skeleton, globals_);
        globalTransforms(character.skeleton, globals_, globals_);
    }

    [[nodiscard]] std::vector<Foot> find() {
        findLowestVertices();
        std::vector<Foot> feet;
        for (uint32_t joint = 0; joint < rig_.jointParents.size(); ++joint) {
            if (const std::optional<Foot> foot = footOf(joint)) {
                feet.push_back(*foot);
            }
        }
        removeToes(feet);
        std::stable_sort(feet.begin(), feet.end(), [](const Foot& a, const Foot& b) { return a.sole < b.sole; });
        feet.resize(std::min(feet.size(), kMostFeet));
        return feet;
    }

private:
    [[nodiscard]] glm::dvec3 placeOf(uint32_t node) const { return glm::dvec3(globals_[node][3]); }

    /// The end of a limb that hangs down to the ground.
    [[nodiscard]] std::optional<Foot> footOf(uint32_t joint) const {
        const std::optional<Modifier> limb = limbOf(character_, rig_, joint);
        if (!limb) {
            return std::nullopt;
        }
        const glm::dvec3 a = placeOf(limb->chain[0]), b = placeOf(limb->chain[1]), c = placeOf(limb->chain[2]);
        Foot foot;
        foot.node = limb->chain[2];
        foot.leg = glm::length(b - a) + glm::length(c - b);
        foot.sole = std::min(c.y, lowestBelow_[foot.node]);
        foot.height = c.y - foot.sole;
        constexpr double kDown = 0.6, kHighest = 0.42, kNearGround = 0.08; // legs; a knee is higher than 0.42
        const bool stands = std::isfinite(foot.leg) && std::isfinite(foot.sole) && foot.leg > 0.0 &&
                            a.y - c.y > kDown * foot.leg && foot.height <= kHighest * foot.leg &&
                            foot.sole - lowest_ <= kNearGround * foot.leg;
        return stands ? std::optional(foot) : std::nullopt;
    }

    /// By node: the height of the lowest vertex of those that follow it, or what hangs on it, more than others.
    void findLowestVertices() {
        const cage::Skin& skin = character_.skin;
        const cage::SkinWeights& weights = character_.weights;
        const cage::Skeleton& skeleton = character_.skeleton;
        lowestBelow_.assign(skeleton.nodes.size(), std::numeric_limits<double>::infinity());
        std::vector<glm::dmat4> palette;
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            palette.push_back(glm::dmat4(globals_[skin.joints[j]]) * glm::dmat4(skin.inverseBinds[j]));
        }
        for (size_t v = 0; v < character_.cage.positions.size(); ++v) {
            const auto begin = weights.influences.begin() + weights.starts[v],
                       end = weights.influences.begin() + weights.starts[v + 1];
            const auto best = std::max_element(
                begin, end, [](const cage::Influence& a, const cage::Influence& b) { return a.weight < b.weight; });
            if (best != end) {
                const double height =
                    (palette[best->joint] * glm::dvec4(glm::dvec3(character_.cage.positions[v]), 1.0)).y;
                double& lowest = lowestBelow_[skin.joints[best->joint]];
                lowest = std::min(lowest, height);
                lowest_ = std::min(lowest_, height);
            }
        }
        for (size_t i = skeleton.parentsFirst.size(); i-- > 0;) {
            const uint32_t node = skeleton.parentsFirst[i], parent = skeleton.nodes[node].parent;
            if (parent != cage::kNone) {
                lowestBelow_[parent] = std::min(lowestBelow_[parent], lowestBelow_[node]);
            }
        }
    }

    /// A joint below another foot is a toe.
    void removeToes(std::vector<Foot>& feet) const {
        const cage::Skeleton& skeleton = character_.skeleton;
        std::vector<uint8_t> isFoot(skeleton.nodes.size(), 0), isBelow(skeleton.nodes.size(), 0);
        for (const Foot& foot : feet) {
            isFoot[foot.node] = 1;
        }
        for (const uint32_t node : skeleton.parentsFirst) {
            const uint32_t parent = skeleton.nodes[node].parent;
            isBelow[node] = parent != cage::kNone && (isFoot[parent] != 0 || isBelow[parent] != 0) ? 1 : 0;
        }
        std::erase_if(feet, [&](const Foot& foot) { return isBelow[foot.node] != 0; });
    }

    const cage::Character& character_;
    Rig rig_;
    std::vector<glm::mat4> globals_;
    std::vector<double> lowestBelow_;
    double lowest_ = std::numeric_limits<double>::infinity(); ///< of the whole cage
};

/// Finds the contacts of one clip after the other.
class ContactFinder {
public:
    ContactFinder(const cage::Character& character, const std::vector<Foot>& feet)
        : character_(character), feet_(feet), root_{findRoot(character), kRootGround | kRootYaw} {
        const cage::Skeleton& skeleton = character.skeleton;
        places_.assign(skeleton.nodes.size(), cage::kNone);
        for (const Foot& foot : feet) {
            for (uint32_t node = foot.node; node != cage::kNone; node = skeleton.nodes[node].parent) {
                places_[node] = 0;
            }
        }
        for (const uint32_t node : skeleton.parentsFirst) {
            if (places_[node] != cage::kNone) {
                places_[node] = static_cast<uint32_t>(nodes_.size());
                nodes_.push_back(node);
            }
        }
        globals_.resize(nodes_.size());
    }

    void find(const cage::Clip& clip, std::vector<std::vector<Contact>>& found) {
        const size_t first = found.size();
        found.resize(first + feet_.size());
        if (!(clip.duration <= kLongestClip)) {
            return;
        }
        const size_t samples = std::max(static_cast<size_t>(clip.duration * kRate) + 1, size_t{2});
        if (samples * nodes_.size() > samplesLeft_) {
            return;
        }
        samplesLeft_ -= samples * nodes_.size();
        step_ = clip.duration / static_cast<double>(samples - 1);
        sample(clip, samples);
        const glm::dvec2 ground = groundSpeed();
        for (size_t f = 0; f < feet_.size(); ++f) {
            found[first + f] = contactsOf(f, ground);
            joinOverTheEnd(clip, feet_[f], found[first + f]);
        }
    }

private:
    void sample(const cage::Clip& clip, size_t samples) {
        std::vector<cage::Clip> own(nodes_.size()); // the channels of a node
        for (const cage::Channel& channel : clip.channels) {
            if (channel.path != cage::ChannelPath::weights && places_[channel.node] != cage::kNone) {
                own[places_[channel.node]].channels.push_back(channel);
            }
        }
        paths_.assign(feet_.size(), std::vector<glm::dvec3>(samples));
        for (size_t k = 0; k < samples; ++k) {
            for (size_t n = 0; n < nodes_.size(); ++n) {
                const cage::Node& from = character_.skeleton.nodes[nodes_[n]];
                const glm::dmat4 local = localMatrix(
                    from, sampleNode(character_.skeleton, own[n], step_ * static_cast<double>(k), nodes_[n]));
                globals_[n] = from.parent == cage::kNone ? local : globals_[places_[from.parent]] * local;
            }
            for (size_t f = 0; f < feet_.size(); ++f) {
                paths_[f][k] = glm::dvec3(globals_[places_[feet_[f].node]][3]);
            }
        }
    }

    [[nodiscard]] glm::dvec2 speed(size_t foot, size_t sample) const {
        const std::vector<glm::dvec3>& path = paths_[foot];
        const size_t before = sample > 0 ? sample - 1 : 0, after = std::min(sample + 1, path.size() - 1);
        return step_ > 0.0
                   ? (onGround(path[after]) - onGround(path[before])) / (step_ * static_cast<double>(after - before))
                   : glm::dvec2(0.0);
    }

    /// How high a foot may be to stand; nothing if it never comes near the ground.
    [[nodiscard]] std::optional<double> standingHeight(size_t foot) const {
        double lowest = std::numeric_limits<double>::infinity();
        for (const glm::dvec3& p : paths_[foot]) {
            if (!isFinite(p)) {
                return std::nullopt;
            }
            lowest = std::min(lowest, p.y);
        }
        const Foot& own = feet_[foot];
        constexpr double kNearRest = 0.15;
        return lowest < own.sole + own.height + kNearRest * own.leg ? std::optional(lowest + kContactHeight * own.leg)
                                                                    : std::nullopt;
    }

    /// The median of all feet that are as low as they get: while a foot rolls over its heel or its toes, its joint goes
    /// slower than the ground. Where many of those that are low enough to stand rest, the ground does, too: else a step
    /// or a turn on the spot would make it slide.
    [[nodiscard]] glm::dvec2 groundSpeed() const {
        constexpr double kAtRest = 0.1, kEnoughAtRest = 0.3; // legs a second; of all that are low
        constexpr double kFlat = 0.015;                      // legs above the lowest
        std::vector<double> speeds[2];
        size_t atRest = 0, low = 0;
        for (size_t f = 0; f < feet_.size(); ++f) {
            const std::optional<double> height = standingHeight(f);
            for (size_t k = 0; height && k < paths_[f].size(); ++k) {
                const glm::dvec2 own = speed(f, k);
                if (paths_[f][k].y < *height) {
                    ++low;
                    atRest += glm::length(own) < kAtRest * feet_[f].leg ? 1 : 0;
                }
                if (paths_[f][k].y < *height - (kContactHeight - kFlat) * feet_[f].leg) {
                    speeds[0].push_back(own.x);
                    speeds[1].push_back(own.y);
                }
            }
        }
        glm::dvec2 median(0.0);
        for (int axis = 0; axis < 2 && static_cast<double>(atRest) < kEnoughAtRest * static_cast<double>(low); ++axis) {
            std::vector<double>& own = speeds[axis];
            const auto middle = own.begin() + static_cast<ptrdiff_t>(own.size() / 2);
            std::nth_element(own.begin(), middle, own.end());
            median[axis] = *middle;
        }
        return median;
    }

    [[nodiscard]] std::vector<Contact> contactsOf(size_t foot, const glm::dvec2& ground) const {
        const std::optional<double> height = standingHeight(foot);
        if (!height) {
            return {};
        }
        // Runs of samples: in each the foot stays near one place. Short gaps do not count.
        const std::vector<glm::dvec3>& path = paths_[foot];
        std::vector<Run> runs;
        for (size_t k = 0; k < path.size(); ++k) {
            const bool stands =
                path[k].y < *height && glm::length(speed(foot, k) - ground) < kContactSpeed * feet_[foot].leg;
            if (!stands) {
                continue;
            }
            const glm::dvec2 place = onGround(path[k]) - ground * (step_ * static_cast<double>(k));
            const bool goesOn = !runs.empty() &&
                                static_cast<double>(k - runs.back().last) * step_ <= kShortest + 1e-9 &&
                                glm::length(place - runs.back().mean()) <= kContactRadius * feet_[foot].leg;
            if (!goesOn) {
                runs.push_back({k, k, glm::dvec2(0.0), 0});
            }
            runs.back().last = k;
            runs.back().sum += place;
            ++runs.back().count;
        }
        std::vector<Contact> contacts;
        for (const Run& run : runs) {
            const double begin = step_ * static_cast<double>(run.first), end = step_ * static_cast<double>(run.last);
            if (step_ == 0.0 && contacts.empty()) { // a clip of one pose
                contacts.push_back({-1.0, 1.0, run.mean(), glm::dvec2(0.0)});
            } else if (end - begin >= kShortest) {
                contacts.push_back({begin, end, run.mean(), ground});
            }
        }
        return contacts;
    }

    /// If the foot stands at the clip's end and at its beginning, in the same place once the root has moved on, these
    /// are one contact.
    void joinOverTheEnd(const cage::Clip& clip, const Foot& foot, std::vector<Contact>& contacts) const {
        if (contacts.empty() || !(clip.duration > 0.0) || contacts.front().begin > 0.0 ||
            contacts.back().end < clip.duration - 0.5 * step_) {
            return;
        }
        const RootMotion loop = rootMotionBetween(character_, clip, root_, 0.0, clip.duration, false);
        const auto moved = [](const RootMotion& motion, const glm::dvec2& p) {
            return onGround(glm::dvec3(toMatrix(motion) * glm::dvec4(p.x, 0.0, p.y, 1.0)));
        };
        Contact &first = contacts.front(), &last = contacts.back();
        const double duration = clip.duration, firstSeconds = first.end - first.begin,
                     lastSeconds = last.end - last.begin;
        if (contacts.size() == 1) { // it stands all the time
            first.begin -= duration;
            first.end += duration;
            return;
        }
        // The end of the clip as the next loop sees it.
        const glm::dvec2 before = moved(inverse(loop), last.place + last.drift * duration);
        if (glm::length(before - first.place) > kJoinDistance * foot.leg) {
            return;
        }
        const glm::dvec2 place =
            (before * lastSeconds + first.place * firstSeconds) / std::max(firstSeconds + lastSeconds, 1e-9);
        const double begin = first.begin, end = last.end;
        first.place = place;
        first.begin = begin - lastSeconds;
        last.place = moved(loop, place) - last.drift * duration;
        last.end = end + firstSeconds;
    }

    /// Samples one behind the other, and the sum of where the foot stands in them at the clip's time 0.
    struct Run {
        size_t first = 0, last = 0;
        glm::dvec2 sum{0.0};
        size_t count = 0;
        [[nodiscard]] glm::dvec2 mean() const { return sum / static_cast<double>(std::max(count, size_t{1})); }
    };

    const cage::Character& character_;
    const std::vector<Foot>& feet_;
    RootSelection root_;
    std::vector<uint32_t> nodes_;  ///< feet and what they hang on, parents first
    std::vector<uint32_t> places_; ///< by node: its place there, or kNone
    std::vector<glm::dmat4> globals_;
    std::vector<std::vector<glm::dvec3>> paths_; ///< of every foot, in model space
    double step_ = 0.0;
    size_t samplesLeft_ = kMostSamples;
};

} // namespace

Contacts findContacts(const cage::Character& character) {
    Contacts contacts;
    contacts.feet = FootFinder(character).find();
    if (contacts.feet.empty()) {
        return contacts;
    }
    ContactFinder finder(character, contacts.feet);
    for (const cage::Clip& clip : character.clips) {
        finder.find(clip, contacts.ofClips);
    }
    return contacts;
}

} // namespace supple::skinning
