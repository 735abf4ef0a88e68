// Groups that give back the memory of their surfaces while none of their instances is drawn
// (SuppleGroupDesc.keepUnseenFrames), and the bytes of a view (SuppleViewDesc.memoryBytes).
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace supple::test {
namespace {

constexpr uint32_t kGiving = 3;     ///< instances
constexpr uint64_t kKeptFrames = 2; ///< before memory goes back
constexpr float kStep = 0.1f;       ///< that instances rise in a frame

struct GivingUse {
    const char* name;
    SuppleScheme scheme = SUPPLE_SCHEME_PM;
    bool inView = true;
    bool plays = false;
    uint32_t groupFlags = 0;
    uint64_t coefficientBytes = 0;
};
constexpr GivingUse kGivingUses[] = {
    {"pm, at levels", SUPPLE_SCHEME_PM},
    {"catmull-clark, at levels, played", SUPPLE_SCHEME_CATMULL_CLARK, true, true},
    {"pm, with the view's coefficients", SUPPLE_SCHEME_PM, true, false, 0, 4u << 20},
    {"fragments, at rates", SUPPLE_SCHEME_FRAGMENTS},
    {"polygons, in a view", SUPPLE_SCHEME_POLYGONS},
    {"pm, at a rate", SUPPLE_SCHEME_PM, false, false,
     SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_PATCHES},
    {"pm, an indexed mesh, played", SUPPLE_SCHEME_PM, false, true,
     SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_INDEXED_MESH},
};

/// A group, in a view of its own if it is in one, whose instances move and can be out of sight.
class Giving {
public:
    Giving(CrowdContext& context, const GivingUse& use, SuppleAsset asset, uint64_t keepUnseenFrames)
        : context_(context), use_(use) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = kGiving;
        desc.scheme = use.scheme;
        desc.rate = 4;
        desc.flags = use.groupFlags;
        desc.poseSource = use.plays ? SUPPLE_POSES_PLAYBACK : SUPPLE_POSES_SET;
        desc.keepUnseenFrames = keepUnseenFrames;
        if (use.inView) {
            constexpr uint32_t kFlags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL | SUPPLE_VIEW_ATTRIBUTES;
            view_.emplace(context, 100'000, kFlags, 0, use.coefficientBytes);
            view_->camera.smallestEdge = 20.0f;
            desc.view = view_->handle();
        }
        crowd_ = std::make_unique<Crowd>(context, desc);
        for (uint32_t i = 0; i < kGiving; ++i) {
            instances_.push_back(crowd_->spawn());
        }
    }
    [[nodiscard]] bool valid() const { return crowd_->valid(); }
    [[nodiscard]] SuppleGroup group() const { return crowd_->group(); }
    [[nodiscard]] const Crowd& crowd() const { return *crowd_; }

    /// As the next frame finds it.
    void set(uint32_t frame, bool seen) {
        for (uint32_t i = 0; i < kGiving; ++i) {
            const glm::mat4 place = glm::translate(
                glm::mat4(1.0f), {3.0f * static_cast<float>(i) - 3.0f, kStep * static_cast<float>(frame), 0.0f});
            EXPECT_EQ(suppleSetTransform(context_.handle(), instances_[i], &place[0][0]), SUPPLE_OK);
        }
        if (!view_) {
            for (const SuppleInstance instance : instances_) {
                crowd_->setVisible(instance, seen);
            }
            return;
        }
        const glm::vec3 eye(0, 0.5f, 9), target = eye + glm::vec3(0, 0, seen ? -1 : 1);
        view_->look(eye, target, glm::perspectiveRH_ZO(1.2f, 1.0f, 0.1f, 100.0f));
    }
    [[nodiscard]] SuppleMemoryUse memory() const {
        SuppleMemoryUse use{};
        use.structSize = sizeof(use);
        EXPECT_EQ(suppleGetGroupMemory(context_.handle(), group(), &use), SUPPLE_OK);
        return use;
    }
    [[nodiscard]] SuppleGroupInfo info() const { return crowd_->output().info; }
    /// Nothing while its memory is given back.
    [[nodiscard]] DrawnPatches drawn() const {
        return info().surfacesGivenBack != 0 && !crowd_->output().hasLevels() ? DrawnPatches{} : drawnPatches(*crowd_);
    }
    [[nodiscard]] SuppleViewStatistics statistics() const { return view_->statistics(); }

private:
    CrowdContext& context_;
    const GivingUse& use_;
    std::optional<TestView> view_;
    std::unique_ptr<Crowd> crowd_;
    std::vector<SuppleInstance> instances_;
};

// Words of a corner in DrawnCorners, in a view.
constexpr size_t kVertex = 24 / sizeof(uint32_t), kPosition = 3, kCorner = kVertex + kPosition + 1; // capacity

/// What is drawn has risen by so much since the frame before, and has moved by nothing else.
void expectMotion(const DrawnPatches& drawn, float rise) {
    double worst = 0.0;
    for (const auto& [key, words] : drawn) {
        ASSERT_EQ(words.size() % kCorner, 0u);
        for (size_t c = 0; c < words.size(); c += kCorner) {
            glm::vec3 now, before;
            std::memcpy(&now, &words[c], sizeof now);
            std::memcpy(&before, &words[c + kVertex], sizeof before);
            raise(worst, static_cast<double>(glm::length(now - before - glm::vec3(0.0f, rise, 0.0f))));
        }
    }
    EXPECT_FALSE(drawn.empty());
    EXPECT_LE(worst, rise == 0.0f ? 0.0 : 1e-5);
}

/// Bytes of what goes back, beside scratch memory.
uint64_t ofSurfaces(const SuppleMemoryUse& use) {
    return use.vertices + use.streams + use.coefficients;
}

struct GivingContext {
    const char* name;
    SuppleMapping mapping;
    uint32_t flags = 0;
};
constexpr GivingContext kGivingContexts[] = {
    {"narrow", SUPPLE_MAPPING_NARROW},
    {"wide", SUPPLE_MAPPING_WIDE},
    {"shared", SUPPLE_MAPPING_WIDE, SUPPLE_CONTEXT_SHARED_DISPATCHES},
};
class GivenBack : public testing::TestWithParam<GivingContext> {
protected:
    void SetUp() override {
        ASSERT_NE(testDevice(), nullptr);
        context.emplace(*testDevice(), GetParam().mapping, 2, GetParam().flags);
        ASSERT_TRUE(context->valid());
    }
    [[nodiscard]] SuppleAsset assetFor(const GivingUse& use) {
        return use.plays ? context->createAsset(tubeFile(), "tube")
                         : context->createAsset(perturbed(cage::makeCubeSphere(3), 0.05f, 3));
    }
    const ValidationGuard guard;
    std::optional<CrowdContext> context;
};
INSTANTIATE_TEST_SUITE_P(Contexts, GivenBack, testing::ValuesIn(kGivingContexts),
                         [](const auto& param) { return param.param.name; });

TEST_P(GivenBack, MemoryFallsAndRisesAndBitsAreThoseOfAGroupThatKeepsIt) {
    for (const GivingUse& use : kGivingUses) {
        SCOPED_TRACE(use.name);
        const SuppleAsset asset = assetFor(use);
        Giving keeps(*context, use, asset, 0), gives(*context, use, asset, kKeptFrames);
        ASSERT_TRUE(keeps.valid() && gives.valid());
        const SuppleMemoryUse all = gives.memory();
        EXPECT_NEAR(static_cast<double>(ofSurfaces(all)), static_cast<double>(ofSurfaces(keeps.memory())), 2048)
            << "alignment";
        EXPECT_GT(ofSurfaces(all) + all.scratch, 3000u);
        uint64_t version = gives.info().surfaceVersion, least = all.deviceLocal;
        constexpr std::string_view kScript = "ssnsnnssnnnnnnnsssnnnnnss"; // seen or not
        uint32_t unseen = 0, given = 0, before = 0, patches = 0;
        for (uint32_t frame = 0; frame < kScript.size(); ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            const bool seen = kScript[frame] == 's';
            for (Giving* group : {&keeps, &gives}) {
                group->set(frame, seen);
            }
            const std::vector<SuppleGroup> both = {keeps.group(), gives.group()};
            context->run(both);
            const SuppleGroupInfo info = gives.info();
            EXPECT_EQ(info.surfacesGivenBack, !seen && unseen >= kKeptFrames ? 1u : 0u);
            EXPECT_EQ(info.surfaceVersion - version, info.surfacesGivenBack != before ? 1u : 0u);
            before = info.surfacesGivenBack;
            version = info.surfaceVersion;
            unseen = seen ? 0 : unseen + 1;
            const DrawnPatches expected = keeps.drawn();
            EXPECT_EQ(expected.empty(), !seen);
            EXPECT_TRUE(gives.drawn() == expected);
            patches += static_cast<uint32_t>(expected.size());
            const SuppleMemoryUse now = gives.memory();
            EXPECT_EQ(now.deviceLocal + now.givenBack, all.deviceLocal);
            if (now.givenBack > 0) {
                ++given;
                least = std::min(least, now.deviceLocal);
                EXPECT_EQ(ofSurfaces(now), 0u);
                EXPECT_GE(now.givenBack, ofSurfaces(all));
                EXPECT_LT(now.deviceLocal, all.deviceLocal * 3 / 4);
                EXPECT_EQ(info.surfacesGivenBack, 1u);
            }
        }
        EXPECT_GT(given, 4u) << "frames without the memory";
        std::printf("%s: %llu bytes on the device, %llu of them while nobody sees it\n", use.name,
                    static_cast<unsigned long long>(all.deviceLocal), static_cast<unsigned long long>(least));
        EXPECT_GT(patches, 20u);
        EXPECT_GT(version, 3u);
    }
}

TEST_P(GivenBack, WhatComesIntoSightInsideAFrameIsDrawnAFrameLaterAndHasNoMotion) {
    const GivingUse& use = kGivingUses[0];
    const SuppleAsset asset = assetFor(use);
    Giving keeps(*context, use, asset, 0), gives(*context, use, asset, kKeptFrames);
    ASSERT_TRUE(keeps.valid() && gives.valid());
    const std::vector<SuppleGroup> both = {keeps.group(), gives.group()};
    const auto run = [&](uint32_t number, bool seen, bool late) {
        if (!late) {
            keeps.set(number, seen);
            gives.set(number, seen);
        }
        context->beginFrame();
        if (late) {
            keeps.set(number, seen);
            gives.set(number, seen);
        }
        ASSERT_TRUE(
            context->device()
                .submitAndWait([&](VkCommandBuffer commands) { EXPECT_EQ(context->record(commands, both), SUPPLE_OK); })
                .ok());
    };
    for (uint32_t frame = 0; frame < 6; ++frame) {
        run(frame, frame < 2, false);
    }
    ASSERT_GT(gives.memory().givenBack, 0u);
    run(6, true, true);
    EXPECT_FALSE(keeps.drawn().empty());
    expectMotion(keeps.drawn(), 0.0f);
    EXPECT_TRUE(gives.drawn().empty());
    EXPECT_EQ(gives.info().surfacesGivenBack, 1u);
    context->beginFrame();
    EXPECT_EQ(gives.statistics().unposedInstanceCount, kGiving);
    EXPECT_EQ(gives.statistics().instanceCount, kGiving);
    run(7, true, true);
    // The vertices of the group that has drawn all the time; but they are where they were in the frame before.
    const DrawnPatches expected = keeps.drawn(), drawn = gives.drawn();
    ASSERT_EQ(drawn.size(), expected.size());
    EXPECT_FALSE(drawn == expected) << "all instances have moved";
    size_t corners = 0;
    for (const auto& [key, words] : drawn) {
        const DrawnCorners& other = expected.at(key);
        ASSERT_EQ(words.size(), other.size());
        for (size_t c = 0; c < words.size(); c += kCorner, ++corners) {
            ASSERT_TRUE(std::equal(&words[c], &words[c] + kVertex, &other[c]));
        }
    }
    EXPECT_GT(corners, 1000u);
    expectMotion(drawn, 0.0f);
    expectMotion(expected, kStep);
    run(8, true, true);
    expectMotion(gives.drawn(), kStep);
    EXPECT_TRUE(gives.drawn() == keeps.drawn()) << "motion is exact from the second frame on";
}

TEST_P(GivenBack, WhatReturnsInACancelledFrameIsZeroedInTheNextOne) {
    for (const size_t number : {0u, 1u, 3u, 5u}) {
        const GivingUse& use = kGivingUses[number];
        SCOPED_TRACE(use.name);
        const SuppleAsset asset = assetFor(use);
        Giving keeps(*context, use, asset, 0), gives(*context, use, asset, kKeptFrames);
        ASSERT_TRUE(keeps.valid() && gives.valid());
        const std::vector<SuppleGroup> both = {keeps.group(), gives.group()};
        const auto set = [&](uint32_t frame, bool seen) {
            keeps.set(frame, seen);
            gives.set(frame, seen);
        };
        for (uint32_t frame = 0; frame < 6; ++frame) {
            set(frame, frame < 2);
            context->run(both);
        }
        ASSERT_EQ(gives.info().surfacesGivenBack, 1u);
        for (uint32_t frame = 6; frame < 8; ++frame) { // with the buffers that it has taken once
            set(frame, true);
            context->cancel(both);
            EXPECT_EQ(gives.info().surfacesGivenBack, 0u);
        }
        for (uint32_t frame = 8; frame < 11; ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            set(frame, true);
            context->run(both);
            EXPECT_TRUE(gives.drawn() == keeps.drawn());
            EXPECT_FALSE(gives.drawn().empty());
            if (use.inView && !use.plays && use.scheme == SUPPLE_SCHEME_PM) {
                expectMotion(gives.drawn(), frame == 8 ? 0.0f : kStep); // cancelled frames have shown nothing
            }
        }
    }
}

TEST_P(GivenBack, WhatACancelledFrameHasZeroedStaysUntilAFrameHasDoneSo) {
    const GivingUse& use = kGivingUses[0];
    Giving gives(*context, use, assetFor(use), 1);
    ASSERT_TRUE(gives.valid());
    for (uint32_t frame = 0; frame < 4; ++frame) {
        gives.set(frame, frame < 1);
        context->run(gives.group());
    }
    ASSERT_GT(gives.memory().givenBack, 0u);
    // It is in sight when the frame begins, and no longer when the frame is recorded.
    gives.set(4, true);
    context->beginFrame();
    ASSERT_EQ(gives.info().surfacesGivenBack, 0u);
    gives.set(4, false);
    Commands dropped(context->device());
    const SuppleGroup group = gives.group();
    dropped.record([&](VkCommandBuffer commands) { EXPECT_EQ(context->record(commands, {&group, 1}), SUPPLE_OK); });
    ASSERT_EQ(suppleCancelFrame(context->handle()), SUPPLE_OK);
    context->run(group);
    EXPECT_EQ(gives.info().surfacesGivenBack, 0u) << "this frame zeroes it";
    context->run(group);
    EXPECT_EQ(gives.info().surfacesGivenBack, 1u);
    gives.set(5, true);
    context->run(group);
    EXPECT_FALSE(gives.drawn().empty());
    expectMotion(gives.drawn(), 0.0f);
}

TEST_P(GivenBack, WithoutMemoryNothingIsDrawnAndTheNextFramesTryAgain) {
    CrowdContext own(*testDevice(), GetParam().mapping, 2, GetParam().flags);
    const GivingUse& use = kGivingUses[5];
    const SuppleAsset asset = own.createAsset(perturbed(cage::makeCubeSphere(3), 0.05f, 3));
    Giving gives(own, use, asset, 1);
    ASSERT_TRUE(gives.valid());
    const auto run = [&](uint32_t frame, bool seen) {
        gives.set(frame, seen);
        own.run(gives.group());
    };
    run(0, true);
    const DrawnPatches before = gives.drawn();
    for (uint32_t frame = 0; frame < 5; ++frame) {
        run(0, false);
    }
    ASSERT_GT(gives.memory().givenBack, 0u);
    // Blocks are not taken to pieces: what is free in them would be enough.
    SuppleMemoryUse whole{};
    whole.structSize = sizeof(whole);
    ASSERT_EQ(suppleGetContextMemory(own.handle(), &whole), SUPPLE_OK);
    const bool refusable = whole.spare == 0;
    ASSERT_TRUE(refusable) << "the context of tests has no blocks";
    ASSERT_EQ(suppleSetMemoryBudget(own.handle(), 1, nullptr, nullptr), SUPPLE_OK);
    (void)own.takeLines();
    for (uint32_t frame = 0; frame < 3; ++frame) {
        run(0, true);
        EXPECT_EQ(gives.info().surfacesGivenBack, 1u);
        EXPECT_EQ(own.takeCount(SUPPLE_MESSAGE_DEVICE_MEMORY), frame == 0 ? 1u : 0u) << "it is said once";
    }
    ASSERT_EQ(suppleSetMemoryBudget(own.handle(), 0, nullptr, nullptr), SUPPLE_OK);
    run(0, true);
    EXPECT_EQ(gives.info().surfacesGivenBack, 0u);
    EXPECT_TRUE(gives.drawn() == before);
}

TEST_P(GivenBack, WhoseInstancesAnotherGroupDrawsKeepsItsMemory) {
    const GivingUse& use = kGivingUses[0];
    const SuppleAsset asset = assetFor(use);
    Giving gives(*context, use, asset, 1);
    const auto run = [&](std::span<const SuppleGroup> groups, bool seen) {
        gives.set(0, seen);
        context->run(groups);
    };
    const SuppleGroup leader = gives.group();
    for (uint32_t frame = 0; frame < 5; ++frame) {
        run({&leader, 1}, false);
    }
    ASSERT_GT(gives.memory().givenBack, 0u);
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.instancesOf = leader;
    desc.rate = 2;
    Crowd follower(*context, desc);
    const std::vector<SuppleGroup> both = {leader, follower.group()};
    for (uint32_t frame = 0; frame < 5; ++frame) {
        run(both, false);
    }
    EXPECT_EQ(gives.memory().givenBack, 0u);
    EXPECT_FALSE(drawnPatches(follower).empty());
    // A capacity makes it anew, with its memory. Its version goes on.
    const uint64_t version = gives.info().surfaceVersion;
    EXPECT_GE(version, 2u) << "given back, and taken again";
    ASSERT_EQ(suppleSetCapacity(context->handle(), leader, kGiving + 2), SUPPLE_OK);
    run(both, true);
    EXPECT_FALSE(gives.drawn().empty());
    EXPECT_GE(gives.info().surfaceVersion, version);
}

TEST_P(GivenBack, AViewStaysWithinItsBytes) {
    constexpr uint64_t kBytes = 24u << 20;
    SuppleViewDesc desc{};
    desc.structSize = sizeof(desc);
    desc.flags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES;
    desc.maxVertices = 100'000;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    desc.memoryBytes = kBytes;
    SuppleView view{};
    ASSERT_EQ(suppleCreateView(context->handle(), &desc, &view), SUPPLE_OK);
    SuppleMemoryUse use{};
    use.structSize = sizeof(use);
    ASSERT_EQ(suppleGetViewMemory(context->handle(), view, &use), SUPPLE_OK);
    EXPECT_LE(use.deviceLocal, kBytes + 4096) << "alignment";
    EXPECT_GE(use.deviceLocal, kBytes - 1024);
    EXPECT_EQ(use.deviceLocal, use.vertices + use.streams + use.coefficients + use.lists + use.tables);
    EXPECT_GT(use.coefficients, kBytes / 8);
    ASSERT_EQ(suppleDestroyView(context->handle(), view), SUPPLE_OK);
    // What is asked for beside it must have room.
    desc.coefficientBytes = 8u << 20;
    ASSERT_EQ(suppleCreateView(context->handle(), &desc, &view), SUPPLE_ERROR_LIMIT);
    desc.memoryBytes = kBytes * 2;
    ASSERT_EQ(suppleCreateView(context->handle(), &desc, &view), SUPPLE_OK);
    ASSERT_EQ(suppleGetViewMemory(context->handle(), view, &use), SUPPLE_OK);
    EXPECT_EQ(use.coefficients, uint64_t{16} << 20);
    ASSERT_EQ(suppleDestroyView(context->handle(), view), SUPPLE_OK);
    desc.coefficientBytes = 0;
    desc.memoryBytes = 1u << 20;
    EXPECT_EQ(suppleCreateView(context->handle(), &desc, &view), SUPPLE_ERROR_LIMIT);
    (void)context->takeLines();
}

} // namespace
} // namespace supple::test
