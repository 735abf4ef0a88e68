#include "shaders/shared/subdivision.h"
#include "surface/table_check_common.h"

#include <algorithm>

namespace supple::surface {

namespace {

/// Rows as the device reads them.
class StencilCheck {
public:
    StencilCheck(TableCheck& check, const Construction& construction, uint64_t vertices)
        : check_(check), construction_(construction), vertices_(vertices),
          halves_(construction.kernel.kind == shared::kHalfWords) {}

    bool run() {
        check_.begin("rows of stencils");
        const uint64_t lanes = construction_.section.count, blocks = lanes / shared::kBlockLanes;
        if (!check_.require(lanes % shared::kBlockLanes == 0, "a block without all of its lanes") ||
            !check_.elements(construction_.section.table, blocks)) {
            return false;
        }
        for (uint64_t block = 0; block < blocks; ++block) {
            if (!checkBlock(4 * (construction_.section.table + block))) {
                return false;
            }
        }
        return check_.require(rows_ == construction_.coefficients, "another number than of vertices");
    }

private:
    bool checkBlock(uint64_t word) {
        const uint64_t first = check_.word(word), each = check_.word(word + 1), rows = check_.word(word + 2);
        const uint64_t pairs = check_.word(word + 3);
        if (!check_.require(rows > 0 && rows <= shared::kBlockLanes, "no rows, or more than a block has lanes") ||
            !check_.require(pairs > 0 && each == (halves_ ? 1 : 2) * (1 + pairs), "rows of another length") ||
            !check_.words(first, each * rows)) {
            return false;
        }
        // Blocks have rows of their own. With this no file can make kernels read the rows of a large cage for every
        // block.
        words_ += each * rows;
        rows_ += rows;
        if (!check_.require(words_ <= check_.tables().words.size(), "their rows overlap")) {
            return false;
        }
        for (uint64_t row = 0; row < rows; ++row) {
            if (!checkRow(first + row * each, pairs)) {
                return false;
            }
        }
        return true;
    }

    bool checkRow(uint64_t word, uint64_t pairs) {
        const uint32_t* row = &check_.tables().words[word];
        const uint32_t number = halves_ ? row[0] & 0xFFFFu : row[0], weights = halves_ ? row[0] >> 16 : row[1];
        const uint32_t largest = halves_ ? largestHalf(row + 1, static_cast<uint32_t>(2 * pairs))
                                         : *std::max_element(row + 2, row + 2 + 2 * pairs);
        const uint64_t table = construction_.section.table;
        return check_.within(uint64_t{construction_.from} + largest, 1, vertices_, "vertices") &&
               check_.require(weights <= table, "weights before the tables") &&
               check_.elements(table - weights, (pairs + 1) / 2) &&
               checkTarget(check_, uint64_t{construction_.to} + number);
    }

    TableCheck& check_;
    const Construction& construction_;
    uint64_t vertices_;
    bool halves_;
    uint64_t rows_ = 0, words_ = 0; ///< of all blocks
};

} // namespace

bool checkStencils(TableCheck& check, const Construction& construction, uint64_t vertices) {
    return StencilCheck(check, construction, vertices).run();
}

} // namespace supple::surface
