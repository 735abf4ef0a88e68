#include "surface/grid.h"

#include <cstddef>

namespace supple::surface {

namespace {

/// Samples before row j of a triangle of rows of n, n - 1, ... samples.
constexpr uint32_t rowStart(uint32_t n, uint32_t j) {
    return j * n - j * (j - 1) / 2;
}

/// The sample of a pentagon's sector at (i, j), i + j <= rate; points on the next ray are the next sector's.
uint32_t pentagonSample(uint32_t rate, uint32_t sector, uint32_t i, uint32_t j) {
    const uint32_t perSector = rate * (rate + 1) / 2;
    if (j == rate) {
        return 5 * perSector;
    }
    if (i + j == rate) {
        sector = (sector + 1) % 5;
        i = 0;
    }
    return sector * perSector + rowStart(rate, j) + i;
}

/// Triangles of a triangular grid of `rate` segments a side, whose sample (i, j) is at(i, j).
template <class At>
void triangleCells(uint32_t rate, std::vector<uint16_t>& indices, At&& at) {
    for (uint32_t j = 0; j < rate; ++j) {
        for (uint32_t i = 0; i + j < rate; ++i) {
            indices.insert(indices.end(), {at(i, j), at(i + 1, j), at(i, j + 1)});
            if (i + j + 1 < rate) {
                indices.insert(indices.end(), {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        }
    }
}

} // namespace

uint32_t edgeSample(Domain domain, uint32_t rate, uint32_t edge, uint32_t k) {
    const uint32_t side = rate + 1;
    switch (domain) {
    case Domain::quad:
    case Domain::polar: {
        const uint32_t last = domain == Domain::polar && edge == 2 ? 3 : edge; // the quad's third side is the apex
        const uint32_t i[4] = {k, rate, rate - k, 0}, j[4] = {0, k, rate, rate - k};
        return j[last] * side + i[last];
    }
    case Domain::triangle: {
        const uint32_t i[3] = {k, rate - k, 0}, j[3] = {0, k, rate - k};
        return rowStart(side, j[edge]) + i[edge];
    }
    default:
        return pentagonSample(rate, edge, k, 0);
    }
}

std::vector<uint16_t> gridIndices(Domain domain, uint32_t rate) {
    std::vector<uint16_t> indices;
    indices.reserve((domain == Domain::pentagon ? 15 : domain == Domain::triangle ? 3 : 6) * std::size_t{rate} * rate);
    const uint32_t side = rate + 1;
    switch (domain) {
    case Domain::triangle:
        triangleCells(rate, indices,
                      [&](uint32_t i, uint32_t j) { return static_cast<uint16_t>(rowStart(side, j) + i); });
        break;
    case Domain::pentagon:
        for (uint32_t sector = 0; sector < 5; ++sector) {
            triangleCells(rate, indices, [&](uint32_t i, uint32_t j) {
                return static_cast<uint16_t>(pentagonSample(rate, sector, i, j));
            });
        }
        break;
    default:
        for (uint32_t j = 0; j < rate; ++j) {
            for (uint32_t i = 0; i < rate; ++i) {
                const auto a = static_cast<uint16_t>(j * side + i);
                const auto b = static_cast<uint16_t>(a + 1);
                const auto c = static_cast<uint16_t>(a + side + 1);
                const auto d = static_cast<uint16_t>(a + side);
                indices.insert(indices.end(), {a, b, c});
                if (domain == Domain::quad || j + 1 < rate) { // a polar patch's last row ends in one point
                    indices.insert(indices.end(), {a, c, d});
                }
            }
        }
    }
    return indices;
}

std::vector<float> parameterPairs() {
    std::vector<float> pairs;
    for (uint32_t rate = 1; rate <= kMaxRate; ++rate) {
        for (uint32_t k = 0; k <= rate; ++k) {
            pairs.push_back(static_cast<float>(k) / static_cast<float>(rate));
            pairs.push_back(static_cast<float>(rate - k) / static_cast<float>(rate));
        }
    }
    return pairs;
}

} // namespace supple::surface
