// Every word of the exact schemes' tables that is an index or a count is looked at (surface/chains/table_check.cpp).
// This lists them by what shaders/shared/{exact,surface,subdivision}.h say of the records, and changes one at a time.
#include "shaders/shared/chains.h"
#include "shaders/shared/subdivision.h"
#include "surface/patch_records.h"
#include "surface/smooth_uvs.h"
#include "tests/support/exact_tables.h"

#include <bit>
#include <gtest/gtest.h>
#include <set>

namespace supple::test {
namespace {

using namespace shared;
using surface::Construction;
using surface::Kernel;
using surface::PatchClass;
using surface::SchemeId;
using surface::Tables;

/// A number in the tables: a word, or some of its bits.
struct Number {
    const char* what = "";
    uint64_t word = 0;
    uint64_t bad = 0; ///< the first that is out of range, if there are bits for it
    uint32_t shift = 0, bits = 32;
    bool allOnes = true; ///< that, too, is out of range

    [[nodiscard]] uint64_t most() const { return (uint64_t{1} << bits) - 1; }
};

/// What is in the tables, and which numbers that is.
class NumberList {
public:
    explicit NumberList(const ExactTables& made) : made_(made), tables_(made.tables) {}

    std::vector<Number> list() {
        for (const Construction& c : tables_.constructions) {
            switch (c.kernel.kernel) {
            case Kernel::subdivisionIsolate:
                addStencils(c, made_.vertices);
                break;
            case Kernel::subdivisionIsolateMeshInPool:
                addStencils(c, tables_.meshVertices + uint64_t{tables_.constructions[0].coefficients});
                break;
            case Kernel::chainsVertex:
            case Kernel::chainsVertexMeshInPool:
                addPlain(c);
                break;
            default:
                addChains(c);
            }
        }
        addRing();
        for (const surface::PatchRange& range : tables_.ranges) {
            const uint32_t elements = surface::recordElements(tables_, range.patchClass);
            for (uint32_t p = 0; p < range.section.count; ++p) {
                addPatch(uint64_t{range.section.table} + elements * p, range.patchClass);
            }
            const uint32_t each = surface::uvElements(tables_, range.patchClass);
            for (uint32_t r = 0; tables_.uvLeaves && r < tables_.uvSets * range.section.count; ++r) {
                addUvs(uint64_t{range.smoothUvs} + each * r);
            }
        }
        return std::move(numbers_);
    }

private:
    [[nodiscard]] uint32_t at(uint64_t word) const { return tables_.words[word]; }
    [[nodiscard]] uint32_t half(uint64_t word, uint32_t k) const {
        return tables_.words[word + k / 2] >> 16 * (k % 2) & 0xFFFFu;
    }
    [[nodiscard]] uint64_t words() const { return tables_.words.size(); }
    [[nodiscard]] uint64_t elements() const { return words() / 4; }
    [[nodiscard]] uint64_t pool() const { return tables_.poolStride; }
    [[nodiscard]] bool isLoop() const { return made_.recipe.scheme == SchemeId::loop; }

    void add(const char* what, uint64_t word, uint64_t bad, bool allOnes = true) {
        numbers_.push_back({what, word, bad, 0, 32, allOnes});
    }
    void addHalf(const char* what, uint64_t word, uint32_t k, uint64_t bad, bool allOnes = true) {
        numbers_.push_back({what, word + k / 2, bad, 16 * (k % 2), 16, allOnes});
    }

    void addStencils(const Construction& c, uint64_t vertices) {
        for (uint32_t block = 0; block < c.section.count / kBlockLanes; ++block) {
            const uint64_t word = uint64_t{4} * (c.section.table + block), each = at(word + 1), pairs = at(word + 3);
            add("rows of a block of stencils", word, words());
            add("words of a row", word + 1, each + 1);
            add("number of rows of a block", word + 2, kBlockLanes + 1);
            add("pairs of a row", word + 3, pairs + 1);
            for (uint32_t row = 0; row < at(word + 2); ++row) {
                addStencil(c, at(word) + each * row, pairs, vertices);
            }
        }
    }
    void addStencil(const Construction& c, uint64_t row, uint64_t pairs, uint64_t vertices) {
        const uint64_t weightsBad = c.section.table + uint64_t{1};
        const bool halves = c.kernel.kind == kHalfWords;
        if (halves) {
            addHalf("number of a row", row, 0, pool() - c.to);
            addHalf("weights of a row", row, 1, weightsBad, weightsBad <= 0xFFFFu);
        } else {
            add("number of a row", row, pool() - c.to);
            add("weights of a row", row + 1, weightsBad);
        }
        for (uint32_t k = 2; k < 2 * pairs + 2; ++k) {
            if (halves) {
                addHalf("vertex of a row", row, k, vertices - c.from);
            } else {
                add("vertex of a row", row + k, vertices - c.from);
            }
        }
    }

