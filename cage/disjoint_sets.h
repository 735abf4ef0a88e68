// Sets that only ever join: union-find.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace supple::cage {

/// Sets of the numbers below `count`, each known by its smallest member.
class DisjointSets {
public:
    explicit DisjointSets(size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

    uint32_t find(uint32_t member) {
        while (parents_[member] != member) {
            parents_[member] = parents_[parents_[member]];
            member = parents_[member];
        }
        return member;
    }
    /// False if they are one set already.
    bool unite(uint32_t a, uint32_t b) {
        a = find(a);
        b = find(b);
        if (a == b) {
            return false;
        }
        parents_[std::max(a, b)] = std::min(a, b);
        return true;
    }

private:
    std::vector<uint32_t> parents_;
};

} // namespace supple::cage
