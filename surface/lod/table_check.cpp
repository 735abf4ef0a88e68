#include "surface/lod/table_check.h"

#include "shaders/shared/blend.h"
#include "shaders/shared/lod.h"
#include "surface/patch_records.h"
#include "surface/table_check_common.h"

#include <algorithm>
#include <array>

namespace supple::surface::lod {

namespace {

/// A side of a patch whose curve is no cubic.
bool checkSide(TableCheck& check, Borders borders, std::span<const uint32_t> edge) {
    const PatchRange* range = rangeOfRecord(check.tables(), edge[0]);
    if (range == nullptr) {
        return check.require(false, "no record of a patch");
    }
    const bool irregular = range->patchClass == PatchClass::loopIrregular,
               sharp = range->patchClass == PatchClass::loopIrregularSharp;
    const bool fits = borders == Borders::splineHalves  ? irregular || sharp
                      : borders == Borders::sharpHalves ? sharp
                                                        : rowOf(range->patchClass).borders == borders;
    return check.require(fits, "a patch of another class") &&
           check.within(edge[1], 1, cornerCount(domainOf(range->patchClass)), "sides");
}

/// An edge between charts has both of them.
uint32_t elementsOf(Borders borders) {
    return borders == Borders::charts ? 2 : 1;
}

bool checkLevelEdge(TableCheck& check, Borders borders, std::span<const uint32_t> edge) {
    if (borders == Borders::charts) {
        return check.pool(edge[0] & shared::kPoolIndexMask, shared::kChartCoefficients) &&
               check.pool(edge[4] & shared::kPoolIndexMask, shared::kChartCoefficients);
    }
    if (borders != Borders::cubics) {
        return checkSide(check, borders, edge);
    }
    return check.poolAll(edge);
}

void checkLevelEdges(TableCheck& check) {
    check.begin("edges with levels");
    const Tables& tables = check.tables();
    const LodTables& lod = tables.lod;
    uint64_t next = 0, element = lod.edges.front().section.table;
    for (const LodTables::Edges& edges : lod.edges) {
        const Section& section = edges.section;
        const uint32_t each = elementsOf(edges.borders);
        if (!check.require(edges.borders <= Borders::charts &&
                               (edges.borders == Borders::charts) == (lod.borders == Borders::charts),
                           "a kind of other patches") ||
            !check.require(edges.first == next && section.table == element && section.count > 0,
                           "they do not follow each other") ||
            !check.elements(element, uint64_t{each} * section.count)) {
            return;
        }
        for (uint64_t e = 0; e < section.count; ++e, element += each) {
            if (!checkLevelEdge(check, edges.borders, std::span(tables.words).subspan(4 * element, size_t{4} * each))) {
                return;
            }
        }
        next += section.count;
    }
    check.require(next == lod.edgeCount, "another number of edges");
}

void checkRuns(TableCheck& check) {
    check.begin("runs of patches");
    const Tables& tables = check.tables();
    uint64_t next = 0;
    for (const LodTables::PatchRun& run : tables.lod.runs) {
        if (!check.require(run.patchCount > 0, "an empty one") ||
            !check.within(next, run.patchCount, tables.patches.size(), "patches")) {
            return;
        }
        for (const uint64_t end = next + run.patchCount; next < end; ++next) {
            const PatchInfo& patch = tables.patches[next];
            if (!check.require(patch.patchClass == run.patchClass && patch.material == run.material,
                               "a patch of another class or material")) {
                return;
            }
        }
    }
    check.require(next == tables.patches.size(), "they do not have all patches");
}

/// What a patch's record with levels must be, but for its edges.
bool checkLevelPatch(TableCheck& check, uint32_t patch, uint32_t run, uint64_t record) {
    const Tables& tables = check.tables();
    const uint64_t element = tables.lod.patches.table + uint64_t{2} * patch;
    const PatchInfo& info = tables.patches[patch];
    const uint32_t kind = static_cast<uint32_t>(info.patchClass) | info.part << shared::kLodPartShift;
    const std::span<const uint32_t> edges = check.element(element), more = check.element(element + 1);
    bool fits = check.within(more[0], 1, tables.lod.edgeCount, "edges");
    for (const uint32_t edge : edges) {
        fits = fits && check.within(edge, 1, tables.lod.edgeCount, "edges");
    }
    return fits && check.require(more[1] == run, "another run") && check.require(more[2] == record, "another record") &&
           check.require(more[3] == kind, "another class or part");
}

void checkLevelPatches(TableCheck& check) {
    check.begin("patches with levels");
    const Tables& tables = check.tables();
    const LodTables& lod = tables.lod;
    if (!check.require(lod.patches.count == tables.patches.size(), "another number of patches") ||
        !check.elements(lod.patches.table, uint64_t{2} * lod.patches.count)) {
        return;
    }
    uint32_t run = 0, inRun = 0;
    for (const PatchRange& range : tables.ranges) {
        uint64_t record = range.section.table;
        const uint32_t each = recordElements(tables, range.patchClass);
        for (uint32_t p = 0; p < range.section.count; ++p, record += each, ++inRun) {
            if (inRun == lod.runs[run].patchCount) {
                ++run;
                inRun = 0;
            }
            if (!checkLevelPatch(check, range.firstPatch + p, run, record)) {
                return;
            }
        }
    }
}

/// Dispatches of a depth have as many lanes as its construction, for each instance.
void checkDepths(TableCheck& check) {
    check.begin("depths of chains");
    const Tables& tables = check.tables();
    std::array<uint32_t, shared::kDepths> lanes{};
    size_t depths = 0;
    for (const Construction& construction : tables.constructions) {
        if (construction.stage != Stage::deepen) {
            continue;
        }
        if (!check.require(depths < lanes.size(), "too many")) {
            return;
        }
        lanes[depths++] = construction.section.count;
    }
    if (tables.lod.depth == 0) {
        check.require(depths == 0, "levels of chains without the last of them");
        return;
    }
    const auto areOurs = [&](std::span<const uint32_t> element) {
        return std::equal(element.begin(), element.end(), lanes.begin(), lanes.end());
    };
    (void)(check.pool(tables.lod.depth) && check.elements(tables.lod.depthLanes, 1) &&
           check.require(areOurs(check.element(tables.lod.depthLanes)), "other lanes"));
}

} // namespace

void checkLevels(TableCheck& check) {
    const Tables& tables = check.tables();
    const LodTables& lod = tables.lod;
    check.begin("levels of detail");
    if (lod.edges.empty()) {
        check.require(lod.edgeCount == 0 && lod.patches.count == 0 && lod.runs.empty() && lod.depth == 0 &&
                          lod.borders == Borders::cubics && !tables.has(Stage::deepen),
                      "parts of what is not there");
        return;
    }
    Borders most = Borders::cubics;
    for (const PatchRange& range : tables.ranges) {
        most = std::max(most, rowOf(range.patchClass).borders);
    }
    check.require(lod.borders == most, "borders of other patches");
    for (void (*part)(TableCheck&) : {&checkLevelEdges, &checkRuns, &checkLevelPatches, &checkDepths}) {
        if (!check.failed()) {
            part(check);
        }
    }
}

} // namespace supple::surface::lod