    void addPlain(const Construction& c) {
        if (c.kernel.kind == kPointsFan) {
            for (uint32_t i = 0; i < c.section.count; ++i) {
                const uint64_t word = uint64_t{4} * c.section.table + uint64_t{2} * i;
                add("first point of a fan", word, pool() - std::popcount(at(word + 1)) + 1);
                add("points that a fan makes", word + 1, uint64_t{1} << kFanPoints);
            }
        }
        for (uint32_t i = 0; c.kernel.kind == kFewFan && i < c.section.count; ++i) {
            const uint64_t word = uint64_t{4} * c.section.table + uint64_t{3} * i;
            add("slot of a plain vertex", word, at(word) + uint64_t{1});
            add("weights of a plain vertex", word + 1, elements());
            add("limit point of a plain vertex", word + 2, pool());
            add("faces of weights", uint64_t{4} * at(word + 1), 6); // kFewSpokes
        }
    }

    void addRing() {
        const uint64_t vertices = tables_.meshVertices == 0 ? made_.vertices : tables_.constructions[0].coefficients;
        for (uint64_t word = tables_.ring; word < tables_.ring + uint64_t{tables_.faces} - tables_.tangents; ++word) {
            numbers_.push_back({"element in the ring", word, elements(), kRingPlaceBits, 32 - kRingPlaceBits, true});
            const uint64_t element = SUPPLE_RING_ELEMENT(at(word));
            add("corner in the ring", 4 * element + SUPPLE_RING_PLACE(at(word), kRingFarEnd), vertices, true);
        }
    }

    void addChains(const Construction& c) {
        if (c.kernel.kind == kMakesLimits) {
            for (uint32_t i = 0; i < c.section.count; ++i) {
                addVertex(uint64_t{4} * c.section.table + uint64_t{8} * i);
            }
            return;
        }
        for (uint32_t i = 0; i < c.section.count / kBlockLanes; ++i) {
            const uint64_t word = uint64_t{4} * (c.section.table + uint64_t{i});
            const uint64_t fan = uint64_t{4} * at(word);
            add("fan of a block", word, at(word) + uint64_t{1});
            add("vertices of a block", word + 1, at(word + 1) + uint64_t{1});
            if (c.kernel.kind == kMakesChains) {
                add("number of vertices of a block", word + 2, kBlockPoints / at(fan + 1) + 1);
                add("last level of a block", word + 3, at(word + 3) + uint64_t{1});
            } else {
                const uint32_t count = at(word + 2) & ((1u << kChainLevelShift) - 1);
                numbers_.push_back({"number of vertices of a block", word + 2, vertices_ + uint64_t{1}, 0, 24, true});
                numbers_.push_back({"level of a block", word + 2, lastLevel() + 1, kChainLevelShift, 8, true});
                const uint32_t centres = c.kernel.kind == kMakesFirstLevel ? 0 : 1;
                add("item of a block", word + 3, count * uint64_t{at(fan) + at(fan + 2) + centres});
            }
        }
    }
    [[nodiscard]] uint64_t lastLevel() const {
        return tables_.rate == 0 ? 6 : std::max<uint64_t>(2, std::bit_width(tables_.rate - 1));
    }

    void addVertex(uint64_t record) {
        ++vertices_;
        const uint64_t fan = uint64_t{4} * at(record + 1), sectors = at(fan), open = at(fan + 2), net = at(record);
        const uint64_t each = isLoop() ? 1 : 2, chain = at(record + 4), ring = each * sectors + open;
        const uint64_t size = chain != 0 ? 1 + 3 * each * sectors + 2 * open : 1 + ring;
        const uint64_t chainPoints = at(fan + 1) * (lastLevel() - 1);
        add("net of a vertex", record, words());
        add("fan of a vertex", record + 1, elements());
        add("arrangement of a vertex", record + 2, elements());
        add("limit point of a vertex", record + 3, pool());
        if (chain != 0) {
            add("chain of a vertex", record + 4, pool() - chainPoints + 1);
        }
        add("normals of a vertex", record + 5, pool() - at(uint64_t{4} * at(record + 2)) + 1);
        add("first point of a vertex's net", record + 6, pool());
        add("centre of a vertex's chain", record + 7, chain + 1);
        for (uint32_t k = 0; k < size; ++k) {
            addHalf("point of a vertex's net", net, k, pool() - at(record + 6));
        }
        if (seen_.insert(fan).second) {
            add("sectors of a fan", fan, sectors + 1);
            add("points of a fan", fan + 1, at(fan + 1) + uint64_t{1});
            add("openness of a fan", fan + 2, 2);
        }
        const uint64_t arrangement = uint64_t{4} * at(record + 2);
        if (seen_.insert(arrangement).second) {
            addArrangement(arrangement, sectors + open, ring);
        }
    }

