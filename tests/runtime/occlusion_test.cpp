// Depth pyramids: how the shader for hosts makes them, and what they hide of a view's groups.
#include "tests/support/depth_pyramid.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_surface.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <cstdio>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

namespace supple::test {
namespace {

TEST(DepthPyramidShader, TexelsHoldTheFarthestOfAllThatTheyTouch) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    struct Case {
        glm::uvec2 picture, level0;
    };
    size_t texels = 0, loose = 0;
    for (const Case& size :
         {Case{{1, 1}, {1, 1}}, Case{{64, 32}, {64, 32}}, Case{{201, 117}, {201, 117}}, Case{{201, 117}, {100, 58}},
          Case{{640, 361}, {256, 128}}, Case{{7, 300}, {7, 300}}, Case{{130, 1}, {65, 1}}, Case{{10, 10}, {16, 24}}}) {
        for (const bool reversed : {false, true}) {
            DepthPicture picture{size.picture.x, size.picture.y, reversed, {}};
            picture.depths.resize(size_t{picture.width} * picture.height);
            for (float& depth : picture.depths) {
                depth = unit(random);
            }
            const auto pyramid = DepthPyramid::create(*testDevice(), picture, size.level0.x, size.level0.y);
            ASSERT_NE(pyramid, nullptr);
            EXPECT_EQ(pyramid->extent(pyramid->levels() - 1).width, 1u);
            EXPECT_EQ(pyramid->extent(pyramid->levels() - 1).height, 1u);
            const bool powers = picture.width == 64 || picture.width == 1;
            for (uint32_t level = 0; level < pyramid->levels(); ++level) {
                const VkExtent2D extent = pyramid->extent(level);
                const std::vector<float> made = pyramid->read(level);
                for (uint32_t y = 0; y < extent.height; ++y) {
                    for (uint32_t x = 0; x < extent.width; ++x) {
                        float farthest = reversed ? 1.0f : 0.0f;
                        for (uint32_t v = y * picture.height / extent.height;
                             v * extent.height < (y + 1) * picture.height; ++v) {
                            for (uint32_t u = x * picture.width / extent.width;
                                 u * extent.width < (x + 1) * picture.width; ++u) {
                                const float depth = picture.depths[size_t{v} * picture.width + u];
                                farthest = reversed ? std::min(farthest, depth) : std::max(farthest, depth);
                            }
                        }
                        const float own = made[size_t{y} * extent.width + x];
                        ++texels;
                        // Texels of the level before reach out of this one's rectangle where sizes are no multiples.
                        loose += own != farthest ? 1 : 0;
                        if (level == 0 || powers) {
                            EXPECT_EQ(own, farthest);
                        } else if (reversed) {
                            EXPECT_LE(own, farthest);
                        } else {
                            EXPECT_GE(own, farthest);
                        }
                    }
                }
            }
        }
    }
    std::printf("%zu texels, %zu farther than need be\n", texels, loose);
    EXPECT_GT(texels, 100'000u);
    EXPECT_LT(loose * 4, texels);
}

class Occlusion : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, Occlusion, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

std::array<float, 16> columnsOf(const glm::mat4& matrix) {
    std::array<float, 16> columns{};
    std::memcpy(columns.data(), &matrix, sizeof(columns));
    return columns;
}

/// Slots that a group's draws show, and by how much a vertex of each has moved along x.
std::map<uint32_t, double> shown(const Crowd& crowd) {
    const LodSurface surface = readLodSurface(crowd);
    std::map<uint32_t, double> slots;
    std::map<uint32_t, uint32_t> patches;
    for (const LodSurface::Patch& patch : surface.patches) {
        const PositionBits both{surface.positions[patch.firstVertex], surface.previous[patch.firstVertex]};
        const std::vector<glm::vec3> points = asPositions(both);
        slots[patch.slot] = static_cast<double>(points[0].x) - static_cast<double>(points[1].x);
        ++patches[patch.slot];
    }
    for (const auto& [slot, count] : patches) {
        EXPECT_EQ(count, crowd.output().surface.patchCount);
    }
    return slots;
}

std::set<uint32_t> slotsOf(const std::map<uint32_t, double>& shown) {
    std::set<uint32_t> slots;
    for (const auto& [slot, moved] : shown) {
        slots.insert(slot);
    }
    return slots;
}

TEST_P(Occlusion, AWallHidesWhatLiesBehindIt) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    for (const bool reversed : {false, true}) {
        TestView view(context, 300'000, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION);
        SuppleGroupDesc desc{};
        desc.asset = context.createAsset(cage::makeCubeSphere(2));
        desc.capacity = 16;
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.view = view.handle();
        Crowd crowd(context, desc);
        desc.scheme = SUPPLE_SCHEME_PREP;
        desc.capacity = 3;
        Crowd other(context, desc);
        ASSERT_TRUE(crowd.valid() && other.valid());

        // The eye at (0, 0, 20) looks along -z; the wall stands at z = 10 between x = -5 and 5, from y = -2.5 upwards,
        // so that at z = 0 it hides -10..10 and from -5 upwards.
        const std::vector<glm::vec3> places = {{-3, 0, 0}, {0, 0, 0},    {3, 0, 0},   {-3, 0, -6},
                                               {0, 0, -6}, {3, 0, -6},   {-12, 0, 0}, {12, 0, 0},
                                               {0, 0, 14}, {0, -6.5, 0}, {10, 0, 0}};
        const std::set<uint32_t> behind = {0, 1, 2, 3, 4, 5}, others = {6, 7, 8, 9, 10};
        std::set<uint32_t> all = behind;
        all.insert(others.begin(), others.end());
        std::vector<SuppleInstance> instances;
        for (size_t i = 0; i < places.size(); ++i) {
            instances.push_back(crowd.spawn());
        }
        const SuppleInstance hiddenOther = other.spawn(), seenOther = other.spawn();

        glm::mat4 projection = glm::perspectiveRH_ZO(glm::radians(45.0f), 16.0f / 9.0f, 0.5f, 100.0f);
        if (reversed) {
            projection = glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 1, 1) * projection;
        }
        const glm::mat4 both = projection * glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.0f, -20.0f));
        std::memcpy(view.camera.viewProjection, &both, sizeof(both));
        view.look({0.0f, 0.0f, 20.0f});
        DepthPicture picture{417, 235, reversed, {}};
        picture.depths.assign(size_t{picture.width} * picture.height, reversed ? 0.0f : 1.0f);
        const glm::vec4 low = both * glm::vec4(-5.0f, -2.5f, 10.0f, 1.0f),
                        high = both * glm::vec4(5.0f, 100.0f, 10.0f, 1.0f);
        for (uint32_t y = 0; y < picture.height; ++y) {
            for (uint32_t x = 0; x < picture.width; ++x) {
                const glm::vec2 at =
                    2.0f * glm::vec2((static_cast<float>(x) + 0.5f) / static_cast<float>(picture.width),
                                     (static_cast<float>(y) + 0.5f) / static_cast<float>(picture.height)) -
                    1.0f;
                if (at.x > low.x / low.w && at.x < high.x / high.w && at.y > low.y / low.w) {
                    picture.depths[size_t{y} * picture.width + x] = low.z / low.w;
                }
            }
        }
        const auto wall = DepthPyramid::create(context.device(), picture, 417, 235);
        const auto halfWall = DepthPyramid::create(context.device(), picture, 208, 117);
        ASSERT_TRUE(wall != nullptr && halfWall != nullptr);
        const SuppleDepthPyramidDesc wallDesc = wall->desc(columnsOf(both)), halfDesc = halfWall->desc(columnsOf(both));
        const auto set = [&](const SuppleDepthPyramidDesc* pyramid) {
            EXPECT_EQ(suppleSetDepthPyramid(context.handle(), view.handle(), pyramid), SUPPLE_OK);
        };
        float drift = 0.0f;
        const auto frame = [&] {
            drift += 0.015625f;
            for (size_t i = 0; i < places.size(); ++i) {
                crowd.pose(instances[i], SUPPLE_BIND_POSE, 0.0,
                           glm::translate(glm::mat4(1.0f), places[i] + glm::vec3(drift, 0.0f, 0.0f)));
            }
            other.pose(hiddenOther, SUPPLE_BIND_POSE, 0.0,
                       glm::translate(glm::mat4(1.0f), glm::vec3(1.0f, 2.0f, -2.0f)));
            other.pose(seenOther, SUPPLE_BIND_POSE, 0.0,
                       glm::translate(glm::mat4(1.0f), glm::vec3(-12.0f, 3.0f, 0.0f)));
            const SuppleGroup groups[] = {crowd.group(), other.group()};
            context.run(groups);
        };
        // Statistics of the last frame but one: they come with the next.
        const auto expectStatistics = [&](uint32_t seen, uint32_t occluded) {
            const SuppleViewStatistics now = view.statistics();
            EXPECT_EQ(now.instanceCount, 13u);
            EXPECT_EQ(now.drawnInstanceCount, seen);
            EXPECT_EQ(now.occludedInstanceCount, occluded);
            EXPECT_EQ(now.backFaceCount, 0u);
        };
        const double step = 0.015625;

