#include "skinning/retarget.h"

#include "cage/message.h"
#include "cage/node_match.h"
#include "cage/refusal.h"
#include "cage/skeleton.h"
#include "skinning/fitted_clip.h"
#include "skinning/followers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace supple::skinning {
namespace {

using cage::kNone;

constexpr float kSameBone = 0.01f;  ///< relative: bones of skeletons that are the same
constexpr double kFarMiss = 0.05;   ///< heights of the hips: what is told
constexpr double kMostMissed = 0.3; ///< beyond it a leg does not fit, and keeps the clip's angles

/// The first, parents before children; kNone also for no name.
uint32_t nodeNamed(const cage::Skeleton& skeleton, const std::string& name) {
    const auto found = std::find_if(skeleton.parentsFirst.begin(), skeleton.parentsFirst.end(),
                                    [&](uint32_t n) { return skeleton.nodes[n].name == name; });
    return found != skeleton.parentsFirst.end() && !name.empty() ? *found : kNone;
}

glm::vec3 restTranslation(const cage::Node& node) {
    return node.hasMatrix ? glm::vec3(node.matrix[3]) : node.translation;
}

/// The skeleton with matrices taken apart where they can be, as takeClips() does it.
cage::Skeleton withoutMatrices(cage::Skeleton skeleton) {
    for (cage::Node& node : skeleton.nodes) {
        if (node.hasMatrix) {
            (void)cage::decompose(node); // a sheared one stays, and is not turned
        }
    }
    return skeleton;
}

/// Fits one set.
class SetFitter {
public:
    SetFitter(const RetargetOptions& options, const cage::Skeleton& to, cage::ClipSet& set)
        : options_(options), to_(withoutMatrices(to)), set_(set), match_(cage::matchNodes(set.skeleton, to_)) {
        Roles from{}, own{};
        from.fill(kNone);
        own.fill(kNone);
        for (const JointPair& pair : options.pairs) {
            takePair(pair, from, own);
        }
        faults_.raise();
        from_ = findRoles(set.skeleton, from);
        own_ = findRoles(to_, own);
    }

    void fit() {
        const bool isAsked = options_.retargeting != Retargeting::differing || !options_.pairs.empty();
        std::string reason = whyNot();
        if (reason.empty() && !isAsked) {
            reason = isUpright(set_.skeleton, from_) && isUpright(to_, own_) ? "" : "not both skeletons stand upright";
        }
        if (!reason.empty()) {
            if (isAsked) {
                cage::refuse(set_.name, "cannot be retargeted: " + reason);
            }
            set_.whyNotFitted = reason;
            return;
        }
        if (!isAsked && isSameSkeleton()) {
            return;
        }
        const Followers followers = findFollowers({set_.skeleton, from_}, {to_, own_}, given_, match_.partners);
        noteLeftOut(followers);
        fitClips(followers);
        tell(followers);
        moveWeights();
        set_.skeleton = to_;
        set_.isFitted = true;
    }

private:
    void takePair(const JointPair& pair, Roles& from, Roles& own) {
        const uint32_t leader = nodeNamed(set_.skeleton, pair.from), node = nodeNamed(to_, pair.to);
        if (!pair.to.empty() && node == kNone) {
            faults_.keep({ErrorCode::argument, {"joint pairs: the character has no node " + cage::quoted(pair.to)}});
            return;
        }
        if (!pair.from.empty() && leader == kNone) {
            unknown_.push_back(pair.from);
        } else if (!pair.role) {
            given_.emplace_back(leader, node);
        } else {
            from[*pair.role] = leader != kNone ? leader : from[*pair.role];
            own[*pair.role] = node != kNone ? node : own[*pair.role];
        }
    }

    /// Why the clips cannot be fitted, or nothing.
    [[nodiscard]] std::string whyNot() const {
        const std::string reason = whyNot(from_, set_.skeleton, "its");
        return reason.empty() ? whyNot(own_, to_, "the character's") : reason;
    }
    [[nodiscard]] static std::string whyNot(const Roles& roles, const cage::Skeleton& skeleton, const char* whose) {
        if (!hasLegs(roles)) {
            return whatIsMissing(roles) + " in " + whose + " skeleton";
        }
        if (!(hipsHeight(RestPlaces(skeleton), roles) > 0.0)) {
            return std::string("the hips of ") + whose + " skeleton are not above the ankles";
        }
        return {};
    }

