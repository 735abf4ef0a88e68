#include "skinning/clip_bounds.h"

#include "cage/solved_driver.h"
#include "skinning/centers.h"
#include "skinning/chord.h"
#include "skinning/delta_mush.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace supple::skinning {

namespace {

constexpr int kMostHalvings = 8;
/// Poses on the device are floats: of the products that lead to a vertex, and of the extent (docs/playback.md).
constexpr double kProductSlack = 1e-6, kExtentSlack = 2e-5;
/// Of the coefficients of a driver: what is off where they cancel out.
constexpr double kDriverSlack = 1e-5;
/// No smoothed weight is as small.
constexpr double kLeastWeight = 1e-6;

/// Finds the box of intervals, one after the other.
class BoundsFinder {
public:
    BoundsFinder(const cage::Character& character, const cage::Clip* clip, const ClipBoundsDesc& desc)
        : character_(character), desc_(desc), poser_(character, clip), positions_(character.cage.positions.size()) {
        std::copy(character.cage.positions.begin(), character.cage.positions.end(), positions_.begin());
        const cage::Skin& skin = character.skin;
        inverseBinds_.assign(skin.inverseBinds.begin(), skin.inverseBinds.end());
        reach_.resize(skin.joints.size(), -1.0);
        for (size_t v = 0; v < positions_.size(); ++v) {
            takeVertex(v);
        }
        joints_.resize(skin.joints.size());
        placed_.resize(positions_.size());
        takeDrivers(clip == nullptr);
        if (clip != nullptr) {
            steps_ = std::any_of(clip->channels.begin(), clip->channels.end(), [](const cage::Channel& channel) {
                return channel.interpolation == cage::Interpolation::step;
            });
        }
    }

    /// Errors above `tolerance` halve the interval.
    void follow(double first, double last, double tolerance, int halvings = 0) {
        poser_.pose(first, last, pose_);
        if (halvings < kMostHalvings && worstError() > tolerance) {
            const double middle = 0.5 * (first + last);
            follow(first, middle, tolerance, halvings + 1);
            follow(middle, last, tolerance, halvings + 1);
            return;
        }
        takeJoints();
        morph();
        Box box = emptyBox();
        if (turns() || morphs_) {
            for (size_t v = 0; v < positions_.size(); ++v) {
                addVertex(v, box);
            }
            reached_ = -1.0;
        } else {
            addPlain(first, last, box);
        }
        const glm::dvec3 size = box.high - box.low;
        box = grownBy(box, kProductSlack * products_ + kExtentSlack * glm::length(size));
        box = grownBy(box, desc_.margin * (box.high - box.low));
        box_.low = glm::min(box_.low, box.low);
        box_.high = glm::max(box_.high, box.high);
        isSound_ = isSound_ && std::isfinite(sum_) && std::isfinite(glm::length(box.high - box.low));
    }

    [[nodiscard]] const Box& box() const { return box_; }
    [[nodiscard]] bool isSound() const { return isSound_; }

private:
    /// What drivers add to a morph weight, at least and at most.
    struct Driven {
        double low = 0.0, high = 0.0;
    };
    struct Joint {
        ChordNode place;
        ChordMatrix rotation; ///< of the joint's matrix with the inverse bind
        bool turns = false;   ///< whether that is a rotation times a positive number
    };
    /// Where a joint alone takes a vertex.
    struct Moved {
        ChordVector at;
        double weight = 0.0;
        uint32_t joint = 0;
    };

    /// They add what they will, between their ends. In the rest pose that is 0, but for what floats leave of it.
    void takeDrivers(bool rests) {
        driven_.resize(character_.morphs.targets.size());
        for (const cage::PoseDriver& driver : character_.drivers) {
            const Result<cage::SolvedDriver> solved = rests ? cage::solveDriver(driver) : Error{};
            for (size_t t = 0; t < driver.targets.size(); ++t) {
                const double most = solved ? kDriverSlack * sumOfCoefficients(*solved, t, driver.targets.size())
                                           : std::numeric_limits<double>::infinity();
                Driven& own = driven_[driver.targets[t]];
                own.low += std::max(static_cast<double>(driver.low), -most);
                own.high += std::min(static_cast<double>(driver.high), most);
            }
        }
    }
    static double sumOfCoefficients(const cage::SolvedDriver& solved, size_t target, size_t targets) {
        double sum = 0.0;
        for (size_t i = target; i < solved.coefficients.size(); i += targets) {
            sum += std::abs(static_cast<double>(solved.coefficients[i]));
        }
        return sum;
    }