        frame();
        EXPECT_EQ(slotsOf(shown(crowd)), all) << "no pyramid yet";
        EXPECT_EQ(slotsOf(shown(other)), (std::set<uint32_t>{0, 1}));
        set(&wallDesc);
        frame();
        expectStatistics(13, 0);
        std::map<uint32_t, double> now = shown(crowd);
        EXPECT_EQ(slotsOf(now), others);
        for (const uint32_t slot : others) {
            EXPECT_NEAR(now[slot], step, 1e-5) << slot;
        }
        EXPECT_EQ(slotsOf(shown(other)), std::set<uint32_t>{1});
        frame(); // stands until set again
        expectStatistics(6, 7);
        EXPECT_EQ(slotsOf(shown(crowd)), others);
        set(&halfDesc);
        frame();
        EXPECT_EQ(slotsOf(shown(crowd)), others);
        context.cancel(crowd.group());
        set(&wallDesc);
        frame();
        EXPECT_EQ(slotsOf(shown(crowd)), others);
        frame();
        // The wall goes: what was behind it is new.
        set(nullptr);
        frame();
        expectStatistics(6, 7);
        now = shown(crowd);
        EXPECT_EQ(slotsOf(now), all);
        for (const uint32_t slot : all) {
            EXPECT_NEAR(now[slot], behind.count(slot) > 0 ? 0.0 : step, 1e-5) << slot;
        }
        frame();
        expectStatistics(13, 0);
        now = shown(crowd);
        for (const uint32_t slot : all) {
            EXPECT_NEAR(now[slot], step, 1e-5) << slot;
        }
        // Hidden by the host counts as neither.
        set(&wallDesc);
        crowd.setVisible(instances[0], false);
        frame();
        frame();
        const SuppleViewStatistics last = view.statistics();
        EXPECT_EQ(last.instanceCount, 12u);
        EXPECT_EQ(last.drawnInstanceCount, shown(crowd).size() + shown(other).size());
        EXPECT_EQ(last.occludedInstanceCount, 12 - last.drawnInstanceCount);
        EXPECT_LE(last.drawnInstanceCount, 7u);
    }
}