    /// Whether the head is farther above the hips than beside them. One without a head is.
    [[nodiscard]] static bool isUpright(const cage::Skeleton& skeleton, const Roles& roles) {
        const Role top = roles[roleOf(BodyPart::head)] != kNone ? roleOf(BodyPart::head) : roleOf(BodyPart::neck);
        if (roles[top] == kNone) {
            return true;
        }
        const RestPlaces rest(skeleton);
        const glm::dvec3 way = rest.place(roles[top]) - rest.place(roles[roleOf(BodyPart::hips)]);
        return way.y > glm::length(glm::dvec2(way.x, way.z));
    }

    /// Whether clips fit as they are: nodes of one role have one name, and the bones from them to the hips are the
    /// same, each in its parent's frame. So it does not count in which pose the two skeletons rest.
    [[nodiscard]] bool isSameSkeleton() const {
        for (Role role = 0; role < kRoles; ++role) {
            const bool isCommon = from_[role] != kNone && own_[role] != kNone;
            if (isCommon && (match_.partners[from_[role]] != own_[role] || !haveSameBones(from_[role]))) {
                return false;
            }
        }
        return true;
    }
    /// Up to the hips, or to the root where they are not above the node.
    [[nodiscard]] bool haveSameBones(uint32_t node) const {
        for (; node != kNone && node != from_[roleOf(BodyPart::hips)]; node = set_.skeleton.nodes[node].parent) {
            const uint32_t partner = match_.partners[node], above = set_.skeleton.nodes[node].parent;
            if (partner == kNone || to_.nodes[partner].parent != (above == kNone ? kNone : match_.partners[above])) {
                return false;
            }
            const glm::vec3 a = restTranslation(set_.skeleton.nodes[node]), b = restTranslation(to_.nodes[partner]);
            if (glm::length(a - b) > kSameBone * std::max(glm::length(a), glm::length(b))) {
                return false;
            }
        }
        return true;
    }

    /// Names what the clips move and nothing follows.
    void noteLeftOut(const Followers& followers) {
        const std::vector<bool> turning = atOrAboveLeaders(followers);
        std::set<uint32_t> moving; // of what is above the hips as well, the hips have it all
        for (uint32_t n = from_[roleOf(BodyPart::hips)]; n != kNone; n = set_.skeleton.nodes[n].parent) {
            moving.insert(n);
        }
        for (const MoveFollower& follower : followers.moved) {
            moving.insert(follower.leader);
        }
        std::set<uint32_t> alone, scaled, stretched;
        for (const cage::Clip& clip : set_.clips) {
            for (const cage::Channel& channel : clip.channels) {
                if (channel.path == cage::ChannelPath::rotation && !turning[channel.node] && varies(channel)) {
                    alone.insert(channel.node);
                } else if (channel.path == cage::ChannelPath::scale && varies(channel)) {
                    scaled.insert(channel.node);
                } else if (channel.path == cage::ChannelPath::translation && moving.count(channel.node) == 0 &&
                           varies(channel)) {
                    stretched.insert(channel.node);
                }
            }
        }
        say("turns of ", alone);
        say("scales of ", scaled);
        say("movements of ", stretched);
    }
    /// By node: whether its turns reach somebody who follows.
    [[nodiscard]] std::vector<bool> atOrAboveLeaders(const Followers& followers) const {
        std::vector<bool> reaches(set_.skeleton.nodes.size(), false);
        for (const TurnFollower& follower : followers.turned) {
            for (const uint32_t leader : {follower.leader, follower.next}) {
                for (uint32_t n = leader; n != kNone && !reaches[n]; n = set_.skeleton.nodes[n].parent) {
                    reaches[n] = true;
                }
            }
        }
        return reaches;
    }
    void say(const char* what, const std::set<uint32_t>& nodes) {
        std::vector<std::string> names;
        for (const uint32_t node : nodes) {
            names.push_back(cage::nameOf(set_.skeleton, node));
        }
        if (!names.empty()) {
            leftOut_ += (leftOut_.empty() ? "" : "; ") + (what + cage::listed(names));
        }
    }
    /// By more than a hundredth of the largest number.
    [[nodiscard]] static bool varies(const cage::Channel& channel) {
        const size_t width = channel.width();
        const bool cubic = channel.interpolation == cage::Interpolation::cubicSpline;
        const size_t stride = cubic ? 3 * width : width, first = cubic ? width : 0;
        float largest = 0.0f, difference = 0.0f;
        for (size_t k = first; k + width <= channel.values.size(); k += stride) {
            for (size_t i = 0; i < width; ++i) {
                largest = std::max(largest, std::abs(channel.values[k + i]));
                difference = std::max(difference, std::abs(channel.values[k + i] - channel.values[first + i]));
            }
        }
        return difference > 0.01f * largest;
    }

