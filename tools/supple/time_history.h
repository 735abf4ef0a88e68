// What the passes of the last frames took, for the viewer's graph.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace supple::tools {

class TimeHistory {
public:
    static constexpr size_t kFrames = 150;

    /// Milliseconds by name: passes, or parts. Those of one name are added up. The same frame again adds nothing.
    void add(uint64_t frame, const std::vector<std::pair<std::string, double>>& times);
    void clear();

    /// In the order in which they came first.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    /// Of each of them: a mean over the last frames, in which the newest count most.
    [[nodiscard]] const std::vector<float>& means() const { return means_; }
    [[nodiscard]] size_t frames() const { return rows_.size(); }
    /// The times of a frame by name. Frame 0 is the oldest. Names that came first in a later frame are missing.
    [[nodiscard]] const std::vector<float>& row(size_t frame) const { return rows_[frame]; }
    /// The largest sum of a frame.
    [[nodiscard]] float most() const;

private:
    uint64_t last_ = 0;
    std::vector<std::string> names_;
    std::vector<float> means_;
    std::vector<std::vector<float>> rows_;
};

} // namespace supple::tools
