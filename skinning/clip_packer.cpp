#include "skinning/clip_packer.h"

#include "shaders/shared/pose.h"
#include "skinning/clip_table.h"
#include "skinning/packed_clip.h"
#include "skinning/pose.h"
#include "skinning/rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace supple::skinning {
namespace {

using cage::Channel;
using cage::ChannelPath;
using shared::kSegmentFrames;

constexpr double kShell = 0.015;     // of the extent
constexpr double kStill = 0.5;       // of a budget: what a property may lose to be constant
constexpr double kForRounding = 0.6; // of a budget; the rest is for knots
constexpr uint32_t kMostFrames = 4096;
constexpr size_t kMostPoses = 400'000;   // frames times nodes: what the truth takes
constexpr size_t kMostWork = 10'000'000; // frames times properties, of all clips
constexpr size_t kMostWatched = 160;     // vertices that each step of the bisection looks at
constexpr double kInfinite = std::numeric_limits<double>::infinity();

double angleBetween(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat d = glm::dot(a, b) < 0.0 ? a + b : a - b;
    return 4.0 * std::asin(std::min(0.5 * glm::length(d), 1.0));
}

/// What all clips of a character share.
class Body {
public:
    explicit Body(const cage::Character& character)
        : character_(character), globals_(character.skeleton.nodes.size()), order_(nodeOrder(character)) {
        Pose rest;
        skinning::restPose(character, rest);
        std::vector<glm::dmat4> globals(globals_.size());
        pose(rest, globals);
        measureExtent(globals);
        measureReach(globals);
        watch(globals);
        for (const cage::MorphTarget& target : character.morphs.targets) {
            double& reach = targetReach_.emplace_back(0.0);
            for (const glm::vec3& delta : target.deltas) {
                reach = std::max(reach, static_cast<double>(glm::length(delta)));
            }
        }
    }

    [[nodiscard]] const cage::Character& character() const { return character_; }
    [[nodiscard]] const NodeOrder& order() const { return order_; }
    [[nodiscard]] double extent() const { return extent_; }
    /// What a turn by an angle moves at most, as a part of the angle; and a way or a scale, as a part of itself.
    [[nodiscard]] double reach(uint32_t node, ChannelPath path) const {
        return path == ChannelPath::translation ? above_[node] : reach_[node];
    }
    [[nodiscard]] const std::vector<uint32_t>& watched() const { return watched_; }
    /// How far a morph target moves a vertex at most.
    [[nodiscard]] double targetReach(uint32_t target) const { return targetReach_[target]; }

    void pose(const Pose& from, std::vector<glm::dmat4>& globals) const {
        const cage::Skeleton& skeleton = character_.skeleton;
        for (const uint32_t node : skeleton.parentsFirst) {
            const glm::dmat4 local = localMatrix(skeleton.nodes[node], from.locals[node]);
            const uint32_t parent = skeleton.nodes[node].parent;
            globals[node] = parent == cage::kNone ? local : globals[parent] * local;
        }
    }

    /// Where a vertex is.
    [[nodiscard]] glm::dvec3 vertex(uint32_t v, const std::vector<glm::dmat4>& globals) const {
        const cage::SkinWeights& weights = character_.weights;
        glm::dvec3 sum(0.0);
        for (uint32_t i = weights.starts[v]; i < weights.starts[v + 1]; ++i) {
            const uint32_t joint = weights.influences[i].joint;
            const glm::dvec4 bound = inverseBinds_[joint] * glm::dvec4(glm::dvec3(character_.cage.positions[v]), 1.0);
            sum += static_cast<double>(weights.influences[i].weight) *
                   glm::dvec3(globals[character_.skin.joints[joint]] * bound);
        }
        return sum;
    }

