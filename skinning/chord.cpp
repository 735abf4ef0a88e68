#include "skinning/chord.h"

#include <algorithm>
#include <cmath>

namespace supple::skinning {

namespace {

using cage::Channel;
using cage::ChannelPath;
using cage::Interpolation;

constexpr double kAnyRotation = 2.0; ///< no rotation is further from a mean of rotations

/// Of a spline between two times within one of its segments.
class SplineError {
public:
    /// Nothing is to be said of channels that are their chords there.
    SplineError(const Channel& channel, double first, double last) : channel_(channel) {
        const auto& times = channel.times;
        const double middle = 0.5 * (first + last);
        const auto later = std::upper_bound(times.begin(), times.end(), middle,
                                            [](double t, float k) { return t < static_cast<double>(k); });
        if (channel.interpolation != Interpolation::cubicSpline || later == times.begin() || later == times.end()) {
            return;
        }
        key_ = static_cast<size_t>(later - times.begin()) - 1;
        const double begin = static_cast<double>(times[key_]);
        seconds_ = static_cast<double>(times[key_ + 1]) - begin;
        ends_[0] = (first - begin) / seconds_;
        ends_[1] = (last - begin) / seconds_;
    }
    /// Numbers `from` to `from + count` of a value.
    [[nodiscard]] double of(size_t from, size_t count) const {
        if (seconds_ == 0.0) {
            return 0.0;
        }
        double most = 0.0;
        for (const double u : ends_) {
            double squares = 0.0;
            for (size_t c = from; c < from + count; ++c) {
                const double second =
                    value(3 * key_ + 1, c) * (12.0 * u - 6.0) + value(3 * key_ + 2, c) * seconds_ * (6.0 * u - 4.0) +
                    value(3 * key_ + 4, c) * (6.0 - 12.0 * u) + value(3 * key_ + 3, c) * seconds_ * (6.0 * u - 2.0);
                squares += second * second;
            }
            most = std::max(most, std::sqrt(squares));
        }
        const double share = ends_[1] - ends_[0];
        return most * share * share / 8.0;
    }

private:
    [[nodiscard]] double value(size_t row, size_t component) const {
        return static_cast<double>(channel_.values[row * channel_.width() + component]);
    }

    const Channel& channel_;
    size_t key_ = 0;
    double seconds_ = 0.0;
    double ends_[2] = {0.0, 0.0}; ///< as shares of the segment
};

glm::dvec4 vectorOf(const glm::dquat& q) {
    return {q.x, q.y, q.z, q.w};
}

/// How far the rotation may be from its chord, as a matrix. `error`: how far the quaternion may be from its own.
///
/// A slerp by the angle a: its second derivative in s has the norm a^2, so it is within a^2 / 8.
///
/// A spline is made of unit length. Let q0 and q1 be its ends, r0 and r1 their lengths, u0 and u1 them of unit length,
/// d = |u1 - u0|. The spline is within `error` of the chord c(s) from q0 to q1, and neither is shorter than m. Made of
/// unit length they differ by error / m at most. c of unit length lies on the arc from u0 to u1, at the place where the
/// chord from u0 to u1 has the share s r1 / ((1-s) r0 + s r1), which differs from s by |r1/r0 - 1| / (4 min(1, r1/r0))
/// at most; and that chord is within d^2 / 4 of the unit sphere. The sum e bounds how far the unit quaternion is from
/// its chord. A rotation is a product of the quaternion with itself, so the rule of products gives
/// d^2 / 4 + 2 e + e^2.
double rotationError(const glm::dquat& first, const glm::dquat& last, bool spline, double error) {
    const glm::dvec4 q0 = vectorOf(first), q1 = vectorOf(last), along = q1 - q0;
    const double r0 = glm::length(q0), r1 = glm::length(q1);
    if (!(r0 > 0.0) || !(r1 > 0.0)) {
        return kAnyRotation;
    }
    if (!spline) {
        const double angle = 2.0 * std::acos(std::min(std::abs(glm::dot(q0, q1)) / (r0 * r1), 1.0));
        return angle * angle / 8.0;
    }
    const double squared = glm::dot(along, along);
    const double nearest = squared > 0.0 ? std::clamp(-glm::dot(q0, along) / squared, 0.0, 1.0) : 0.0;
    const double shortest = glm::length(q0 + nearest * along) - error;
    if (!(shortest > 0.0)) {
        return kAnyRotation;
    }
    const double d = glm::length(q1 / r1 - q0 / r0), ratio = r1 / r0;
    const double e = error / shortest + d * std::abs(ratio - 1.0) / (4.0 * std::min(1.0, ratio)) + d * d / 4.0;
    return std::min(kAnyRotation, d * d / 4.0 + 2.0 * e + e * e);
}

/// Whether three numbers are one positive number, but for rounding.
bool isUniform(const glm::dvec3& scale) {
    const double least = std::min({scale.x, scale.y, scale.z}), most = std::max({scale.x, scale.y, scale.z});
    return least > 0.0 && most <= 1.0001 * least;
}

/// Whether the matrix is a rotation times a positive number.
bool isTurn(const glm::dmat3& matrix) {
    const glm::dmat3 squares = glm::transpose(matrix) * matrix;
    const double one = squares[0][0];
    double most = 0.0;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            most = std::max(most, std::abs(squares[c][r] - (c == r ? one : 0.0)));
        }
    }
    return one > 0.0 && most <= 2e-4 * one && glm::determinant(matrix) > 0.0;
}

