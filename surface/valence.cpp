#include "surface/valence.h"

#include <cmath>
#include <numbers>

namespace supple::surface {

std::pair<double, double> turn(uint32_t k, uint32_t n) {
    k %= n;
    if (4 * k % n == 0) {
        constexpr std::pair<double, double> kQuarters[4] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
        return kQuarters[4 * k / n];
    }
    const double angle = 2.0 * std::numbers::pi * k / n;
    return {std::cos(angle), std::sin(angle)};
}

double subdominant(uint32_t valence) {
    const double c = turn(1, valence).first;
    return (c + 5.0 + std::sqrt((c + 9.0) * (c + 1.0))) / 16.0;
}

} // namespace supple::surface
