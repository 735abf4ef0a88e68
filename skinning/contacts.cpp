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

constexpr double kContactHeight = 0.05, kContactSpeed = 0.4; // legs; legs a second
constexpr double kShortest = 0.05;                           // seconds: of a contact, and of a gap between two
constexpr double kRate = 60.0;                               // looks a second
constexpr size_t kMostLooks = 20000;
constexpr double kJoinDistance = 0.1; // legs: what the end of a loop and its beginning may differ by

glm::dvec2 onGround(const glm::dvec3& p) {
    return {p.x, p.z};
}

class FootFinder {
public:
    explicit FootFinder(const cage::Character& character)
        : character_(character), parents_(makeRig(character).jointParents), globals_(character.skeleton.nodes.size()) {
        restPose(character.skeleton, globals_);
        globalTransforms(character.skeleton, globals_, globals_);
    }

    [[nodiscard]] std::vector<Foot> find() {
        std::vector<Foot> feet;
        for (uint32_t joint = 0; joint < parents_.size(); ++joint) {
            if (const std::optional<Foot> foot = legOf(joint)) {
                feet.push_back(*foot);
            }
        }
        if (feet.empty()) {
            return feet;
        }
        takeSoles(feet);
        double lowest = feet.front().sole;
        for (const Foot& foot : feet) {
            lowest = std::min(lowest, foot.sole);
        }
        std::erase_if(feet, [&](const Foot& foot) {
            constexpr double kNearGround = 0.5; // legs: a knee is higher
            return foot.sole + foot.height - lowest > kNearGround * foot.leg;
        });
        const std::vector<Foot> all = feet;
        std::erase_if(feet, [&](const Foot& foot) { // toes
            return std::any_of(all.begin(), all.end(), [&](const Foot& other) {
                return other.node != foot.node && hangsOn(foot.node, other.node);
            });
        });
        feet.resize(std::min(feet.size(), kMostFeet));
        return feet;
    }

private:
    [[nodiscard]] glm::dvec3 placeOf(uint32_t node) const { return glm::dvec3(globals_[node][3]); }

    /// A limb that hangs down.
    [[nodiscard]] std::optional<Foot> legOf(uint32_t joint) const {
        const std::optional<Modifier> limb = limbOf(character_, parents_, joint);
        if (!limb) {
            return std::nullopt;
        }
        const glm::dvec3 a = placeOf(limb->chain[0]), b = placeOf(limb->chain[1]), c = placeOf(limb->chain[2]);
        const double leg = glm::length(b - a) + glm::length(c - b);
        constexpr double kDown = 0.6;
        if (!(leg > 0.0) || !(a.y - c.y > kDown * leg)) {
            return std::nullopt;
        }
        Foot foot;
        foot.node = limb->chain[2];
        foot.leg = leg;
        foot.sole = c.y;
        return foot;
    }

    [[nodiscard]] bool hangsOn(uint32_t node, uint32_t above) const {
        while (node != above && node != cage::kNone) {
            node = character_.skeleton.nodes[node].parent;
        }
        return node == above;
    }

    void takeSoles(std::vector<Foot>& feet) const {
        const std::vector<double> lowest = lowestVertices();
        for (Foot& foot : feet) {
            const double joint = foot.sole;
            for (size_t j = 0; j < lowest.size(); ++j) {
                if (hangsOn(character_.skin.joints[j], foot.node)) {
                    foot.sole = std::min(foot.sole, lowest[j]);
                }
            }
            foot.height = joint - foot.sole;
        }
    }

    /// By joint: the height of the lowest vertex of those that follow it more than others.
    [[nodiscard]] std::vector<double> lowestVertices() const {
        const cage::Skin& skin = character_.skin;
        const cage::SkinWeights& weights = character_.weights;
        std::vector<double> lowest(skin.joints.size(), std::numeric_limits<double>::infinity());
        for (size_t v = 0; v < character_.cage.positions.size(); ++v) {
            const auto begin = weights.influences.begin() + weights.starts[v],
                       end = weights.influences.begin() + weights.starts[v + 1];
            const auto best = std::max_element(
                begin, end, [](const cage::Influence& a, const cage::Influence& b) { return a.weight < b.weight; });
            if (best != end) {
                const glm::dmat4 place =
                    glm::dmat4(globals_[skin.joints[best->joint]]) * glm::dmat4(skin.inverseBinds[best->joint]);
                const glm::dvec4 placed = place * glm::dvec4(glm::dvec3(character_.cage.positions[v]), 1.0);
                lowest[best->joint] = std::min(lowest[best->joint], placed.y);
            }
        }
        return lowest;
    }