    /// What joints move for a vertex: the vertex itself or, if delta mush smooths it, the means of what each moves of
    /// its neighborhood. The heaviest joint has what the others leave.
    void takeVertex(size_t vertex) {
        const auto take = [&](uint32_t joint, double weight, const glm::dvec3& point) {
            influences_.push_back({joint, weight});
            local_.push_back(glm::dvec3(inverseBinds_[joint] * glm::dvec4(point, 1.0)));
            distances_.push_back(glm::length(local_.back()));
            reach_[joint] = std::max(reach_[joint], distances_.back());
        };
        if (isSmoothed(vertex)) {
            const DeltaMush& mush = *desc_.skinning.mush;
            const glm::dvec3 place(mush.places[vertex]);
            double left = 1.0;
            glm::dvec3 offset(0.0);
            for (uint32_t i = mush.starts[vertex] + 1; i < mush.starts[vertex + 1]; ++i) {
                const MushInfluence& own = mush.influences[i];
                const double weight = static_cast<double>(own.weight);
                take(own.joint, weight, place + glm::dvec3(own.offset) / std::max(weight, kLeastWeight));
                left -= weight;
                offset -= glm::dvec3(own.offset);
            }
            take(mush.influences[mush.starts[vertex]].joint, left, place + offset / std::max(left, kLeastWeight));
        } else {
            const cage::SkinWeights& weights = character_.weights;
            for (uint32_t i = weights.starts[vertex]; i < weights.starts[vertex + 1]; ++i) {
                const cage::Influence& own = weights.influences[i];
                take(own.joint, static_cast<double>(own.weight), positions_[vertex]);
            }
        }
        starts_.push_back(static_cast<uint32_t>(influences_.size()));
    }

    /// Whether delta mush makes more of it than linear skinning does.
    [[nodiscard]] bool isSmoothed(size_t vertex) const {
        const DeltaMush* const mush = desc_.skinning.mush;
        return isMush(desc_.skinning.mode) && mush->places[vertex].w != 0.0f &&
               mush->starts[vertex + 1] - mush->starts[vertex] > 1;
    }

    /// Vertices of several joints turn by their rotations.
    [[nodiscard]] bool turns() const { return desc_.skinning.mode != SkinningMode::linear; }

    [[nodiscard]] double worstError() const {
        double worst = 0.0;
        for (size_t j = 0; j < reach_.size(); ++j) {
            const ChordNode& node = pose_.nodes[character_.skin.joints[j]];
            if (reach_[j] >= 0.0) {
                worst = std::max(worst, node.linear.error * reach_[j] + node.translation.error);
            }
        }
        return worst;
    }

    void takeJoints() {
        products_ = 0.0;
        for (size_t j = 0; j < joints_.size(); ++j) {
            Joint& joint = joints_[j];
            joint.place = pose_.nodes[character_.skin.joints[j]];
            const ChordVector& t = joint.place.translation;
            const glm::dvec3 bind(inverseBinds_[j][3]);
            products_ = std::max({products_, glm::length(t.ends[0]), glm::length(t.ends[1]),
                                  joint.place.linear.size * (glm::length(bind) + std::max(reach_[j], 0.0))});
            if (!turns()) {
                continue;
            }
            const glm::dmat3 linear(inverseBinds_[j]);
            const double determinant = glm::determinant(linear), size = std::cbrt(determinant);
            joint.turns = joint.place.turns && determinant > 0.0 &&
                          normOf(glm::transpose(linear) * linear / (size * size) - glm::dmat3(1.0)) < 1e-3;
            if (joint.turns) {
                joint.rotation = joint.place.rotation * chordMatrix(linear / size, linear / size, 0.0);
            }
        }
    }