    /// The largest distance, in extents, between two poses: of some vertices, and of the shells of all joints.
    [[nodiscard]] double distance(const std::vector<glm::dmat4>& a, const std::vector<glm::dmat4>& b,
                                  std::span<const uint32_t> vertices) const {
        double worst = 0.0;
        for (const uint32_t v : vertices) {
            worst = std::max(worst, glm::length(vertex(v, a) - vertex(v, b)));
        }
        for (const uint32_t node : character_.skin.joints) {
            for (int axis = 0; axis < 3; ++axis) {
                worst = std::max(worst, glm::length(shellPoint(a[node], axis) - shellPoint(b[node], axis)));
            }
        }
        return worst / extent_;
    }

private:
    [[nodiscard]] glm::dvec3 shellPoint(const glm::dmat4& m, int axis) const {
        const glm::dvec3 along(m[axis]);
        const double length = glm::length(along);
        return glm::dvec3(m[3]) + (length > 0.0 ? along * (kShell * extent_ / length) : glm::dvec3(0.0));
    }

    void measureExtent(const std::vector<glm::dmat4>& globals) {
        inverseBinds_.assign(character_.skin.inverseBinds.begin(), character_.skin.inverseBinds.end());
        glm::dvec3 low(kInfinite), high(-kInfinite);
        for (uint32_t v = 0; v < character_.cage.vertexCount(); ++v) {
            const glm::dvec3 p = vertex(v, globals);
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        extent_ = glm::length(high - low);
    }

    /// How far what hangs on a node is from it, by its weight.
    void measureReach(const std::vector<glm::dmat4>& globals) {
        const cage::Skeleton& skeleton = character_.skeleton;
        const cage::SkinWeights& weights = character_.weights;
        reach_.assign(skeleton.nodes.size(), kShell * extent_);
        std::vector<double> share(skeleton.nodes.size(), 0.0);
        std::vector<uint32_t> touched;
        for (uint32_t v = 0; v < character_.cage.vertexCount(); ++v) {
            const glm::dvec3 p = vertex(v, globals);
            for (uint32_t i = weights.starts[v]; i < weights.starts[v + 1]; ++i) {
                uint32_t node = character_.skin.joints[weights.influences[i].joint];
                for (; node != cage::kNone; node = skeleton.nodes[node].parent) {
                    touched.push_back(node);
                    share[node] += std::abs(static_cast<double>(weights.influences[i].weight));
                }
            }
            for (const uint32_t node : touched) {
                reach_[node] = std::max(reach_[node], share[node] * glm::length(p - glm::dvec3(globals[node][3])));
            }
            for (const uint32_t node : touched) {
                share[node] = 0.0;
            }
            touched.clear();
        }
        for (size_t n = 0; n < skeleton.nodes.size(); ++n) {
            const uint32_t parent = skeleton.nodes[n].parent;
            double size = 1.0;
            if (parent != cage::kNone) {
                const glm::dmat3 linear(globals[parent]);
                size = std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]), 1e-9});
            }
            above_.push_back(size);
        }
    }

    /// The vertices farthest from the joints that they follow.
    void watch(const std::vector<glm::dmat4>& globals) {
        const cage::SkinWeights& weights = character_.weights;
        std::vector<std::pair<double, uint32_t>> farthest; // by joint
        farthest.assign(character_.skin.joints.size(), {-1.0, 0u});
        for (uint32_t v = 0; v < character_.cage.vertexCount(); ++v) {
            const glm::dvec3 p = vertex(v, globals);
            for (uint32_t i = weights.starts[v]; i < weights.starts[v + 1]; ++i) {
                const uint32_t joint = weights.influences[i].joint;
                const double far = static_cast<double>(weights.influences[i].weight) *
                                   glm::length(p - glm::dvec3(globals[character_.skin.joints[joint]][3]));
                farthest[joint] = std::max(farthest[joint], {far, v});
            }
        }
        std::sort(farthest.rbegin(), farthest.rend());
        for (const auto& [far, v] : farthest) {
            if (far >= 0.0 && watched_.size() < kMostWatched) {
                watched_.push_back(v);
            }
        }
    }

    const cage::Character& character_;
    std::vector<glm::mat4> globals_;
    NodeOrder order_;
    std::vector<glm::dmat4> inverseBinds_;
    std::vector<double> reach_, above_; ///< by node; of what it hangs on the scale
    std::vector<double> targetReach_;
    std::vector<uint32_t> watched_;
    double extent_ = 0.0;
};

