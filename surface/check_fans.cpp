#include "surface/table_check_common.h"

#include <algorithm>

namespace supple::surface {

namespace {

using namespace shared;

/// A word of the ring: of the facet the vertex itself, the far end and the two far corners.
bool checkRingWord(TableCheck& check, uint32_t word, uint64_t vertices) {
    const uint32_t facet = SUPPLE_RING_ELEMENT(word);
    if (!check.elements(facet, 1)) {
        return false;
    }
    const uint32_t* corners = &check.tables().words[size_t{4} * facet];
    const auto vertex = [&](uint32_t which) { return SUPPLE_POINT(corners[SUPPLE_RING_PLACE(word, which)]); };
    return check.within(
        std::max({vertex(kRingVertex), vertex(kRingFarEnd), vertex(kRingFarCorner), vertex(kRingOtherCorner)}), 1,
        vertices, "vertices");
}

} // namespace

FanSlots::FanSlots(TableCheck& check, uint64_t vertices) : check_(check) {
    const Tables& tables = check.tables();
    check.begin("ring");
    if (!check.within(tables.tangents, 0, tables.faces, "face coefficients")) {
        return;
    }
    count_ = tables.faces - tables.tangents;
    if (!check.pool(tables.faces, count_) || !check.pool(0, vertices) || !check.words(tables.ring, count_) ||
        !check.require(tables.ring % 4 == 0, "it does not begin an element")) {
        count_ = 0;
        return;
    }
    for (const uint32_t word : std::span(tables.words).subspan(tables.ring, count_)) {
        if (!checkRingWord(check, word, vertices)) {
            return;
        }
    }
}

bool FanSlots::takeRegular(uint32_t count) {
    return check_.require(next_ == 0, "regular ones come first") && take(0, uint64_t{4} * count);
}

bool FanSlots::take(uint32_t slot, uint64_t spokes) {
    const bool follows = check_.within(slot, spokes, count_, "spokes") &&
                         check_.require(slot == next_, "spokes do not follow each other");
    next_ += spokes;
    return follows;
}

bool FanSlots::done() {
    return check_.require(next_ == count_, "fans do not have all spokes");
}

uint64_t checkFanWeights(TableCheck& check, uint32_t element, uint32_t openFlag, bool alwaysOpen) {
    if (!check.elements(element, 1)) {
        return 0;
    }
    const uint32_t head = check.element(element)[0];
    const uint64_t facets = head & ~openFlag, spokes = facets + ((head & openFlag) != 0 || alwaysOpen ? 1 : 0);
    return check.require(facets > 0, "a fan without facets") && check.elements(element, 1 + 2 * spokes) ? spokes : 0;
}

} // namespace supple::surface