    const cage::Character& character_;
    std::vector<uint32_t> parents_;
    std::vector<glm::mat4> globals_;
};

/// Looks at the feet of one clip after the other.
class ContactFinder {
public:
    ContactFinder(const cage::Character& character, const std::vector<Foot>& feet)
        : character_(character), feet_(feet), root_{findRoot(character), kRootGround | kRootYaw} {
        std::vector<bool> taken(character.skeleton.nodes.size(), false);
        for (const Foot& foot : feet) {
            for (uint32_t node = foot.node; node != cage::kNone; node = character.skeleton.nodes[node].parent) {
                taken[node] = true;
            }
        }
        for (const uint32_t node : character.skeleton.parentsFirst) {
            if (taken[node]) {
                nodes_.push_back(node);
            }
        }
        globals_.resize(taken.size());
    }

    void find(const cage::Clip& clip, std::vector<std::vector<Contact>>& found) {
        const size_t looks =
            std::clamp(static_cast<size_t>(std::min(clip.duration * kRate, 1e9)) + 1, size_t{2}, kMostLooks);
        step_ = clip.duration / static_cast<double>(looks - 1);
        follow(clip, looks);
        const glm::dvec2 ground = groundSpeed();
        for (size_t f = 0; f < feet_.size(); ++f) {
            found.push_back(contactsOf(f, ground));
            joinOverTheEnd(clip, feet_[f], found.back());
        }
    }

private:
    void follow(const cage::Clip& clip, size_t looks) {
        cage::Clip own; // with the channels of these nodes alone
        own.duration = clip.duration;
        for (const cage::Channel& channel : clip.channels) {
            if (channel.path != cage::ChannelPath::weights &&
                std::find(nodes_.begin(), nodes_.end(), channel.node) != nodes_.end()) {
                own.channels.push_back(channel);
            }
        }
        paths_.assign(feet_.size(), std::vector<glm::dvec3>(looks));
        for (size_t k = 0; k < looks; ++k) {
            for (const uint32_t node : nodes_) {
                const cage::Node& from = character_.skeleton.nodes[node];
                const glm::dmat4 local =
                    localMatrix(from, sampleNode(character_.skeleton, own, step_ * static_cast<double>(k), node));
                globals_[node] = from.parent == cage::kNone ? local : globals_[from.parent] * local;
            }
            for (size_t f = 0; f < feet_.size(); ++f) {
                paths_[f][k] = glm::dvec3(globals_[feet_[f].node][3]);
            }
        }
    }

    [[nodiscard]] glm::dvec2 speed(size_t foot, size_t look) const {
        const std::vector<glm::dvec3>& path = paths_[foot];
        const size_t before = look > 0 ? look - 1 : 0, after = std::min(look + 1, path.size() - 1);
        return step_ > 0.0
                   ? (onGround(path[after]) - onGround(path[before])) / (step_ * static_cast<double>(after - before))
                   : glm::dvec2(0.0);
    }

    /// How high a foot may be to stand; nothing if it never comes near the ground.
    [[nodiscard]] std::optional<double> standingHeight(size_t foot) const {
        double lowest = paths_[foot].front().y;
        for (const glm::dvec3& p : paths_[foot]) {
            lowest = std::min(lowest, p.y);
        }
        const Foot& own = feet_[foot];
        constexpr double kNearRest = 0.15;
        return lowest < own.sole + own.height + kNearRest * own.leg ? std::optional(lowest + kContactHeight * own.leg)
                                                                    : std::nullopt;
    }

