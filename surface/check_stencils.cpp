#include "shaders/shared/subdivision.h"
#include "surface/table_check_common.h"

#include <algorithm>

namespace supple::surface {

namespace {

/// A row as the device reads it.
struct StencilRow {
    uint64_t list = 0;                 ///< the word at which its vertices begin
    uint32_t number = 0, weights = 0;  ///< its own, and how many elements before the rows its weights lie
    uint64_t pairs = 0, listWords = 0; ///< behind its first vertex; words that the list takes
    uint32_t largest = 0;              ///< of its vertices
};

class StencilCheck {
public:
    StencilCheck(TableCheck& check, const Construction& construction, uint64_t vertices)
        : check_(check), construction_(construction), vertices_(vertices),
          halves_(construction.kernel.kind == shared::kHalfWords) {}

    bool run() {
        check_.begin("rows of stencils");
        const uint64_t rows = construction_.section.count, first = uint64_t{4} * construction_.section.table;
        if (!check_.words(first, (halves_ ? 2 : 3) * rows)) {
            return false;
        }
        for (uint64_t row = 0; row < rows; ++row) {
            if (!checkRow(first + (halves_ ? 2 : 3) * row)) {
                return false;
            }
        }
        return true;
    }

private:
    bool checkRow(uint64_t word) {
        StencilRow row;
        row.list = check_.word(word);
        row.number = halves_ ? check_.word(word + 1) & 0xFFFFu : check_.word(word + 1);
        row.weights = halves_ ? check_.word(word + 1) >> 16 : check_.word(word + 2);
        if (!(halves_ ? readHalves(row) : readWords(row))) {
            return false;
        }
        // Rows have lists of their own. With this no file can make kernels read one list for every row of a large cage.
        listWords_ += row.listWords;
        const uint64_t table = construction_.section.table;
        return check_.require(listWords_ <= check_.tables().words.size(), "their lists overlap") &&
               check_.within(uint64_t{construction_.from} + row.largest, 1, vertices_, "vertices") &&
               check_.require(row.weights <= table, "weights before the tables") &&
               check_.elements(table - row.weights, (row.pairs + 1) / 2) &&
               checkTarget(check_, uint64_t{construction_.to} + row.number);
    }

    bool readHalves(StencilRow& row) {
        if (!check_.words(row.list, 1)) {
            return false;
        }
        row.pairs = check_.word(row.list) & 0xFFFFu;
        row.listWords = 1 + row.pairs;
        if (!check_.words(row.list, row.listWords)) {
            return false;
        }
        const uint32_t* list = &check_.tables().words[row.list];
        row.largest = std::max(list[0] >> 16, largestHalf(list + 1, static_cast<uint32_t>(2 * row.pairs)));
        return true;
    }

    bool readWords(StencilRow& row) {
        if (!check_.words(row.list, 2)) {
            return false;
        }
        row.pairs = check_.word(row.list);
        row.listWords = 2 + 2 * row.pairs;
        if (!check_.words(row.list, row.listWords)) {
            return false;
        }
        const uint32_t* list = &check_.tables().words[row.list];
        row.largest = *std::max_element(list + 1, list + row.listWords);
        return true;
    }

    TableCheck& check_;
    const Construction& construction_;
    uint64_t vertices_;
    bool halves_;
    uint64_t listWords_ = 0;
};

} // namespace

bool checkStencils(TableCheck& check, const Construction& construction, uint64_t vertices) {
    return StencilCheck(check, construction, vertices).run();
}

} // namespace supple::surface
