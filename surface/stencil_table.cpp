#include "surface/stencil_table.h"

#include "shaders/shared/subdivision.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <vector>

namespace supple::surface {

namespace {

/// The weights of rows, each list once.
class WeightLists {
public:
    /// The element, among those of all lists, of the weights of a row's other vertices.
    uint32_t of(const Stencils& stencils, uint32_t row) {
        list_.clear();
        for (uint32_t i = stencils.starts[row] + 1; i < stencils.starts[row + 1]; ++i) {
            list_.push_back(floatBits(stencils.weights[i]));
        }
        const auto [known, isNew] = elements_.try_emplace(list_, static_cast<uint32_t>(words_.size() / 4));
        if (isNew) {
            words_.insert(words_.end(), list_.begin(), list_.end());
            words_.resize((words_.size() + 3) / 4 * 4, 0);
        }
        return known->second;
    }
    [[nodiscard]] const std::vector<uint32_t>& words() const { return words_; }

private:
    std::vector<uint32_t> words_, list_;
    std::map<std::vector<uint32_t>, uint32_t> elements_;
};

/// Whole rows of numbers, of 16 bits each if all of them fit.
class NumberWriter {
public:
    NumberWriter(bool halves, TableWriter& writer) : halves_(halves), writer_(writer) {}

    /// An even number of them.
    void put(std::span<const uint32_t> numbers) {
        if (halves_) {
            writer_.putHalves(numbers);
        } else {
            writer_.put(numbers);
        }
    }

private:
    bool halves_;
    TableWriter& writer_;
};

uint32_t entriesOf(const Stencils& stencils, uint32_t row) {
    return stencils.starts[row + 1] - stencils.starts[row] - 1;
}

/// By length, so that neighbouring lanes loop equally long: a counting sort.
std::vector<uint32_t> rowsByLength(const Stencils& stencils) {
    uint32_t longest = 0;
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        longest = std::max(longest, entriesOf(stencils, row));
    }
    std::vector<uint32_t> starts(longest + 2, 0), order(stencils.rows());
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        ++starts[entriesOf(stencils, row) + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        order[starts[entriesOf(stencils, row)]++] = row;
    }
    return order;
}

} // namespace

KindOfKernel stencilKernel(bool fromPool, uint32_t numbers) {
    return fromPool
               ? KindOfKernel{Kernel::subdivisionIsolateMeshInPool, numbers, "supple subdivision, isolate once more"}
               : KindOfKernel{Kernel::subdivisionIsolate, numbers, "supple subdivision, isolate"};
}

void writeStencils(const Stencils& stencils, const StencilPlace& place, TableWriter& writer, Tables& tables) {
    constexpr uint32_t kHalves = 0x10000;
    const uint32_t rows = stencils.rows();
    WeightLists lists;
    std::vector<uint32_t> weights(rows), vertices(rows), list;
    for (uint32_t row = 0; row < rows; ++row) {
        weights[row] = lists.of(stencils, row);
    }
    const auto elements = static_cast<uint32_t>(lists.words().size() / 4);
    const bool halves = rows <= kHalves && elements < kHalves &&
                        std::all_of(stencils.vertices.begin(), stencils.vertices.end(),
                                    [](uint32_t vertex) { return vertex < kHalves; });
    writer.reserve(stencils.vertices.size() + 8 * size_t{rows} + lists.words().size());
    NumberWriter numbers(halves, writer);
    for (uint32_t row = 0; row < rows; ++row) {
        vertices[row] = writer.word();
        list.assign({(entriesOf(stencils, row) + 1) / 2});
        list.insert(list.end(), stencils.vertices.begin() + stencils.starts[row],
                    stencils.vertices.begin() + stencils.starts[row + 1]);
        if (list.size() % 2 != 0) { // a weight of 0 on the row's own first vertex
            list.push_back(stencils.vertices[stencils.starts[row]]);
        }
        numbers.put(list);
    }
    (void)writer.element();
    writer.put(lists.words());
    const KindOfKernel kernel = stencilKernel(place.fromPool, halves ? shared::kHalfWords : shared::kWholeWords);
    Construction points{place.stage, kernel, {writer.element(), rows}, rows};
    points.from = place.from;
    points.to = place.to;
    tables.constructions.push_back(points);
    for (const uint32_t row : rowsByLength(stencils)) {
        writer.put({vertices[row]});
        numbers.put(std::array{row, elements - weights[row]});
    }
    (void)writer.element();
}

} // namespace supple::surface
