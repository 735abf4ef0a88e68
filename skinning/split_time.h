// Seconds as two floats, the way the device keeps them (shaders/pose/time.glsl).
#pragma once

namespace supple::skinning {

/// high is the float nearest to the time, low the float nearest to the rest: 48 bits of it.
struct SplitTime {
    float high = 0.0f;
    float low = 0.0f;
};
[[nodiscard]] inline SplitTime splitTime(double seconds) {
    const auto high = static_cast<float>(seconds);
    return {high, static_cast<float>(seconds - static_cast<double>(high))};
}

[[nodiscard]] inline double joinedTime(float high, float low) {
    return static_cast<double>(high) + static_cast<double>(low);
}

} // namespace supple::skinning