/// What the frames between a frame and a later one of its segment move away if they are left out.
struct Spans {
    std::vector<std::vector<float>> away; ///< by first frame, then from length 2 on; they end where it is too much

    [[nodiscard]] double of(uint32_t first, uint32_t length) const {
        if (length < 2) {
            return 0.0;
        }
        const std::vector<float>& own = away[first];
        return length - 2 < own.size() ? static_cast<double>(own[length - 2]) : kInfinite;
    }
    /// `left(first, length)` tells it.
    template <class Left>
    void measure(uint32_t last, double tooMuch, Left&& left) {
        away.assign(last + 1, {});
        for (uint32_t first = 0; first < last; ++first) {
            const uint32_t most = std::min(kSegmentFrames - first % kSegmentFrames, last - first);
            for (uint32_t length = 2; length <= most; ++length) {
                const double own = left(first, length);
                away[first].push_back(static_cast<float>(own));
                if (own > tooMuch) {
                    break;
                }
            }
        }
    }
    /// The fewest knots whose spans move no frame farther away than that; the borders of segments among them.
    [[nodiscard]] std::vector<uint32_t> knots(uint32_t last, double most) const {
        std::vector<uint32_t> knots;
        for (uint32_t begin = 0; begin < last; begin += kSegmentFrames) {
            const uint32_t frames = std::min(kSegmentFrames, last - begin);
            std::array<uint32_t, kSegmentFrames + 1> cost{}, next{};
            for (uint32_t f = frames; f-- > 0;) {
                cost[f] = UINT32_MAX;
                for (uint32_t to = frames; to > f; --to) {
                    if (cost[to] + 1 < cost[f] && of(begin + f, to - f) <= most) {
                        cost[f] = cost[to] + 1;
                        next[f] = to;
                    }
                }
            }
            for (uint32_t f = 0; f < frames; f = next[f]) {
                knots.push_back(begin + f);
            }
        }
        knots.push_back(last);
        return knots;
    }
};

/// The morph weights of one part in a clip, on its frames. They stay floats, at fewer keys.
struct WeightTrack {
    const Channel* channel = nullptr;
    std::vector<std::vector<double>> values; ///< by frame
    double fromRest = 0.0;
    Spans spans;
};

/// A property of one clip, on its frames.
struct Track {
    uint32_t place = 0;
    ChannelPath path = ChannelPath::translation;
    std::vector<glm::dvec3> values; ///< one a frame; of rotations the quarter tangents from the reference
    std::vector<glm::dquat> turns;  ///< of rotations
    std::array<uint32_t, 3> reference{255u, 255u, 255u};
    glm::dvec3 constant{0.0};                  ///< what it would be kept at
    double reach = 0.0;                        ///< what its values, or its angle, move
    double fromRest = 0.0, fromConstant = 0.0; ///< what it moves away, if it is left at these
    Spans spans;

    [[nodiscard]] bool turnsAbout() const { return path == ChannelPath::rotation; }
};

class ClipPacker {
public:
    /// `workLeft`: how many properties of frames may be looked at; it becomes less.
    ClipPacker(const Body& body, const cage::Clip& clip, double error, size_t& workLeft)
        : body_(body), clip_(clip), error_(error), workLeft_(workLeft) {}

    /// Nothing if it stays as it is.
    std::optional<cage::Clip> pack() {
        if (!clip_.packed.words.empty() || clip_.channels.empty() || !(clip_.duration > 0.0) ||
            !(body_.extent() > 1e-12 && body_.extent() < 1e12) || !chooseChannels()) {
            return std::nullopt;
        }
        for (double rate = firstRate(); rate <= 4.0 * std::max(firstRate(), kOffGridRate); rate *= 2.0) {
            last_ = frameAt(rate);
            const size_t work = size_t{last_} * tracks_.size();
            if (last_ > kMostFrames || last_ * body_.character().skeleton.nodes.size() > kMostPoses ||
                work > workLeft_) {
                break;
            }
            workLeft_ -= work;
            if (!follow()) {
                break;
            }
            if (std::optional<cage::Clip> packed = search()) {
                return packed;
            }
        }
        return std::nullopt;
    }

private:
    static constexpr double kOffGridRate = 60.0;

