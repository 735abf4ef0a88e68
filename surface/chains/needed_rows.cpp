#include "surface/chains/needed_rows.h"

#include <algorithm>

namespace supple::surface::chains {

using cage::kNone;

NeededRows::NeededRows(uint32_t all, uint32_t farthest) : numbers_(all, kNone), farthest_(farthest) {}

void NeededRows::add(uint32_t row) {
    numbers_[row] = count();
    rows_.push_back(row);
}

void NeededRows::addAlone(uint32_t row) {
    alone_.push_back(count());
    add(row);
}

void NeededRows::group(const RowGroups& groups) {
    groups_ = &groups;
    groupFirsts_.assign(groups.starts.size() - 1, kNone);
}

void NeededRows::need(uint32_t row) {
    if (numbers_[row] != kNone) {
        return;
    }
    const uint32_t group = groups_ == nullptr ? kNone : groups_->groupOf[row];
    if (group == kNone) {
        addAlone(row);
        return;
    }
    groupFirsts_[group] = count();
    for (uint32_t i = groups_->starts[group]; i < groups_->starts[group + 1]; ++i) {
        add(groups_->rows[i]);
    }
}

uint32_t NeededRows::firstOf(uint32_t number) const {
    const auto known = firsts_.find(number);
    return known == firsts_.end() ? number : known->second;
}

template <class NumberOf>
bool NeededRows::areNear(std::span<const uint32_t> net, const NumberOf& numberOf) const {
    const auto byNumber = [&](uint32_t a, uint32_t b) { return numberOf(a) < numberOf(b); };
    const auto [least, most] = std::minmax_element(net.begin(), net.end(), byNumber);
    return net.empty() || numberOf(*most) - numberOf(*least) <= farthest_;
}

void NeededRows::needNet(std::span<uint32_t> net) {
    for (const uint32_t row : net) {
        need(row);
    }
    const auto last = [&](uint32_t row) { return numbers_[row]; };
    const auto first = [&](uint32_t row) { return firstOf(numbers_[row]); };
    if (areNear(net, last)) {
        std::transform(net.begin(), net.end(), net.begin(), last);
    } else if (areNear(net, first)) { // its neighbours were numbered again, but it needs not be
        std::transform(net.begin(), net.end(), net.begin(), first);
    } else {
        numberAgain(net);
    }
}

/// Rows among the last numbers, half as many as may lie between them, keep theirs. The others get new ones, which are
/// as many at most.
void NeededRows::numberAgain(std::span<uint32_t> net) {
    const uint32_t kept = count() - std::min(count(), (farthest_ + 1) / 2);
    for (uint32_t& row : net) {
        if (numbers_[row] < kept) {
            const uint32_t first = firstOf(numbers_[row]);
            addAlone(row);
            firsts_.emplace(numbers_[row], first);
        }
        row = numbers_[row];
    }
}

std::vector<uint32_t> NeededRows::repeated() const {
    std::vector<uint32_t> rows;
    for (const auto& [number, first] : firsts_) {
        rows.push_back(rows_[number]);
    }
    return rows;
}

std::vector<uint32_t> patchesByNeighbours(const std::vector<DraftPatch>& patches, const cage::Cage& cage,
                                          const cage::Topology& topology) {
    std::vector<uint32_t> patchOf(cage.faceCount(), kNone), faces, order;
    for (uint32_t p = 0; p < patches.size(); ++p) {
        patchOf[patches[p].facet] = p;
    }
    std::vector<uint8_t> isSeen(cage.faceCount(), 0);
    const auto see = [&](uint32_t face) {
        if (isSeen[face] == 0) {
            isSeen[face] = 1;
            faces.push_back(face);
        }
    };
    // In breadth: the faces that lie side by side are never further apart than the front is long.
    for (uint32_t seed = 0, next = 0; seed < cage.faceCount(); ++seed) {
        see(seed);
        for (; next < faces.size(); ++next) {
            const uint32_t face = faces[next];
            for (uint32_t c = cage.faceStarts[face]; c < cage.faceStarts[face + 1]; ++c) {
                if (topology.twins[c] != kNone) {
                    see(topology.cornerFaces[topology.twins[c]]);
                }
            }
        }
    }
    for (const uint32_t face : faces) {
        if (patchOf[face] != kNone) {
            order.push_back(patchOf[face]);
        }
    }
    return order;
}

} // namespace supple::surface::chains
