#include "shaders/shared/blend.h"
#include "shaders/shared/subdivision.h"
#include "tests/surface/table_words_parts.h"

#include <set>

namespace supple::test {

using namespace shared;
using namespace surface;

void WordList::addHalf(const char* what, uint64_t word, uint32_t k, uint64_t limit, bool allOnes) {
    const uint64_t own = word + k / 2;
    const uint32_t shift = 16 * (k % 2), rest = at(own) & ~(0xFFFFu << shift);
    std::vector<uint32_t> bad;
    if (limit <= 0xFFFFu) {
        bad.push_back(rest | static_cast<uint32_t>(limit) << shift);
        if (allOnes) {
            bad.push_back(rest | 0xFFFFu << shift);
        }
    }
    add(what, own, std::move(bad));
}

void addStencilWords(WordList& list, const Construction& c, uint64_t vertices) {
    const bool halves = c.kernel.kind == kHalfWords;
    const uint64_t words = list.tables().words.size(), pool = list.tables().poolStride;
    for (uint64_t block = 0; block < c.section.count / kBlockLanes; ++block) {
        const uint64_t word = 4 * (c.section.table + block), each = list.at(word + 1), pairs = list.at(word + 3);
        list.addIndex("rows of a block of stencils", word, words);
        list.addIndex("words of a stencil", word + 1, each + 1);
        list.addIndex("number of stencils of a block", word + 2, kBlockLanes + 1);
        list.addIndex("pairs of a stencil", word + 3, pairs + 1);
        for (uint64_t row = list.at(word), n = 0; n < list.at(word + 2); ++n, row += each) {
            if (halves) {
                list.addHalf("number of a stencil", row, 0, pool - c.to);
                list.addHalf("weights of a stencil", row, 1, c.section.table + uint64_t{1});
            } else {
                list.addIndex("number of a stencil", row, pool - c.to);
                list.addIndex("weights of a stencil", row + 1, c.section.table + uint64_t{1});
            }
            for (uint32_t k = 2; k < 2 * pairs + 2; ++k) {
                if (halves) {
                    list.addHalf("vertex of a stencil", row, k, vertices - c.from);
                } else {
                    list.addIndex("vertex of a stencil", row + k, vertices - c.from);
                }
            }
        }
    }
}

namespace {

class BlendWords {
public:
    BlendWords(WordList& list, const TableSource& source)
        : list_(list), tables_(list.tables()), vertices_(source.vertices), atLevels_(source.recipe.lod) {}

    void run() {
        if (tables_.constructions.size() > 1) {
            addStencilWords(list_, tables_.constructions.front(), vertices_);
            vertices_ = tables_.constructions.front().coefficients;
        }
        const Section& charts = tables_.constructions.back().section;
        for (uint64_t chart = 0; chart < charts.count; ++chart) {
            addChart(4 * (charts.table + chart));
        }
        for (const PatchRange& range : tables_.ranges) {
            const uint64_t corners = uint64_t{4} * range.section.count;
            const bool sharp = range.patchClass == PatchClass::blendSharp;
            for (uint64_t c = 0; c < corners; ++c) {
                addCorner(4 * (range.section.table + c), sharp, tables_.poolStride, kChartCoefficients);
            }
            for (uint64_t c = 0; tables_.uvMode != cage::UvMode::all && c < tables_.uvSets * corners; ++c) {
                addCorner(4 * (range.smoothUvs + c), sharp, list_.elements(), 5);
            }
        }
        for (const LodTables::Edges& edges : tables_.lod.edges) {
            for (uint64_t end = 0; end < uint64_t{2} * edges.section.count; ++end) {
                addCoefficients("chart of an edge", 4 * (edges.section.table + end), tables_.poolStride,
                                kChartCoefficients);
            }
        }
    }

private:
    void addChart(uint64_t record) {
        const uint32_t ring = list_.at(record + 1), fit = 4 * list_.at(record + 2), points = list_.at(fit);
        list_.addIndex("vertex of a chart", record, vertices_);
        list_.add("ring of a chart", record + 1, {~0u, static_cast<uint32_t>(tables_.words.size() - points + 1)});
        list_.addIndex("fit of a chart", record + 2, list_.elements());
        list_.add("coefficients of a chart", record + 3,
                  {~0u, tables_.poolStride, tables_.poolStride - kChartCoefficients + 1});
        if (fits_.insert(fit).second) {
            list_.add("points of a fit", fit, {~0u, static_cast<uint32_t>(list_.elements() / 3)});
        }
        for (uint32_t k = 0; k < points; ++k) {
            list_.addIndex("vertex of a ring", ring + k, vertices_);
        }
    }

    void addCoefficients(const char* what, uint64_t word, uint64_t limit, uint32_t count) {
        const uint32_t flags = list_.at(word) & ~kPoolIndexMask;
        list_.add(what, word,
                  {flags | kPoolIndexMask, flags | static_cast<uint32_t>(limit),
                   flags | static_cast<uint32_t>(limit - count + 1)});
    }

    void addCorner(uint64_t record, bool sharp, uint64_t limit, uint32_t count) {
        const uint64_t side = tables_.rate + 3, samples = side * side;
        addCoefficients("coefficients of a corner", record, limit, count);
        list_.addIndex("direction of a corner", record + 1, list_.elements());
        if (!atLevels_) {
            list_.addIndex("samples of a corner", record + 2, list_.elements() - samples + 1);
        }
        if (!atLevels_ && sharp && (list_.at(record) & kCreasedChart) != 0) {
            list_.addIndex("crease samples of a corner", record + 3, list_.elements() - 2 * samples + 1);
        }
    }

    WordList& list_;
    const Tables& tables_;
    uint64_t vertices_;
    bool atLevels_;
    std::set<uint32_t> fits_; ///< that are listed
};

} // namespace

void addBlendWords(WordList& list, const TableSource& source) {
    BlendWords(list, source).run();
}

} // namespace supple::test
