#include "skinning/update_errors.h"

#include "shaders/shared/pose.h"
#include "skinning/driven_weights.h"
#include "skinning/pose.h"
#include "skinning/pose_distance.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace supple::skinning {
namespace {

constexpr double kUpdateSeconds = 1.0 / shared::kUpdateSteps;
constexpr double kLongestMeasured = 300.0; // seconds
constexpr size_t kMostMeasured = 2'000'000;
/// A gap of less between the end of a clip and its beginning is none: a tenth of a pixel at a hundred of them.
constexpr double kClosedGap = 1e-3;
constexpr size_t kLongestInterval = shared::kMaxUpdateInterval;

constexpr uint32_t kAllAxes = kRootGround | kRootHeight | kRootYaw;

/// Vertices that are skinned linearly by matrices that go straight go straight themselves, and so do morph weights: so
/// errors are those of what lies between two frames.
class UpdateMeasurement {
public:
    UpdateMeasurement(const cage::Character& character, const DriverTable& drivers)
        : character_(character), root_(findRoot(character)), distance_(character), driven_(drivers),
          globals_(character.skeleton.nodes.size()) {}

    UpdateFacts take() {
        UpdateFacts facts;
        facts.extent = distance_.extent();
        facts.root = root_;
        for (const cage::Clip& clip : character_.clips) {
            facts.ofClips.push_back(of(clip));
        }
        return facts;
    }

private:
    struct Frame {
        std::vector<glm::dvec3> points;
        std::vector<double> weights;
    };
    /// A ring, by the number of the frame.
    static constexpr size_t kFrames = kLongestInterval + 1;
    Frame& frame(size_t number) { return frames_[number % kFrames]; }

    /// With these axes of the root's movement taken out.
    void place(const cage::Clip& clip, double time, uint32_t axes, Frame& frame) {
        sampleClip(character_, clip, time, pose_);
        if (axes != 0) {
            removeRootMotion(character_, clip, {root_, axes}, pose_);
        }
        distance_.globalsOf(pose_, globals_);
        distance_.place(globals_, frame.points);
        frame.weights = pose_.morphWeights;
        driven_.addTo(pose_, frame.weights);
    }

    /// Of what lies `part` of the way from one frame to another, from a third.
    double distanceOf(const Frame& a, const Frame& b, double part, const Frame& exact) const {
        double squares = 0.0, morphed = 0.0;
        for (size_t i = 0; i < a.points.size(); ++i) {
            const glm::dvec3 off = a.points[i] + (b.points[i] - a.points[i]) * part - exact.points[i];
            squares = std::max(squares, glm::dot(off, off));
        }
        for (size_t t = 0; t < a.weights.size(); ++t) {
            const double off = a.weights[t] + (b.weights[t] - a.weights[t]) * part - exact.weights[t];
            morphed += std::abs(off) * distance_.targetReaches()[t];
        }
        return std::sqrt(squares) + morphed;
    }

    void findWhetherItCloses(const cage::Clip& clip, UpdateErrors& errors) {
        const Frame& begin = frame(0);
        const Frame& end = frame(1);
        place(clip, 0.0, 0, frame(0));
        for (uint32_t axes = 0; axes <= (root_ != cage::kNone ? kAllAxes : 0); ++axes) {
            place(clip, clip.duration, axes, frame(1));
            const bool closes = distanceOf(begin, begin, 0.0, end) <= kClosedGap * distance_.extent();
            errors.closesWithout |= uint32_t{closes} << axes;
        }
        errors.closes = (errors.closesWithout & 1u) != 0;
    }

    UpdateErrors of(const cage::Clip& clip) {
        UpdateErrors errors;
        if (!(distance_.extent() > 0.0) || !(clip.duration <= kLongestMeasured)) {
            return errors;
        }
        UpdateErrors found;
        findWhetherItCloses(clip, found);
        const bool closesOut = !found.closes && (found.closesWithout >> kAllAxes & 1u) != 0;
        const auto steps = static_cast<size_t>(std::ceil(clip.duration / kUpdateSeconds));
        const size_t samples = (steps + kLongestInterval + 1) * (closesOut ? 2 : 1) * globals_.size();
        if (samples > samplesLeft_) {
            return errors;
        }
        samplesLeft_ -= samples;
        found.every = measured(clip, 0, found.closes);
        const std::array<double, 3> out = closesOut ? measured(clip, kAllAxes, true) : found.every;
        for (size_t n = 0; n < out.size(); ++n) {
            found.every[n] = std::max(found.every[n], out[n]) / distance_.extent();
        }
        return found;
    }

    std::array<double, 3> measured(const cage::Clip& clip, uint32_t axes, bool loops) {
        const double duration = clip.duration, steps = duration / kUpdateSeconds;
        const size_t last = loops ? static_cast<size_t>(std::ceil(steps)) + kLongestInterval
                                  : static_cast<size_t>(std::floor(steps + 1e-3));
        std::array<double, 3> errors{};
        for (size_t i = 0; i <= last; ++i) {
            const double time = static_cast<double>(i) * kUpdateSeconds;
            place(clip, loops && duration > 0.0 ? std::fmod(time, duration) : std::min(time, duration), axes, frame(i));
            for (size_t n = 0; n < errors.size(); ++n) {
                const size_t every = size_t{2} << n;
                // Intervals begin wherever an instance's slot and the clip's start put them.
                if (i >= every && (i % (every / 2) == 0 || i == last)) {
                    errors[n] = std::max(errors[n], errorOf(i - every, every));
                }
            }
        }
        for (size_t n = 0; n < errors.size(); ++n) {
            errors[n] = last >= size_t{2} << n ? errors[n] : UpdateErrors::kUnknown;
        }
        return errors;
    }

    /// Of the interval that begins with a frame.
    double errorOf(size_t first, size_t every) {
        double most = 0.0;
        for (size_t k = 1; k < every; ++k) {
            const double part = static_cast<double>(k) / static_cast<double>(every);
            most = std::max(most, distanceOf(frame(first), frame(first + every), part, frame(first + k)));
        }
        return most;
    }

    const cage::Character& character_;
    uint32_t root_ = cage::kNone;
    PoseDistance distance_;
    DrivenWeights driven_;
    Pose pose_;
    std::vector<glm::dmat4> globals_;
    std::array<Frame, kFrames> frames_;
    size_t samplesLeft_ = kMostMeasured;
};

} // namespace

double UpdateErrors::at(double steps) const {
    for (size_t n = 0; n < every.size(); ++n) {
        if (steps <= static_cast<double>(size_t{2} << n)) {
            return every[n];
        }
    }
    return kUnknown;
}

bool UpdateFacts::closes(uint32_t clip, const RootSelection& taken) const {
    const UpdateErrors& errors = ofClips[clip];
    return errors.closes || (taken.node == root && (errors.closesWithout >> taken.axes & 1u) != 0);
}

UpdateFacts measureUpdates(const cage::Character& character) {
    return measureUpdates(character, buildDriverTable(character));
}

UpdateFacts measureUpdates(const cage::Character& character, const DriverTable& drivers) {
    return UpdateMeasurement(character, drivers).take();
}

} // namespace supple::skinning
