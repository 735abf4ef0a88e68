#include "skinning/clip_markers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace supple::skinning {
namespace {

/// Shorter loops have more passes within the times that are allowed than a double counts.
constexpr double kShortestLoop = 1e-6;

/// The passes of a clip in which a marker is met: first..last, whole numbers.
struct Passes {
    double first = 0.0, last = -1.0;
    [[nodiscard]] double count() const { return std::max(last - first + 1.0, 0.0); }
};

/// When markers occur. The same marker and pass always give the same bits, so that intervals that follow each other
/// have every occurrence once.
class Occurrences {
public:
    explicit Occurrences(double duration) : duration_(duration) {}
    /// The end of a pass has the bits of the start of the next.
    [[nodiscard]] double time(double pass, double marker) const {
        const double end = (pass + 1.0) * duration_;
        return marker == duration_ ? end : std::min(pass * duration_ + marker, end);
    }
    /// The last pass in which the marker is not later than `time`.
    [[nodiscard]] double lastUntil(double time, double marker) const {
        double pass = std::floor((time - marker) / duration_);
        while (this->time(pass, marker) > time) {
            pass -= 1.0;
        }
        while (this->time(pass + 1.0, marker) <= time) {
            pass += 1.0;
        }
        return pass;
    }
    /// The first pass in which the marker is not earlier than `time`.
    [[nodiscard]] double firstFrom(double time, double marker) const {
        const double pass = lastUntil(time, marker);
        return this->time(pass, marker) == time ? pass : pass + 1.0;
    }

private:
    double duration_;
};

Passes passesOnce(double marker, const MarkerInterval& interval) {
    const bool forwards = interval.to >= interval.from;
    const bool met = (forwards ? interval.from < marker && marker <= interval.to
                               : interval.to <= marker && marker < interval.from) ||
                     (interval.start && marker == interval.from);
    return met ? Passes{0.0, 0.0} : Passes{};
}

Passes passesOf(const cage::Clip& clip, double marker, const MarkerInterval& interval) {
    if (!interval.loop || clip.duration < kShortestLoop) {
        return passesOnce(marker, interval);
    }
    const Occurrences occurrences(clip.duration);
    Passes passes;
    if (interval.to >= interval.from) {
        const double before = occurrences.lastUntil(interval.from, marker);
        const bool atStart = interval.start && occurrences.time(before, marker) == interval.from &&
                             before >= occurrences.lastUntil(interval.from, 0.0);
        passes = {atStart ? before : before + 1.0, occurrences.lastUntil(interval.to, marker)};
    } else {
        const double behind = occurrences.firstFrom(interval.from, marker);
        const bool atStart = interval.start && occurrences.time(behind, marker) == interval.from &&
                             behind <= occurrences.firstFrom(interval.from, clip.duration);
        passes = {occurrences.firstFrom(interval.to, marker), atStart ? behind : behind - 1.0};
    }
    return passes;
}

} // namespace

uint64_t markersBetween(const cage::Clip& clip, const MarkerInterval& interval, std::span<PassedMarker> out) {
    const auto markers = static_cast<uint32_t>(clip.markers.size());
    std::vector<Passes> passes(markers);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Passes all{kInfinity, -kInfinity};
    double total = 0.0;
    for (uint32_t m = 0; m < markers; ++m) {
        passes[m] = passesOf(clip, clip.markers[m].time, interval);
        if (passes[m].count() > 0.0) {
            total += passes[m].count();
            all = {std::min(all.first, passes[m].first), std::max(all.last, passes[m].last)};
        }
    }
    const bool backwards = interval.to < interval.from;
    const Occurrences occurrences(clip.duration);
    size_t filled = 0;
    const size_t wanted = std::min(out.size(), static_cast<size_t>(total));
    for (double step = 0.0; filled < wanted; step += 1.0) {
        const double pass = backwards ? all.last - step : all.first + step;
        for (uint32_t i = 0; i < markers && filled < wanted; ++i) {
            const uint32_t m = backwards ? markers - 1 - i : i;
            if (pass >= passes[m].first && pass <= passes[m].last) {
                out[filled++] = {m, occurrences.time(pass, clip.markers[m].time)};
            }
        }
    }
    return static_cast<uint64_t>(total);
}

} // namespace supple::skinning
