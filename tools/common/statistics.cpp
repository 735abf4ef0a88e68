#include "tools/common/statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace supple::tools {

double quantile(std::span<const double> ascending, double q) {
    if (ascending.empty()) {
        return 0.0;
    }
    const double rank = std::clamp(q, 0.0, 1.0) * static_cast<double>(ascending.size() - 1);
    const auto below = static_cast<size_t>(rank);
    const size_t above = std::min(below + 1, ascending.size() - 1);
    return std::lerp(ascending[below], ascending[above], rank - static_cast<double>(below));
}

Summary summarize(std::span<const double> values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    return {quantile(sorted, 0.5),  quantile(sorted, 0.95), quantile(sorted, 1.0), quantile(sorted, 0.0),
            quantile(sorted, 0.05), quantile(sorted, 0.25), quantile(sorted, 0.75)};
}

} // namespace supple::tools
