// Order statistics of measured times.
#pragma once

#include <span>

namespace supple::tools {

struct Summary {
    double median = 0.0;
    double p95 = 0.0;
    double max = 0.0;
    double min = 0.0, p05 = 0.0, p25 = 0.0, p75 = 0.0;
};

/// The q-quantile (0 <= q <= 1) of ascending values by linear interpolation between the two nearest ranks, so that
/// q = 0.5 of an even count is the mean of the middle two; 0 for no values.
[[nodiscard]] double quantile(std::span<const double> ascending, double q);

/// Of values in any order; all zero for none.
[[nodiscard]] Summary summarize(std::span<const double> values);

} // namespace supple::tools
