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
    /// The element, among those of all lists, of the weights of a row's vertices. Kernels take the first one's as what
    /// the others leave.
    uint32_t of(const Stencils& stencils, uint32_t row) {
        list_.assign({0});
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

uint32_t verticesOf(const Stencils& stencils, uint32_t row) {
    return stencils.starts[row + 1] - stencils.starts[row];
}
uint32_t pairsOf(const Stencils& stencils, uint32_t row) {
    return (verticesOf(stencils, row) + 1) / 2;
}

/// By length, so that neighbouring lanes loop equally long: a counting sort.
std::vector<uint32_t> rowsByLength(const Stencils& stencils) {
    uint32_t longest = 0;
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        longest = std::max(longest, pairsOf(stencils, row));
    }
    std::vector<uint32_t> starts(longest + 2, 0), order(stencils.rows());
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        ++starts[pairsOf(stencils, row) + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        order[starts[pairsOf(stencils, row)]++] = row;
    }
    return order;
}

/// Rows of one length that follow each other.
struct Block {
    uint32_t first = 0, rows = 0;
};
std::vector<Block> blocksOf(const Stencils& stencils, std::span<const uint32_t> order) {
    std::vector<Block> blocks;
    for (uint32_t i = 0; i < order.size(); ++i) {
        if (blocks.empty() || blocks.back().rows == shared::kBlockLanes ||
            pairsOf(stencils, order[i]) != pairsOf(stencils, order[blocks.back().first])) {
            blocks.push_back({i, 0});
        }
        ++blocks.back().rows;
    }
    return blocks;
}

} // namespace

KindOfKernel stencilKernel(bool fromPool, uint32_t numbers) {
    return {fromPool ? Kernel::subdivisionIsolateMeshInPool : Kernel::subdivisionIsolate, numbers};
}

bool isByStencils(const Construction& construction) {
    return construction.kernel.kernel == Kernel::subdivisionIsolate ||
           construction.kernel.kernel == Kernel::subdivisionIsolateMeshInPool;
}

void writeStencils(const Stencils& stencils, const StencilPlace& place, TableWriter& writer, Tables& tables) {
    constexpr uint32_t kHalves = 0x10000;
    const uint32_t rows = stencils.rows();
    if (rows == 0) {
        return;
    }
    WeightLists lists;
    std::vector<uint32_t> weights(rows);
    for (uint32_t row = 0; row < rows; ++row) {
        weights[row] = lists.of(stencils, row);
    }
    const auto elements = static_cast<uint32_t>(lists.words().size() / 4);
    const auto numberOf = [&](uint32_t row) { return place.numbers.empty() ? row : place.numbers[row]; };
    const uint32_t last =
        place.numbers.empty() ? rows - 1 : *std::max_element(place.numbers.begin(), place.numbers.end());
    const bool halves = last < kHalves && elements < kHalves &&
                        std::all_of(stencils.vertices.begin(), stencils.vertices.end(),
                                    [](uint32_t vertex) { return vertex < kHalves; });
    const std::vector<uint32_t> order = rowsByLength(stencils);
    const std::vector<Block> blocks = blocksOf(stencils, order);
    const auto blockCount = static_cast<uint32_t>(blocks.size());
    writer.reserve(stencils.vertices.size() + 3 * size_t{rows} + lists.words().size() + 4 * blocks.size());
    (void)writer.element();
    writer.put(lists.words());
    Construction points{place.stage,
                        stencilKernel(place.fromPool, halves ? shared::kHalfWords : shared::kWholeWords),
                        {writer.element(), blockCount * shared::kBlockLanes},
                        rows};
    points.from = place.from;
    points.to = place.to;
    tables.constructions.push_back(points);
    uint32_t word = writer.word() + 4 * blockCount;
    for (const Block& block : blocks) {
        const uint32_t pairs = pairsOf(stencils, order[block.first]), words = (halves ? 1 : 2) * (1 + pairs);
        writer.put({word, words, block.rows, pairs});
        word += words * block.rows;
    }
    NumberWriter numbers(halves, writer);
    std::vector<uint32_t> list;
    for (const uint32_t row : order) {
        list.assign({numberOf(row), elements - weights[row]});
        list.insert(list.end(), stencils.vertices.begin() + stencils.starts[row],
                    stencils.vertices.begin() + stencils.starts[row + 1]);
        if (list.size() % 2 != 0) { // a weight of 0 on the row's own first vertex
            list.push_back(stencils.vertices[stencils.starts[row]]);
        }
        numbers.put(list);
    }
    (void)writer.element();
}

} // namespace supple::surface
