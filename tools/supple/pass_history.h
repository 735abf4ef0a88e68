// What the passes of the last frames took, for the viewer's graph.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace supple::tools {

class PassHistory {
public:
    static constexpr size_t kFrames = 150;

    /// Milliseconds by pass. The same frame again adds nothing.
    void add(uint64_t frame, const std::vector<std::pair<std::string, double>>& times);
    void clear();

    /// In the order in which they came first.
    [[nodiscard]] const std::vector<std::string>& passes() const { return passes_; }
    [[nodiscard]] size_t frames() const { return rows_.size(); }
    /// The times of a frame by pass. Frame 0 is the oldest. Passes that came first in a later frame are missing.
    [[nodiscard]] const std::vector<float>& row(size_t frame) const { return rows_[frame]; }
    /// The largest sum of a frame.
    [[nodiscard]] float most() const;

private:
    uint64_t last_ = 0;
    std::vector<std::string> passes_;
    std::vector<std::vector<float>> rows_;
};

} // namespace supple::tools
