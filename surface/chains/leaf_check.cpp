#include "surface/chains/leaf_check.h"

#include "shaders/shared/chains.h"
#include "surface/chains/fan_tables.h"
#include "surface/patch_records.h"
#include "surface/smooth_uvs.h"
#include "surface/table_check_common.h"

#include <array>

namespace supple::surface::chains {
namespace {

constexpr uint32_t kQuadFlags = (1u << shared::kNetFirstShift) - 1;

uint32_t halfAt(const uint32_t* words, uint32_t k) {
    return words[k / 2] >> 16 * (k % 2) & 0xFFFFu;
}

} // namespace

bool LeafCheck::takePatches() {
    for (const PatchRange& range : check_.tables().ranges) {
        if (range.patchClass == PatchClass::regular) {
            continue;
        }
        check_.begin(isTriangles() ? "patches of triangles" : "irregular quads");
        const uint64_t elements = recordElements(check_.tables(), range.patchClass);
        for (uint64_t p = 0; p < range.section.count; ++p) {
            const uint64_t element = range.section.table + elements * p;
            if (!(isTriangles() ? takeTriangle(element, range.patchClass) : takeQuad(element, range.patchClass))) {
                return false;
            }
        }
    }
    return true;
}

bool LeafCheck::takeQuad(uint64_t element, PatchClass patchClass) {
    const uint32_t* record = &check_.tables().words[4 * element];
    const uint32_t* net = record + 4 * shared::kQuadNetElement;
    if (!checkQuadNet(net, coefficients()) || !checkSharpness(net, patchClass != PatchClass::irregular)) {
        return false;
    }
    std::array<bool, 4> plain{};
    bool hasChains = false;
    for (uint32_t i = 0; i < 4; ++i) {
        const Corner corner{record[4 + i], record[4 * shared::kQuadNetListElement + i],
                            halfAt(net, shared::kNetListNormals + i)};
        plain[i] = corner.isPlain();
        hasChains = hasChains || corner.netLists != 0;
        if (!(plain[i] ? check_.require(corner.netLists == 0, "a plain corner with a chain") &&
                             checkPatchCorner(check_, record[i], corner.chain)
                       : point(record[i], coefficients()) && checkCorner(corner, coefficients()))) {
            return false;
        }
    }
    for (uint32_t i = 0; i < 4; ++i) {
        const bool cubic = (net[shared::kNetListLastWord] >> (shared::kCubicSide + i) & 1u) != 0;
        if (!check_.require(!cubic || (plain[i] && plain[(i + 1) % 4]), "a cubic side of a corner that is not plain")) {
            return false;
        }
    }
    // Kernels look for the first corner with a chain: there is one.
    return check_.require(hasChains == (patchClass != PatchClass::creased), "chains that its class has not, or none");
}

bool LeafCheck::takeTriangle(uint64_t element, PatchClass patchClass) {
    const uint32_t* record = &check_.tables().words[4 * element];
    const uint32_t* corners = record + 4 * shared::kTriangleCornerElement;
    const uint32_t vertices = *std::max_element(record + 4 * shared::kTriangleCageElement, corners);
    if (!point(std::max({vertices, corners[0], corners[1], corners[2]}), coefficients())) {
        return false;
    }
    if (patchClass == PatchClass::loopRegular) {
        return true;
    }
    const uint32_t* net = record + 4 * shared::kTriangleNetElement;
    if (!checkTriangleNet(net, coefficients())) {
        return false;
    }
    const uint32_t* chains = record + 4 * shared::kTriangleChainElement;
    bool hasChains = false;
    for (uint32_t i = 0; i < 3; ++i) {
        const Corner corner{chains[i], chains[4 + i], halfAt(net, shared::kTriangleNetListNormals + i)};
        const bool plain = (corners[3] >> (shared::kPlainTriangleCorner + i) & 1u) != 0;
        hasChains = hasChains || !plain;
        if (!check_.require(plain == corner.isPlain() && plain == (corner.netLists == 0),
                            "a plain corner with a chain, or another one without") ||
            !(plain || checkCorner(corner, coefficients()))) {
            return false;
        }
    }
    return check_.require(hasChains, "an irregular one without a chain");
}

bool LeafCheck::checkQuadNet(const uint32_t* net, const Points& points) {
    return point(uint64_t{net[shared::kNetListLastWord] >> shared::kNetFirstShift} +
                     largestHalf(net, shared::kNetPoints),
                 points);
}

/// Kernels look for it behind the net if that says so.
bool LeafCheck::checkSharpness(const uint32_t* net, bool has) {
    return check_.require(halfAt(net, shared::kNetListSharp) == (has ? 1u : 0u),
                          "the sharpness of sides that its class has not, or none");
}

bool LeafCheck::checkTriangleNet(const uint32_t* net, const Points& points) {
    return point(uint64_t{net[shared::kTriangleNetListLastWord]} + largestHalf(net, shared::kTriangleNetPoints),
                 points);
}

/// One that is not plain.
bool LeafCheck::checkCorner(const Corner& corner, const Points& points) {
    return check_.require(corner.chain >= corner.normal, "a normal before the pool") &&
           point(corner.chain - corner.normal, points) &&
           (corner.netLists == 0 || (check_.require(!check_.source().recipe.lod || check_.tables().lod.depth > 0,
                                                    "a chain, and nothing tells its last level") &&
                                     checkChain(corner, points)));
}

bool LeafCheck::checkChain(const Corner& corner, const Points& points) {
    if (!checkNetList(corner.netLists)) {
        return false;
    }
    const uint32_t words = 4 * FanTables::netListElements(subdivision_);
    const uint64_t size =
        check_.word(uint64_t{4} * corner.netLists + words - 1) & ((1u << shared::kChainLevelShift) - 1);
    const uint64_t levels = lastLevel_ - kFirstChainLevel + 1;
    // The point that they are relative to lies before the first.
    return check_.require(corner.chain > 0, "a chain without a place") &&
           check_.within(corner.chain - uint64_t{1}, 1 + levels * size, points.count, points.name);
}

/// Its points are among those of a level.
bool LeafCheck::checkNetList(uint64_t element) {
    const uint32_t elements = FanTables::netListElements(subdivision_);
    if (!check_.elements(element, elements)) {
        return false;
    }
    if (!netLists_.isFirst(element)) {
        return true;
    }
    const uint32_t* words = &check_.tables().words[4 * element];
    const uint32_t last = words[4 * elements - 1];
    return check_.require(last >> shared::kChainLevelShift == lastLevel_,
                          "a netList of chains with another last level") &&
           check_.within(largestHalf(words, isTriangles() ? shared::kTriangleNetPoints : shared::kNetPoints), 1,
                         last & ((1u << shared::kChainLevelShift) - 1), "points of a level");
}

bool LeafCheck::takeSmoothUvs() {
    const Tables& tables = check_.tables();
    if (!tables.uvLeaves) {
        return true;
    }
    check_.begin("smooth texture coordinates");
    for (const PatchRange& range : tables.ranges) {
        const uint64_t records = uint64_t{tables.uvSets} * range.section.count;
        const uint32_t elements = uvElements(tables, range.patchClass);
        for (uint64_t r = 0; r < records; ++r) {
            const uint64_t element = range.smoothUvs + elements * r;
            if (!(isTriangles() ? takeUvTriangle(element) : takeUvQuad(element))) {
                return false;
            }
        }
    }
    return true;
}

bool LeafCheck::takeUvQuad(uint64_t element) {
    const uint32_t* record = &check_.tables().words[4 * element];
    const uint32_t* net = record + 4 * shared::kQuadNetElement;
    if (!checkQuadNet(net, pairs()) || !checkSharpness(net, true) ||
        !check_.require((net[shared::kNetListLastWord] & kQuadFlags) == 0, "a cubic side") ||
        !point(*std::max_element(record, record + 4), pairs())) {
        return false;
    }
    for (uint32_t i = 0; i < 4; ++i) {
        if (!checkUvCorner(
                {record[4 + i], record[4 * shared::kQuadNetListElement + i], halfAt(net, shared::kNetListNormals + i)},
                pairs())) {
            return false;
        }
    }
    return true;
}

/// As an irregular one from its corners on: no side is whole, for that asks for the vertices before these.
bool LeafCheck::takeUvTriangle(uint64_t element) {
    const uint32_t* corners = &check_.tables().words[4 * element];
    const uint32_t* chains = corners + 4 * (shared::kTriangleChainElement - shared::kTriangleCornerElement);
    const uint32_t* net = corners + 4 * (shared::kTriangleNetElement - shared::kTriangleCornerElement);
    if (!checkTriangleNet(net, pairs()) ||
        !check_.require((corners[3] >> shared::kWholeTriangleSide & 7u) == 0, "a side of one curve") ||
        !point(*std::max_element(corners, corners + 3), pairs())) {
        return false;
    }
    for (uint32_t i = 0; i < 3; ++i) {
        if (!checkUvCorner({chains[i], chains[4 + i], halfAt(net, shared::kTriangleNetListNormals + i)}, pairs())) {
            return false;
        }
    }
    return true;
}

bool LeafCheck::checkUvCorner(const Corner& corner, const Points& points) {
    return check_.require(corner.normal == 0, "a normal") && (corner.netLists == 0 || checkChain(corner, points));
}

} // namespace supple::surface::chains
