// Pieces of a block: none overlap, all are aligned, and what is given back can be taken again as one.
#include "gpu/free_ranges.h"

#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace supple::gpu {
namespace {

struct Taken {
    uint64_t offset = 0, bytes = 0;
};

TEST(FreeRanges, PiecesAreApartAndAligned) {
    constexpr uint64_t kSize = 1 << 16;
    for (uint32_t seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        FreeRanges ranges(kSize);
        std::vector<Taken> pieces;
        std::vector<bool> used(kSize, false);
        size_t refused = 0;
        for (int turn = 0; turn < 4000; ++turn) {
            if (random() % 5 < 2 && !pieces.empty()) {
                const size_t which = random() % pieces.size();
                const Taken piece = pieces[which];
                ranges.give(piece.offset, piece.bytes);
                std::fill_n(used.begin() + static_cast<std::ptrdiff_t>(piece.offset), piece.bytes, false);
                pieces[which] = pieces.back();
                pieces.pop_back();
                continue;
            }
            const uint64_t bytes = 1 + random() % 3000, alignment = uint64_t{1} << random() % 9;
            const std::optional<uint64_t> offset = ranges.take(bytes, alignment);
            if (!offset) {
                ++refused;
                continue;
            }
            ASSERT_EQ(*offset % alignment, 0u);
            ASSERT_LE(*offset + bytes, kSize);
            for (uint64_t i = *offset; i < *offset + bytes; ++i) {
                ASSERT_FALSE(used[i]) << "seed " << seed;
                used[i] = true;
            }
            pieces.push_back({*offset, bytes});
        }
        EXPECT_GT(refused, 0u) << "the block was never full";
        for (const Taken& piece : pieces) {
            EXPECT_FALSE(ranges.isWhole());
            ranges.give(piece.offset, piece.bytes);
        }
        EXPECT_TRUE(ranges.isWhole());
        EXPECT_EQ(ranges.take(kSize, kSize), 0u) << "the ranges did not join";
    }
}

TEST(FreeRanges, TakeTheSmallestThatFits) {
    FreeRanges ranges(100);
    ASSERT_EQ(ranges.take(40, 1), 0u);
    ASSERT_EQ(ranges.take(10, 1), 40u);
    ASSERT_EQ(ranges.take(20, 1), 50u);
    ASSERT_EQ(ranges.take(10, 1), 70u);
    ranges.give(0, 40);
    ranges.give(50, 20);
    EXPECT_EQ(ranges.take(20, 1), 50u);
    EXPECT_EQ(ranges.take(30, 16), 0u);
    EXPECT_EQ(ranges.take(21, 1), std::nullopt);
}

} // namespace
} // namespace supple::gpu
