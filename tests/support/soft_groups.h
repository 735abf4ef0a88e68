// Groups of cages of which something is soft.
#pragma once

#include "tests/support/played_group.h"
#include "tests/support/soft_assets.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace supple::test {

inline constexpr uint32_t kSoft = SUPPLE_GROUP_SOFT;
using Floats = std::vector<float>;

/// A group of cages of which something is soft.
class SoftGroup : public PlayedGroup {
public:
    SoftGroup(CrowdContext& context, const SuppleGroupDesc& desc) : PlayedGroup(context, desc) {}

    void frame(double time) {
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

    /// The longest side of the box that holds the cage at rest.
    [[nodiscard]] float longestSide() const {
        const glm::vec3 size = sizeAtRest();
        return std::max({size.x, size.y, size.z});
    }

    Floats cages;
};

/// Two groups of a figure with a belly and a cape that do the same, but for what a test does to the first.
class SoftPair {
public:
    SoftPair(CrowdContext& context, uint32_t capacity)
        : asset(context.asset(kCapedFile)), other(context, playedGroup(asset, capacity, kSoft)),
          plain(context, playedGroup(asset, capacity, kSoft)) {
        for (uint32_t i = 0; i < capacity; ++i) {
            other.play(i, i % 2, 0.1 * i);
            plain.play(i, i % 2, 0.1 * i);
        }
    }
    void run(uint32_t step) {
        other.frame(step / 60.0);
        plain.frame(step / 60.0);
    }
    [[nodiscard]] bool same(uint32_t i) const { return other.shown(i) == plain.shown(i); }

    SuppleAsset asset;
    SoftGroup other, plain;
};

} // namespace supple::test
