// The channel of a UV set: how faces are cut into runs, and what becomes of them in every mode.
#include "cage/uv_channel.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using Rule = UvChannel::Rule;

/// A cage of 4 x 4 quads that is its own map, and what was made of it.
class UvChannels : public testing::Test {
protected:
    UvChannels() { mapPositions(); }

    void mapPositions() {
        cage.cornerUvs.clear();
        for (const uint32_t v : cage.faceVertices) {
            cage.cornerUvs.emplace_back(cage.positions[v]);
        }
    }
    static uint32_t at(uint32_t x, uint32_t y) { return 5 * y + x; }
    /// The corner of the quad in a column and a row at a vertex.
    [[nodiscard]] uint32_t cornerOf(uint32_t column, uint32_t row, uint32_t vertex) const {
        uint32_t c = cage.faceStarts[4 * row + column];
        while (cage.faceVertices[c] != vertex) {
            ++c;
        }
        return c;
    }
    glm::vec2& uv(uint32_t column, uint32_t row, uint32_t vertex) {
        return cage.cornerUvs[cornerOf(column, row, vertex)];
    }

    UvChannel build(UvMode mode, bool folds = true) {
        topology = *buildTopology(cage);
        features = buildFeatures(cage, topology);
        for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
            if (topology.boundary[v] != 0 && topology.sectorCount(v) == 1) {
                features.vertexSharpness[v] = kHardSharpness;
            }
        }
        Result<UvChannel> channel = buildUvChannel(cage, topology, {features.edgeSharpness, features.vertexSharpness},
                                                   cage.cornerUvs, mode, folds);
        EXPECT_TRUE(channel);
        return std::move(*channel);
    }
    /// The rules of a vertex's runs, in the order of the channel.
    [[nodiscard]] static std::vector<Rule> rulesAt(const UvChannel& channel, uint32_t vertex) {
        std::vector<Rule> rules;
        for (size_t k = 0; k < channel.vertices.size(); ++k) {
            if (channel.vertices[k] == vertex) {
                rules.push_back(channel.rules[k]);
            }
        }
        return rules;
    }
    [[nodiscard]] static size_t cuts(const UvChannel& channel) {
        return static_cast<size_t>(std::count(channel.cutEdges.begin(), channel.cutEdges.end(), 1));
    }

    Cage cage = test::grid(4, 4);
    Topology topology;
    Features features;
};

TEST_F(UvChannels, WithoutSeamsAreTheCage) {
    const UvChannel channel = build(UvMode::cornersPlus1);
    EXPECT_EQ(channel.values.size(), cage.vertexCount());
    EXPECT_EQ(cuts(channel), 0u);
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        EXPECT_EQ(rulesAt(channel, v), std::vector<Rule>{Rule::match});
    }
    // All vertices of the border are corners where borders are linear.
    const UvChannel linear = build(UvMode::boundaries);
    EXPECT_EQ(rulesAt(linear, at(2, 0)), std::vector<Rule>{Rule::corner});
    EXPECT_EQ(rulesAt(linear, at(2, 2)), std::vector<Rule>{Rule::match});
}

TEST_F(UvChannels, OfASeamHaveTwoRunsAtItsVertices) {
    for (uint32_t row = 0; row < 4; ++row) {
        for (const uint32_t y : {row, row + 1}) {
            uv(2, row, at(2, y)) += glm::vec2(0.2f, 0.0f);
        }
    }
    for (const UvMode mode : {UvMode::none, UvMode::cornersPlus1, UvMode::cornersPlus2, UvMode::boundaries}) {
        SCOPED_TRACE(uvModeName(mode));
        const UvChannel channel = build(mode);
        EXPECT_EQ(channel.values.size(), cage.vertexCount() + 5);
        EXPECT_EQ(cuts(channel), 4u);
        const Rule rule = mode == UvMode::boundaries ? Rule::corner : Rule::crease;
        EXPECT_EQ(rulesAt(channel, at(2, 2)), std::vector<Rule>(2, rule));
        // On the border of the surface each run has one face.
        const Rule end = mode == UvMode::none ? Rule::crease : Rule::corner;
        EXPECT_EQ(rulesAt(channel, at(2, 0)), std::vector<Rule>(2, end));
        EXPECT_EQ(channel.topology.boundary[channel.cage.faceVertices[cornerOf(2, 1, at(2, 2))]], 1);
    }
}

TEST_F(UvChannels, OfADartHaveOneOpenRunAtItsTip) {
    uv(2, 0, at(2, 0)) += glm::vec2(0.2f, 0.0f);
    uv(2, 0, at(2, 1)) += glm::vec2(0.2f, 0.0f);
    uv(2, 1, at(2, 1)) += glm::vec2(0.2f, 0.0f);
    const UvChannel channel = build(UvMode::cornersPlus1);
    EXPECT_EQ(rulesAt(channel, at(2, 2)), std::vector<Rule>{Rule::crease});
    const uint32_t tip = channel.cage.faceVertices[cornerOf(2, 2, at(2, 2))];
    EXPECT_EQ(channel.topology.boundary[tip], 1);
    EXPECT_EQ(channel.topology.sectorCount(tip), 4u);
    EXPECT_EQ(rulesAt(build(UvMode::cornersPlus2), at(2, 2)), std::vector<Rule>{Rule::corner});
}