    void addArrangement(uint64_t word, uint64_t spokes, uint64_t ring) {
        add("runs of an arrangement", word, spokes + 1);
        add("sharpness of an arrangement", word + 1, words(), false); // all ones: there is none
        add("steps of an arrangement", word + 2, elements());
        add("ring of an arrangement", word + 3, ring + 1);
        for (uint64_t step = at(word + 2); step < at(word + 2) + lastLevel() - 1; ++step) {
            add("first spoke of a step", 4 * step + 2, spokes);
            add("second spoke of a step", 4 * step + 3, spokes);
        }
        uint64_t run = word + 4;
        for (uint32_t r = 0; r < at(word); ++r) {
            add("blocks of a run", run, 2 * spokes + 1);
            run += 4 + 4 * at(run) * ring;
        }
    }

    void addPatch(uint64_t element, PatchClass patchClass) {
        const uint64_t record = 4 * element;
        if (isLoop()) {
            for (uint32_t k = 0; k < kLeafPoints + 3; ++k) {
                add(k < kLeafPoints ? "vertex of a triangle" : "limit point of a triangle", record + k, pool());
            }
            if (patchClass != PatchClass::loopRegular) {
                addLeaves(record + 4 * kTriangleChainElement, record + 4 * kTriangleChainElement + 4,
                          record + 4 * kTriangleNetElement, true);
            }
            return;
        }
        for (uint32_t k = 0; k < 4; ++k) {
            add("limit point of a quad", record + k, pool());
        }
        if (patchClass == PatchClass::regular) {
            for (uint32_t k = 4; k < 8; ++k) {
                numbers_.push_back({"spoke of a quad", record + k, pool() - tables_.faces, 0, kSpokeBits, true});
            }
            return;
        }
        addLeaves(record + 4, record + 4 * kQuadNetListElement, record + 4 * kQuadNetElement, true);
        const uint64_t net = record + 4 * kQuadNetElement, last = net + kNetListLastWord;
        addHalf("whether a quad has sharpness", net, kNetListSharp, half(net, kNetListSharp) ^ 1u);
        for (uint32_t i = 0; i < 4; ++i) {
            if (half(net, kNetListNormals + i) != 0 || half(net, kNetListNormals + (i + 1) % 4) != 0) {
                numbers_.push_back({"cubic side of a quad", last, 1, kCubicSide + i, 1, true});
            }
        }
    }

    void addUvs(uint64_t element) {
        const uint64_t record = 4 * element;
        for (uint32_t k = 0; k < (isLoop() ? 3u : 4u); ++k) {
            add("limit point of texture coordinates", record + k, words() / 2);
        }
        const uint64_t chains = record + 4;
        const uint64_t net = isLoop() ? record + 12 : record + 4 * kQuadNetElement;
        addLeaves(chains, chains + 4, net, false);
        if (!isLoop()) {
            addHalf("whether texture coordinates have sharpness", net, kNetListSharp, 0);
        }
        for (uint32_t i = 0; i < (isLoop() ? 3u : 4u); ++i) {
            if (isLoop()) {
                numbers_.push_back(
                    {"whole side of texture coordinates", record + 3, 1, kWholeTriangleSide + i, 1, true});
            } else {
                numbers_.push_back(
                    {"cubic side of texture coordinates", net + kNetListLastWord, 1, kCubicSide + i, 1, true});
            }
        }
    }

