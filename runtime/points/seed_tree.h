// Where searches for nearest points begin.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace supple::runtime {

/// Takes the nearest of many points, by a tree that halves them along the longest side of their box.
class SeedTree {
public:
    static constexpr size_t kNearest = 8;
    /// The middle of a cell of the surface. The cell lies within `bend` of a disk: that of radius `reach` round the
    /// middle, in its tangent plane.
    struct Seed {
        glm::dvec3 position{0.0};
        uint32_t domain = 0;
        double a = 0.0, b = 0.0;
        glm::vec3 normal{0.0f}; ///< of unit length, or zero where there is none
        float reach = 0.0f, bend = 0.0f;

        /// No point of the cell is nearer than that.
        [[nodiscard]] double leastDistance(const glm::dvec3& to) const {
            const glm::dvec3 e = to - position;
            const double above = glm::dot(e, glm::dvec3(normal));
            const double beside = std::sqrt(std::max(glm::dot(e, e) - above * above, 0.0));
            const double reached = normal == glm::vec3(0.0f) ? beside : std::max(beside - reach, 0.0);
            return std::max(std::sqrt(above * above + reached * reached) - bend, 0.0);
        }
    };
    explicit SeedTree(std::vector<Seed> seeds)
        : seeds_(std::move(seeds)), axes_(seeds_.size(), 0), sizes_(seeds_.size(), 0.0f) {
        split(0, seeds_.size());
    }

    [[nodiscard]] const Seed& operator[](size_t seed) const { return seeds_[seed]; }
    /// The kNearest nearest, in rising order of their distance: its square, and the seed.
    [[nodiscard]] std::vector<std::pair<double, size_t>> nearest(const glm::dvec3& to) const {
        std::vector<std::pair<double, size_t>> best;
        search(0, seeds_.size(), to, best);
        return best;
    }
    /// Those whose cells may have a point nearer than `distance`: how near, and the seed. The first ones in rising
    /// order.
    [[nodiscard]] std::vector<std::pair<double, size_t>> mayBeNearer(const glm::dvec3& to, double distance,
                                                                     size_t most) const {
        std::vector<std::pair<double, size_t>> found;
        addNearer(0, seeds_.size(), to, distance, found);
        const size_t count = std::min(most, found.size());
        std::partial_sort(found.begin(), found.begin() + static_cast<ptrdiff_t>(count), found.end());
        found.resize(count);
        return found;
    }

private:
    /// Returns how far a cell of the range reaches from its middle at most.
    float split(size_t begin, size_t end) {
        if (begin == end) {
            return 0.0f;
        }
        if (end - begin == 1) {
            return sizes_[begin] = seeds_[begin].reach + seeds_[begin].bend;
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
        const float own = seeds_[middle].reach + seeds_[middle].bend;
        return sizes_[middle] = std::max({own, split(begin, middle), split(middle + 1, end)});
    }
    void addNearer(size_t begin, size_t end, const glm::dvec3& to, double distance,
                   std::vector<std::pair<double, size_t>>& found) const {
        if (begin == end) {
            return;
        }
        const size_t middle = (begin + end) / 2;
        const Seed& own = seeds_[middle];
        if (const double least = own.leastDistance(to); least < distance) {
            found.emplace_back(least, middle);
        }
        const double apart = own.position[axes_[middle]] - to[axes_[middle]], reached = distance + sizes_[middle];
        if (apart > -reached) {
            addNearer(begin, middle, to, distance, found);
        }
        if (apart < reached) {
            addNearer(middle + 1, end, to, distance, found);
        }
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
    std::vector<float> sizes_;  ///< likewise: how far any cell of the range reaches from its middle
};

} // namespace supple::runtime
