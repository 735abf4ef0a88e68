#include "surface/stencil_table.h"

#include <algorithm>
#include <numeric>

namespace supple::surface {

void writeStencils(const Stencils& stencils, const StencilPlace& place, TableWriter& writer, Tables& tables) {
    const auto entries = [&](uint32_t row) { return stencils.starts[row + 1] - stencils.starts[row] - 1; };
    const uint32_t rows = stencils.rows();
    std::vector<uint32_t> first(rows);
    uint32_t longest = 0;
    writer.reserve(2 * (stencils.vertices.size() + rows) + 4 * size_t{rows});
    for (uint32_t row = 0; row < rows; ++row) {
        first[row] = writer.element();
        longest = std::max(longest, entries(row));
        for (uint32_t i = stencils.starts[row] + 1; i < stencils.starts[row + 1]; ++i) {
            writer.put({place.from + stencils.vertices[i], floatBits(stencils.weights[i])});
        }
        if (entries(row) % 2 != 0) { // a weight of 0 on the row's own first vertex
            writer.put({place.from + stencils.vertices[stencils.starts[row]], 0u});
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
        writer.put({place.from + stencils.vertices[stencils.starts[row]], first[row], entries(row), place.to + row});
    }
}

} // namespace supple::surface
