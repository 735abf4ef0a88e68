#include "surface/build.h"
#include "surface/chains/needed_rows.h"
#include "tests/support/large_pole.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace supple::test {
namespace {

using surface::chains::NeededRows;

// Nets here and there among more rows than may lie apart.
TEST(NeededRows, RowsOfANetLieNearEachOther) {
    constexpr uint32_t kAll = 5000, kFarthest = 255, kNet = 25;
    NeededRows rows(kAll, kFarthest);
    std::mt19937 random(1);
    for (uint32_t n = 0; n < 4000; ++n) {
        std::vector<uint32_t> net(kNet);
        const uint32_t begin = random() % kAll;
        for (uint32_t& row : net) {
            row = random() % 4 == 0 ? random() % kAll : (begin + random() % 40) % kAll;
        }
        std::vector<uint32_t> numbers = net;
        rows.needNet(numbers);
        const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
        ASSERT_LE(*most - *least, kFarthest);
        for (uint32_t i = 0; i < kNet; ++i) {
            ASSERT_LT(numbers[i], rows.count());
            ASSERT_EQ(rows.rows()[numbers[i]], net[i]);
        }
    }
    EXPECT_GT(rows.count(), kAll) << "some have several numbers";
}

TEST(NeededRows, EachIsThereOnceWhereAllAreNear) {
    NeededRows rows(100);
    std::vector<uint32_t> net = {7, 3, 7, 90}, other = {90, 4};
    rows.needNet(net);
    rows.needNet(other);
    EXPECT_EQ(net, (std::vector<uint32_t>{0, 1, 0, 2}));
    EXPECT_EQ(other, (std::vector<uint32_t>{2, 3}));
    EXPECT_EQ(rows.rows(), (std::vector<uint32_t>{7, 3, 90, 4}));
}

// The net of a vertex with as many faces as chains take, half of it numbered long ago.
TEST(NeededRows, TheLargestNetsFit) {
    constexpr uint32_t kAll = 300000, kNet = 32767;
    NeededRows rows(kAll);
    for (uint32_t row = 0; row < kAll; ++row) {
        rows.need(row);
    }
    std::vector<uint32_t> net(kNet);
    for (uint32_t i = 0; i < kNet; ++i) {
        net[i] = i % 2 == 0 ? i : kAll - 1 - i;
    }
    rows.needNet(net);
    const auto [least, most] = std::minmax_element(net.begin(), net.end());
    EXPECT_LE(*most - *least, 0xFFFFu);
    EXPECT_EQ(rows.count(), kAll + kNet / 2 + 1);
}

// However a file orders its faces, neighbors lie near each other.
TEST(NeededRows, ShuffledCagesNeedNoMorePoints) {
    cage::Cage cage = grid(150, 150);
    for (uint32_t v = 0; v + 1 < cage.vertexCount(); v += 2) {
        if (v / 151 == (v + 1) / 151) {
            cage.creases.push_back({v, v + 1, 1.5f});
        }
    }
    cage::Cage shuffled = cage;
    std::vector<uint32_t> order(cage.faceCount());
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), std::mt19937(3));
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        std::copy_n(cage.faceVertices.begin() + 4 * order[f], 4, shuffled.faceVertices.begin() + 4 * f);
    }
    surface::Recipe recipe;
    recipe.rate = 2;
    const Result<surface::Tables> tables = surface::catmull_clark::build(recipe, cage);
    const Result<surface::Tables> again = surface::catmull_clark::build(recipe, shuffled);
    ASSERT_TRUE(tables && again);
    EXPECT_GT(tables->poolStride, 150000u); // 16 bits are not enough for all of it
    EXPECT_EQ(repeatedPoints(*tables), 0u);
    EXPECT_EQ(repeatedPoints(*again), 0u);
    EXPECT_EQ(again->poolStride, tables->poolStride);
    EXPECT_NEAR(static_cast<double>(again->words.size()), static_cast<double>(tables->words.size()),
                0.01 * static_cast<double>(tables->words.size()));
}

} // namespace
} // namespace supple::test
