#include "shaders/shared/subdivision.h"
#include "surface/grid.h"
#include "tests/surface/table_words_parts.h"

#include <set>
#include <utility>

namespace supple::test {

namespace {

using namespace shared;
using namespace surface;

class FragmentWords {
public:
    FragmentWords(WordList& list, const TableSource& source)
        : list_(list), tables_(list.tables()), all_(tables_.fragments), loop_(all_.loop), vertices_(source.vertices) {}

    void run() {
        for (const Construction& step : tables_.constructions) {
            addStencilWords(list_, step, vertices_);
            vertices_ = step.to + uint64_t{step.coefficients};
        }
        for (const Fragments::Class& own : all_.classes) {
            readClass(4 * uint64_t{list_.at(uint64_t{4} * own.fragments.table)});
            addHeader();
            for (uint32_t step = 1; step <= all_.steps; ++step) {
                for (uint32_t row = 0; row < points(step); ++row) {
                    addRow(4 * uint64_t{level(step, 0)} + 4 * uint64_t{row}, step);
                }
            }
            addLimitRows();
            addFragments(own);
            for (size_t s = 0; s < own.blocks.size(); ++s) {
                const auto step = static_cast<uint32_t>(s / kWorkKinds) + 1;
                addWork(own.blocks[s], step, s % kWorkKinds == kInBulk);
            }
        }
    }

private:
    void readClass(uint64_t header) {
        header_ = header;
        count_ = list_.at(header);
        sectors_ = list_.at(header + 1) & ~kSharpClass;
        sharp_ = (list_.at(header + 1) & kSharpClass) != 0;
        facet_ = list_.at(header + 5) == 0;
        const uint32_t each = (loop_ ? 3 : 6) * sectors_;
        spokes_ = facet_ ? 3 : sectors_ + (points(0) > 1 + each ? 1 : 0);
    }
    [[nodiscard]] uint32_t level(uint32_t step, uint32_t k) const {
        return list_.at(header_ + uint64_t{4} * (kClassHeaderElements + step) + k);
    }
    [[nodiscard]] uint32_t points(uint32_t step) const { return level(step, 2); }
    [[nodiscard]] uint32_t samples() const {
        return sampleCount(loop_ ? Domain::triangle : Domain::quad, tables_.rate);
    }
    /// Whether a word is not listed yet for classes with or without sharpness.
    bool isNew(uint64_t word) { return known_.insert({word, sharp_}).second; }
    void addOther(const char* what, uint64_t word) { list_.add(what, word, {~0u, list_.at(word) + 1}); }

    void addHeader() {
        list_.add("fragments of a class", header_, {~0u, 0, count_ + 1});
        list_.add("sectors of a class", header_ + 1,
                  {~0u, list_.at(header_ + 1) + 1, list_.at(header_ + 1) & kSharpClass});
        list_.addIndex("nets of a class", header_ + 2, tables_.words.size());
        if (sharp_) {
            list_.addIndex("sharpness of a class", header_ + 3, tables_.words.size());
        }
        list_.addIndex("patches of a class", header_ + 4, tables_.words.size());
        list_.add("masks of a class", header_ + 5, {~0u, facet_ ? 1 : static_cast<uint32_t>(tables_.words.size())});
        if (sharp_ && !facet_) {
            list_.addIndex("centre steps of a class", header_ + 6, list_.elements() + 1);
        }
        list_.addIndex("limit rows of a class", header_ + 10, list_.elements());
        addOther("number of limit rows", header_ + 11);
        for (uint32_t step = 0; step <= all_.steps; ++step) {
            const uint64_t word = header_ + uint64_t{4} * (kClassHeaderElements + step);
            addOther("points of a step", word + 2);
            if (step > 0) {
                list_.addIndex("rows of a step", word, list_.elements());
                addOther("run of a step", word + 3);
            }
            if (step < all_.steps) {
                addOther("neighbours of a step", word + 1);
            }
        }
    }

    /// A pattern row; its level reads `points(step - 1)`.
    void addRow(uint64_t row, uint32_t step) {
        const uint32_t packed = list_.half(row, 7), rule = packed & 3u;
        if (!isNew(row)) {
            return;
        }
        const uint32_t sources = rule == kCentreRule ? 0
                                 : rule == kFaceRule ? 4
                                 : rule == kEdgeRule ? (loop_ ? 4 : 6)
                                                     : (loop_ ? 7 : 1);
        for (uint32_t k = 0; k < 8; ++k) {
            list_.add("rule", row + k / 2, {});
        }
        for (uint32_t k = 0; k < sources; ++k) {
            list_.addHalf("source of a row", row, k, points(step - 1));
        }
        if (sharp_) {
            list_.add("spoke of a row", row + 3, {(list_.at(row + 3) & 0x3FFFFu) | (spokes_ + 1) << 18});
        }
        if (rule == kVertexRule && !loop_) {
            addNeighbours(4 * (uint64_t{level(step - 1, 1)} + list_.half(row, 0)), 8, step - 1);
        }
    }
    void addNeighbours(uint64_t word, uint32_t count, uint32_t step) {
        if (!isNew(word)) {
            return;
        }
        for (uint32_t k = 0; k < count; ++k) {
            list_.addHalf("neighbour", word, k, points(step));
        }
    }

