// Steps, mixtures and colors, for models and pictures alike.
#pragma once

#include "modeller.h"

#include <algorithm>
#include <cmath>

namespace supple::creature {

// A smooth step from 0 at `from` to 1 at `to`.
inline double ramp(double from, double to, double value) {
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

inline double mix(double a, double b, double t) {
    return a + (b - a) * t;
}

inline Vec3 mix(const Vec3& a, const Vec3& b, double t) {
    return a + (b - a) * t;
}

// The linear color of sRGB's 0xRRGGBB.
inline Vec3 srgb(unsigned hex) {
    Vec3 color;
    for (int i = 0; i < 3; ++i) {
        const double c = static_cast<double>((hex >> (16 - 8 * i)) & 0xff) / 255.0;
        color[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    return color;
}

} // namespace supple::creature
