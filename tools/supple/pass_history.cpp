#include "tools/supple/pass_history.h"

#include <algorithm>
#include <numeric>

namespace supple::tools {

void PassHistory::add(uint64_t frame, const std::vector<std::pair<std::string, double>>& times) {
    if (frame == last_) {
        return;
    }
    last_ = frame;
    std::vector<float> row(passes_.size(), 0.0f);
    for (const auto& [pass, time] : times) {
        const auto known = std::find(passes_.begin(), passes_.end(), pass);
        const auto index = static_cast<size_t>(known - passes_.begin());
        if (known == passes_.end()) {
            passes_.push_back(pass);
            row.push_back(0.0f);
        }
        row[index] += static_cast<float>(time);
    }
    if (rows_.size() == kFrames) {
        rows_.erase(rows_.begin());
    }
    rows_.push_back(std::move(row));
}

void PassHistory::clear() {
    passes_.clear();
    rows_.clear();
}

float PassHistory::most() const {
    float most = 0.0f;
    for (const std::vector<float>& row : rows_) {
        most = std::max(most, std::accumulate(row.begin(), row.end(), 0.0f));
    }
    return most;
}

} // namespace supple::tools
