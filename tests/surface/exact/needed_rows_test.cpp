#include "surface/exact/needed_rows.h"

#include <gtest/gtest.h>
#include <random>

namespace supple::test {
namespace {

using surface::exact::NeededRows;

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
    // Every further number of a row knows the first.
    std::vector<uint32_t> firsts(kAll, cage::kNone);
    for (uint32_t number = 0; number < rows.count(); ++number) {
        uint32_t& first = firsts[rows.rows()[number]];
        const auto known = rows.firsts().find(number);
        if (first == cage::kNone) {
            first = number;
            ASSERT_EQ(known, rows.firsts().end());
        } else {
            ASSERT_NE(known, rows.firsts().end());
            ASSERT_EQ(known->second, first);
        }
    }
    EXPECT_FALSE(rows.firsts().empty());
}

TEST(NeededRows, EachIsThereOnceWhereAllAreNear) {
    NeededRows rows(100);
    std::vector<uint32_t> net = {7, 3, 7, 90}, other = {90, 4};
    rows.needNet(net);
    rows.needNet(other);
    EXPECT_EQ(net, (std::vector<uint32_t>{0, 1, 0, 2}));
    EXPECT_EQ(other, (std::vector<uint32_t>{2, 3}));
    EXPECT_EQ(rows.rows(), (std::vector<uint32_t>{7, 3, 90, 4}));
    EXPECT_TRUE(rows.firsts().empty());
}

} // namespace
} // namespace supple::test