glm::dmat3 rotationOf(const glm::dmat3& matrix) {
    return matrix / std::cbrt(glm::determinant(matrix));
}

} // namespace

double normOf(const glm::dmat3& matrix) {
    // The norm of the symmetric matrix of squares is not larger than any of its rows' sums.
    const glm::dmat3 squares = glm::transpose(matrix) * matrix;
    double most = 0.0;
    for (int c = 0; c < 3; ++c) {
        most = std::max(most, std::abs(squares[c][0]) + std::abs(squares[c][1]) + std::abs(squares[c][2]));
    }
    return std::sqrt(most);
}

ChordMatrix chordMatrix(const glm::dmat3& first, const glm::dmat3& last, double error) {
    return {{first, last}, error, std::max(normOf(first), normOf(last)), normOf(last - first)};
}

ChordMatrix operator*(const ChordMatrix& a, const ChordMatrix& b) {
    return chordMatrix(a.ends[0] * b.ends[0], a.ends[1] * b.ends[1],
                       a.change * b.change / 4.0 + a.size * b.error + a.error * b.size + a.error * b.error);
}

ChordVector operator*(const ChordMatrix& a, const ChordVector& x) {
    const double change = glm::length(x.ends[1] - x.ends[0]);
    const double size = std::max(glm::length(x.ends[0]), glm::length(x.ends[1]));
    return {{a.ends[0] * x.ends[0], a.ends[1] * x.ends[1]},
            a.change * change / 4.0 + a.size * x.error + a.error * size + a.error * x.error};
}

ChordVector operator+(const ChordVector& a, const ChordVector& b) {
    return {{a.ends[0] + b.ends[0], a.ends[1] + b.ends[1]}, a.error + b.error};
}

ChordPoser::ChordPoser(const cage::Character& character, const cage::Clip* clip)
    : character_(character), clip_(clip), turns_(character.skeleton.nodes.size()),
      errors_(character.skeleton.nodes.size()) {
    for (size_t n = 0; n < turns_.size(); ++n) {
        const cage::Node& node = character.skeleton.nodes[n];
        turns_[n] = node.hasMatrix ? isTurn(glm::dmat3(node.matrix)) : isUniform(glm::dvec3(node.scale));
    }
    const std::span<const Channel> channels = clip != nullptr ? std::span(clip->channels) : std::span<const Channel>();
    for (const Channel& channel : channels) {
        if (channel.path != ChannelPath::scale) {
            continue;
        }
        bool uniform = channel.interpolation != Interpolation::cubicSpline; // which may pass through 0
        for (size_t v = 0; v < channel.values.size(); v += 3) {
            uniform = uniform && isUniform({channel.values[v], channel.values[v + 1], channel.values[v + 2]});
        }
        turns_[channel.node] = uniform;
    }
}