    /// What corners have, and the net: of positions, or texture coordinates.
    void addLeaves(uint64_t chains, uint64_t netLists, uint64_t net, bool positions) {
        const uint32_t points = isLoop() ? kTriangleNetPoints : kNetPoints;
        const uint32_t normals = isLoop() ? kTriangleNetListNormals : kNetListNormals;
        const uint64_t lastWord = isLoop() ? kTriangleNetListLastWord : kNetListLastWord;
        const uint64_t last = net + lastWord, limit = positions ? pool() : words() / 2;
        const uint32_t shift = isLoop() ? 0 : kNetFirstShift;
        const uint64_t first = at(last) >> shift;
        numbers_.push_back({"first point of a net", last, limit, shift, 32 - shift, true});
        for (uint32_t k = 0; k < points; ++k) {
            addHalf("point of a net", net, k, limit - first, limit - first <= 0xFFFFu);
        }
        for (uint32_t i = 0; i < (isLoop() ? 3u : 4u); ++i) {
            const uint64_t netList = at(netLists + i), chain = at(chains + i);
            if (half(net, normals + i) != 0) {
                addHalf("normal of a corner", net, normals + i, chain + 1, chain < 0xFFFFu);
            } else {
                addHalf("normal that a corner has not", net, normals + i, 1, false);
            }
            if (netList != 0) {
                add("netList of a corner", netLists + i, elements());
                const uint64_t size = at(4 * netList + lastWord) & ((1u << kChainLevelShift) - 1);
                add("chain of a corner", chains + i, limit - size * (lastLevel() - 1) + 1);
                addNetList(4 * netList, points, size, lastWord);
            } else if (half(net, normals + i) != 0) {
                add("place of a corner's normal", chains + i, limit + half(net, normals + i));
            } else if (positions && !isLoop()) {
                numbers_.push_back({"spoke of a corner", chains + i, limit - tables_.faces, 0, kSpokeBits, true});
            }
        }
    }
    void addNetList(uint64_t netList, uint32_t points, uint64_t size, uint64_t lastWord) {
        if (!seen_.insert(netList).second) {
            return;
        }
        for (uint32_t k = 0; k < points; ++k) {
            addHalf("point of a netList", netList, k, size);
        }
        numbers_.push_back({"points of a level", netList + lastWord, 0, 0, kChainLevelShift, true}); // none
        numbers_.push_back({"last level", netList + lastWord, lastLevel() + 1, kChainLevelShift, 8, true});
    }

    const ExactTables& made_;
    const Tables& tables_;
    std::vector<Number> numbers_;
    uint32_t vertices_ = 0;   ///< with records
    std::set<uint64_t> seen_; ///< first words of fans, arrangements and net lists
};

/// Changes the numbers one by one. Which kinds of them there were.
std::set<std::string> expectChecked(const ExactTables& made) {
    const Status untouched = made.check();
    EXPECT_TRUE(untouched) << untouched.error().message;
    std::set<std::string> kinds;
    std::set<std::string> wrong;
    Tables tables = made.tables;
    for (const Number& number : NumberList(made).list()) {
        uint32_t& word = tables.words[number.word];
        const uint32_t before = word;
        const auto set = [&](uint64_t value) {
            const uint32_t mask = static_cast<uint32_t>(number.most() << number.shift);
            word = (before & ~mask) | static_cast<uint32_t>(value << number.shift);
            if (made.check(tables) && wrong.insert(number.what).second) {
                ADD_FAILURE() << number.what << ": word " << number.word << " was " << before << ", " << value
                              << " is not refused";
            }
            word = before;
        };
        if (number.bad <= number.most()) {
            set(number.bad);
            kinds.insert(number.what);
        }
        if (number.allOnes) {
            set(number.most());
            kinds.insert(number.what);
        }
    }
    return kinds;
}

surface::Recipe recipeOf(SchemeId scheme, bool wide, bool lod) {
    surface::Recipe recipe;
    recipe.scheme = scheme;
    recipe.wide = wide;
    recipe.lod = lod;
    recipe.uvMode = cage::UvMode::cornersOnly;
    return recipe;
}

/// Over all cages, in both mappings, for a rate and for levels.
std::set<std::string> expectAllChecked(SchemeId scheme, const std::vector<cage::Cage>& cages) {
    std::set<std::string> kinds;
    for (const cage::Cage& cage : cages) {
        for (const bool wide : {false, true}) {
            for (const bool lod : {false, true}) {
                const Result<ExactTables> made = makeExactTables(recipeOf(scheme, wide, lod), 8, cage);
                EXPECT_TRUE(made);
                if (made) {
                    kinds.merge(expectChecked(*made));
                }
            }
        }
    }
    return kinds;
}

TEST(ExactTableWords, QuadsOfCatmullClark) {
    const std::set<std::string> kinds =
        expectAllChecked(SchemeId::catmullClark, {withCharts(withCreases(withoutFaces(jack(), {0, 9}), true), true),
                                                  withCharts(gyroBipyramid(5)), straightCrease()});
    EXPECT_EQ(kinds.size(), 58u) << "all that the list has for quads";
}

TEST(ExactTableWords, TrianglesOfLoop) {
    const std::set<std::string> kinds = expectAllChecked(
        SchemeId::loop, {withCharts(withCreases(withoutFaces(quartered(gyroBipyramid(5)), {3}), false), true), cube()});
    EXPECT_EQ(kinds.size(), 45u) << "all that the list has for triangles";
}

} // namespace
} // namespace supple::test