    /// The positions at both ends, and how far each vertex may be from its chord, as far as targets move it.
    void morph() {
        morphs_ = false;
        for (size_t t = 0; t < character_.morphs.targets.size(); ++t) {
            const double middle = 0.5 * (driven_[t].low + driven_[t].high);
            const double weights[2] = {pose_.weights[0][t] + middle, pose_.weights[1][t] + middle};
            const double error = pose_.weightErrors[t] + (driven_[t].high - middle);
            if (weights[0] == 0.0 && weights[1] == 0.0 && error == 0.0) {
                continue;
            }
            if (!morphs_) {
                morphed_[0] = morphed_[1] = positions_;
                morphErrors_.assign(positions_.size(), 0.0);
                morphs_ = true;
            }
            const cage::MorphTarget& target = character_.morphs.targets[t];
            for (size_t k = 0; k < target.vertices.size(); ++k) {
                const uint32_t v = target.vertices[k];
                const glm::dvec3 delta(target.deltas[k]);
                morphed_[0][v] += weights[0] * delta;
                morphed_[1][v] += weights[1] * delta;
                morphErrors_[v] += error * glm::length(delta);
            }
        }
    }

    [[nodiscard]] ChordVector moved(size_t vertex, uint32_t influence) const {
        const uint32_t joint = influences_[influence].joint;
        const ChordNode& place = joints_[joint].place;
        if (!morphs_ || isSmoothed(vertex)) {
            return place.linear * ChordVector{{local_[influence], local_[influence]}, 0.0} + place.translation;
        }
        const glm::dmat4& bind = inverseBinds_[joint];
        const ChordVector local{{glm::dvec3(bind * glm::dvec4(morphed_[0][vertex], 1.0)),
                                 glm::dvec3(bind * glm::dvec4(morphed_[1][vertex], 1.0))},
                                morphErrors_[vertex] * normOf(glm::dmat3(bind))};
        return place.linear * local + place.translation;
    }

    void addVertex(size_t vertex, Box& box) {
        moved_.clear();
        glm::dvec3 ends[2]{glm::dvec3(0.0), glm::dvec3(0.0)};
        double error = 0.0;
        for (uint32_t i = starts_[vertex]; i < starts_[vertex + 1]; ++i) {
            const auto& [joint, weight] = influences_[i];
            const ChordVector at = moved(vertex, i);
            ends[0] += weight * at.ends[0];
            ends[1] += weight * at.ends[1];
            error += weight * at.error;
            if (turns()) {
                moved_.push_back({at, weight, joint});
            }
        }
        take(ends, error + (moved_.size() < 2 ? 0.0 : beyondLinear(vertex)), box);
    }

    /// How far a vertex of several joints may be from the mean of what they make of it.
    [[nodiscard]] double beyondLinear(size_t vertex) const {
        switch (desc_.skinning.mode) {
        case SkinningMode::linear:
            return 0.0;
        case SkinningMode::dualQuaternion:
            return dualQuaternionError();
        case SkinningMode::centersOfRotation:
            return centerError(vertex);
        case SkinningMode::deltaMush:
        case SkinningMode::deltaMushLight:
            return isSmoothed(vertex) ? smoothedLength(vertex) : 0.0;
        }
        return 0.0;
    }

    /// All vertices, linearly skinned and not morphed: the same as addVertex() without what is not needed. Where an
    /// interval begins at which the last one ended, they are known there.
    void addPlain(double first, double last, Box& box) {
        const bool known = first == reached_ && !steps_;
        for (size_t v = 0; v < positions_.size(); ++v) {
            glm::dvec3 ends[2]{known ? placed_[v] : glm::dvec3(0.0), glm::dvec3(0.0)};
            double error = 0.0;
            for (uint32_t i = starts_[v]; i < starts_[v + 1]; ++i) {
                const auto& [joint, weight] = influences_[i];
                const ChordNode& place = joints_[joint].place;
                for (int end = known ? 1 : 0; end < 2; ++end) {
                    ends[end] += weight * (place.linear.ends[end] * local_[i] + place.translation.ends[end]);
                }
                error += weight * (place.linear.error * distances_[i] + place.translation.error);
            }
            placed_[v] = ends[1];
            take(ends, error, box);
        }
        reached_ = last;
    }

