#include "cage/clip_checks.h"

#include "cage/limits.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supple::cage {
namespace {

/// Keys are floats, and the times of markers need not be: what rounding alone moves out of the clip is in it.
constexpr double kTimeRounding = 1e-6;

double lengthOf(const float* q) {
    return std::sqrt(static_cast<double>(q[0]) * q[0] + static_cast<double>(q[1]) * q[1] +
                     static_cast<double>(q[2]) * q[2] + static_cast<double>(q[3]) * q[3]);
}

/// Key rotations are unit quaternions but for rounding, which 8-bit outputs make coarse. Tangents are left alone.
void checkRotations(Channel& channel, const std::string& output) {
    const size_t perKey = channel.interpolation == Interpolation::cubicSpline ? 3 : 1;
    for (size_t k = perKey / 2; 4 * k < channel.values.size(); k += perKey) {
        float* q = &channel.values[4 * k];
        const double length = lengthOf(q);
        if (isZeroRotation(q)) {
            refuse(item(output, k), "zero quaternion");
        }
        if (std::abs(length - 1.0) > 1e-5 && channel.interpolation != Interpolation::cubicSpline) {
            for (int c = 0; c < 4; ++c) {
                q[c] = static_cast<float>(q[c] / length);
            }
        }
    }
}

/// The time `first` becomes 0.
void moveKeys(Channel& channel, float first) {
    for (size_t k = 0; k < channel.times.size(); ++k) {
        float& time = channel.times[k];
        time = static_cast<float>(static_cast<double>(time) - static_cast<double>(first));
        if (k > 0 && !(time > channel.times[k - 1])) { // rounded together
            time = std::nextafter(channel.times[k - 1], std::numeric_limits<float>::infinity());
        }
    }
}

} // namespace

bool isZeroRotation(const float* q) {
    return !(lengthOf(q) > 1e-6);
}

void checkTimes(const Channel& channel, const std::string& times) {
    for (size_t k = 0; k < channel.times.size(); ++k) {
        if (!std::isfinite(channel.times[k])) {
            refuse(item(times, k), "not finite");
        }
        if (k > 0 && !(channel.times[k] > channel.times[k - 1])) {
            refuse(item(times, k), "not later than the key before it");
        }
    }
    checkKeyCount(channel, times);
}

void checkKeyCount(const Channel& channel, const std::string& times) {
    if (channel.interpolation == Interpolation::cubicSpline && channel.times.size() < 2) {
        refuse(times, "CUBICSPLINE needs at least two keys");
    }
}

void checkValues(Channel& channel, size_t elementWidth, const std::string& values) {
    for (size_t k = 0; k < channel.values.size(); ++k) {
        if (const char* fault = faultOfCoordinate(channel.values[k])) {
            refuse(item(values, k / elementWidth), fault);
        }
    }
    if (channel.path == ChannelPath::rotation) {
        checkRotations(channel, values);
    }
}

float beginAtFirstKey(Clip& clip, const std::string& element, Warnings& warnings) {
    float first = 0.0f;
    for (const Channel& channel : clip.channels) {
        first = std::min(first, channel.times.front());
    }
    for (const SharpnessCurve& curve : clip.sharpness) {
        first = std::min(first, curve.keys.times.front());
    }
    if (first == 0.0f) {
        return first;
    }
    warn(warnings, element, "keys before 0; its time begins at its first key, " + shortNumber(first) + " s");
    for (Channel& channel : clip.channels) {
        moveKeys(channel, first);
    }
    for (SharpnessCurve& curve : clip.sharpness) {
        moveKeys(curve.keys, first);
    }
    return first;
}

double lastKey(const Clip& clip) {
    double last = 0.0;
    for (const Channel& channel : clip.channels) {
        last = std::max(last, static_cast<double>(channel.times.back()));
    }
    for (const SharpnessCurve& curve : clip.sharpness) {
        last = std::max(last, static_cast<double>(curve.keys.times.back()));
    }
    return last;
}

std::optional<std::string> placeMarker(double given, double first, double duration, Marker& marker) {
    const double slack = kTimeRounding * std::max({std::abs(given), std::abs(first), duration});
    if (given - first < -slack) {
        return "time " + shortNumber(given) + " is before the clip's beginning";
    }
    if (given - first > duration + slack) {
        return "time " + shortNumber(given) + " is behind the clip's end, " + shortNumber(first + duration) + " s";
    }
    marker.time = std::clamp(given - first, 0.0, duration);
    return std::nullopt;
}

void sortMarkers(std::vector<Marker>& markers) {
    std::stable_sort(markers.begin(), markers.end(), [](const Marker& a, const Marker& b) { return a.time < b.time; });
}

} // namespace supple::cage
