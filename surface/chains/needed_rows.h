// Numbers of the points of level 1 that nets name. Private to chains/.
#pragma once

#include "cage/topology.h"
#include "surface/table_writer.h"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace supple::surface::chains {

/// Rows of which a kernel makes several at once, side by side: each stands in one group at most.
struct RowGroups {
    std::vector<uint32_t> groupOf;      ///< by row; cage::kNone: it is made alone
    std::vector<uint32_t> starts, rows; ///< the rows of group g are those from starts[g] to starts[g + 1]
};

/// Numbers rows of weights, in the order in which they are needed. The numbers of a net's rows differ by no more than
/// 16 bits hold (writeNetList()). A row that is needed in nets far from each other has several numbers, and its point
/// is there as often.
class NeededRows {
public:
    /// `farthest`: how far apart the numbers of a net may be. A net has at most half as many rows.
    explicit NeededRows(uint32_t all, uint32_t farthest = 0xFFFF);

    /// Before any row is needed. The rows of a group have numbers that follow each other: all of them count as needed
    /// when one is. The groups must outlive this.
    void group(const RowGroups& groups);

    void need(uint32_t row);
    /// Puts numbers in the place of a net's rows.
    void needNet(std::span<uint32_t> net);

    /// By number.
    [[nodiscard]] const std::vector<uint32_t>& rows() const { return rows_; }
    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(rows_.size()); }
    /// For a group whose rows are needed.
    [[nodiscard]] uint32_t firstOfGroup(uint32_t group) const { return groupFirsts_[group]; }
    /// The numbers that no group has, rising.
    [[nodiscard]] const std::vector<uint32_t>& alone() const { return alone_; }
    /// The rows that have several numbers; some are named several times.
    [[nodiscard]] std::vector<uint32_t> repeated() const;
    /// The last number of a row that is needed.
    [[nodiscard]] uint32_t number(uint32_t row) const { return numbers_[row]; }

private:
    void add(uint32_t row);
    void addAlone(uint32_t row);
    [[nodiscard]] uint32_t firstOf(uint32_t number) const;
    template <class NumberOf>
    [[nodiscard]] bool areNear(std::span<const uint32_t> net, const NumberOf& numberOf) const;
    void numberAgain(std::span<uint32_t> net);

    const RowGroups* groups_ = nullptr;
    std::vector<uint32_t> numbers_, rows_, alone_;
    std::vector<uint32_t> groupFirsts_;   ///< by group: the number of its first row
    std::map<uint32_t, uint32_t> firsts_; ///< by further number of a row: its first one
    uint32_t farthest_;
};

/// Indices of patches such that patches of neighbouring faces lie near each other, in whatever order the file has its
/// faces. Numbered in this order, hardly a row needs a second number.
[[nodiscard]] std::vector<uint32_t> patchesByNeighbours(const std::vector<DraftPatch>& patches, const cage::Cage& cage,
                                                        const cage::Topology& topology);

} // namespace supple::surface::chains