    /// Those that are packed: the last one of a property counts.
    bool chooseChannels() {
        const NodeOrder& order = body_.order();
        std::map<std::pair<uint32_t, ChannelPath>, size_t> last;
        for (size_t c = 0; c < clip_.channels.size(); ++c) {
            const Channel& own = clip_.channels[c];
            if (own.path != ChannelPath::weights && order.places[own.node] != cage::kNone) {
                last[{order.places[own.node], own.path}] = c;
            }
        }
        std::vector<bool> taken(clip_.channels.size(), false);
        for (const auto& [property, c] : last) {
            const Channel& own = clip_.channels[c];
            if (own.interpolation == cage::Interpolation::linear &&
                !body_.character().skeleton.nodes[own.node].hasMatrix) {
                taken[c] = true;
                Track& track = tracks_.emplace_back();
                track.place = property.first;
                track.path = property.second;
            }
        }
        for (size_t c = 0; c < clip_.channels.size(); ++c) {
            const Channel& own = clip_.channels[c];
            const uint32_t place = own.path != ChannelPath::weights ? order.places[own.node] : cage::kNone;
            // What comes before the last one of a property does nothing.
            const bool stays = place == cage::kNone || last[{place, own.path}] == c;
            if (own.path == ChannelPath::weights && own.interpolation == cage::Interpolation::linear) {
                weights_.push_back({&own, {}, 0.0, {}});
            } else if (!taken[c] && stays) {
                rest_.push_back(own);
            }
        }
        return !tracks_.empty();
    }

    /// The rate on whose frames all keys lie, or a common one.
    [[nodiscard]] double firstRate() const {
        for (const double rate : {24.0, 25.0, 30.0, 12.0, 15.0, 60.0, 48.0, 50.0, 120.0}) {
            const auto onFrames = [&](float time) {
                const double frame = static_cast<double>(time) * rate;
                return std::abs(frame - std::round(frame)) < 2e-3;
            };
            if (std::all_of(clip_.channels.begin(), clip_.channels.end(), [&](const Channel& own) {
                    return std::all_of(own.times.begin(), own.times.end(), onFrames);
                })) {
                return rate;
            }
        }
        return kOffGridRate;
    }
    /// The number of the last frame, at the clip's end; too many count as one too many.
    [[nodiscard]] uint32_t frameAt(double rate) const {
        const double frames = std::ceil(clip_.duration * rate - 2e-3);
        return frames > kMostFrames ? kMostFrames + 1 : std::max(static_cast<uint32_t>(frames), 1u);
    }
    [[nodiscard]] double timeOf(double frame) const { return clip_.duration * frame / last_; }

