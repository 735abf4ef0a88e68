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

double cosineOfHalfTurns(uint32_t k, uint32_t n) {
    k %= 2 * n;
    if (k > n) {
        k = 2 * n - k;
    }
    if (2 * k > n) {
        return -cosineOfHalfTurns(n - k, n);
    }
    return k == 0 ? 1.0 : 2 * k == n ? 0.0 : 3 * k == n ? 0.5 : std::cos(std::numbers::pi * k / n);
}

double sineOfHalfTurns(uint32_t k, uint32_t n) {
    k %= 2 * n;
    if (k > n) {
        return -sineOfHalfTurns(2 * n - k, n);
    }
    if (2 * k > n) {
        k = n - k;
    }
    return k == 0 ? 0.0 : 2 * k == n ? 1.0 : 6 * k == n ? 0.5 : std::sin(std::numbers::pi * k / n);
}

double subdominant(uint32_t valence) {
    const double c = turn(1, valence).first;
    return (c + 5.0 + std::sqrt((c + 9.0) * (c + 1.0))) / 16.0;
}

} // namespace supple::surface