    [[nodiscard]] glm::dvec2 groundSpeed() const {
        std::vector<double> speeds[2];
        for (size_t f = 0; f < feet_.size(); ++f) {
            const std::optional<double> height = standingHeight(f);
            for (size_t k = 0; height && k < paths_[f].size(); ++k) {
                if (paths_[f][k].y < *height) {
                    const glm::dvec2 own = speed(f, k);
                    speeds[0].push_back(own.x);
                    speeds[1].push_back(own.y);
                }
            }
        }
        glm::dvec2 median(0.0);
        for (int axis = 0; axis < 2; ++axis) {
            std::vector<double>& own = speeds[axis];
            if (!own.empty()) {
                const auto middle = own.begin() + static_cast<ptrdiff_t>(own.size() / 2);
                std::nth_element(own.begin(), middle, own.end());
                median[axis] = *middle;
            }
        }
        return median;
    }

    [[nodiscard]] std::vector<Contact> contactsOf(size_t foot, const glm::dvec2& ground) const {
        std::vector<Contact> contacts;
        const std::optional<double> height = standingHeight(foot);
        if (!height) {
            return contacts;
        }
        const std::vector<glm::dvec3>& path = paths_[foot];
        const auto stands = [&](size_t k) {
            return path[k].y < *height && glm::length(speed(foot, k) - ground) < kContactSpeed * feet_[foot].leg;
        };
        // Looks that stand, and short gaps between them.
        std::vector<std::pair<size_t, size_t>> runs;
        for (size_t k = 0; k < path.size(); ++k) {
            if (!stands(k)) {
                continue;
            }
            const bool goesOn = !runs.empty() && static_cast<double>(k - runs.back().second) * step_ <= kShortest;
            if (goesOn) {
                runs.back().second = k;
            } else {
                runs.emplace_back(k, k);
            }
        }
        for (const auto& [first, last] : runs) {
            const bool whole = first == 0 && last + 1 == path.size(); // also of a clip of one pose
            if (whole || static_cast<double>(last - first) * step_ >= kShortest) {
                contacts.push_back(contactIn(path, first, last, ground));
            }
        }
        return contacts;
    }

    [[nodiscard]] Contact contactIn(const std::vector<glm::dvec3>& path, size_t first, size_t last,
                                    const glm::dvec2& ground) const {
        Contact contact;
        contact.begin = step_ * static_cast<double>(first);
        contact.end = step_ * static_cast<double>(last);
        contact.drift = ground;
        for (size_t k = first; k <= last; ++k) {
            contact.place += onGround(path[k]) - ground * (step_ * static_cast<double>(k));
        }
        contact.place /= static_cast<double>(last - first + 1);
        return contact;
    }

    /// If the foot stands at the clip's end and at its beginning, in the same place once the root has moved on, it does
    /// so in one.
    void joinOverTheEnd(const cage::Clip& clip, const Foot& foot, std::vector<Contact>& contacts) const {
        if (contacts.empty() || !(clip.duration > 0.0) || contacts.front().begin > 0.0 ||
            contacts.back().end < clip.duration - 0.5 * step_) {
            return;
        }
        const RootMotion loop = rootMotionBetween(character_, clip, root_, 0.0, clip.duration, false);
        const auto moved = [](const RootMotion& motion, const glm::dvec2& p, double point) {
            return onGround(glm::dvec3(toMatrix(motion) * glm::dvec4(p.x, 0.0, p.y, point)));
        };
        Contact &first = contacts.front(), &last = contacts.back();
        const double duration = clip.duration, own = last.end - last.begin, other = first.end - first.begin;
        if (contacts.size() == 1 && own >= duration - 0.5 * step_) { // it stands all the time
            first.begin -= duration;
            first.end += duration;
            return;
        }
        // The end of the clip as the next loop sees it.
        const glm::dvec2 before = moved(inverse(loop), last.place + last.drift * duration, 1.0);
        if (glm::length(before - first.place) > kJoinDistance * foot.leg) {
            return;
        }
        const glm::dvec2 place = (before * own + first.place * other) / std::max(own + other, 1e-9);
        const double begin = first.begin, end = last.end;
        first.place = place;
        first.begin = begin - own;
        last.place = moved(loop, place, 1.0) - last.drift * duration;
        last.end = end + other;
    }

    const cage::Character& character_;
    const std::vector<Foot>& feet_;
    RootSelection root_;
    std::vector<uint32_t> nodes_; ///< feet and what they hang on, parents first
    std::vector<glm::dmat4> globals_;
    std::vector<std::vector<glm::dvec3>> paths_; ///< of every foot, in model space
    double step_ = 0.0;
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
