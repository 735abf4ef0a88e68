// Coarse grids: patches of all domains meet on their borders, and none of their triangles is turned over.
#include "host/coarse_grid.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <utility>

namespace supple::host {
namespace {

/// Sides that one triangle alone has: the border, in the direction of its triangles.
std::map<uint16_t, uint16_t> borderOf(const std::vector<uint16_t>& indices) {
    std::set<std::pair<uint16_t, uint16_t>> sides;
    for (size_t i = 0; i < indices.size(); ++i) {
        const std::pair side(indices[i], indices[i % 3 == 2 ? i - 2 : i + 1]);
        EXPECT_TRUE(sides.insert(side).second) << "two triangles have a side in the same direction";
    }
    std::map<uint16_t, uint16_t> border;
    for (const auto& [from, to] : sides) {
        if (!sides.contains({to, from})) {
            EXPECT_TRUE(border.emplace(from, to).second);
        }
    }
    return border;
}

/// The samples along the side from corner 0 to corner 1, by their places on it: it is the same in all domains.
std::vector<uint32_t> firstSideOf(SuppleDomain domain, uint32_t rate, uint32_t segments) {
    const std::map<uint16_t, uint16_t> border = borderOf(coarseGrid(domain, rate, segments));
    EXPECT_EQ(border.size(), (domain == SUPPLE_DOMAIN_PENTAGON   ? 5u
                              : domain == SUPPLE_DOMAIN_TRIANGLE ? 3u
                                                                 : 4u) *
                                 segments);
    std::vector<uint32_t> places{0};
    for (uint32_t i = 0; i < segments; ++i)
        places.push_back(border.at(static_cast<uint16_t>(places.back())));
    if (domain == SUPPLE_DOMAIN_PENTAGON) { // corner 1 is the first sample of the next sector
        EXPECT_EQ(std::exchange(places.back(), rate), rate * (rate + 1) / 2);
    }
    return places;
}

TEST(CoarseGrid, PatchesMeetWhateverTheirDomains) {
    for (uint32_t rate = 1; rate <= SUPPLE_MAX_RATE; ++rate) {
        uint32_t segments = rate, before = 0;
        for (; segments != before; before = std::exchange(segments, halvedSegments(segments, rate, 1))) {
            SCOPED_TRACE(std::to_string(segments) + " of " + std::to_string(rate));
            const std::vector<uint32_t> expected = firstSideOf(SUPPLE_DOMAIN_QUAD, rate, segments);
            EXPECT_EQ(expected.back(), rate);
            for (uint32_t i = 0; i <= segments; ++i)
                EXPECT_EQ(expected[i], rate - expected[segments - i]) << "the neighbour counts from the other end";
            EXPECT_EQ(firstSideOf(SUPPLE_DOMAIN_TRIANGLE, rate, segments), expected);
            EXPECT_EQ(firstSideOf(SUPPLE_DOMAIN_PENTAGON, rate, segments), expected);
        }
        EXPECT_EQ(segments, 1u);
    }
}

TEST(CoarseGrid, AllSegmentsAreTheGridItself) {
    const std::vector<uint16_t> quad{0, 1, 3, 0, 3, 2};
    EXPECT_EQ(coarseGrid(SUPPLE_DOMAIN_QUAD, 1, 1), quad);
    EXPECT_EQ(coarseGrid(SUPPLE_DOMAIN_TRIANGLE, 1, 1), (std::vector<uint16_t>{0, 1, 2}));
    EXPECT_EQ(halvedSegments(7, 7, 2), 3u);
    EXPECT_EQ(halvedSegments(3, 7, 2), 3u);
    EXPECT_EQ(halvedSegments(8, 8, 2), 4u);
}

} // namespace
} // namespace supple::host