TEST_F(UvChannels, SplitAValueThatStandsInTwoRuns) {
    const uint32_t v = at(2, 2);
    uv(1, 1, v) += glm::vec2(0.2f, 0.0f);
    uv(2, 2, v) += glm::vec2(0.2f, 0.0f);
    const UvChannel channel = build(UvMode::none);
    EXPECT_EQ(rulesAt(channel, v), std::vector<Rule>(4, Rule::corner));
}

TEST_F(UvChannels, OfAJunctionAreCornersFromPlusOneOn) {
    // Three charts meet at the middle: the left half, and two quarters.
    for (uint32_t row = 0; row < 4; ++row) {
        for (const uint32_t y : {row, row + 1}) {
            uv(2, row, at(2, y)) += glm::vec2(10.0f, row < 2 ? 0.0f : 10.0f);
            uv(2, row, at(3, y)) += glm::vec2(10.0f, row < 2 ? 0.0f : 10.0f);
            uv(3, row, at(3, y)) += glm::vec2(10.0f, row < 2 ? 0.0f : 10.0f);
            uv(3, row, at(4, y)) += glm::vec2(10.0f, row < 2 ? 0.0f : 10.0f);
        }
    }
    EXPECT_EQ(rulesAt(build(UvMode::cornersPlus1), at(2, 2)), std::vector<Rule>(3, Rule::corner));
    const std::vector<Rule> only = rulesAt(build(UvMode::cornersOnly), at(2, 2));
    EXPECT_EQ(std::count(only.begin(), only.end(), Rule::crease), 1); // two runs have one face
    EXPECT_EQ(rulesAt(build(UvMode::none), at(2, 2)), std::vector<Rule>(3, Rule::crease));
    EXPECT_EQ(rulesAt(build(UvMode::none), at(3, 2)), std::vector<Rule>(2, Rule::crease));
}

TEST_F(UvChannels, CutWhereTheSurfaceIsSharpInsideARun) {
    for (uint32_t row = 0; row < 4; ++row) {
        for (const uint32_t y : {row, row + 1}) {
            uv(2, row, at(2, y)) += glm::vec2(0.2f, 0.0f);
        }
    }
    cage.creases = {{at(2, 2), at(3, 2), kHardSharpness}};
    const std::vector<Rule> both = rulesAt(build(UvMode::cornersPlus1), at(2, 2));
    EXPECT_EQ(both, std::vector<Rule>(2, Rule::corner));
    const std::vector<Rule> one = rulesAt(build(UvMode::cornersOnly), at(2, 2));
    EXPECT_EQ(std::count(one.begin(), one.end(), Rule::corner), 1);
    cage.creases[0].sharpness = 1.5f; // goes over from corner to crease, and the other side with it
    const UvChannel soft = build(UvMode::cornersPlus1);
    EXPECT_EQ(rulesAt(soft, at(2, 2)), std::vector<Rule>(2, Rule::crease));
    EXPECT_EQ(std::count_if(soft.companions.begin(), soft.companions.end(), [](uint32_t c) { return c != kNone; }), 1);
}

TEST_F(UvChannels, FoldWhereMirroredHalvesMeet) {
    for (glm::vec2& own : cage.cornerUvs) {
        own.x = std::min(own.x, 4.0f - own.x);
    }
    const UvChannel channel = build(UvMode::cornersPlus1);
    EXPECT_EQ(cuts(channel), 4u);
    EXPECT_EQ(rulesAt(channel, at(2, 2)), std::vector<Rule>(2, Rule::crease)); // the fold goes through
    EXPECT_EQ(rulesAt(channel, at(2, 0)), std::vector<Rule>(2, Rule::corner));
    EXPECT_EQ(cuts(build(UvMode::cornersPlus1, false)), 0u);
}

TEST_F(UvChannels, HaveCornersRoundAPole) {
    cage = test::cappedCylinder(6, 3);
    mapPositions();
    const uint32_t pole = cage.vertexCount() - 1;
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) {
        if (cage.faceVertices[c] == pole) {
            cage.cornerUvs[c] += glm::vec2(0.01f * static_cast<float>(c), 0.0f);
        }
    }
    const uint32_t onRing = 2 * 6;
    EXPECT_EQ(rulesAt(build(UvMode::cornersOnly), onRing), std::vector<Rule>{Rule::corner});
    EXPECT_EQ(rulesAt(build(UvMode::none), onRing), std::vector<Rule>{Rule::crease});
    EXPECT_EQ(rulesAt(build(UvMode::cornersOnly, false), onRing), std::vector<Rule>{Rule::crease});
    EXPECT_EQ(rulesAt(build(UvMode::cornersOnly), pole).size(), 6u);
}

} // namespace
} // namespace supple::cage
