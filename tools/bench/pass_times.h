// What the passes of a frame take, by Supple's own timestamps.
#pragma once

#include <supple/supple.h>

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace supple::bench {

/// The passes of a frame in the order in which they came, and milliseconds.
struct PassTimes {
    std::vector<std::pair<std::string, double>> passes; ///< those of all groups together
    double whole = 0.0;                                 ///< from the beginning of the first to the end of the last

    PassTimes() = default;
    explicit PassTimes(std::span<const SuppleTiming> timings);
    /// 0: there was no such pass.
    [[nodiscard]] double of(const std::string& pass) const;
};

[[nodiscard]] double medianOf(const std::vector<PassTimes>& frames,
                              const std::function<double(const PassTimes&)>& value);

} // namespace supple::bench
