#include "runtime/queries/piece_tree.h"

#include "shaders/shared/queries.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace supple::runtime {
namespace {

using namespace shared;

/// Where a piece lies: the mean of its coefficients.
glm::vec3 middleOf(const PieceTable& table, uint32_t piece, std::span<const glm::vec3> positions) {
    const uint32_t* const head = &table.words[size_t{4} * kPieceElements * piece];
    const uint32_t count = head[1] >> kPieceVerticesShift;
    glm::vec3 middle(0.0f);
    for (uint32_t k = 0; k < count; ++k) {
        const uint32_t* const shares = &table.words[size_t{4} * head[3] + size_t{kPieceCoefficients} * k];
        const float sum = std::accumulate(shares, shares + kPieceCoefficients, 0.0f,
                                          [](float all, uint32_t share) { return all + std::bit_cast<float>(share); });
        middle += sum / static_cast<float>(kPieceCoefficients) * positions[table.words[size_t{4} * head[2] + k]];
    }
    return middle;
}

/// The leaves below a node. Those of a level are side by side, and the last levels may be cut off.
uint32_t leavesBelow(uint32_t node, uint32_t leafCount) {
    uint32_t count = 0;
    for (uint64_t first = node, last = node; first < 2 * uint64_t{leafCount}; first *= 2, last = 2 * last + 1) {
        const uint64_t begin = std::max<uint64_t>(first, leafCount), end = std::min<uint64_t>(last + 1, 2 * leafCount);
        count += static_cast<uint32_t>(end > begin ? end - begin : 0);
    }
    return count;
}

class Leaves {
public:
    explicit Leaves(std::vector<glm::vec3> middles) : middles_(std::move(middles)), pieces_(middles_.size()) {
        std::iota(pieces_.begin(), pieces_.end(), 0u);
        order_.resize(middles_.size());
        if (!pieces_.empty()) {
            put(1, pieces_);
        }
    }
    [[nodiscard]] const std::vector<uint32_t>& order() const { return order_; }

private:
    /// Shares out what lies below a node between its children, across the longest side of what their middles fill. The
    /// tree is as deep as the logarithm of its leaves.
    void put(uint32_t node, std::span<uint32_t> pieces) {
        if (node >= order_.size()) {
            order_[node - order_.size()] = pieces[0];
            return;
        }
        glm::vec3 low = middles_[pieces[0]], high = low;
        for (const uint32_t piece : pieces) {
            low = glm::min(low, middles_[piece]);
            high = glm::max(high, middles_[piece]);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const uint32_t half = leavesBelow(2 * node, static_cast<uint32_t>(order_.size()));
        std::nth_element(pieces.begin(), pieces.begin() + half, pieces.end(), [&](uint32_t a, uint32_t b) {
            return std::pair(middles_[a][axis], a) < std::pair(middles_[b][axis], b);
        });
        put(2 * node, pieces.first(half));
        put(2 * node + 1, pieces.subspan(half));
    }

    std::vector<glm::vec3> middles_;
    std::vector<uint32_t> pieces_, order_; ///< order_: by leaf, the piece
};

} // namespace

Result<uint32_t> addLeaves(PieceTable& table, std::span<const glm::vec3> positions, uint64_t mostElements) {
    std::vector<glm::vec3> middles;
    for (uint32_t piece = 0; piece < table.pieceCount; ++piece) {
        middles.push_back(middleOf(table, piece, positions));
    }
    const auto first = static_cast<uint32_t>(table.words.size() / 4);
    const Leaves leaves(std::move(middles));
    table.words.insert(table.words.end(), leaves.order().begin(), leaves.order().end());
    table.words.resize((table.words.size() + 3) / 4 * 4);
    if (table.words.size() / 4 > mostElements) {
        return Error{ErrorCode::limit, "the pieces of its surfaces, with a tree over them, are more than " +
                                           std::to_string(mostElements) + " elements of 16 bytes"};
    }
    return first;
}

} // namespace supple::runtime
