#include "tests/surface/table_words.h"

#include "shaders/shared/lod.h"
#include "shaders/shared/pm.h"
#include "shaders/shared/polygons.h"
#include "shaders/shared/prep.h"
#include "surface/patch_class.h"
#include "surface/patch_records.h"
#include "tests/surface/table_words_parts.h"

#include <algorithm>
#include <set>

namespace supple::test {
namespace {

using namespace shared;
using namespace surface;

constexpr uint32_t kAll = 0xFFFFFFFFu;

class Words {
public:
    Words(const Tables& tables, const TableSource& source)
        : tables_(tables), source_(source), pool_(tables.poolStride),
          elements_(static_cast<uint32_t>(tables.words.size() / 4)), slots_(tables.faces - tables.tangents) {}

    std::vector<IndexWord> list() {
        const bool polygons = source_.recipe.scheme == SchemeId::polygons;
        addHeader();
        addOwn(source_.recipe.scheme);
        if (source_.recipe.attributes && !polygons) {
            addCornerAttributes();
        }
        addMesh();
        addLevels();
        return std::move(words_);
    }

private:
    /// None may be another than it is.
    void addHeader() {
        for (uint32_t word = 0; word < kTableHeaderWords; ++word) {
            words_.push_back({"header", word, {tables_.words[word] + 1, kAll}});
        }
    }
    /// What is the scheme's own.
    void addOwn(SchemeId scheme) {
        WordList list(tables_, words_);
        if (scheme == SchemeId::blend) {
            addBlendWords(list, source_);
            return;
        }
        if (scheme == SchemeId::fragments || scheme == SchemeId::loopFragments) {
            addFragmentWords(list, source_);
            return;
        }
        for (const PatchRange& range : tables_.ranges) {
            addRange(range);
        }
        for (const Construction& construction : tables_.constructions) {
            addConstruction(construction);
        }
        if (scheme == SchemeId::polygons) {
            addSurfaceVertices();
        } else {
            addRing();
        }
    }

    [[nodiscard]] uint32_t at(size_t word) const { return tables_.words[word]; }
    void add(const char* what, size_t word, std::vector<uint32_t> bad) {
        words_.push_back({what, word, std::move(bad)});
    }
    /// An index below a limit.
    void addIndex(const char* what, size_t word, uint64_t limit) {
        add(what, word, {kAll, static_cast<uint32_t>(limit)});
    }

    /// A spoke and the step to the next one: neither may lead out of tangents and face coefficients.
    void addSpoke(const char* what, size_t word) {
        const uint32_t mask = kMaxSpokes - 1, past = pool_ - tables_.faces, spoke = at(word) & mask;
        std::vector<uint32_t> bad{(at(word) & ~mask) | mask, (at(word) & ~mask) | past, (past - 1) | 1u << kSpokeBits};
        if (spoke < 512) {
            bad.push_back(spoke | 512u << kSpokeBits); // 512 down
        }
        add(what, word, bad);
    }
    /// In the low bits of a word.
    void addPoint(const char* what, size_t word, uint32_t bits) {
        const uint32_t mask = (1u << bits) - 1;
        add(what, word, {at(word) | mask, (at(word) & ~mask) | pool_});
    }

    void addRange(const PatchRange& range) {
        const uint32_t each = recordElements(tables_, range.patchClass);
        for (uint32_t p = 0; p < range.section.count; ++p) {
            const size_t first = size_t{4} * (range.section.table + p * each);
            if (rowOf(range.patchClass).hasSectors()) {
                addSectorPatch(first, cornerCount(domainOf(range.patchClass)));
            } else {
                addBicubicPatch(first, range.patchClass);
            }
            for (size_t i = 0; tables_.cornerNormals && i < 4; ++i) {
                add("corner normal", first + size_t{4} * (each - 1) + i, {kNoNormal - 1, pool_});
            }
        }
    }
    void addBicubicPatch(size_t first, PatchClass patchClass) {
        const bool polar = patchClass == PatchClass::polar;
        for (size_t i = 0; i < (polar ? 3 : 4); ++i) {
            addIndex("limit point", first + i, pool_);
            addSpoke("spoke", first + 4 + i);
        }
        if (polar) {
            add("inner coefficients", first + 3, {kAll, pool_, pool_ - 1});
            addIndex("apex", first + 7, elements_);
            add("crease sets of an apex", size_t{4} * at(first + 7) + 3,
                {kMaxCreaseSets + 1, (kMaxCreaseSets + 1) << kBackSetShift, kAll});
        }
        for (size_t i = 8; patchClass == PatchClass::perturbed && i < 12; ++i) {
            const uint32_t flags = at(first + i) & ~kEdgeOfPatchMask;
            add("perturbation", first + i, {kAll, flags | pool_, flags | (pool_ - 3)});
        }
    }
    void addSectorPatch(size_t first, uint32_t m) {
        for (uint32_t i = 0; i < m; ++i) {
            const size_t point = first + SUPPLE_PM_POINT_WORD(i), spoke = first + SUPPLE_PM_SPOKE_WORD(i);
            addPoint("limit point", point, kPointBits);
            if (SUPPLE_SPOKE(at(spoke)) + tables_.faces < 512) { // the step to the spoke across
                words_.back().bad.push_back((at(point) & (kMaxSpokes - 1)) | 512u << kSpokeBits);
            }
            addSpoke("spoke", spoke);
            const size_t word = first + SUPPLE_PM_CLASS_WORD(m, i);
            const uint32_t shift = kEdgeClassBits * (i % 3), mask = (kMaxPmEdgeClasses - 1) << shift;
            const uint32_t limit = (elements_ - tables_.edgeClasses) / 2;
            add("edge class", word, {});
            if (limit < kMaxPmEdgeClasses) {
                words_.back().bad = {at(word) | mask, (at(word) & ~mask) | limit << shift};
            }
        }
        const size_t inner = first + SUPPLE_PM_INNER_WORD(m);
        addPoint("inner coefficients", inner, kInnerBits);
        words_.back().bad.push_back((at(inner) & ~((1u << kInnerBits) - 1)) | (pool_ - 3 * m));
    }