    /// The clip on its frames, and in their middles. False: it leaves what can be packed.
    bool follow() {
        const cage::Character& character = body_.character();
        const NodeOrder& order = body_.order();
        for (Track& track : tracks_) {
            track.values.clear();
            track.turns.clear();
        }
        for (WeightTrack& track : weights_) {
            track.values.clear();
        }
        const double tooMuch = 0.01 * body_.extent();
        trueWeights_.assign(2 * size_t{last_} + 1, {});
        truth_.assign(2 * size_t{last_} + 1, std::vector<glm::dmat4>(character.skeleton.nodes.size()));
        for (uint32_t k = 0; k < truth_.size(); ++k) {
            sampleClip(character, clip_, timeOf(0.5 * k), pose_);
            body_.pose(pose_, truth_[k]);
            if (!isModest(truth_[k])) {
                return false;
            }
            trueWeights_[k] = pose_.morphWeights;
            for (WeightTrack& track : weights_) {
                if (k % 2 == 0) {
                    const auto begin = pose_.morphWeights.begin() + track.channel->firstTarget;
                    track.values.emplace_back(begin, begin + static_cast<ptrdiff_t>(track.channel->width()));
                }
            }
            for (Track& track : tracks_) {
                const Transform& own = pose_.locals[order.nodes[track.place]];
                if (k % 2 == 0 && track.turnsAbout()) {
                    glm::dquat q = unit(own.rotation);
                    q = !track.turns.empty() && glm::dot(track.turns.back(), q) < 0.0 ? -q : q;
                    track.turns.push_back(q);
                } else if (k % 2 == 0) {
                    track.values.push_back(track.path == ChannelPath::translation ? own.translation : own.scale);
                }
            }
        }
        for (Track& track : tracks_) {
            measure(track);
            track.spans.measure(last_, tooMuch,
                                [&](uint32_t first, uint32_t length) { return left(track, first, length); });
        }
        for (WeightTrack& track : weights_) {
            measure(track);
            track.spans.measure(last_, tooMuch,
                                [&](uint32_t first, uint32_t length) { return left(track, first, length); });
        }
        return true;
    }
    /// Neither the nodes nor what is said of them is so far off that whole numbers do not reach there.
    [[nodiscard]] bool isModest(const std::vector<glm::dmat4>& globals) const {
        constexpr double kFar = 1e12;
        const auto modest = [](const glm::dvec3& v) { return glm::all(glm::lessThan(glm::abs(v), glm::dvec3(kFar))); };
        return std::all_of(
                   globals.begin(), globals.end(),
                   [&](const glm::dmat4& m) { return modest(m[0]) && modest(m[1]) && modest(m[2]) && modest(m[3]); }) &&
               std::all_of(pose_.locals.begin(), pose_.locals.end(),
                           [&](const Transform& t) { return modest(t.translation) && modest(t.scale); }) &&
               std::all_of(pose_.morphWeights.begin(), pose_.morphWeights.end(),
                           [](double w) { return std::abs(w) < kFar; });
    }

    /// How far weights move a vertex at most.
    [[nodiscard]] double moved(uint32_t firstTarget, std::span<const double> a, std::span<const double> b) const {
        double sum = 0.0;
        for (size_t t = 0; t < a.size(); ++t) {
            sum += body_.targetReach(firstTarget + static_cast<uint32_t>(t)) * std::abs(a[t] - b[t]);
        }
        return sum;
    }
    void measure(WeightTrack& track) const {
        const std::vector<float>& weights = body_.character().morphs.weights;
        const auto begin = weights.begin() + track.channel->firstTarget;
        const std::vector<double> rest(begin, begin + static_cast<ptrdiff_t>(track.values.front().size()));
        track.fromRest = 0.0;
        for (const std::vector<double>& own : track.values) {
            track.fromRest = std::max(track.fromRest, moved(track.channel->firstTarget, own, rest));
        }
    }
    [[nodiscard]] double left(const WeightTrack& track, uint32_t first, uint32_t length) const {
        const std::vector<double>&a = track.values[first], &b = track.values[first + length];
        std::vector<double> between(a.size());
        double away = 0.0;
        for (uint32_t k = 1; k < length; ++k) {
            for (size_t t = 0; t < a.size(); ++t) {
                between[t] = glm::mix(a[t], b[t], static_cast<double>(k) / length);
            }
            away = std::max(away, moved(track.channel->firstTarget, between, track.values[first + k]));
        }
        return away;
    }
    /// The keys that are left; nothing if the weights stay at rest.
    [[nodiscard]] std::optional<Channel> thinned(const WeightTrack& track, double budget) const {
        if (track.fromRest <= kStill * budget) {
            return std::nullopt;
        }
        Channel channel = *track.channel;
        channel.times.clear();
        channel.values.clear();
        for (const uint32_t frame : track.spans.knots(last_, (1.0 - kForRounding) * budget)) {
            channel.times.push_back(static_cast<float>(timeOf(frame)));
            for (const double w : track.values[frame]) {
                channel.values.push_back(static_cast<float>(w));
            }
        }
        return channel.times.size() < track.channel->times.size() ? channel : *track.channel;
    }

