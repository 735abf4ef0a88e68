#include "surface/stencil_table.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace supple::surface {

namespace {

/// The weights of rows, each list once.
class WeightLists {
public:
    explicit WeightLists(TableWriter& writer) : writer_(writer) {}

    /// The element of the weights of a row's other vertices.
    uint32_t of(const Stencils& stencils, uint32_t row) {
        list_.clear();
        for (uint32_t i = stencils.starts[row] + 1; i < stencils.starts[row + 1]; ++i) {
            list_.push_back(floatBits(stencils.weights[i]));
        }
        const auto [known, isNew] = elements_.try_emplace(list_, writer_.element());
        if (isNew) {
            writer_.put(list_);
        }
        return known->second;
    }

private:
    TableWriter& writer_;
    std::map<std::vector<uint32_t>, uint32_t> elements_;
    std::vector<uint32_t> list_;
};

} // namespace

void writeStencils(const Stencils& stencils, const StencilPlace& place, TableWriter& writer, Tables& tables) {
    const auto entries = [&](uint32_t row) { return stencils.starts[row + 1] - stencils.starts[row] - 1; };
    const uint32_t rows = stencils.rows();
    WeightLists lists(writer);
    std::vector<uint32_t> vertices(rows), weights(rows);
    uint32_t longest = 0;
    writer.reserve(stencils.vertices.size() + 8 * size_t{rows});
    for (uint32_t row = 0; row < rows; ++row) {
        weights[row] = lists.of(stencils, row);
        vertices[row] = writer.element();
        longest = std::max(longest, entries(row));
        for (uint32_t i = stencils.starts[row] + 1; i < stencils.starts[row + 1]; ++i) {
            writer.put({place.from + stencils.vertices[i]});
        }
        if (entries(row) % 2 != 0) { // a weight of 0 on the row's own first vertex
            writer.put({place.from + stencils.vertices[stencils.starts[row]]});
        }
    }
    // By length, so that neighbouring lanes loop equally long: a counting sort.
    std::vector<uint32_t> starts(longest + 2, 0), order(rows);
    for (uint32_t row = 0; row < rows; ++row) {
        ++starts[entries(row) + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    for (uint32_t row = 0; row < rows; ++row) {
        order[starts[entries(row)]++] = row;
    }
    constexpr KindOfKernel kKernels[] = {
        {Kernel::subdivisionIsolate, 0, "supple subdivision, isolate"},
        {Kernel::subdivisionIsolateMeshInPool, 0, "supple subdivision, isolate once more"},
    };
    tables.constructions.push_back({place.stage, kKernels[place.fromPool ? 1 : 0], {writer.element(), rows}, rows});
    for (const uint32_t row : order) {
        writer.put({place.from + stencils.vertices[stencils.starts[row]], vertices[row], entries(row), place.to + row});
    }
    for (const uint32_t row : order) {
        writer.put({weights[row]});
    }
    (void)writer.element();
}

} // namespace supple::surface