    void addConstruction(const Construction& construction) {
        const size_t first = size_t{4} * construction.section.table, count = construction.section.count;
        const uint32_t kind = construction.kernel.kind;
        switch (construction.kernel.kernel) {
        case Kernel::prepVertex:
        case Kernel::pmVertex: {
            const size_t each = construction.kernel.kernel == Kernel::pmVertex ? 3 : 2;
            for (size_t r = 0; kind != kRegularFan && r < count; ++r) {
                addFan(first + each * r, each, kind == kCreasedFan || kind == kVariableFan);
            }
            break;
        }
        case Kernel::prepEdge:
            for (size_t r = 0; r < count; ++r) {
                addPerturbedEdge(first + 4 * r);
            }
            break;
        case Kernel::polygonsFace:
            for (size_t r = 0; r < count; ++r) {
                kind == kLongFaces ? addLongFace(first + 4 * r) : addShortFace(first + 4 * r);
            }
            break;
        case Kernel::polygonsFrame:
            for (size_t r = 0; r < count; ++r) {
                addFrame(first + 4 * r);
            }
            break;
        default: // the facets of P_m are patches
            break;
        }
    }
    void addFan(size_t record, size_t words, bool creased) {
        add("first spoke", record, {kAll, slots_, at(record) + 1});
        addIndex("fan weights", record + 1, elements_);
        if (words == 3) {
            addIndex("limit point", record + 2, pool_);
        }
        const size_t weights = size_t{4} * at(record + 1);
        if (!known_.insert(weights).second) {
            return;
        }
        const uint32_t head = at(weights);
        add("fan", weights, {creased ? head | kSectorFacets : kAll, 0, head + 1});
        if (creased && (head & kOwnEndsSector) != 0) {
            const uint32_t spokes = (head & kSectorFacets) + ((head & kOpenSector) != 0 ? 1 : 0);
            addIndex("other spoke of a curve", weights + size_t{4} * (1 + spokes), slots_ + 1);
            addIndex("other spoke of a curve", weights + size_t{4} * (2 + spokes), slots_ + 1);
        }
    }
    void addPerturbedEdge(size_t record) {
        for (const size_t end : {record, record + 2}) {
            addPoint("end", end, kPointBits);
            addSpoke("spoke of an edge", end + 1);
        }
        words_[words_.size() - 4].bad.push_back(at(record) | ~0u << kPointBits); // the edge's class
        words_[words_.size() - 2].bad.push_back(at(record + 2) | ~0u << kPointBits);
    }
    void addShortFace(size_t record) {
        for (size_t i = 0; i < 4; ++i) {
            addIndex("vertex of a face", record + i, source_.vertices);
        }
    }
    void addLongFace(size_t record) {
        add("vertices of a long face", record, {kAll, 4 * elements_});
        add("count of vertices", record + 1, {kAll, 0, 1, 4 * elements_});
        addIndex("number of a long face", record + 2, pool_);
        for (size_t i = 0; i < at(record + 1); ++i) {
            addIndex("vertex of a long face", at(record) + i, source_.vertices);
        }
    }
    void addFrame(size_t record) {
        addIndex("vertex of a frame", record, source_.vertices);
        addIndex("vertex of its tangent", record + 1, source_.vertices);
        add("faces of a frame", record + 2, {kAll, 4 * elements_ + 1});
        add("count of faces", record + 3, {kAll, 4 * elements_});
        for (size_t i = 0; i < at(record + 3); ++i) {
            addIndex("face of a frame", at(record + 2) + i, pool_);
        }
    }

    void addSurfaceVertices() {
        const Section& vertices = tables_.triangles.vertices;
        for (size_t v = 0; v < vertices.count; ++v) {
            add("frame of a vertex", size_t{4} * (vertices.table + v), {kAll, pool_, pool_ - 2});
        }
    }