    void measure(Track& track) const {
        const cage::Node& node = body_.character().skeleton.nodes[body_.order().nodes[track.place]];
        track.reach = body_.reach(body_.order().nodes[track.place], track.path);
        const auto middle = [&] {
            glm::dvec3 low(kInfinite), high(-kInfinite);
            for (const glm::dvec3& v : track.values) {
                low = glm::min(low, v);
                high = glm::max(high, v);
            }
            return 0.5 * (low + high);
        };
        track.fromRest = track.fromConstant = 0.0;
        if (!track.turnsAbout()) {
            track.constant = middle();
            const glm::dvec3 rest(track.path == ChannelPath::translation ? node.translation : node.scale);
            for (const glm::dvec3& v : track.values) {
                track.fromRest = std::max(track.fromRest, track.reach * glm::length(v - rest));
                track.fromConstant = std::max(track.fromConstant, track.reach * glm::length(v - track.constant));
            }
            return;
        }
        glm::dquat sum(0.0, 0.0, 0.0, 0.0);
        for (const glm::dquat& q : track.turns) {
            sum = sum + q;
        }
        track.reference = referenceNear(glm::length(sum) > 1e-3 ? sum : track.turns.front());
        PackedProperty own;
        own.reference = track.reference;
        const glm::dquat reference = referenceOf(own);
        track.values.clear();
        for (const glm::dquat& q : track.turns) {
            track.values.push_back(quarterTangent(glm::conjugate(reference) * q));
        }
        const glm::dquat constant = reference * quarterTangentTurn(middle());
        track.constant = quarterTangent(constant);
        const glm::dquat rest = unit(glm::dquat(node.rotation));
        for (const glm::dquat& q : track.turns) {
            track.fromRest = std::max(track.fromRest, track.reach * angleBetween(q, rest));
            track.fromConstant = std::max(track.fromConstant, track.reach * angleBetween(q, constant));
        }
    }

    /// What the frames inside of a span move away if they are left out.
    [[nodiscard]] double left(const Track& track, uint32_t first, uint32_t length) const {
        double away = 0.0;
        const uint32_t end = first + length;
        if (track.turnsAbout()) {
            const glm::dquat &a = track.turns[first], &b = track.turns[end];
            if (std::abs(glm::dot(a, b)) < 0.5 + 1e-3) { // more than 120 degrees, which slerpShare does not know
                return kInfinite;
            }
            for (uint32_t k = 1; k < length; ++k) {
                const glm::dquat q = slerp(a, b, static_cast<double>(k) / length);
                away = std::max(away, angleBetween(q, track.turns[first + k]));
            }
        } else {
            const glm::dvec3 &a = track.values[first], &b = track.values[end];
            for (uint32_t k = 1; k < length; ++k) {
                const glm::dvec3 v = glm::mix(a, b, static_cast<double>(k) / length);
                away = std::max(away, glm::length(v - track.values[first + k]));
            }
        }
        return away * track.reach;
    }

    /// What is too large for the layout stays too large.
    static glm::ivec3 wholeOf(const glm::dvec3& value, int exponent) {
        return glm::ivec3(glm::clamp(glm::round(value * std::ldexp(1.0, exponent)), -1e6, 1e6));
    }

    /// The clip if each property may move `budget` away.
    [[nodiscard]] PackedClip packedWith(double budget) const {
        PackedClip packed;
        packed.last = last_;
        for (const Track& track : tracks_) {
            if (track.fromRest <= kStill * budget) {
                continue;
            }
            PackedProperty own;
            own.place = track.place;
            own.path = track.path;
            own.isConstant = track.fromConstant <= kStill * budget;
            if (own.isConstant) {
                own.exponent = constantExponent(track.constant);
                own.values.push_back(wholeOf(track.constant, own.exponent));
            } else {
                // An angle is four quarter tangents. 0.87: the distance to the nearest point of a lattice, in steps.
                const double metric = track.reach * (track.turnsAbout() ? 4.0 : 1.0);
                const double step = kForRounding * budget / (0.87 * metric);
                own.exponent = std::clamp(static_cast<int>(std::ceil(-std::log2(step))), kLeastExponent, kMostExponent);
                own.reference = track.reference;
                own.frames = track.spans.knots(last_, (1.0 - kForRounding) * budget);
                for (const uint32_t frame : own.frames) {
                    own.values.push_back(wholeOf(track.values[frame], own.exponent));
                }
            }
            packed.properties.push_back(std::move(own));
        }
        return packed;
    }

