#include "weights.h"

#include <algorithm>
#include <cmath>

namespace supple::creature {

Influences strongest(const std::vector<double>& weights) {
    // On a coarse grid first: equal weights of mirrored joints must not be ordered by their last bit.
    std::vector<std::pair<long, int>> order;
    for (size_t joint = 0; joint < weights.size(); ++joint) {
        const long grid = std::lround(weights[joint] * 1e5);
        if (grid > 200) {
            order.push_back({-grid, static_cast<int>(joint)});
        }
    }
    std::sort(order.begin(), order.end());
    order.resize(std::min<size_t>(order.size(), 4));
    long total = 0;
    for (const auto& [grid, joint] : order) {
        total -= grid;
    }
    // Shares of 65536 are exact in a float and sum to exactly one.
    Influences result;
    long left = 65536;
    for (size_t i = order.size(); i-- > 1;) {
        const long share = -order[i].first * 65536 / total;
        result.joints[i] = order[i].second;
        result.weights[i] = static_cast<float>(share) / 65536.0f;
        left -= share;
    }
    result.joints[0] = order[0].second;
    result.weights[0] = static_cast<float>(left) / 65536.0f;
    return result;
}

} // namespace supple::creature
