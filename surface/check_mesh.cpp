#include "surface/smooth_uvs.h"
#include "surface/table_check_common.h"

#include <array>

namespace supple::surface {

namespace {

using namespace shared;

/// The side of the patch whose record an edge names. Kernels read it as one of a certain class.
bool checkSideOfRecord(TableCheck& check, uint32_t kind, std::span<const uint32_t> record) {
    const PatchRange* range = rangeOfRecord(check.tables(), record[0]);
    if (range == nullptr) {
        return check.require(false, "no record of a patch");
    }
    const bool fits = kind == kHalvesEdges              ? rowOf(range->patchClass).borders == Borders::halves
                      : kind == kTriangleEdges          ? range->patchClass == PatchClass::loopRegular
                      : kind == kIrregularTriangleEdges ? range->patchClass == PatchClass::loopIrregular
                                                        : range->patchClass == PatchClass::loopIrregularSharp;
    return check.require(fits, "a patch of another class") &&
           check.within(record[1], 1, cornerCount(domainOf(range->patchClass)), "sides");
}

/// The border's cubic, what lies inside, and what more the flags and the kind ask for.
bool checkCubicEdge(TableCheck& check, uint32_t kind, std::span<const uint32_t> record) {
    bool fits = check.poolAll(record.first(8));
    const uint32_t flags = record[10], extra = record[11];
    if (kind == kPerturbedEdges) {
        fits = fits && check.pool(extra, 4);
    }
    const bool singular = kind == kMixedEdges && (flags & kSingularEdge) != 0;
    const bool hasNormal = check.tables().cornerNormals && (flags & kStoredNormalEdge) != 0;
    return fits && (!(singular || hasNormal) || check.pool(extra));
}

bool checkEdge(TableCheck& check, uint32_t kind, std::span<const uint32_t> record) {
    const MeshTables& mesh = check.tables().mesh;
    return (record[8] == kNoEdgeSample || check.within(record[8], 1, mesh.cornerCount, "corners")) &&
           check.within(record[9], 1, mesh.edgeCount, "edges") &&
           (kind < kHalvesEdges ? checkCubicEdge(check, kind, record) : checkSideOfRecord(check, kind, record));
}

/// Sections follow each other: attributes count through them. Their edges are all there are.
void checkEdges(TableCheck& check) {
    check.begin("edges of the indexed mesh");
    const Tables& tables = check.tables();
    const MeshTables& mesh = tables.mesh;
    uint64_t next = mesh.edges.front().section.table, count = 0;
    for (const MeshTables::Edges& edges : mesh.edges) {
        const uint64_t size = uint64_t{kEdgeElements} * edges.section.count;
        if (!check.within(edges.kind, 1, kEdgeKinds, "kinds") ||
            !check.require(edges.section.table == next && size > 0, "they do not follow each other") ||
            !check.elements(next, size)) {
            return;
        }
        for (uint64_t element = next; element < next + size; element += kEdgeElements) {
            const std::span record = std::span(tables.words).subspan(4 * element, size_t{4} * kEdgeElements);
            if (!checkEdge(check, edges.kind, record)) {
                return;
            }
        }
        next += size;
        count += edges.section.count;
    }
    // Each edge has a record, and each corner's sample is that of an edge.
    check.require(count == mesh.edgeCount && mesh.cornerCount <= count, "another number of edges or corners");
}

void checkMeshPatches(TableCheck& check) {
    check.begin("patches of the indexed mesh");
    const Tables& tables = check.tables();
    const MeshTables& mesh = tables.mesh;
    bool fits = check.require(mesh.patches.size() == tables.patches.size(), "another number of patches");
    for (size_t p = 0; p < mesh.patches.size() && fits; ++p) {
        for (uint32_t i = 0; i < tables.patches[p].cornerCount && fits; ++i) {
            fits = check.within(mesh.patches[p].edges[i], 1, mesh.edgeCount, "edges") &&
                   check.within(mesh.patches[p].corners[i], 1, mesh.cornerCount, "corners");
        }
    }
}

/// The range that has the numbers of an edge's patch, and the first of these.
struct PlaceOfNumbers {
    const PatchRange* range = nullptr;
    uint64_t place = 0;
};
PlaceOfNumbers placeOfNumbers(const Tables& tables, uint32_t word, uint32_t half) {
    for (const PatchRange& range : tables.ranges) {
        const uint64_t perWord = tables.attributeHalves ? 2 : 1;
        const uint64_t place = perWord * (word - uint64_t{range.attributes}) + half;
        if (word >= range.attributes && half < perWord &&
            place < uint64_t{cornerCount(domainOf(range.patchClass))} * range.section.count) {
            return {&range, place};
        }
    }
    return {};
}

/// An edge's attributes are those of a patch that has it: the numbers of its corners and what is smooth.
bool checkEdgeAttributes(TableCheck& check, std::span<const uint32_t> element) {
    const Tables& tables = check.tables();
    const uint32_t form = element[1], side = form & kPatchSideMask;
    const auto [range, place] = placeOfNumbers(tables, element[0], form >> kPatchHalfShift);
    if (range == nullptr) {
        return check.require(false, "no numbers of corners");
    }
    const uint32_t corners = cornerCount(domainOf(range->patchClass));
    if (!check.require((form >> kPatchCornersShift & kPatchSideMask) == corners && place % corners == 0,
                       "no patch's corners") ||
        !check.within(side, 1, corners, "sides")) {
        return false;
    }
    if (tables.uvLeaves) {
        const uint64_t each = uint64_t{uvElements(tables, range->patchClass)} * tables.uvSets;
        return check.require(element[2] == range->smoothUvs + each * (place / corners), "another patch's leaves");
    }
    return element[2] == 0 || check.elements(element[2], uint64_t{kUvCurveElements} * tables.uvSets);
}

void checkAllEdgeAttributes(TableCheck& check) {
    check.begin("attributes of edges");
    const Section& attributes = check.tables().mesh.attributes;
    const uint32_t count = check.source().recipe.attributes ? check.tables().mesh.edgeCount : 0;
    if (!check.require(attributes.count == count, "another number of edges") ||
        !check.elements(attributes.table, count)) {
        return;
    }
    for (uint64_t element = attributes.table; element < uint64_t{attributes.table} + count; ++element) {
        if (!checkEdgeAttributes(check, check.element(element))) {
            return;
        }
    }
}

} // namespace

void checkIndexedMesh(TableCheck& check) {
    const MeshTables& mesh = check.tables().mesh;
    const Recipe& recipe = check.source().recipe;
    check.begin("indexed mesh");
    if (mesh.edges.empty()) {
        check.require(mesh.patches.empty() && mesh.edgeCount == 0 && mesh.cornerCount == 0 &&
                          mesh.attributes.count == 0 && !mesh.tangents,
                      "parts of one that is not there");
        return;
    }
    check.require(mesh.tangents == (recipe.attributes && recipe.tangents), "tangents not as the recipe says");
    checkEdges(check);
    checkMeshPatches(check);
    checkAllEdgeAttributes(check);
}

} // namespace supple::surface