void ChordPoser::findErrors(double first, double last, ChordPose& pose) {
    std::fill(errors_.begin(), errors_.end(), NodeErrors{});
    pose.weightErrors.assign(character_.morphs.targets.size(), 0.0);
    if (clip_ == nullptr) {
        return;
    }
    for (const Channel& channel : clip_->channels) {
        const SplineError spline(channel, first, last);
        NodeErrors& errors = errors_[channel.node];
        switch (channel.path) {
        case ChannelPath::translation:
            errors.translation = spline.of(0, 3);
            break;
        case ChannelPath::scale:
            errors.scale = spline.of(0, 3);
            break;
        case ChannelPath::rotation:
            errors.rotation =
                rotationError(ends_[0].locals[channel.node].rotation, ends_[1].locals[channel.node].rotation,
                              channel.interpolation == Interpolation::cubicSpline, spline.of(0, 4));
            break;
        case ChannelPath::weights:
            for (size_t t = 0; t < channel.width(); ++t) {
                pose.weightErrors[channel.firstTarget + t] = spline.of(t, 1);
            }
            break;
        }
    }
}

ChordNode ChordPoser::local(uint32_t n) const {
    const cage::Node& node = character_.skeleton.nodes[n];
    ChordNode result;
    result.turns = turns_[n];
    if (node.hasMatrix) {
        const glm::dmat4 matrix(node.matrix);
        result.linear = chordMatrix(glm::dmat3(matrix), glm::dmat3(matrix), 0.0);
        result.translation = {{glm::dvec3(matrix[3]), glm::dvec3(matrix[3])}, 0.0};
        if (result.turns) {
            result.rotation = chordMatrix(rotationOf(glm::dmat3(matrix)), rotationOf(glm::dmat3(matrix)), 0.0);
        }
        return result;
    }
    glm::dmat3 turns[2], scales[2];
    for (int end = 0; end < 2; ++end) {
        Transform transform = ends_[end].locals[n];
        result.translation.ends[end] = transform.translation;
        const glm::dvec3 s = transform.scale;
        scales[end] = glm::dmat3(s.x, 0, 0, 0, s.y, 0, 0, 0, s.z);
        transform.scale = glm::dvec3(1.0);
        turns[end] = glm::dmat3(localMatrix(node, transform));
    }
    result.translation.error = errors_[n].translation;
    result.rotation = chordMatrix(turns[0], turns[1], errors_[n].rotation);
    result.linear = result.rotation * chordMatrix(scales[0], scales[1], errors_[n].scale);
    return result;
}

void ChordPoser::pose(double first, double last, ChordPose& pose) {
    for (int end = 0; end < 2; ++end) {
        if (clip_ == nullptr) {
            restPose(character_, ends_[end]);
        } else {
            // A step that `last` begins belongs to what comes behind it.
            sampleClip(character_, *clip_, end == 0 ? first : std::nextafter(last, first), ends_[end]);
        }
        pose.weights[end] = ends_[end].morphWeights;
    }
    findErrors(first, last, pose);
    pose.nodes.resize(errors_.size());
    for (const uint32_t n : character_.skeleton.parentsFirst) {
        const uint32_t parent = character_.skeleton.nodes[n].parent;
        ChordNode& node = pose.nodes[n];
        node = local(n);
        if (parent != cage::kNone) {
            const ChordNode& above = pose.nodes[parent];
            node.translation = above.linear * node.translation + above.translation;
            node.linear = above.linear * node.linear;
            node.turns = node.turns && above.turns;
            node.rotation = node.turns ? above.rotation * node.rotation : ChordMatrix{};
        }
    }
}

} // namespace supple::skinning
