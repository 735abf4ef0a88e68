#include "skinning/clip_packer.h"

#include "cage/message.h"
#include "cage/solved_driver.h"
#include "shaders/shared/pose.h"
#include "skinning/clip_table.h"
#include "skinning/driven_weights.h"
#include "skinning/packed_clip.h"
#include "skinning/pose.h"
#include "skinning/pose_distance.h"
#include "skinning/root_motion.h"
#include "skinning/rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace supple::skinning {
namespace {

using cage::Channel;
using cage::ChannelPath;
using shared::kSegmentFrames;

constexpr double kStill = 0.5;            // of a budget: what a property may lose to be constant
constexpr double kForRounding = 0.6;      // of a budget; the rest is for skipped frames
constexpr double kLatticeDistance = 0.87; // to the nearest point, in steps
constexpr double kWeightShare = 0.5;      // of a budget, for morph weights
constexpr int kBalancings = 2;
constexpr double kBalance = 0.7;   // the power of what is left with which a budget grows
constexpr double kLeastUsed = 0.1; // of the error: less counts as that
constexpr double kOffGridRate = 60.0;
constexpr uint32_t kMostFrames = 4096;
constexpr size_t kMostPoses = 400'000;         // frames times nodes: memory for what the clip was
constexpr uint64_t kMostWork = 1'000'000'000u; // half microseconds
constexpr double kInfinite = std::numeric_limits<double>::infinity();

double angleBetween(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat d = glm::dot(a, b) < 0.0 ? a + b : a - b;
    return 4.0 * std::asin(std::min(0.5 * glm::length(d), 1.0));
}

/// Spans of frames within a segment: the distance moved if the frames inside of a span are skipped.
class Spans {
public:
    /// `distance(first, length)` tells it. Where it is `tooMuch`, longer spans are not tried.
    template <class Distance>
    void measure(uint32_t last, double tooMuch, Distance&& distance) {
        distances_.assign(last + 1, {});
        for (uint32_t first = 0; first < last; ++first) {
            const uint32_t most = std::min(kSegmentFrames - first % kSegmentFrames, last - first);
            for (uint32_t length = 2; length <= most; ++length) {
                const double own = distance(first, length);
                distances_[first].push_back(static_cast<float>(own));
                if (own > tooMuch) {
                    break;
                }
            }
        }
    }
    /// The fewest knots whose spans skip no frame by more than that distance. The borders of segments are knots.
    [[nodiscard]] std::vector<uint32_t> knots(uint32_t last, double most) const {
        std::vector<uint32_t> knots;
        for (uint32_t begin = 0; begin < last; begin += kSegmentFrames) {
            const uint32_t frames = std::min(kSegmentFrames, last - begin);
            std::array<uint32_t, kSegmentFrames + 1> cost{}, next{};
            for (uint32_t f = frames; f-- > 0;) {
                cost[f] = UINT32_MAX;
                for (uint32_t to = frames; to > f; --to) {
                    if (cost[to] + 1 < cost[f] && distance(begin + f, to - f) <= most) {
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

private:
    [[nodiscard]] double distance(uint32_t first, uint32_t length) const {
        if (length < 2) {
            return 0.0;
        }
        const std::vector<float>& own = distances_[first];
        return length - 2 < own.size() ? static_cast<double>(own[length - 2]) : kInfinite;
    }

    std::vector<std::vector<float>> distances_; ///< by first frame, from length 2 on
};

/// A property of a clip, on its frames.
struct Track {
    const Channel* channel = nullptr; ///< null for morph weights
    ChannelPath path = ChannelPath::translation;
    uint32_t place = 0;             ///< of PackedPlaces
    std::vector<glm::dvec3> values; ///< one a frame; of rotations the quarter tangents from the reference
    std::vector<glm::dquat> turns;  ///< of rotations
    std::array<uint32_t, 3> reference{15u, 15u, 15u};
    glm::dvec3 constant{0.0};                  ///< the value if it is kept constant
    glm::dvec3 reach{0.0};                     ///< distance moved per radian, or per unit of a value
    double fromRest = 0.0, fromConstant = 0.0; ///< distance moved if it is kept at these
    bool jumps = false;                        ///< a rotation by more than the decoder's arc between two frames
    double share = 1.0;                        ///< its budget, in budgets of the clip
    Spans spans;

    [[nodiscard]] bool isRotation() const { return path == ChannelPath::rotation; }
    [[nodiscard]] bool isWeights() const { return path == ChannelPath::weights; }
    /// What morph targets move adds up.
    [[nodiscard]] double distance(const glm::dvec3& difference) const {
        const glm::dvec3 moved = reach * glm::abs(difference);
        return isWeights() ? moved.x + moved.y + moved.z : glm::length(moved);
    }
    /// The largest distance by which rounding to a lattice of step 1 moves. An angle is four quarter tangents.
    [[nodiscard]] double moveOfStep() const {
        return isRotation()  ? 4.0 * kLatticeDistance * reach.x
               : isWeights() ? 0.5 * (reach.x + reach.y + reach.z)
                             : kLatticeDistance * reach.x;
    }
};

/// How far packing may move a vertex, as parts of the extent.
struct PackErrors {
    double fine = 0.0;
    double coarse = 0.0; ///< of coarse twins; not more than `fine`: there is none
    [[nodiscard]] bool wantTwins() const { return coarse > fine; }
};

/// What a clip becomes with some budget.
struct Attempt {
    PackedClip packed;
    std::vector<Channel> rest; ///< channels that are not packed
};

class ClipPacker {
public:
    /// `workLeft` becomes less.
    ClipPacker(const PoseDistance& distance, const DriverTable& drivers, const NodeOrder& order, const cage::Clip& clip,
               const PackErrors& errors, uint64_t& workLeft)
        : distance_(distance), driven_(drivers), hasDrivers_(drivers.quads != 0), order_(order), clip_(clip),
          errors_(errors), workLeft_(workLeft) {}

    /// Nothing if the clip stays as it is; leftOut() may say why.
    std::optional<cage::Clip> pack() {
        const bool plain = clip_.packed.words.empty() && !clip_.channels.empty() && clip_.duration > 1e-6;
        if (!plain || !(distance_.extent() > 1e-12 && distance_.extent() < 1e12) || !chooseChannels()) {
            return std::nullopt;
        }
        const double first = firstRate();
        for (double rate = first; rate <= 4.0 * std::max(first, kOffGridRate); rate *= 2.0) {
            last_ = frameAt(rate);
            if (!takeWork() || !follow()) {
                return std::nullopt;
            }
            if (std::optional<Found> fine = balanced(errors_.fine, [&](double budget) { return attempt(budget); })) {
                addTwin(*fine);
                return std::move(fine->clip);
            }
        }
        return std::nullopt;
    }
    [[nodiscard]] const char* leftOut() const { return leftOut_; }
    /// Why the clip has no twin, if it was to get one and is packed.
    [[nodiscard]] const char* twinLeftOut() const { return twinLeftOut_; }

private:
    /// Those that are packed: the last one of a property counts.
    bool chooseChannels() {
        std::map<std::pair<uint32_t, ChannelPath>, const Channel*> last;
        std::vector<const Channel*> weights;
        for (const Channel& own : clip_.channels) {
            if (own.path == ChannelPath::weights) {
                weights.push_back(&own);
            } else if (order_.places[own.node] != cage::kNone) {
                last[{order_.places[own.node], own.path}] = &own;
            }
        }
        const auto isPacked = [&](const Channel& own) {
            return own.interpolation == cage::Interpolation::linear &&
                   !distance_.character().skeleton.nodes[own.node].hasMatrix;
        };
        for (const auto& [property, channel] : last) {
            if (isPacked(*channel)) {
                Track& track = tracks_.emplace_back();
                track.channel = channel;
                track.path = channel->path;
                track.place = property.first;
            }
        }
        for (const Channel& own : clip_.channels) {
            if (own.path == ChannelPath::weights) {
                continue;
            }
            if (const uint32_t place = order_.places[own.node];
                place == cage::kNone || (last[{place, own.path}] == &own && !isPacked(own))) {
                rest_.push_back(own);
            }
        }
        chooseWeights(weights);
        return !tracks_.empty();
    }
    /// All are packed, or none.
    void chooseWeights(std::span<const Channel* const> channels) {
        movesWeights_ = !channels.empty();
        if (!std::all_of(channels.begin(), channels.end(),
                         [](const Channel* own) { return own->interpolation == cage::Interpolation::linear; })) {
            keepWeights(rest_);
            return;
        }
        std::set<uint32_t> threes;
        for (const Channel* own : channels) {
            for (uint32_t target = 0; target < own->width(); ++target) {
                threes.insert((own->firstTarget + target) / 3);
            }
        }
        for (const uint32_t three : threes) {
            Track& track = tracks_.emplace_back();
            track.path = ChannelPath::weights;
            track.place = static_cast<uint32_t>(order_.nodes.size()) + three;
        }
    }
    void keepWeights(std::vector<Channel>& to) const {
        std::copy_if(clip_.channels.begin(), clip_.channels.end(), std::back_inserter(to),
                     [](const Channel& own) { return own.path == ChannelPath::weights; });
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

    /// False: it would take too much memory or time.
    bool takeWork() {
        const cage::Character& character = distance_.character();
        const size_t targets = comparesWeights() ? character.morphs.targets.size() : 0;
        const uint64_t work = (1 + kBalancings) * uint64_t{last_} *
                              (20 * tracks_.size() + distance_.all().size() + targets + driverWork());
        leftOut_ = last_ > kMostFrames                                                     ? "it has too many frames"
                   : last_ * (character.skeleton.nodes.size() + targets / 16) > kMostPoses ? "it has too many poses"
                   : work > workLeft_ ? "the clips before it took too long"
                                      : nullptr;
        workLeft_ -= leftOut_ == nullptr ? work : 0;
        return leftOut_ == nullptr;
    }

    /// Weights differ where a channel or a driver sets some.
    [[nodiscard]] bool comparesWeights() const { return movesWeights_ || hasDrivers_; }
    [[nodiscard]] size_t driverWork() const {
        size_t rounds = 0;
        for (const cage::PoseDriver& driver : distance_.character().drivers) {
            rounds += cage::driverWork(driver);
        }
        return rounds;
    }
    /// As instances show them in pose_.
    void takeWeights(std::vector<double>& weights) {
        weights = pose_.morphWeights;
        driven_.addTo(pose_, weights);
    }

    /// The clip on its frames, and in their middles. False: it has numbers that are too large to be packed.
    bool follow() {
        const cage::Character& character = distance_.character();
        for (Track& track : tracks_) {
            track.values.clear();
            track.turns.clear();
        }
        truth_.assign(2 * size_t{last_} + 1, std::vector<glm::dmat4>(character.skeleton.nodes.size()));
        trueWeights_.assign(comparesWeights() ? truth_.size() : 0, {});
        for (uint32_t k = 0; k < truth_.size(); ++k) {
            sampleClip(character, clip_, timeOf(0.5 * k), pose_);
            distance_.globalsOf(pose_, truth_[k]);
            if (!isModest(truth_[k])) {
                leftOut_ = "its numbers are too large";
                return false;
            }
            if (comparesWeights()) {
                takeWeights(trueWeights_[k]);
            }
            if (k % 2 == 0) {
                takeFrame();
            }
        }
        const double tooMuch = 0.01 * distance_.extent();
        for (Track& track : tracks_) {
            measure(track);
            track.spans.measure(last_, tooMuch, [&](uint32_t first, uint32_t length) {
                return distanceIfSkipped(track, first, length);
            });
        }
        return true;
    }
    void takeFrame() {
        for (Track& track : tracks_) {
            if (track.isWeights()) {
                track.values.push_back(threeOf(pose_.morphWeights, track));
                continue;
            }
            const Transform& own = pose_.locals[order_.nodes[track.place]];
            if (track.isRotation()) {
                const glm::dquat q = unit(own.rotation);
                const bool other = !track.turns.empty() && glm::dot(track.turns.back(), q) < 0.0;
                track.turns.push_back(other ? -q : q);
            } else {
                track.values.push_back(track.path == ChannelPath::translation ? own.translation : own.scale);
            }
        }
    }
    /// The three of a track, from numbers by morph target; behind the last target there are zeros.
    template <class Numbers>
    [[nodiscard]] glm::dvec3 threeOf(const Numbers& numbers, const Track& track) const {
        const size_t first = 3 * (track.place - order_.nodes.size());
        glm::dvec3 three(0.0);
        for (size_t k = 0; k < 3 && first + k < numbers.size(); ++k) {
            three[static_cast<int>(k)] = static_cast<double>(numbers[first + k]);
        }
        return three;
    }
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

    static glm::dvec3 middleOf(const std::vector<glm::dvec3>& values) {
        glm::dvec3 low(kInfinite), high(-kInfinite);
        for (const glm::dvec3& v : values) {
            low = glm::min(low, v);
            high = glm::max(high, v);
        }
        return 0.5 * (low + high);
    }
    void measure(Track& track) const {
        track.fromRest = track.fromConstant = 0.0;
        if (track.isWeights()) {
            track.reach = threeOf(distance_.targetReaches(), track);
            measureFrom(track, threeOf(distance_.character().morphs.weights, track));
            return;
        }
        const uint32_t node = order_.nodes[track.place];
        const cage::Node& own = distance_.character().skeleton.nodes[node];
        track.reach = glm::dvec3(distance_.reach(node, track.path));
        if (track.isRotation()) {
            measureTurns(track, unit(glm::dquat(own.rotation)));
        } else {
            measureFrom(track, glm::dvec3(track.path == ChannelPath::translation ? own.translation : own.scale));
        }
    }
    static void measureFrom(Track& track, const glm::dvec3& rest) {
        track.constant = middleOf(track.values);
        for (const glm::dvec3& v : track.values) {
            track.fromRest = std::max(track.fromRest, track.distance(v - rest));
            track.fromConstant = std::max(track.fromConstant, track.distance(v - track.constant));
        }
    }
    void measureTurns(Track& track, const glm::dquat& rest) const {
        glm::dquat sum(0.0, 0.0, 0.0, 0.0);
        for (const glm::dquat& q : track.turns) {
            sum = sum + q;
        }
        track.reference = referenceNear(glm::length(sum) > 1e-3 ? sum : track.turns.front());
        const glm::dquat reference = referenceTurn(track.reference);
        track.values.clear();
        track.jumps = false;
        for (size_t f = 0; f < track.turns.size(); ++f) {
            track.values.push_back(toQuarterTangent(glm::conjugate(reference) * track.turns[f]));
            track.jumps = track.jumps || (f > 0 && !isShortArc(track.turns[f - 1], track.turns[f]));
        }
        const glm::dquat constant = reference * fromQuarterTangent(middleOf(track.values));
        track.constant = toQuarterTangent(constant);
        for (const glm::dquat& q : track.turns) {
            track.fromRest = std::max(track.fromRest, track.reach.x * angleBetween(q, rest));
            track.fromConstant = std::max(track.fromConstant, track.reach.x * angleBetween(q, constant));
        }
    }
    /// Up to 120 degrees, which slerpShare is made for.
    static bool isShortArc(const glm::dquat& a, const glm::dquat& b) { return std::abs(glm::dot(a, b)) > 0.501; }

    [[nodiscard]] double distanceIfSkipped(const Track& track, uint32_t first, uint32_t length) const {
        double worst = 0.0;
        const uint32_t end = first + length;
        if (track.isRotation()) {
            const glm::dquat &a = track.turns[first], &b = track.turns[end];
            if (!isShortArc(a, b)) {
                return kInfinite;
            }
            for (uint32_t k = 1; k < length; ++k) {
                const glm::dquat q = slerp(a, b, static_cast<double>(k) / length);
                worst = std::max(worst, track.reach.x * angleBetween(q, track.turns[first + k]));
            }
        } else {
            const glm::dvec3 &a = track.values[first], &b = track.values[end];
            for (uint32_t k = 1; k < length; ++k) {
                const glm::dvec3 v = glm::mix(a, b, static_cast<double>(k) / length);
                worst = std::max(worst, track.distance(v - track.values[first + k]));
            }
        }
        return worst;
    }

    /// The largest distance between two lists of morph weights.
    [[nodiscard]] double between(std::span<const double> a, std::span<const double> b) const {
        double sum = 0.0;
        for (size_t t = 0; t < a.size(); ++t) {
            sum += distance_.targetReaches()[t] * std::abs(a[t] - b[t]);
        }
        return sum;
    }

    /// What is too large for 20 bits stays too large.
    static glm::ivec3 wholeOf(const glm::dvec3& value, int exponent) {
        return glm::ivec3(glm::clamp(glm::round(value * std::ldexp(1.0, exponent)), -1e6, 1e6));
    }
    /// Nothing if the property stays at rest.
    [[nodiscard]] std::optional<PackedProperty> packed(const Track& track, double budget) const {
        if (track.fromRest <= kStill * budget) {
            return std::nullopt;
        }
        PackedProperty own;
        own.place = track.place;
        own.path = track.path;
        own.isConstant = track.fromConstant <= kStill * budget;
        if (own.isConstant) {
            own.exponent = constantExponent(track.constant);
            own.values.push_back(wholeOf(track.constant, own.exponent));
            return own;
        }
        const double bits = std::ceil(-std::log2(kForRounding * budget / track.moveOfStep()));
        own.exponent = static_cast<int>(std::clamp<double>(bits, kLeastExponent, kMostExponent));
        own.reference = track.reference;
        own.frames = track.spans.knots(last_, (1.0 - kForRounding) * budget);
        for (const uint32_t frame : own.frames) {
            own.values.push_back(wholeOf(track.values[frame], own.exponent));
        }
        removeEqualKnots(own);
        return own;
    }

    [[nodiscard]] Attempt attempt(double budget) const {
        Attempt attempt;
        attempt.packed.last = last_;
        attempt.rest = rest_;
        bool keepsWeights = false;
        for (const Track& track : tracks_) {
            std::optional<PackedProperty> own = packed(track, budget * track.share);
            if (own && (track.jumps || !fitsLayout(*own))) {
                if (track.isWeights()) {
                    keepsWeights = true;
                } else {
                    attempt.rest.push_back(*track.channel);
                }
            } else if (own) {
                attempt.packed.properties.push_back(std::move(*own));
            }
        }
        if (keepsWeights) {
            std::erase_if(attempt.packed.properties,
                          [](const PackedProperty& own) { return own.path == ChannelPath::weights; });
            keepWeights(attempt.rest);
        }
        return attempt;
    }

    [[nodiscard]] cage::Clip decoded(const Attempt& attempt) const {
        cage::Clip clip;
        clip.name = clip_.name;
        clip.duration = clip_.duration;
        clip.markers = clip_.markers;
        clip.sharpness = clip_.sharpness;
        clip.channels = channelsOf(attempt.packed, clip_.duration, order_.nodes, order_.targetCount);
        clip.packed.channelCount = static_cast<uint32_t>(clip.channels.size());
        clip.channels.insert(clip.channels.end(), attempt.rest.begin(), attempt.rest.end());
        return clip;
    }

    /// Once it is more than `most`, nobody asks how much more.
    [[nodiscard]] double errorOf(const cage::Clip& clip, std::span<const uint32_t> vertices, double most) {
        double worst = 0.0;
        std::vector<glm::dmat4> globals(distance_.character().skeleton.nodes.size());
        for (uint32_t k = 0; k < truth_.size() && worst <= most; ++k) {
            sampleClip(distance_.character(), clip, timeOf(0.5 * k), pose_);
            distance_.globalsOf(pose_, globals);
            double own = distance_.between(globals, truth_[k], vertices);
            if (comparesWeights()) {
                takeWeights(shownWeights_);
                own += between(shownWeights_, trueWeights_[k]) / distance_.extent();
            }
            worst = std::max(worst, own);
        }
        return worst;
    }

    /// What a budget has given.
    struct Found {
        Attempt attempt;
        cage::Clip clip; ///< with its words and its error
    };
    /// Tries make(budget) with the largest budget that keeps within the error, first of some vertices, at last of all.
    template <class Make>
    std::optional<Found> search(double error, Make&& make) {
        double low = 0.0, high = 0.0, part = 0.5; // budgets, in errors
        for (int i = 0; i < 10; ++i) {
            const cage::Clip clip = decoded(make(part * error * distance_.extent()));
            (errorOf(clip, distance_.watched(), error) <= error ? low : high) = part;
            part = high == 0.0 ? 1.5 * part : 0.5 * (low + high);
            if (low > 0.0 && high > 0.0 && high < 1.05 * low) {
                break;
            }
        }
        for (int i = 0; i < 12 && low > 0.0; ++i, low *= 0.93) {
            Found own{make(low * error * distance_.extent()), {}};
            std::optional<std::vector<uint32_t>> words =
                packedWords(own.attempt.packed, clip_.duration, {order_.nodes.size(), order_.targetCount});
            if (!words || own.attempt.packed.properties.empty()) {
                return std::nullopt;
            }
            own.clip = decoded(own.attempt);
            own.clip.packed.error = errorOf(own.clip, distance_.all(), error);
            if (own.clip.packed.error <= error) {
                own.clip.packed.words = std::move(*words);
                return own;
            }
        }
        return std::nullopt;
    }

    /// As search(), also with budgets that differ: if all that follows a node is off by less than it may be, what moves
    /// the node gets more. What stands at the end of a long chain, as fingers do, needs smaller budgets than a foot.
    template <class Make>
    std::optional<Found> balanced(double error, Make&& make) {
        for (Track& track : tracks_) {
            track.share = track.isWeights() ? kWeightShare : 1.0;
        }
        std::optional<Found> best = search(error, make);
        std::optional<Found> last = best;
        for (int i = 0; i < kBalancings && last; ++i) {
            const std::vector<double> off = offBelow(last->clip);
            for (Track& track : tracks_) {
                if (track.isWeights()) {
                    continue;
                }
                track.share *= std::pow(error / std::max(off[order_.nodes[track.place]], kLeastUsed * error), kBalance);
            }
            last = search(error, make);
            if (last && clipBytes(order_, last->clip) < clipBytes(order_, best->clip)) {
                best = last;
            }
        }
        return best;
    }
    /// By node: the largest distance of what follows it, in extents.
    [[nodiscard]] std::vector<double> offBelow(const cage::Clip& clip) {
        const cage::Skeleton& skeleton = distance_.character().skeleton;
        std::vector<double> off(skeleton.nodes.size(), 0.0);
        std::vector<glm::dmat4> globals(skeleton.nodes.size());
        for (uint32_t k = 0; k < truth_.size(); ++k) {
            sampleClip(distance_.character(), clip, timeOf(0.5 * k), pose_);
            distance_.globalsOf(pose_, globals);
            distance_.takeLargest(globals, truth_[k], off);
        }
        for (auto node = skeleton.parentsFirst.rbegin(); node != skeleton.parentsFirst.rend(); ++node) {
            if (const uint32_t parent = skeleton.nodes[*node].parent; parent != cage::kNone) {
                off[parent] = std::max(off[parent], off[*node]);
            }
        }
        return off;
    }

    /// Gives the clip its coarse twin, if that takes less than what it stands in for.
    void addTwin(Found& fine) {
        if (!errors_.wantTwins()) {
            return;
        }
        if (!takeWork()) {
            twinLeftOut_ = std::exchange(leftOut_, nullptr);
            return;
        }
        const std::optional<Found> coarse = balanced(errors_.coarse, [&](double budget) {
            Attempt own = attempt(budget);
            own.rest = fine.attempt.rest; // what is not packed plays with either
            std::erase_if(own.packed.properties, [&](const PackedProperty& property) {
                return std::none_of(
                    fine.attempt.packed.properties.begin(), fine.attempt.packed.properties.end(),
                    [&](const PackedProperty& of) { return of.place == property.place && of.path == property.path; });
            });
            return own;
        });
        cage::PackedChannels& packed = fine.clip.packed;
        if (coarse && coarse->clip.packed.words.size() < segmentWords(packed.words)) {
            packed.coarseWords = coarse->clip.packed.words;
            packed.coarseError = coarse->clip.packed.error;
        } else {
            twinLeftOut_ = coarse ? "it would take as much as the segments" : "none keeps within the error";
        }
    }

    const PoseDistance& distance_;
    DrivenWeights driven_;
    bool hasDrivers_;
    const NodeOrder& order_;
    const cage::Clip& clip_;
    PackErrors errors_;
    uint64_t& workLeft_;
    const char *leftOut_ = nullptr, *twinLeftOut_ = nullptr;
    uint32_t last_ = 0;
    std::vector<Track> tracks_;
    bool movesWeights_ = false;
    std::vector<Channel> rest_;                  ///< channels that are never packed
    std::vector<std::vector<glm::dmat4>> truth_; ///< by half frame
    std::vector<std::vector<double>> trueWeights_;
    std::vector<double> shownWeights_;
    Pose pose_;
};

} // namespace

std::vector<std::string> packClips(cage::Character& character, double error, double coarseError) {
    std::vector<std::string> leftOut;
    if (character.clips.empty() || character.skin.joints.empty()) {
        return leftOut;
    }
    const uint32_t root = findRoot(character);
    std::vector<std::optional<cage::Clip>> packed;
    {
        PoseDistance distance(character);
        distance.takeDrivers();
        const DriverTable drivers = buildDriverTable(character);
        const NodeOrder order = nodeOrder(character);
        uint64_t workLeft = kMostWork;
        for (const cage::Clip& clip : character.clips) {
            ClipPacker packer(distance, drivers, order, clip, {error, coarseError}, workLeft);
            std::optional<cage::Clip>& own = packed.emplace_back(packer.pack());
            const size_t bytes = clipBytes(order, clip);
            // Its twin is beside what it takes itself.
            if (own && clipBytes(order, *own) - own->packed.coarseWords.size() * sizeof(uint32_t) < bytes) {
                own->packed.unpackedBytes = bytes;
            } else {
                own.reset();
            }
            if (packer.leftOut() != nullptr) {
                leftOut.push_back("clip " + cage::quoted(clip.name) + " is not packed: " + packer.leftOut());
            }
            const bool isDone = coarseError > error && !clip.packed.words.empty() && clip.packed.coarseWords.empty();
            const char* const noTwin = isDone ? "it is packed already" : own ? packer.twinLeftOut() : nullptr;
            if (noTwin != nullptr) {
                leftOut.push_back("clip " + cage::quoted(clip.name) + " has no coarse twin: " + noTwin);
            }
        }
    }
    for (size_t c = 0; c < packed.size(); ++c) {
        if (packed[c]) {
            character.clips[c] = std::move(*packed[c]);
            character.clipRoot = root;
        }
    }
    return leftOut;
}

} // namespace supple::skinning
