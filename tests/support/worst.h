// The largest of what a test measures. Numbers that are not finite cannot hide in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <span>

namespace supple::test {

/// Keeps the largest value; a NaN counts as infinite, so that it cannot hide behind a comparison.
inline void raise(double& worst, double value) {
    worst = std::isnan(value) ? std::numeric_limits<double>::infinity() : std::max(worst, value);
}

/// The largest difference of two numbers in the same place. Other sizes fail; a NaN counts as infinite.
inline double farthestApart(std::span<const float> a, std::span<const float> b) {
    if (a.size() != b.size()) {
        ADD_FAILURE() << a.size() << " numbers beside " << b.size();
        return std::numeric_limits<double>::infinity();
    }
    double worst = 0.0;
    for (size_t k = 0; k < a.size(); ++k) {
        raise(worst, std::abs(static_cast<double>(a[k]) - static_cast<double>(b[k])));
    }
    return worst;
}

} // namespace supple::test