    [[nodiscard]] cage::Clip decoded(const PackedClip& packed, double budget) const {
        cage::Clip clip;
        clip.name = clip_.name;
        clip.duration = clip_.duration;
        clip.markers = clip_.markers;
        clip.sharpness = clip_.sharpness;
        clip.channels = channelsOf(packed, clip_.duration, body_.order().nodes);
        clip.packed.channelCount = static_cast<uint32_t>(clip.channels.size());
        clip.channels.insert(clip.channels.end(), rest_.begin(), rest_.end());
        for (const WeightTrack& track : weights_) {
            if (std::optional<Channel> own = thinned(track, budget)) {
                clip.channels.push_back(std::move(*own));
            }
        }
        return clip;
    }

    [[nodiscard]] double errorOf(const cage::Clip& clip, std::span<const uint32_t> vertices) {
        double worst = 0.0;
        std::vector<glm::dmat4> globals(body_.character().skeleton.nodes.size());
        for (uint32_t k = 0; k < truth_.size() && worst <= error_; ++k) {
            sampleClip(body_.character(), clip, timeOf(0.5 * k), pose_);
            body_.pose(pose_, globals);
            worst = std::max(worst, body_.distance(globals, truth_[k], vertices) +
                                        moved(0, pose_.morphWeights, trueWeights_[k]) / body_.extent());
        }
        return worst;
    }

    /// The largest budget that keeps within the error, first of some vertices, at last of all.
    std::optional<cage::Clip> search() {
        double low = 0.0, high = 0.0, part = 0.5;
        for (int i = 0; i < 10; ++i) {
            const double budget = part * error_ * body_.extent();
            const bool keeps = errorOf(decoded(packedWith(budget), budget), body_.watched()) <= error_;
            (keeps ? low : high) = part;
            part = high == 0.0 ? 1.5 * part : 0.5 * (low + high);
            if (low > 0.0 && high > 0.0 && high < 1.05 * low) {
                break;
            }
        }
        std::vector<uint32_t> all(body_.character().cage.vertexCount());
        for (uint32_t v = 0; v < all.size(); ++v) {
            all[v] = v;
        }
        for (int i = 0; i < 12 && low > 0.0; ++i, low *= 0.93) {
            const double budget = low * error_ * body_.extent();
            const PackedClip packed = packedWith(budget);
            cage::Clip clip = decoded(packed, budget);
            if (clip.channels.empty()) {
                return std::nullopt; // all of it is the rest pose
            }
            clip.packed.error = errorOf(clip, all);
            std::optional<std::vector<uint32_t>> words =
                packedWords(packed, clip_.duration, body_.order().nodes.size());
            if (clip.packed.error <= error_ && words) {
                clip.packed.words = std::move(*words);
                return clip;
            }
        }
        return std::nullopt;
    }

    const Body& body_;
    const cage::Clip& clip_;
    double error_;
    size_t& workLeft_;
    uint32_t last_ = 0;
    std::vector<Track> tracks_;
    std::vector<WeightTrack> weights_;
    std::vector<Channel> rest_;                  ///< channels that stay
    std::vector<std::vector<glm::dmat4>> truth_; ///< by half frame
    std::vector<std::vector<double>> trueWeights_;
    Pose pose_;
};

} // namespace

void packClips(cage::Character& character, double error) {
    if (character.clips.empty() || character.skin.joints.empty()) {
        return;
    }
    std::vector<std::optional<cage::Clip>> packed;
    const Body body(character);
    size_t workLeft = kMostWork;
    for (const cage::Clip& clip : character.clips) {
        std::optional<cage::Clip> own = ClipPacker(body, clip, error, workLeft).pack();
        const size_t bytes = clipBytes(body.order(), clip);
        if (own) {
            own->packed.unpackedBytes = bytes;
        }
        packed.push_back(own && clipBytes(body.order(), *own) < bytes ? std::move(own) : std::nullopt);
    }
    for (size_t c = 0; c < packed.size(); ++c) {
        if (packed[c]) {
            character.clips[c] = std::move(*packed[c]);
        }
    }
}

} // namespace supple::skinning