    void addLimitRows() {
        for (uint64_t row = 0; row < list_.at(header_ + 11); ++row) {
            const uint64_t word = 4 * (list_.at(header_ + 10) + 2 * row);
            for (uint32_t k = 0; k < (loop_ ? 6u : 8u); ++k) {
                list_.addHalf("neighbour of a sample", word, k, points(all_.steps));
            }
            list_.addIndex("point of a sample", word + 4, points(all_.steps));
            if (sharp_) {
                list_.addIndex("spoke of a sample", word + 5, spokes_ + 1);
            }
            const uint32_t place = list_.at(word + 6);
            list_.add("sector of a sample", word + 6, {place | kSectorMask, (place & ~kSectorMask) | sectors_});
            list_.addIndex("number of a sample", word + 7, samples());
        }
    }

    void addFragments(const Fragments::Class& own) {
        for (uint64_t f = 0; f < own.fragments.count; ++f) {
            addOther("header of a fragment", 4 * (own.fragments.table + f));
            list_.addIndex("number of a fragment", 4 * (own.fragments.table + f) + 1, count_);
        }
        for (uint64_t k = 0; k < uint64_t{count_} * points(0); ++k) {
            list_.addIndex("vertex of a net", list_.at(header_ + 2) + k, tables_.poolStride);
        }
        for (uint64_t k = 0; k < uint64_t{count_} * sectors_; ++k) {
            list_.add("patch of a sector", list_.at(header_ + 4) + k,
                      {kNoPatch - 1, static_cast<uint32_t>(tables_.patches.size())});
            if (!facet_) {
                addMask(list_.at(header_ + 5) + k);
            }
        }
        for (uint64_t k = 0; sharp_ && !facet_ && k < uint64_t{all_.steps} * count_; ++k) {
            list_.addIndex("first spoke of a centre", 4 * (list_.at(header_ + 6) + k) + 2, spokes_);
            list_.addIndex("second spoke of a centre", 4 * (list_.at(header_ + 6) + k) + 3, spokes_);
        }
    }
    void addMask(uint64_t word) {
        const uint64_t mask = uint64_t{4} * list_.at(word);
        list_.addIndex("mask of a sector", word, list_.elements());
        if (isNew(mask)) {
            list_.addIndex("first sector of a mask", mask + 1, spokes_);
            list_.addIndex("sectors of a mask", mask + 2, spokes_ + 1);
            addOther("ring of a mask", mask + 3);
        }
    }

    void addWork(const Section& blocks, uint32_t step, bool inBulk) {
        const bool isLimit = step > all_.steps;
        for (uint64_t b = 0; b < blocks.count; ++b) {
            const uint64_t word = 4 * (blocks.table + 3 * b);
            list_.add("rows of a block", word, {~0u});
            if (isLimit || !inBulk) {
                list_.add("list of a block", word + 1, {~0u});
            }
            addOther("first place of a block", word + 2);
            addOther("first fragment of a block", word + 3);
            addOther("what a block reads", word + 4);
            if (!isLimit) {
                addOther("what a block writes", word + 5);
                addOther("neighbours of a block", word + 8);
            }
            addOther("fragments of a block", word + 6);
            list_.add("places of a block", word + 7, {~0u, 0});
            if (!inBulk) {
                addOther("header of a block", word + 9);
            }
        }
        if (blocks.count == 0) {
            return;
        }
        const uint64_t first = uint64_t{4} * blocks.table;
        const uint32_t rows = list_.at(first), list = list_.at(first + 1), places = list_.at(first + 7);
        for (uint32_t place = 0; place < places; ++place) {
            if (isLimit && inBulk) {
                addStrip(4 * (uint64_t{rows} + place));
            } else if (inBulk) {
                addCell(4 * (uint64_t{rows} + place), step);
            } else if (!isLimit) {
                list_.addIndex("row of a list", uint64_t{list} + place, points(step));
            }
        }
    }
    void addCell(uint64_t cell, uint32_t step) {
        const uint32_t targets = loop_ ? 7 : 6;
        for (uint32_t k = 0; k < targets; ++k) {
            list_.addHalf("target of a cell", cell, k, points(step), false);
        }
        list_.addHalf("point of a cell", cell, kCellTargets, points(step - 1));
        addNeighbours(4 * (uint64_t{level(step - 1, 1)} + list_.half(cell, kCellTargets)), loop_ ? 6 : 8, step - 1);
    }
    void addStrip(uint64_t strip) {
        const uint32_t columns = list_.at(strip + 1);
        list_.addIndex("columns of a strip", strip, list_.elements());
        list_.addIndex("number of columns", strip + 1, list_.elements());
        list_.addIndex("sector of a strip", strip + 2, sectors_);
        for (uint64_t c = 0; c < columns; ++c) {
            const uint64_t column = 4 * (list_.at(strip) + c);
            list_.addHalf("point of a column", column, 0, points(all_.steps));
            list_.addHalf("point of a column", column, 1, points(all_.steps));
            list_.addHalf("point of a column", column, 2, points(all_.steps));
            if (c > 0 && c + 1 < columns) {
                list_.add("axis of a column", column + 2, {});
                if (list_.at(column + 2) != kNoSample) {
                    list_.addHalf("sample of a column", column, 3, samples());
                }
            }
        }
    }

    WordList& list_;
    const Tables& tables_;
    const Fragments& all_;
    bool loop_;
    uint64_t vertices_;
    uint64_t header_ = 0; ///< word; of the class at work, as what follows
    uint32_t count_ = 0, sectors_ = 0, spokes_ = 0;
    bool sharp_ = false, facet_ = false;
    std::set<std::pair<uint64_t, bool>> known_; ///< words with which rows, neighbours and masks begin
};

} // namespace

void addFragmentWords(WordList& list, const TableSource& source) {
    FragmentWords(list, source).run();
}

} // namespace supple::test
