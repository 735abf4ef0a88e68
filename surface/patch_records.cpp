#include "surface/patch_records.h"

#include "shaders/shared/surface.h"

#include <string>

namespace supple::surface {

uint32_t spokeWord(uint32_t spoke, uint32_t next) {
    return spoke | (next - spoke) << shared::kSpokeBits;
}

void SpokeLimits::add(uint32_t vertex, uint32_t spokes) {
    count_ += spokes;
    if (spokes > most_) {
        vertex_ = vertex;
        most_ = spokes;
    }
}

Status SpokeLimits::check() const {
    if (count_ > shared::kMaxSpokes) {
        return Error{ErrorCode::limit, "the cage has " + std::to_string(count_) +
                                           " edges counted from both ends; patch records hold " +
                                           std::to_string(shared::kMaxSpokes)};
    }
    if (most_ > shared::kMaxSpokeStep) {
        return Error{ErrorCode::limit, "vertex " + std::to_string(vertex_) + " has " + std::to_string(most_) +
                                           " edges; patch records hold " + std::to_string(shared::kMaxSpokeStep)};
    }
    return success();
}

uint32_t recordElements(const Tables& tables, PatchClass patchClass) {
    return rowOf(patchClass).recordElements + (tables.cornerNormals ? 1 : 0);
}

} // namespace supple::surface
