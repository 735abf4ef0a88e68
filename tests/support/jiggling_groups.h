// Groups of cages whose vertices jiggle.
#pragma once

#include "tests/support/jiggles.h"
#include "tests/support/played_group.h"
#include "tests/support/worst.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace supple::test {

inline constexpr uint32_t kSoft = SUPPLE_GROUP_SOFT;
using Floats = std::vector<float>;

inline double cagesApart(const Floats& a, const Floats& b) {
    return farthestApart(a, b);
}

/// A group of cages whose vertices jiggle.
class JigglingGroup : public PlayedGroup {
public:
    JigglingGroup(CrowdContext& context, const SuppleGroupDesc& desc) : PlayedGroup(context, desc) {}

    void jiggle(double time) {
        EXPECT_EQ(suppleSetTime(handle(), crowd.group(), time), SUPPLE_OK);
        crowd.context().run(crowd.group());
        cages = as<float>(crowd.read(crowd.output().info.deformedCage));
    }
    /// What an instance showed in the last frame.
    [[nodiscard]] Floats shown(uint32_t i) const {
        const size_t stride = size_t{4} * group().instances().cageStride();
        const auto begin = cages.begin() + static_cast<ptrdiff_t>(instances[i].slot * stride);
        return {begin, begin + static_cast<ptrdiff_t>(4 * size_t{character().cage.vertexCount()})};
    }

    Floats cages;
};

/// Two groups that do the same, but for what a test does to the first.
class JigglingPair {
public:
    JigglingPair(CrowdContext& context, uint32_t capacity)
        : asset(context.createAsset(jigglingWren())), other(context, playedGroup(asset, capacity, kSoft)),
          plain(context, playedGroup(context.createAsset(jigglingWren()), capacity, kSoft)) {
        for (uint32_t i = 0; i < capacity; ++i) {
            other.play(i, 2, 0.1 * i);
            plain.play(i, 2, 0.1 * i);
        }
    }
    void run(uint32_t step) {
        other.jiggle(step / 60.0);
        plain.jiggle(step / 60.0);
    }
    [[nodiscard]] bool same(uint32_t i) const { return other.shown(i) == plain.shown(i); }

    SuppleAsset asset;
    JigglingGroup other, plain;
};

} // namespace supple::test