// What is hidden needs no room: others do not go for it.
TEST_P(Occlusion, WhatIsHiddenTakesNothingOfTheBudget) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 300'000, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION);
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(cage::makeCubeSphere(4));
    desc.capacity = 40;
    desc.scheme = SUPPLE_SCHEME_PREP;
    desc.view = view.handle();
    Crowd crowd(context, desc);
    ASSERT_TRUE(crowd.valid());
    // A wall over the left half of the picture, before what is farther than ten. Of forty instances in rows that go
    // away from the camera half are behind it; those before it are larger, those beside it as large as those behind.
    std::set<uint32_t> behind, seen;
    for (uint32_t i = 0; i < 40; ++i) {
        const bool left = i % 2 == 0;
        const auto away = 14.0f + 3.0f * static_cast<float>(i / 2);
        crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0,
                   glm::translate(glm::mat4(1.0f), glm::vec3((left ? -0.3f : 0.3f) * away, 0.0f, -away)));
        (left ? behind : seen).insert(i);
    }
    const glm::mat4 both = glm::perspectiveRH_ZO(glm::radians(60.0f), 16.0f / 9.0f, 0.5f, 200.0f);
    std::memcpy(view.camera.viewProjection, &both, sizeof(both));
    const glm::vec4 at = both * glm::vec4(0.0f, 0.0f, -10.0f, 1.0f);
    DepthPicture picture{320, 180, false, std::vector<float>(size_t{320} * 180, 1.0f)};
    for (uint32_t y = 0; y < picture.height; ++y) {
        std::fill_n(picture.depths.begin() + y * picture.width, picture.width / 2, at.z / at.w);
    }
    const auto wall = DepthPyramid::create(context.device(), picture, 320, 180);
    ASSERT_NE(wall, nullptr);
    const SuppleDepthPyramidDesc pyramid = wall->desc(columnsOf(both));
    const uint32_t least = crowd.output().surface.patchCount * 4; // vertices of an instance at its coarsest
    const uint32_t padding = crowd.output().levels.drawCount / 10 * 192;
    const auto run = [&](uint32_t room) {
        view.camera.vertexBudget = padding + room;
        view.look({0.0f, 0.0f, 0.0f});
        context.run(crowd.group());
        const std::set<uint32_t> slots = slotsOf(shown(crowd));
        context.run(crowd.group());
        return std::pair(slots, view.statistics());
    };
    // Room for twenty of forty: without the wall the nearest of both sides, with it all of the right side.
    const auto [without, freely] = run(20 * least);
    EXPECT_EQ(freely.droppedInstanceCount, 40 - without.size());
    EXPECT_GE(freely.droppedInstanceCount, 20u);
    EXPECT_FALSE(without.contains(39));
    EXPECT_EQ(suppleSetDepthPyramid(context.handle(), view.handle(), &pyramid), SUPPLE_OK);
    const auto [with, walled] = run(20 * least);
    EXPECT_EQ(with, seen);
    EXPECT_EQ(walled.droppedInstanceCount, 0u);
    EXPECT_EQ(walled.occludedInstanceCount, 20u);
    // Room for ten: the nearest ten of those that are seen, and what is hidden counts as hidden.
    const auto [ten, short10] = run(10 * least);
    EXPECT_EQ(ten, (std::set<uint32_t>{1, 3, 5, 7, 9, 11, 13, 15, 17, 19}));
    EXPECT_EQ(short10.droppedInstanceCount, 10u);
    EXPECT_EQ(short10.occludedInstanceCount, 20u);
    EXPECT_EQ(short10.shortfall, 1u);
}

