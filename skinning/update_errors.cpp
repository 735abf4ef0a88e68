#include "skinning/update_errors.h"

#include "shaders/shared/pose.h"
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

double farthestApart(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    double most = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 d = a[i] - b[i];
        most = std::max(most, glm::dot(d, d));
    }
    return std::sqrt(most);
}

/// Vertices that are skinned linearly by matrices that go straight go straight themselves: so errors are those of the
/// points between two frames.
class UpdateMeasurement {
public:
    explicit UpdateMeasurement(const cage::Character& character)
        : character_(character), distance_(character), globals_(character.skeleton.nodes.size()) {}

    UpdateFacts take() {
        UpdateFacts facts;
        facts.extent = distance_.extent();
        for (const cage::Clip& clip : character_.clips) {
            facts.ofClips.push_back(of(clip));
        }
        return facts;
    }

private:
    /// A ring of points, by the number of the frame.
    static constexpr size_t kFrames = kLongestInterval + 1;
    std::vector<glm::dvec3>& frame(size_t number) { return frames_[number % kFrames]; }

    void place(const cage::Clip& clip, double time, std::vector<glm::dvec3>& points) {
        sampleClip(character_, clip, time, pose_);
        distance_.globalsOf(pose_, globals_);
        distance_.place(globals_, points);
    }

    UpdateErrors of(const cage::Clip& clip) {
        UpdateErrors errors;
        const double duration = clip.duration;
        const auto steps =
            duration <= kLongestMeasured ? static_cast<size_t>(std::ceil(duration / kUpdateSeconds)) : kMostMeasured;
        const size_t samples = (steps + kLongestInterval + 3) * globals_.size();
        if (!(distance_.extent() > 0.0) || samples > samplesLeft_) {
            return errors;
        }
        samplesLeft_ -= samples;
        place(clip, 0.0, frame(0));
        place(clip, duration, frame(1));
        errors.closes = farthestApart(frame(0), frame(1)) <= kClosedGap * distance_.extent();
        errors.every = {};
        for (size_t i = 0; i <= steps + kLongestInterval; ++i) {
            const double time = static_cast<double>(i) * kUpdateSeconds;
            const double within =
                errors.closes && duration > 0.0 ? std::fmod(time, duration) : std::min(time, duration);
            place(clip, within, frame(i));
            for (size_t n = 0; n < errors.every.size(); ++n) {
                const size_t every = size_t{2} << n;
                // Intervals begin wherever an instance's slot and the clip's start put them.
                if (i >= every && i % (every / 2) == 0) {
                    errors.every[n] = std::max(errors.every[n], errorOf(i - every, every));
                }
            }
        }
        for (double& error : errors.every) {
            error /= distance_.extent();
        }
        return errors;
    }

    /// Of the interval that begins with a frame.
    double errorOf(size_t first, size_t every) {
        const std::vector<glm::dvec3>&a = frame(first), &b = frame(first + every);
        double most = 0.0;
        for (size_t k = 1; k < every; ++k) {
            const double part = static_cast<double>(k) / static_cast<double>(every);
            const std::vector<glm::dvec3>& exact = frame(first + k);
            for (size_t i = 0; i < a.size(); ++i) {
                const glm::dvec3 off = a[i] + (b[i] - a[i]) * part - exact[i];
                most = std::max(most, glm::dot(off, off));
            }
        }
        return std::sqrt(most);
    }

    const cage::Character& character_;
    PoseDistance distance_;
    Pose pose_;
    std::vector<glm::dmat4> globals_;
    std::array<std::vector<glm::dvec3>, kFrames> frames_;
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

UpdateFacts measureUpdates(const cage::Character& character) {
    return UpdateMeasurement(character).take();
}

} // namespace supple::skinning
