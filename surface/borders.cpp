#include "surface/borders.h"

#include "shaders/shared/chains.h"
#include "shaders/shared/pm.h"
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

std::array<uint32_t, 16> netIndices(const Tables& tables, const uint32_t* record, PatchClass patchClass) {
    using namespace shared;
    const bool polar = patchClass == PatchClass::polar;
    std::array<uint32_t, 16> indices{};
    for (uint32_t k = 0; k < 16; ++k) {
        const uint32_t corner = polar ? SUPPLE_POLAR_NET_CORNER(k) : SUPPLE_NET_CORNER(k);
        const uint32_t point = record[corner], spoke = record[4 + corner];
        const uint32_t choices[] = {point, tables.tangents + SUPPLE_SPOKE(spoke),
                                    tables.tangents + SUPPLE_NEXT_SPOKE(spoke), tables.faces + SUPPLE_SPOKE(spoke),
                                    point + 1};
        static_assert(kNetPoint == 0 && kNetTangent == 1 && kNetNextTangent == 2 && kNetFace == 3 && kNetBehind == 4);
        indices[k] = choices[polar ? SUPPLE_POLAR_NET_KIND(k) : SUPPLE_NET_KIND(k)];
    }
    return indices;
}

uint32_t recordElements(const Tables& tables, PatchClass patchClass) {
    return rowOf(patchClass).recordElements + (tables.cornerNormals ? 1 : 0);
}

namespace {

uint32_t half(const uint32_t* words, uint32_t k) {
    return words[k / 2] >> 16 * (k % 2) & 0xFFFFu;
}
uint32_t netPoint(const Tables& tables, uint32_t first, const uint32_t* window, uint32_t k) {
    const uint32_t index = first + half(window, k);
    const auto copy = tables.copies.find(index);
    return copy == tables.copies.end() ? index : copy->second;
}

} // namespace

uint32_t quadNetPoint(const Tables& tables, const uint32_t* record, uint32_t k) {
    const uint32_t* window = record + size_t{4} * shared::kQuadNetElement;
    return netPoint(tables, window[shared::kWindowLastWord] >> shared::kNetFirstShift, window, k);
}

uint32_t triangleNetPoint(const Tables& tables, const uint32_t* record, uint32_t k) {
    const uint32_t* window = record + size_t{4} * shared::kTriangleNetElement;
    return netPoint(tables, window[shared::kTriangleWindowLastWord], window, k);
}

uint32_t quadNormal(const uint32_t* record, uint32_t corner) {
    const uint32_t before = half(record + size_t{4} * shared::kQuadNetElement, shared::kWindowNormals + corner);
    return before == 0 ? shared::kNoNormal : record[4 + corner] - before;
}

uint32_t triangleNormal(const uint32_t* record, uint32_t corner) {
    const uint32_t before =
        half(record + size_t{4} * shared::kTriangleNetElement, shared::kTriangleWindowNormals + corner);
    return before == 0 ? shared::kNoNormal : record[4 * shared::kTriangleChainElement + corner] - before;
}

std::vector<BorderCurve> borderCurves(const Tables& tables, const uint32_t* record, PatchClass patchClass) {
    if (rowOf(patchClass).isBicubic()) {
        const std::array<uint32_t, 16> net = netIndices(tables, record, patchClass);
        const auto g = [&](uint32_t i, uint32_t j) { return net[4 * j + i]; };
        return {{g(0, 0), g(1, 0), g(2, 0), g(3, 0)},
                {g(3, 0), g(3, 1), g(3, 2), g(3, 3)},
                {g(3, 3), g(2, 3), g(1, 3), g(0, 3)},
                {g(0, 3), g(0, 2), g(0, 1), g(0, 0)}};
    }
    using namespace shared;
    std::vector<BorderCurve> curves;
    const uint32_t sides = cornerCount(domainOf(patchClass));
    const auto point = [&](uint32_t i) { return SUPPLE_POINT(record[SUPPLE_PM_POINT_WORD(i)]); };
    for (uint32_t i = 0; i < sides; ++i) {
        const uint32_t next = (i + 1) % sides;
        curves.push_back({point(i), tables.tangents + SUPPLE_SPOKE(record[SUPPLE_PM_SPOKE_WORD(i)]),
                          tables.tangents + SUPPLE_NEXT_SPOKE(record[SUPPLE_PM_SPOKE_WORD(next)]), point(next)});
    }
    return curves;
}

} // namespace supple::surface
