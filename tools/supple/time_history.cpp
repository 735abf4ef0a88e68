#include "tools/supple/time_history.h"

#include <algorithm>
#include <numeric>

namespace supple::tools {

namespace {

constexpr float kShare = 0.1f; ///< of the newest frame in a mean

} // namespace

void TimeHistory::add(uint64_t frame, const std::vector<std::pair<std::string, double>>& times) {
    if (frame == last_) {
        return;
    }
    last_ = frame;
    std::vector<float> row(names_.size(), 0.0f);
    const size_t before = names_.size();
    for (const auto& [name, time] : times) {
        const auto known = std::find(names_.begin(), names_.end(), name);
        const auto index = static_cast<size_t>(known - names_.begin());
        if (known == names_.end()) {
            names_.push_back(name);
            row.push_back(0.0f);
        }
        row[index] += static_cast<float>(time);
    }
    means_.resize(names_.size());
    for (size_t i = 0; i < means_.size(); ++i) {
        means_[i] = i < before ? means_[i] + kShare * (row[i] - means_[i]) : row[i];
    }
    if (rows_.size() == kFrames) {
        rows_.erase(rows_.begin());
    }
    rows_.push_back(std::move(row));
}

void TimeHistory::clear() {
    names_.clear();
    means_.clear();
    rows_.clear();
}

float TimeHistory::most() const {
    float most = 0.0f;
    for (const std::vector<float>& row : rows_) {
        most = std::max(most, std::accumulate(row.begin(), row.end(), 0.0f));
    }
    return most;
}

} // namespace supple::tools
