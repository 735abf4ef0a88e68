#include "surface/stencil_table.h"

#include <algorithm>

namespace supple::surface {

void writeStencils(const Stencils& stencils, TableWriter& writer, Tables& tables) {
    const auto entries = [&](uint32_t row) { return stencils.starts[row + 1] - stencils.starts[row] - 1; };
    std::vector<uint32_t> order(stencils.rows()), first(stencils.rows());
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        order[row] = row;
        first[row] = writer.element();
        for (uint32_t i = stencils.starts[row] + 1; i < stencils.starts[row + 1]; ++i) {
            writer.put({stencils.vertices[i], floatBits(stencils.weights[i])});
        }
        if (entries(row) % 2 != 0) { // a weight of 0 on the row's own first vertex
            writer.put({stencils.vertices[stencils.starts[row]], 0u});
        }
    }
    // By length, so that neighbouring lanes loop equally long.
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return entries(a) < entries(b); });
    tables.constructions.push_back(
        {Stage::vertex, Kernel::isolate, {writer.element(), stencils.rows()}, stencils.rows()});
    for (const uint32_t row : order) {
        writer.put({stencils.vertices[stencils.starts[row]], first[row], entries(row), row});
    }
}

} // namespace supple::surface