TEST_P(Occlusion, OutOfThePictureIsNotBehindIt) {
    // A wall all over the picture at depth 0: only what lies in the picture, and before the eye, can be behind it.
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 300'000, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION);
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(cage::makeCubeSphere(2));
    desc.capacity = 4;
    desc.view = view.handle();
    Crowd crowd(context, desc);
    ASSERT_TRUE(crowd.valid());
    const std::vector<glm::vec3> places = {{0, 0, 0}, {14.5, 0, 0}, {0, 0, 20}, {0, -8.5, 0}};
    for (const glm::vec3& place : places) {
        crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), place));
    }
    const glm::mat4 both = glm::perspectiveRH_ZO(glm::radians(45.0f), 16.0f / 9.0f, 0.5f, 100.0f) *
                           glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.0f, -20.0f));
    std::memcpy(view.camera.viewProjection, &both, sizeof(both));
    view.look({0.0f, 0.0f, 20.0f});
    const DepthPicture picture{512, 288, false, std::vector<float>(size_t{512} * 288, 0.0f)};
    const auto wall = DepthPyramid::create(context.device(), picture, 512, 288);
    ASSERT_NE(wall, nullptr);
    SuppleDepthPyramidDesc pyramid = wall->desc(columnsOf(both));
    EXPECT_EQ(suppleSetDepthPyramid(context.handle(), view.handle(), &pyramid), SUPPLE_OK);
    context.run(crowd.group());
    EXPECT_EQ(slotsOf(shown(crowd)), (std::set<uint32_t>{1, 2, 3}));
    // One level alone: too fine for what is larger than eight of its texels.
    pyramid.mipLevels = 1;
    EXPECT_EQ(suppleSetDepthPyramid(context.handle(), view.handle(), &pyramid), SUPPLE_OK);
    context.run(crowd.group());
    EXPECT_EQ(slotsOf(shown(crowd)), (std::set<uint32_t>{0, 1, 2, 3}));
}

} // namespace
} // namespace supple::test