    void take(const glm::dvec3 (&ends)[2], double error, Box& box) {
        extend(box, ends[0], error);
        extend(box, ends[1], error);
        sum_ += error + glm::dot(ends[0] + ends[1], glm::dvec3(1.0));
    }

    /// The most that half the angle between two joints' rotations can have as its sine: |R - S| is twice that.
    [[nodiscard]] double sineBetween(const Joint& a, const Joint& b) const {
        if (!a.turns || !b.turns) {
            return 1.0;
        }
        double most = 0.0;
        for (int end = 0; end < 2; ++end) {
            double trace = 0.0;
            for (int c = 0; c < 3; ++c) {
                trace += glm::dot(a.rotation.ends[end][c], b.rotation.ends[end][c]);
            }
            most = std::max(most, std::sqrt(std::max(3.0 - trace, 0.0)) / 2.0);
        }
        return most + (a.rotation.error + b.rotation.error) / 2.0 + 1e-3; // scales are uniform but for rounding
    }

    /// The most that half the angle between the rotations of two joints of moved_ can have as its sine, if a blend of
    /// their quaternions lies between them; 1 if it may not. Quaternions are turned to the side of the heaviest
    /// joint's; two of them are then on one side if both are within 45 degrees of it.
    [[nodiscard]] double sineOfBlend() const {
        const size_t heaviest = heaviestMoved();
        double sine = 0.0, toBase = 0.0;
        for (size_t k = 0; k < moved_.size(); ++k) {
            for (size_t l = 0; l < k; ++l) {
                const double between = sineBetween(joints_[moved_[k].joint], joints_[moved_[l].joint]);
                sine = std::max(sine, between);
                toBase = k == heaviest || l == heaviest ? std::max(toBase, between) : toBase;
            }
        }
        return sine < 0.985 && (moved_.size() == 2 || toBase < 0.7) ? sine : 1.0;
    }

    [[nodiscard]] size_t heaviestMoved() const {
        size_t heaviest = 0;
        for (size_t k = 1; k < moved_.size(); ++k) {
            heaviest = moved_[k].weight > moved_[heaviest].weight ? k : heaviest;
        }
        return heaviest;
    }

    /// How far a vertex that turns about its center may be from where linear skinning takes it: see
    /// SkinnedBounds::grown(). Rotations differ by twice the sine of half their angle, and a blend of quaternions is no
    /// farther from one of them than the others are.
    [[nodiscard]] double centerError(size_t vertex) const {
        const glm::vec4& center = desc_.skinning.centers->points[vertex];
        return center.w == 0.0f ? 0.0 : 2.0 * sineOfBlend() * sizeOfMoved() * armFrom(center, vertex);
    }

    /// Delta mush adds the way from the smoothed place to the vertex, stretched by the joints and turned: that is no
    /// longer than the way times the mean of the joints' sizes, whatever the rotation is.
    [[nodiscard]] double smoothedLength(size_t vertex) const {
        return sizeOfMoved() * armFrom(desc_.skinning.mush->places[vertex], vertex);
    }

    [[nodiscard]] double armFrom(const glm::vec4& center, size_t vertex) const {
        double arm = 0.0;
        for (int end = 0; end < 2; ++end) {
            const glm::dvec3& rest = morphs_ ? morphed_[end][vertex] : positions_[vertex];
            arm = std::max(arm, glm::distance(rest, glm::dvec3(center)));
        }
        return arm + (morphs_ ? morphErrors_[vertex] : 0.0);
    }

    /// By how much joints stretch a way, on the mean.
    [[nodiscard]] double sizeOfMoved() const {
        double size = 0.0;
        for (const Moved& own : moved_) {
            const ChordMatrix& linear = joints_[own.joint].place.linear;
            size += own.weight * (linear.size + linear.error) * normOf(glm::dmat3(inverseBinds_[own.joint]));
        }
        return size;
    }

