#include "host/coarse_grid.h"

#include <algorithm>

namespace supple::host {

namespace {

/// Samples before row j of a triangle of rows of n, n - 1 .. samples.
uint32_t rowStart(uint32_t n, uint32_t j) {
    return j * n - j * (j - 1) / 2;
}

/// Of SUPPLE_DOMAIN_PENTAGON: points on the next ray are the next sector's.
uint32_t pentagonSample(uint32_t rate, uint32_t sector, uint32_t i, uint32_t j) {
    const uint32_t perSector = rate * (rate + 1) / 2;
    if (j == rate)
        return 5 * perSector;
    const bool onNextRay = i + j == rate;
    return (onNextRay ? (sector + 1) % 5 : sector) * perSector + rowStart(rate, j) + (onNextRay ? 0 : i);
}

/// Adds the cells of a triangle. `at` tells the sample at (i, j).
template <class At>
void addTriangleCells(uint32_t segments, std::vector<uint16_t>& indices, At&& at) {
    const auto add = [&](uint32_t i, uint32_t j) { indices.push_back(static_cast<uint16_t>(at(i, j))); };
    for (uint32_t j = 0; j < segments; ++j) {
        for (uint32_t i = 0; i + j < segments; ++i) {
            add(i, j), add(i + 1, j), add(i, j + 1);
            if (i + j + 1 < segments)
                add(i + 1, j), add(i + 1, j + 1), add(i, j + 1);
        }
    }
}

template <class At>
void addQuadCells(uint32_t segments, std::vector<uint16_t>& indices, At&& at) {
    const auto add = [&](uint32_t i, uint32_t j) { indices.push_back(static_cast<uint16_t>(at(i, j))); };
    for (uint32_t j = 0; j < segments; ++j) {
        for (uint32_t i = 0; i < segments; ++i) {
            add(i, j), add(i + 1, j), add(i + 1, j + 1);
            add(i, j), add(i + 1, j + 1), add(i, j + 1);
        }
    }
}

} // namespace

uint32_t halvedSegments(uint32_t segments, uint32_t rate, uint32_t fewest) {
    uint32_t halved = std::max((segments + 1) / 2, fewest);
    // An even number of segments has a middle, and an odd rate has no sample there.
    if (rate % 2 == 1 && halved % 2 == 0)
        halved += halved > fewest ? -1 : 1;
    return std::min(halved, segments);
}

uint32_t coarseSample(uint32_t i, uint32_t segments, uint32_t rate) {
    return 2 * i <= segments ? (i * rate + segments / 2) / segments : rate - coarseSample(segments - i, segments, rate);
}

std::vector<uint16_t> coarseGrid(SuppleDomain domain, uint32_t rate, uint32_t segments) {
    std::vector<uint16_t> indices;
    const auto place = [&](uint32_t i) { return coarseSample(i, segments, rate); };
    switch (domain) {
    case SUPPLE_DOMAIN_TRIANGLE:
        addTriangleCells(segments, indices,
                         [&](uint32_t i, uint32_t j) { return rowStart(rate + 1, place(j)) + place(i); });
        break;
    case SUPPLE_DOMAIN_PENTAGON:
        for (uint32_t sector = 0; sector < 5; ++sector)
            addTriangleCells(segments, indices,
                             [&](uint32_t i, uint32_t j) { return pentagonSample(rate, sector, place(i), place(j)); });
        break;
    default:
        addQuadCells(segments, indices, [&](uint32_t i, uint32_t j) { return place(j) * (rate + 1) + place(i); });
    }
    return indices;
}

} // namespace supple::host