    void fitClips(const Followers& followers) {
        uint64_t numbers = 0;
        for (const cage::Clip& clip : set_.clips) {
            for (const cage::Channel& channel : clip.channels) {
                numbers += channel.times.size() + channel.values.size();
            }
        }
        ClipFitter fitter(set_.skeleton, to_, followers, set_.clips.size(), numbers);
        const ClipFitter::Feet feet =
            options_.retargeting == Retargeting::freeFeet ? ClipFitter::Feet::free : ClipFitter::Feet::placed;
        std::vector<cage::Clip> fitted;
        for (const cage::Clip& clip : set_.clips) {
            ClipFitter::Fitted own = fitter.fit(clip, feet, kMostMissed);
            if (!own.whyLeftOut.empty()) {
                unfitted_.push_back(cage::quoted(clip.name) + " (" + own.whyLeftOut + ")");
                continue;
            }
            if (own.isCoarse) {
                coarse_.push_back(cage::quoted(clip.name));
            }
            if (own.miss > kFarMiss) {
                (own.miss > kMostMissed ? unreached_ : far_)
                    .push_back(cage::quoted(clip.name) + " " + cage::shortNumber(own.miss));
            }
            std::copy_if(clip.channels.begin(), clip.channels.end(), std::back_inserter(own.clip.channels),
                         [](const cage::Channel& c) { return c.path == cage::ChannelPath::weights; });
            fitted.push_back(std::move(own.clip));
        }
        set_.clips = std::move(fitted);
        refuseMisfits();
    }
    void refuseMisfits() const {
        if (options_.strict && !unreached_.empty()) {
            cage::refuse(set_.name, "legs are too short for its clips, in heights of the hips: " +
                                        cage::listed(unreached_) + "; with free feet they need not reach");
        }
        if (options_.strict && !unfitted_.empty()) {
            cage::refuse(set_.name, "clips that cannot be retargeted: " + cage::listed(unfitted_), ErrorCode::limit);
        }
    }

    void tell(const Followers& followers) {
        std::string text = cage::counted(set_.clips.size(), "clip", "clips") +
                           " retargeted: " + cage::counted(followers.byRole, "joint", "joints") + " by role, " +
                           std::to_string(followers.byName) + " by name, hips scaled by " +
                           cage::shortNumber(followers.scale);
        const auto add = [&](const char* what, const std::string& names) {
            text += names.empty() ? "" : "; " + (what + names);
        };
        add("left out: ", leftOut_);
        add("not in its skeleton: ", cage::listed(unknown_));
        add("legs are too short to reach, in heights of the hips: ", cage::listed(far_));
        add("and by so much that they keep the clip's angles: ", cage::listed(unreached_));
        add("fewer keys than they need, as they are too long: ", cage::listed(coarse_));
        add("clips that cannot be retargeted, left out: ", cage::listed(unfitted_));
        set_.warnings.push_back(std::move(text));
    }

    /// Channels of weights go to the nodes of their names.
    void moveWeights() {
        std::vector<uint32_t> meshes(to_.nodes.size(), kNone);
        for (uint32_t node = 0; node < set_.meshes.size(); ++node) {
            if (match_.partners[node] != kNone) {
                meshes[match_.partners[node]] = set_.meshes[node];
            }
        }
        set_.meshes = std::move(meshes);
        for (cage::Clip& clip : set_.clips) {
            std::erase_if(clip.channels, [&](cage::Channel& channel) {
                if (channel.path == cage::ChannelPath::weights) {
                    channel.node = match_.partners[channel.node];
                }
                return channel.node == kNone;
            });
        }
    }

    const RetargetOptions& options_;
    const cage::Skeleton to_;
    cage::ClipSet& set_;
    cage::NodeMatch match_;
    Roles from_{}, own_{};
    cage::Refusals faults_;
    std::string leftOut_;
    std::vector<std::string> unknown_, unfitted_, coarse_, far_, unreached_;
    std::vector<NodePair> given_;
};

} // namespace

void fitClips(const RetargetOptions& options, const cage::Skeleton& to, cage::ClipSet& set) {
    if (options.retargeting == Retargeting::never && !options.pairs.empty()) {
        cage::refuse("joint pairs", "they say how to retarget, which is turned off", ErrorCode::argument);
    }
    if (options.retargeting != Retargeting::never && !set.clips.empty()) {
        SetFitter(options, to, set).fit();
    }
}

} // namespace supple::skinning