    /// How far a vertex that dual quaternions blend may be from where linear skinning takes it (shaders/deform).
    ///
    /// Let joint j take it to y_j, with the weight w_j and the unit quaternion q_j, q = sum w_j q_j, and let d_j = y_j
    /// - y_0 be seen from the heaviest joint's. The result is y_0 + sum (re(a_j) d_j + d_j x v_j), where a_j = w_j q_j
    /// conj(q) / |q|^2 and v_j is its vector part. If quaternions are p apart at most, less than a right angle, then
    /// cos p <= |q|^2 <= 1, so |re(a_j) - w_j| <= w_j (1 / cos p - 1) and |v_j| <= w_j (1 - w_j) tan p. Linear skinning
    /// has w_j instead of a_j. Quaternions that are further apart have |a_j| <= w_j / |q| and |q| >= w_0, because all
    /// lie on the side of q_0.
    [[nodiscard]] double dualQuaternionError() const {
        const Moved& base = moved_[heaviestMoved()];
        const double sine = sineOfBlend();
        const bool together = sine < 1.0;
        const double cosine = together ? std::sqrt(1.0 - sine * sine) : 0.0;
        double error = 0.0;
        for (const Moved& other : moved_) {
            const double distance = std::max(glm::length(other.at.ends[0] - base.at.ends[0]),
                                             glm::length(other.at.ends[1] - base.at.ends[1])) +
                                    other.at.error + base.at.error;
            const double share =
                together ? 1.0 / cosine - 1.0 + (1.0 - other.weight) * sine / cosine : 1.0 + 1.0 / base.weight;
            error += &other == &base ? 0.0 : other.weight * distance * share;
        }
        return error;
    }

    const cage::Character& character_;
    ClipBoundsDesc desc_;
    ChordPoser poser_;
    ChordPose pose_;
    struct Influence {
        uint32_t joint = 0;
        double weight = 0.0;
    };
    std::vector<uint32_t> starts_{0}; ///< by vertex: of influences_
    std::vector<Influence> influences_;
    std::vector<glm::dvec3> positions_, local_; ///< of the cage; by influence, in the space of the joint
    std::vector<glm::dmat4> inverseBinds_;
    std::vector<double> distances_;  ///< by influence: the length of local_
    std::vector<glm::dvec3> placed_; ///< linearly skinned, at the time reached_
    double reached_ = -1.0;
    bool steps_ = false;        ///< what is right before a time is not what is at it
    double sum_ = 0.0;          ///< of everything: finite if all of it is
    std::vector<double> reach_; ///< by joint: the farthest vertex that follows it, or -1
    std::vector<Joint> joints_;
    std::vector<Driven> driven_; ///< by morph target
    bool morphs_ = false;
    std::vector<glm::dvec3> morphed_[2];
    std::vector<double> morphErrors_;
    std::vector<Moved> moved_;
    double products_ = 0.0; ///< the largest length among what is added up to a vertex
    Box box_ = emptyBox();
    bool isSound_ = true;
};

/// The times of all keys, and the clip's ends.
std::vector<double> keysOf(const cage::Clip& clip) {
    std::vector<double> times{0.0, clip.duration};
    for (const cage::Channel& channel : clip.channels) {
        for (const float time : channel.times) {
            times.push_back(std::clamp(static_cast<double>(time), 0.0, clip.duration));
        }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

} // namespace

Box clipBounds(const cage::Character& character, const cage::Clip* clip, const ClipBoundsDesc& desc) {
    BoundsFinder finder(character, clip, desc);
    finder.follow(0.0, 0.0, std::numeric_limits<double>::infinity());
    if (clip != nullptr) {
        const double tolerance = desc.tolerance * glm::length(finder.box().high - finder.box().low);
        const std::vector<double> times = keysOf(*clip);
        for (size_t k = 0; k + 1 < times.size(); ++k) {
            finder.follow(times[k], times[k + 1], tolerance);
        }
        finder.follow(clip->duration, clip->duration, tolerance); // what a step begins there
    }
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return finder.isSound() ? finder.box() : Box{glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
}

Box bindBounds(const cage::Character& character, const ClipBoundsDesc& desc) {
    Box box = emptyBox();
    for (const glm::vec3& position : character.cage.positions) {
        extend(box, glm::dvec3(position));
    }
    return grownBy(box, desc.margin * (box.high - box.low));
}

} // namespace supple::skinning
