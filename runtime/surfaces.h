// The surfaces of a group: one for each scheme that its parts have.
#pragma once

#include "runtime/tessellation/tessellation.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace supple::runtime {

class Surfaces {
public:
    /// `desc` as for a surface of all parts, with the group's own description. Refuses what a scheme cannot take.
    /// `before`: those of the group whose place this one takes. `leader`: those of the group that it follows, if
    /// coefficients may be shared. Null: none.
    [[nodiscard]] static Result<Surfaces> create(const TessellationDesc& desc, const Surfaces* before,
                                                 const Surfaces* leader);

    [[nodiscard]] size_t size() const { return all_.size(); }
    [[nodiscard]] Tessellation& operator[](size_t index) { return *all_[index]; }
    [[nodiscard]] const Tessellation& operator[](size_t index) const { return *all_[index]; }
    [[nodiscard]] auto begin() const { return all_.begin(); }
    [[nodiscard]] auto end() const { return all_.end(); }
    template <class Predicate>
    [[nodiscard]] bool any(Predicate&& predicate) const {
        return std::any_of(all_.begin(), all_.end(), [&](const auto& surface) { return predicate(*surface); });
    }
    /// What a pass of each costs, added up.
    template <class Record>
    PassCost record(Record&& record) const {
        PassCost cost;
        for (const std::unique_ptr<Tessellation>& surface : all_) {
            cost += record(*surface);
        }
        return cost;
    }

    /// The rates that instances may have; a count of 0: none.
    [[nodiscard]] Tessellation::Ladder ladder() const { return ladder_; }
    [[nodiscard]] BoundBytes boundBytes() const;
    [[nodiscard]] Status cutDraws(InstanceWindows& windows, bool byWindows) const;
    /// How many patches every part of the asset has.
    [[nodiscard]] std::vector<PartPatches> partPatches() const;
    /// Whether draws count in instances, with a first instance (SuppleGridOutput).
    [[nodiscard]] bool haveGrids() const;
    /// All or none.
    [[nodiscard]] Status setRate(uint32_t rate);
    /// How many vertices of the view's budget an instance needs at its coarsest.
    [[nodiscard]] uint32_t leastVertices() const;

private:
    void setLadder();

    std::vector<std::unique_ptr<Tessellation>> all_;
    Tessellation::Ladder ladder_;
    size_t partCount_ = 1;
};

} // namespace supple::runtime
