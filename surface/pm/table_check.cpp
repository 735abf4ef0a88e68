// Follows the tables of shaders/shared/pm.h as the kernels of shaders/pm do.
#include "surface/build.h"
#include "surface/pm/kernels.h"
#include "surface/table_check_common.h"

#include <algorithm>
#include <array>

namespace supple::surface::pm {

namespace {

using namespace shared;

bool checkSet(TableCheck& check, uint32_t set) {
    return check.require(set <= kMaxCreaseSets, "a spoke of a crease set that there is not");
}

/// How many spokes a creased or variable sector has; 0 if its weights do not fit. `slots`: of all sectors.
uint64_t checkCreasedWeights(TableCheck& check, uint32_t element, uint64_t slots, bool variable) {
    if (!check.elements(element, 1)) {
        return 0;
    }
    const uint32_t head = check.element(element)[0];
    const uint64_t facets = head & kSectorFacets, spokes = facets + ((head & kOpenSector) != 0 ? 1 : 0);
    const bool ownEnds = (head & kOwnEndsSector) != 0;
    if (!check.require(facets > 0, "a sector without facets") ||
        !check.elements(element, 1 + spokes + (ownEnds ? 2 : 0))) {
        return 0;
    }
    for (uint64_t spoke = 0; variable && spoke < spokes; ++spoke) {
        if (!checkSet(check, check.element(element + 1 + spoke)[3] & kAlphaSetMask)) {
            return 0;
        }
    }
    for (uint64_t end = 0; ownEnds && end < 2; ++end) {
        const uint32_t other = check.element(element + 1 + spokes + end)[0]; // 1 + slot, or 0
        if (other != 0 && !check.within(other - 1, 1, slots, "spokes")) {
            return 0;
        }
    }
    return spokes;
}

/// Records of three words: first slot, weights, limit point.
bool checkSectors(TableCheck& check, const Construction& construction, FanSlots& slots) {
    const uint64_t first = uint64_t{4} * construction.section.table, count = construction.section.count;
    if (!check.words(first, 3 * count)) {
        return false;
    }
    const bool variable = construction.kernel.kind == kVariableFan;
    const bool creased = construction.kernel.kind == kCreasedFan || variable;
    uint32_t known = 0; // weights, which neighbours have in common
    uint64_t spokes = 0;
    for (uint64_t word = first; word < first + 3 * count; word += 3) {
        const uint32_t weights = check.word(word + 1);
        if (creased || spokes == 0 || weights != known) {
            spokes = creased ? checkCreasedWeights(check, weights, slots.count(), variable)
                             : checkFanWeights(check, weights, kOpenSector);
            known = weights;
        }
        if (spokes == 0 || !slots.take(check.word(word), spokes) || !check.pool(check.word(word + 2))) {
            return false;
        }
    }
    return true;
}

void checkFans(TableCheck& check) {
    FanSlots slots(check, check.source().vertices);
    check.begin("sectors");
    for (const Construction& construction : check.tables().constructions) {
        if (construction.kernel.kernel != Kernel::pmVertex || check.failed()) {
            continue;
        }
        if (construction.kernel.kind == kRegularFan) {
            slots.takeRegular(construction.section.count);
        } else {
            checkSectors(check, construction, slots);
        }
    }
    slots.done();
}

/// The facet stage reads the records of all patches of a class, and has no others.
void checkFacets(TableCheck& check) {
    check.begin("facets");
    const auto& ranges = check.tables().ranges;
    for (const Construction& construction : check.tables().constructions) {
        if (construction.kernel.kernel != Kernel::pmFacet) {
            continue;
        }
        const auto own = std::find_if(ranges.begin(), ranges.end(), [&](const PatchRange& range) {
            return static_cast<uint32_t>(range.patchClass) == construction.kernel.kind;
        });
        check.require(own != ranges.end() && own->section.table == construction.section.table &&
                          own->section.count == construction.section.count,
                      "other records than those of the class");
    }
}

/// The record of a patch of m sectors.
bool checkSectorPatch(TableCheck& check, const uint32_t* record, uint32_t m) {
    const Tables& tables = check.tables();
    bool fits = check.pool(SUPPLE_INNER(record[SUPPLE_PM_INNER_WORD(m)]), 1 + uint64_t{3} * m);
    for (uint32_t i = 0; i < m && fits; ++i) {
        const uint32_t point = record[SUPPLE_PM_POINT_WORD(i)], spokes = record[SUPPLE_PM_SPOKE_WORD(i)];
        // The spoke whose facet lies across the edge.
        const uint32_t across = SUPPLE_SPOKE(spokes) + static_cast<uint32_t>(SUPPLE_ACROSS_STEP(point));
        const uint64_t edgeClass = SUPPLE_EDGE_CLASS(record[SUPPLE_PM_CLASS_WORD(m, i)], i);
        fits = checkPatchCorner(check, SUPPLE_POINT(point), spokes) && check.pool(uint64_t{tables.faces} + across) &&
               check.elements(tables.edgeClasses + 2 * edgeClass, 2);
    }
    return fits;
}

void checkSectorPatches(TableCheck& check) {
    check.begin("patch records");
    for (const PatchRange& range : check.tables().ranges) {
        const uint32_t m = cornerCount(domainOf(range.patchClass));
        if (!rowOf(range.patchClass).hasSectors()) {
            continue;
        }
        const size_t first = size_t{4} * range.section.table, words = size_t{4} * SUPPLE_PM_RECORD_ELEMENTS(m);
        for (size_t p = 0; p < range.section.count; ++p) {
            if (!checkSectorPatch(check, &check.tables().words[first + words * p], m)) {
                return;
            }
        }
    }
}

} // namespace

void check(TableCheck& check) {
    checkClasses(check, {PatchClass::regular, PatchClass::polar, PatchClass::p3, PatchClass::p4, PatchClass::p5});
    checkKernels(check, {{Stage::vertex, kVertexKernels}, {Stage::assemble, kFacetKernels}});
    for (void (*part)(TableCheck&) : {&checkFans, &checkFacets, &checkSectorPatches}) {
        if (!check.failed()) {
            part(check);
        }
    }
}

} // namespace supple::surface::pm
