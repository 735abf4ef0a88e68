#include "shaders/shared/pm.h"
#include "shaders/shared/prep.h"
#include "surface/patch_records.h"
#include "surface/smooth_uvs.h"
#include "surface/table_check_common.h"

#include <algorithm>

namespace supple::surface {

namespace {

using namespace shared;

/// The three corners, the two coefficients in front of the apex, and the weights and crease sets that make these.
bool checkPolarPatch(TableCheck& check, std::span<const uint32_t> record) {
    bool fits = check.pool(record[3], 2) && check.elements(record[7], 1);
    const uint32_t sets = fits ? check.element(record[7])[3] : 0;
    fits = fits && check.require(std::max(sets & kAlphaSetMask, sets >> kBackSetShift) <= kMaxCreaseSets,
                                 "an apex of a crease set that there is not");
    for (uint32_t i = 0; i < 3; ++i) {
        fits = fits && checkPatchCorner(check, record[i], record[4 + i]);
    }
    return fits;
}

bool checkQuad(TableCheck& check, std::span<const uint32_t> record) {
    const Tables& tables = check.tables();
    uint32_t last = 0;
    for (const uint32_t spoke : record.subspan(4, 4)) {
        last = std::max({last, SUPPLE_SPOKE(spoke), nextSpoke(spoke)});
    }
    return check.poolAll(record.first(4)) && check.pool(uint64_t{tables.tangents} + last) &&
           check.pool(uint64_t{tables.faces} + last);
}

/// Four coefficients an edge.
bool checkPerturbation(TableCheck& check, std::span<const uint32_t> edges) {
    return check.pool(edges[0] & kEdgeOfPatchMask, 4) && check.pool(edges[1] & kEdgeOfPatchMask, 4) &&
           check.pool(edges[2] & kEdgeOfPatchMask, 4) && check.pool(edges[3] & kEdgeOfPatchMask, 4);
}

bool checkCornerNormals(TableCheck& check, std::span<const uint32_t> normals) {
    bool fits = true;
    for (const uint32_t normal : normals) {
        fits = fits && (normal == kNoNormal || check.pool(normal));
    }
    return fits;
}

void checkBicubicRange(TableCheck& check, const PatchRange& range) {
    const Tables& tables = check.tables();
    const uint32_t words = 4 * recordElements(tables, range.patchClass);
    bool fits = true;
    for (uint32_t p = 0; p < range.section.count && fits; ++p) {
        const auto record = std::span(tables.words).subspan(size_t{4} * range.section.table + size_t{words} * p, words);
        fits = range.patchClass == PatchClass::polar ? checkPolarPatch(check, record) : checkQuad(check, record);
        if (range.patchClass == PatchClass::perturbed) {
            fits = fits && checkPerturbation(check, record.subspan(8, 4));
        }
        if (tables.cornerNormals) {
            fits = fits && checkCornerNormals(check, record.last(4));
        }
    }
}

/// How many words hold the numbers of a range's corners.
uint64_t numberWords(const Tables& tables, const PatchRange& range) {
    const uint64_t corners = uint64_t{cornerCount(domainOf(range.patchClass))} * range.section.count;
    return tables.attributeHalves ? (corners + 1) / 2 : corners;
}

/// What corners have ends where their numbers begin.
uint64_t attributeCount(TableCheck& check) {
    const Tables& tables = check.tables();
    const uint32_t numbers = tables.ranges.front().attributes;
    if (!check.words(numbers, 0) || !check.within(tables.attributes, 0, numbers / 4, "elements")) {
        return 0;
    }
    return (numbers / 4 - tables.attributes) / tables.cornerElements();
}

void checkNumbers(TableCheck& check, const PatchRange& range, uint64_t attributes) {
    const Tables& tables = check.tables();
    const uint64_t count = numberWords(tables, range);
    if (!check.words(range.attributes, count)) {
        return;
    }
    for (const uint32_t word : std::span(tables.words).subspan(range.attributes, count)) {
        const bool fits = tables.attributeHalves ? check.within(word & 0xFFFFu, 1, attributes, "attributes") &&
                                                       check.within(word >> 16, 1, attributes, "attributes")
                                                 : check.within(word, 1, attributes, "attributes");
        if (!fits) {
            return;
        }
    }
}

/// The UV set of each frame. Linear texture coordinates of a set that the cage lacks are zero; smooth ones are not
/// there.
void checkMapFrames(TableCheck& check, uint64_t attributes) {
    const Tables& tables = check.tables();
    const uint32_t sets = tables.uvMode == cage::UvMode::all ? 2 : tables.uvSets, each = tables.cornerElements();
    for (uint64_t i = 0; i < attributes; ++i) {
        const uint64_t frame = tables.attributes + each * i + each - 1;
        if (!check.within(check.element(frame)[3], 1, sets, "UV sets")) {
            return;
        }
    }
}

} // namespace

bool checkPatchCorner(TableCheck& check, uint32_t point, uint32_t spokeWord) {
    const Tables& tables = check.tables();
    const uint64_t last = std::max(SUPPLE_SPOKE(spokeWord), nextSpoke(spokeWord));
    return check.pool(point) && check.pool(tables.tangents + last) && check.pool(tables.faces + last);
}

const PatchRange* rangeOfRecord(const Tables& tables, uint64_t element) {
    for (const PatchRange& range : tables.ranges) {
        const uint64_t each = recordElements(tables, range.patchClass), first = range.section.table;
        if (element >= first && element < first + each * range.section.count && (element - first) % each == 0) {
            return &range;
        }
    }
    return nullptr;
}

void checkBicubicPatches(TableCheck& check) {
    check.begin("patch records");
    for (const PatchRange& range : check.tables().ranges) {
        if (rowOf(range.patchClass).isBicubic()) {
            checkBicubicRange(check, range);
        }
    }
}

void checkCornerAttributes(TableCheck& check) {
    const Tables& tables = check.tables();
    if (!check.source().recipe.attributes || tables.ranges.empty()) {
        return;
    }
    check.begin("corner attributes");
    const uint64_t attributes = attributeCount(check);
    for (const PatchRange& range : tables.ranges) {
        checkNumbers(check, range, attributes);
    }
    if (tables.mapFrames) {
        check.begin("frames of normal maps");
        checkMapFrames(check, attributes);
    }
    check.begin("smooth texture coordinates");
    for (const PatchRange& range : tables.ranges) {
        if (tables.uvMode != cage::UvMode::all) {
            const uint64_t each = uint64_t{uvElements(tables, range.patchClass)} * tables.uvSets;
            check.elements(range.smoothUvs, each * range.section.count);
        }
    }
}

} // namespace supple::surface