    /// The words, and the facets that are no patches.
    void addRing() {
        std::set<uint32_t> facets;
        for (size_t slot = 0; slot < slots_; ++slot) {
            const size_t word = tables_.ring + slot;
            add("ring", word, {kAll, elements_ << kRingPlaceBits});
            const uint32_t facet = SUPPLE_RING_ELEMENT(at(word));
            const bool isPatch =
                std::any_of(tables_.ranges.begin(), tables_.ranges.end(), [&](const PatchRange& range) {
                    return facet - range.section.table <
                           range.section.count * recordElements(tables_, range.patchClass);
                });
            for (uint32_t i = 0; !isPatch && i < 4 && facets.insert(4 * facet + i).second; ++i) {
                add("corner of a facet", size_t{4} * facet + i, {(1u << kPointBits) - 1, source_.vertices});
            }
        }
    }

    void addCornerAttributes() {
        const uint32_t end = tables_.ranges.front().attributes / 4, each = tables_.cornerElements();
        const uint32_t count = (end - tables_.attributes) / each;
        for (const PatchRange& range : tables_.ranges) {
            const uint32_t corners = cornerCount(domainOf(range.patchClass)) * range.section.count;
            for (size_t i = 0; i < corners; i += tables_.attributeHalves ? 2 : 1) {
                const size_t word = range.attributes + (tables_.attributeHalves ? i / 2 : i);
                if (tables_.attributeHalves) {
                    const uint32_t low = at(word) & 0xFFFFu, high = at(word) >> 16;
                    add("attributes of a corner", word,
                        {at(word) | 0xFFFFu, at(word) | 0xFFFF0000u, count | high << 16, low | count << 16});
                } else {
                    addIndex("attributes of a corner", word, count);
                }
            }
        }
        for (uint32_t i = 0; tables_.mapFrames && i < count; ++i) {
            addIndex("UV set", size_t{4} * (tables_.attributes + each * i + each - 1) + 3, 2);
        }
    }

    void addMesh() {
        const MeshTables& mesh = tables_.mesh;
        for (const MeshTables::Edges& edges : mesh.edges) {
            for (size_t e = 0; e < edges.section.count; ++e) {
                addMeshEdge(size_t{4} * (edges.section.table + kEdgeElements * e), edges.kind);
            }
        }
        for (size_t e = 0; e < mesh.attributes.count; ++e) {
            const size_t first = size_t{4} * (mesh.attributes.table + e);
            addIndex("numbers of an edge", first, 4 * elements_);
            const uint32_t form = at(first + 1), mask = kPatchSideMask;
            const uint32_t corners = form >> kPatchCornersShift & mask;
            add("form of an edge", first + 1,
                {kAll, form | mask, (form & ~mask) | corners, form & ~(mask << kPatchCornersShift),
                 form | 2u << kPatchHalfShift});
            addIndex("curves of an edge", first + 2, elements_);
        }
    }
    void addMeshEdge(size_t first, uint32_t kind) {
        for (size_t i = 0; i < 8; ++i) {
            addIndex("coefficient of an edge", first + i, pool_);
        }
        add("corner", first + 8, {kNoEdgeSample - 1, tables_.mesh.cornerCount});
        addIndex("edge", first + 9, tables_.mesh.edgeCount);
        // Flags lead nowhere, but tell whether the next word does.
        const uint32_t flags = at(first + 10);
        const bool singular = kind == kMixedEdges && (flags & kSingularEdge) != 0;
        add("flags of an edge", first + 10, {});
        add("extra word of an edge", first + 11, {});
        if (kind == kPerturbedEdges) {
            words_.back().bad = {kAll, pool_, pool_ - 3};
        } else if (singular || (tables_.cornerNormals && (flags & kStoredNormalEdge) != 0)) {
            words_.back().bad = {kAll, pool_};
        }
    }

    void addLevels() {
        const LodTables& lod = tables_.lod;
        for (const LodTables::Edges& edges : lod.edges) {
            // Those between charts are the scheme's own.
            const size_t words = edges.borders == Borders::cubics ? size_t{4} * edges.section.count : 0;
            for (size_t i = 0; i < words; ++i) {
                addIndex("coefficient of an edge with levels", size_t{4} * edges.section.table + i, pool_);
            }
        }
        for (size_t p = 0; p < lod.patches.count; ++p) {
            const size_t first = size_t{4} * (lod.patches.table + 2 * p);
            for (size_t i = 0; i < kMaxSides; ++i) {
                addIndex("edge of a patch with levels", first + i, lod.edgeCount);
            }
            addIndex("run", first + 5, lod.runs.size());
            add("record", first + 6, {kAll, elements_, at(first + 6) + 1});
            add("class and part", first + 7, {kAll, at(first + 7) + 1, at(first + 7) | source_.parts << kLodPartShift});
        }
    }

    const Tables& tables_;
    const TableSource& source_;
    const uint32_t pool_, elements_, slots_;
    std::set<size_t> known_; ///< words at which weights begin
    std::vector<IndexWord> words_;
};

} // namespace

std::vector<IndexWord> indexWords(const Tables& tables, const TableSource& source) {
    return Words(tables, source).list();
}

} // namespace supple::test
