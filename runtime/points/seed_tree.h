// Where searches for nearest points begin.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace supple::runtime {

/// Takes the nearest of many points, by a tree that halves them along the longest side of their box.
class SeedTree {
public:
    static constexpr size_t kNearest = 8;
    struct Seed {
        glm::dvec3 position{0.0};
        uint32_t piece = 0;
        double a = 0.0, b = 0.0;
    };
    explicit SeedTree(std::vector<Seed> seeds) : seeds_(std::move(seeds)), axes_(seeds_.size(), 0) {
        split(0, seeds_.size());
    }

    /// The kNearest nearest, in rising order of their distance.
    [[nodiscard]] std::vector<Seed> nearest(const glm::dvec3& to) const {
        std::vector<std::pair<double, size_t>> best;
        search(0, seeds_.size(), to, best);
        std::vector<Seed> found;
        for (const auto& [distance, seed] : best) {
            found.push_back(seeds_[seed]);
        }
        return found;
    }

private:
    void split(size_t begin, size_t end) {
        if (end - begin < 2) {
            return;
        }
        glm::dvec3 low = seeds_[begin].position, high = low;
        for (size_t k = begin; k < end; ++k) {
            low = glm::min(low, seeds_[k].position);
            high = glm::max(high, seeds_[k].position);
        }
        const glm::dvec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const size_t middle = (begin + end) / 2;
        const auto at = [&](size_t k) { return seeds_.begin() + static_cast<ptrdiff_t>(k); };
        std::nth_element(at(begin), at(middle), at(end),
                         [&](const Seed& x, const Seed& y) { return x.position[axis] < y.position[axis]; });
        axes_[middle] = static_cast<uint8_t>(axis);
        split(begin, middle);
        split(middle + 1, end);
    }
    void search(size_t begin, size_t end, const glm::dvec3& to, std::vector<std::pair<double, size_t>>& best) const {
        if (begin == end) {
            return;
        }
        const size_t middle = (begin + end) / 2;
        const glm::dvec3 offset = seeds_[middle].position - to;
        const std::pair<double, size_t> own(glm::dot(offset, offset), middle);
        best.insert(std::upper_bound(best.begin(), best.end(), own), own);
        best.resize(std::min(best.size(), kNearest));
        const double apart = offset[axes_[middle]]; // negative: the point lies behind the plane
        const auto visit = [&](bool below) {
            below ? search(begin, middle, to, best) : search(middle + 1, end, to, best);
        };
        visit(apart > 0.0);
        if (best.size() < kNearest || apart * apart < best.back().first) {
            visit(apart <= 0.0);
        }
    }

    std::vector<Seed> seeds_;
    std::vector<uint8_t> axes_; ///< of the seed in the middle of a range
};

} // namespace supple::runtime
