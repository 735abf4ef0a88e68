// Static data by a budget (suppleSetUploadBudget): groups wait for theirs and draw nothing, and then have the bits of
// groups that never waited, whatever happens in between.
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/side_by_side.h"
#include "tests/support/test_view.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

constexpr VkDeviceSize kBudget = 4096; ///< a frame; the tubes below need several
constexpr uint32_t kMostFrames = 200;  ///< any of them takes less

cage::Character uploadedTube(uint32_t sides = 10) {
    cage::Character tube = riggedTube({.segments = 12, .sides = sides, .morphTargets = 2});
    tube.name = "tube";
    return tube;
}

SuppleUploadState stateOf(const CrowdContext& context) {
    SuppleUploadState state{};
    state.structSize = sizeof(state);
    EXPECT_EQ(suppleGetUploadState(context.handle(), &state), SUPPLE_OK);
    return state;
}
SuppleUploadState stateOf(const CrowdContext& context, SuppleGroup group) {
    SuppleUploadState state{};
    state.structSize = sizeof(state);
    EXPECT_EQ(suppleGetGroupUploadState(context.handle(), group, &state), SUPPLE_OK);
    return state;
}
SuppleUploadState stateOf(const CrowdContext& context, SuppleAsset asset) {
    SuppleUploadState state{};
    state.structSize = sizeof(state);
    EXPECT_EQ(suppleGetAssetUploadState(context.handle(), asset, &state), SUPPLE_OK);
    return state;
}

/// What the indirect draws draw. Where they draw nothing, nothing else is looked at.
DrawnPatches drawnOf(const Crowd& crowd) {
    const std::vector<VkDrawIndexedIndirectCommand> draws = crowd.draws();
    EXPECT_FALSE(draws.empty());
    const bool any = std::ranges::any_of(draws, [](const auto& draw) { return draw.instanceCount > 0; });
    return any ? drawnPatches(crowd) : DrawnPatches();
}

/// A group of two tubes with poses of their own.
struct UploadedTubes {
    UploadedTubes(CrowdContext& context, SuppleGroupDesc desc) : crowd(context, desc) {
        if (!crowd.valid()) {
            return;
        }
        for (uint32_t i = 0; i < 2 && desc.instancesOf.id == 0; ++i) {
            instances.push_back(crowd.spawn());
            const glm::mat4 place = glm::translate(glm::mat4(1.0f), glm::vec3(3.0f * i, 0.5f * i, 0.0f));
            EXPECT_EQ(suppleSetTransform(context.handle(), instances.back(), glm::value_ptr(place)), SUPPLE_OK);
        }
    }
    [[nodiscard]] DrawnPatches drawn(std::span<const SuppleGroup> frame = {}) {
        const SuppleGroup own[] = {crowd.group()};
        crowd.context().run(frame.empty() ? std::span<const SuppleGroup>(own) : frame);
        crowd.read();
        return drawnOf(crowd);
    }
    /// Frames until the group is there; `each` before every frame. Draws nothing till then. Returns how many drew
    /// nothing.
    template <class F>
    uint32_t await(F&& each, std::span<const SuppleGroup> frame = {}) {
        uint32_t waited = 0;
        while (stateOf(crowd.context(), crowd.group()).complete == 0 && waited < kMostFrames) {
            each();
            last = drawn(frame);
            const SuppleUploadState state = stateOf(crowd.context(), crowd.group());
            EXPECT_EQ(last.empty(), state.complete == 0) << "frame " << waited;
            waited += state.complete == 0 ? 1 : 0;
        }
        EXPECT_LT(waited, kMostFrames);
        return waited;
    }
    uint32_t await() {
        return await([] {});
    }

    Crowd crowd;
    std::vector<SuppleInstance> instances;
    DrawnPatches last; ///< of await()
};

class BudgetedUploads : public CrowdContexts {
protected:
    /// A context for the test alone.
    static std::unique_ptr<CrowdContext> bounded(SuppleMapping mapping, VkDeviceSize bytes = kBudget) {
        auto made = std::make_unique<CrowdContext>(*testDevice(), mapping);
        EXPECT_EQ(suppleSetUploadBudget(made->handle(), bytes), SUPPLE_OK);
        return made;
    }
};

struct UploadCase {
    const char* name;
    SuppleGroupDesc desc;
    bool inView = false;
};
const UploadCase kUploadCases[] = {
    {"grids", {.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, .scheme = SUPPLE_SCHEME_PM, .rate = 4}},
    {"mesh", {.flags = SUPPLE_GROUP_INDEXED_MESH, .scheme = SUPPLE_SCHEME_PM, .rate = 3}},
    {"polygons", {.scheme = SUPPLE_SCHEME_POLYGONS}},
    {"playing", {.scheme = SUPPLE_SCHEME_PM, .rate = 2, .poseSource = SUPPLE_POSES_PLAYBACK}},
    {"levels", {.scheme = SUPPLE_SCHEME_PM}, true},
    {"rates", {.scheme = SUPPLE_SCHEME_FRAGMENTS, .rate = 4}, true},
};
class UploadsOf : public BudgetedUploads, public testing::WithParamInterface<UploadCase> {
protected:
    /// The group of the case, with a view if it has one.
    struct Made {
        Made(CrowdContext& context, SuppleAsset asset) {
            SuppleGroupDesc desc = GetParam().desc;
            desc.asset = asset;
            desc.capacity = 2;
            if (GetParam().inView) {
                view = std::make_unique<TestView>(context, 400000);
                view->look({1.0f, 2.0f, 9.0f});
                desc.view = view->handle();
            }
            tubes = std::make_unique<UploadedTubes>(context, desc);
            if (desc.poseSource == SUPPLE_POSES_PLAYBACK) {
                EXPECT_EQ(suppleSetTime(context.handle(), tubes->crowd.group(), 0.3), SUPPLE_OK);
            }
        }
        std::unique_ptr<TestView> view;
        std::unique_ptr<UploadedTubes> tubes;
    };

    /// What the group of the case draws of a character in a context without a budget.
    DrawnPatches drawnWithoutBudget(const cage::Character& character) {
        CrowdContext& free = context(SUPPLE_MAPPING_NARROW);
        Made made(free, free.createAsset(character));
        return made.tubes->drawn();
    }
};
INSTANTIATE_TEST_SUITE_P(Kinds, UploadsOf, testing::ValuesIn(kUploadCases),
                         [](const auto& param) { return std::string(param.param.name); });

TEST_P(UploadsOf, ArriveInPiecesAndAreDrawnWithTheSameBits) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        CrowdContext& free = context(mapping);
        const SuppleAsset asset = free.createAsset(uploadedTube());
        Made expected(free, asset);
        const DrawnPatches drawn = expected.tubes->drawn();
        ASSERT_FALSE(drawn.empty());
        EXPECT_EQ(stateOf(free, expected.tubes->crowd.group()).complete, 1u);

        const auto own = bounded(mapping);
        const SuppleAsset arriving = own->createAsset(uploadedTube());
        Made made(*own, arriving);
        const SuppleUploadState before = stateOf(*own, made.tubes->crowd.group());
        EXPECT_EQ(before.complete, 0u);
        EXPECT_EQ(before.bytes, before.bytesLeft);
        VkDeviceSize left = before.bytesLeft;
        const uint32_t waited = made.tubes->await([&] {
            const SuppleUploadState state = stateOf(*own, made.tubes->crowd.group());
            EXPECT_LE(state.frameBytes, kBudget);
            EXPECT_LE(state.bytesLeft, left);
            left = state.bytesLeft;
        });
        EXPECT_EQ(waited, (before.bytes - 1) / kBudget);
        EXPECT_GT(waited, 1u);
        EXPECT_TRUE(made.tubes->last == drawn);
        const SuppleUploadState all = stateOf(*own);
        EXPECT_EQ(all.bytesLeft, 0u);
        EXPECT_GE(all.totalBytes, before.bytes);
        EXPECT_EQ(own->takeError(), 0);
    }
}

TEST_P(UploadsOf, GoOnWhereFramesAreCancelled) {
    const ValidationGuard guard;
    const DrawnPatches drawn = drawnWithoutBudget(uploadedTube());
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    Made made(*own, own->createAsset(uploadedTube()));
    const SuppleGroup group = made.tubes->crowd.group();
    made.tubes->await([&] {
        const SuppleUploadState before = stateOf(*own, group);
        own->cancel(group);
        EXPECT_EQ(stateOf(*own, group).bytesLeft, before.bytesLeft);
        EXPECT_EQ(stateOf(*own).frameBytes, 0u);
    });
    // The last piece and the first passes, in a frame that never runs.
    own->cancel(group);
    EXPECT_TRUE(made.tubes->drawn() == drawn);
}

TEST_P(UploadsOf, AreThereAtOnceInAGroupThatGrows) {
    const ValidationGuard guard;
    const DrawnPatches drawn = drawnWithoutBudget(uploadedTube());
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    Made made(*own, own->createAsset(uploadedTube()));
    const SuppleGroup group = made.tubes->crowd.group();
    (void)made.tubes->drawn();
    ASSERT_EQ(stateOf(*own, group).complete, 0u);
    ASSERT_EQ(suppleSetCapacity(own->handle(), group, 3), SUPPLE_OK);
    made.tubes->await();
    const VkDeviceSize total = stateOf(*own).totalBytes;
    ASSERT_EQ(suppleSetCapacity(own->handle(), group, 5), SUPPLE_OK);
    EXPECT_EQ(stateOf(*own, group).complete, 1u);
    EXPECT_TRUE(made.tubes->drawn() == drawn);
    EXPECT_EQ(stateOf(*own).totalBytes, total) << "all was shared";
}

TEST_P(UploadsOf, BeginAnewWhereTheAssetIsReloaded) {
    const ValidationGuard guard;
    const DrawnPatches drawn = drawnWithoutBudget(uploadedTube(12));
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own->createAsset(uploadedTube());
    Made made(*own, asset);
    made.tubes->await();
    EXPECT_EQ(own->reloadAsset(asset, uploadedTube(12)), SUPPLE_OK);
    EXPECT_GT(made.tubes->await(), 1u);
    EXPECT_TRUE(made.tubes->last == drawn);
    // In a view a version takes the place of the one before the last, whose draws no frame has taken away but those in
    // which all wait.
    EXPECT_EQ(own->reloadAsset(asset, uploadedTube()), SUPPLE_OK);
    for (uint32_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(made.tubes->drawn().empty());
    }
    EXPECT_EQ(own->reloadAsset(asset, uploadedTube(12)), SUPPLE_OK);
    EXPECT_GT(made.tubes->await(), 1u);
    EXPECT_TRUE(made.tubes->last == drawn);
}

TEST_P(UploadsOf, AreFinishedByTheNextFrameWhereTheBudgetEnds) {
    const ValidationGuard guard;
    const DrawnPatches drawn = drawnWithoutBudget(uploadedTube());
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own->createAsset(uploadedTube()), unused = own->createAsset(uploadedTube());
    Made made(*own, asset);
    EXPECT_TRUE(made.tubes->drawn().empty());
    ASSERT_EQ(suppleSetUploadBudget(own->handle(), 2 * kBudget), SUPPLE_OK);
    EXPECT_TRUE(made.tubes->drawn().empty());
    ASSERT_EQ(suppleSetUploadBudget(own->handle(), 0), SUPPLE_OK);
    EXPECT_TRUE(made.tubes->drawn() == drawn);
    EXPECT_EQ(stateOf(*own, unused).complete, 0u) << "no group has needed it";
    Made second(*own, unused);
    EXPECT_TRUE(second.tubes->drawn() == drawn);
    // And one sets in where data waits in staging memory of its own.
    Made third(*own, own->createAsset(uploadedTube()));
    ASSERT_EQ(suppleSetUploadBudget(own->handle(), kBudget), SUPPLE_OK);
    EXPECT_GT(third.tubes->await(), 1u);
    EXPECT_TRUE(third.tubes->last == drawn);
}

SuppleGroupDesc plainTubes(SuppleAsset asset) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 2;
    return desc;
}

TEST_F(BudgetedUploads, ServeGroupsInTheOrderOfTheCall) {
    const ValidationGuard guard;
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    UploadedTubes first(*own, plainTubes(own->createAsset(uploadedTube())));
    UploadedTubes second(*own, plainTubes(own->createAsset(uploadedTube())));
    const SuppleGroup frame[] = {second.crowd.group(), first.crowd.group()};
    second.await([] {}, frame);
    EXPECT_EQ(stateOf(*own, first.crowd.group()).complete, 0u);
    EXPECT_GT(first.await(
                  [&] {
                      const SuppleUploadState state = stateOf(*own);
                      EXPECT_LE(state.frameBytes, kBudget);
                  },
                  frame),
              1u);
    second.crowd.read();
    EXPECT_FALSE(drawnOf(second.crowd).empty()) << "the one that is there goes on";
}

TEST_F(BudgetedUploads, CountWhatIsSharedOnce) {
    const ValidationGuard guard;
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own->createAsset(uploadedTube());
    UploadedTubes first(*own, plainTubes(asset)), second(*own, plainTubes(asset));
    const SuppleUploadState one = stateOf(*own, first.crowd.group()), all = stateOf(*own),
                            shared = stateOf(*own, asset);
    EXPECT_EQ(one.bytes, stateOf(*own, second.crowd.group()).bytes);
    EXPECT_LT(all.bytes, 2 * one.bytes);
    EXPECT_GT(all.bytes, one.bytes);
    EXPECT_LT(shared.bytes, one.bytes);
    first.await();
    EXPECT_EQ(stateOf(*own, asset).complete, 1u);
    EXPECT_LT(stateOf(*own, second.crowd.group()).bytesLeft, kBudget) << "indices";
    EXPECT_FALSE(second.drawn().empty());
    EXPECT_EQ(stateOf(*own).totalBytes, all.bytes);
}

TEST_F(BudgetedUploads, NeedNothingForAnotherRate) {
    const ValidationGuard guard;
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    SuppleGroupDesc desc = plainTubes(own->createAsset(uploadedTube()));
    desc.rate = 4;
    UploadedTubes tubes(*own, desc);
    (void)tubes.drawn();
    tubes.crowd.setRate(2); // while it waits
    tubes.await();
    const DrawnPatches coarse = tubes.drawn();
    tubes.crowd.setRate(3);
    EXPECT_EQ(stateOf(*own, tubes.crowd.group()).complete, 1u);
    EXPECT_FALSE(tubes.drawn() == coarse);
    tubes.crowd.setRate(2);
    EXPECT_TRUE(tubes.drawn() == coarse);
}

TEST_F(BudgetedUploads, GoUpWithWarmUpsAndUploadsToo) {
    const ValidationGuard guard;
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    UploadedTubes tubes(*own, plainTubes(own->createAsset(uploadedTube())));
    const SuppleGroup group = tubes.crowd.group();
    uint32_t frames = 0;
    for (; stateOf(*own, group).complete == 0 && frames < kMostFrames; ++frames) {
        own->beginFrame();
        ASSERT_TRUE(own->device()
                        .submitAndWait([&](VkCommandBuffer commands) {
                            EXPECT_EQ(frames % 2 == 0 ? suppleRecordWarmUp(own->handle(), commands, &group, 1)
                                                      : suppleRecordUploads(own->handle(), commands),
                                      SUPPLE_OK);
                            EXPECT_EQ(own->record(commands, {&group, 1}), SUPPLE_OK);
                        })
                        .ok());
        EXPECT_LE(stateOf(*own).frameBytes, kBudget);
    }
    EXPECT_GT(frames, 2u);
    EXPECT_FALSE(tubes.drawn().empty());
}

TEST_F(BudgetedUploads, KeepFollowersWaitingForTheirLeader) {
    const ValidationGuard guard;
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own->createAsset(uploadedTube());
    SuppleGroupDesc large = plainTubes(asset);
    large.flags = SUPPLE_GROUP_INDEXED_MESH; // its indices come last
    large.rate = 8;
    UploadedTubes leader(*own, large);
    SuppleGroupDesc follows = plainTubes(asset);
    follows.capacity = 0;
    follows.instancesOf = leader.crowd.group();
    UploadedTubes follower(*own, follows);
    EXPECT_EQ(stateOf(*own, follower.crowd.group()).complete, 0u);
    // The follower is named first and has its data first.
    const SuppleGroup frame[] = {follower.crowd.group(), leader.crowd.group()};
    const uint32_t waited = leader.await(
        [&] {
            follower.crowd.read();
            if (own->frame > 0) {
                EXPECT_TRUE(drawnOf(follower.crowd).empty());
            }
        },
        frame);
    EXPECT_GT(waited, 2u);
    EXPECT_FALSE(follower.drawn(frame).empty());
}

TEST_F(BudgetedUploads, LeaveOutSomeGroupsOfAView) {
    const ValidationGuard guard;
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    TestView view(*own, 400000);
    view.look({1.0f, 2.0f, 9.0f});
    SuppleGroupDesc desc = plainTubes(own->createAsset(uploadedTube()));
    desc.view = view.handle();
    UploadedTubes first(*own, desc);
    first.await();
    const DrawnPatches alone = first.drawn();
    desc.asset = own->createAsset(uploadedTube());
    UploadedTubes second(*own, desc);
    const SuppleGroup frame[] = {second.crowd.group(), first.crowd.group()};
    EXPECT_GT(second.await(
                  [&] {
                      first.crowd.read();
                      EXPECT_TRUE(drawnOf(first.crowd) == alone);
                  },
                  frame),
              1u);
    const SuppleGroup both[] = {first.crowd.group(), second.crowd.group()};
    EXPECT_FALSE(second.drawn(both).empty());
    EXPECT_EQ(drawnOf(first.crowd).size(), alone.size());
}

TEST_F(BudgetedUploads, SayNothingOfGroupsThatWait) {
    const ValidationGuard guard;
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    UploadedTubes there(*own, plainTubes(own->createAsset(uploadedTube())));
    there.await();
    ASSERT_EQ(suppleSetUploadBudget(own->handle(), 16), SUPPLE_OK);
    UploadedTubes waits(*own, plainTubes(own->createAsset(uploadedTube())));
    (void)waits.crowd.output();
    own->takeLines();
    const SuppleGroup frame[] = {there.crowd.group(), waits.crowd.group()};
    for (uint32_t i = 0; i < 12; ++i) {
        own->run(frame);
    }
    EXPECT_EQ(own->takeCount(SUPPLE_MESSAGE_NEVER_RECORDED), 0u);
    EXPECT_EQ(stateOf(*own, waits.crowd.group()).complete, 0u);
    // Recorded twice is recorded twice.
    own->beginFrame();
    Commands commands(own->device());
    commands.record([&](VkCommandBuffer buffer) {
        EXPECT_EQ(own->record(buffer, frame), SUPPLE_OK);
        EXPECT_EQ(own->record(buffer, {frame + 1, 1}), SUPPLE_ERROR_ARGUMENT);
    });
    EXPECT_EQ(suppleCancelFrame(own->handle()), SUPPLE_OK);
}

TEST_F(BudgetedUploads, GoOnWhereGroupsAndAssetsGo) {
    const ValidationGuard guard;
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    UploadedTubes stays(*own, plainTubes(own->createAsset(uploadedTube())));
    for (uint32_t i = 0; i < 6; ++i) {
        const SuppleAsset asset = own->createAsset(uploadedTube());
        UploadedTubes goes(*own, plainTubes(asset));
        EXPECT_EQ(suppleDestroyAsset(own->handle(), asset), SUPPLE_OK);
        const SuppleGroup frame[] = {goes.crowd.group(), stays.crowd.group()};
        own->run(frame);
        if (i % 2 == 0) {
            own->run(frame);
        } else {
            own->cancel(frame);
        }
    }
    stays.await();
    EXPECT_EQ(stateOf(*own).bytesLeft, 0u);
}

TEST_F(BudgetedUploads, AreHandedOverOnce) {
    const ValidationGuard guard;
    LoggedContext own(*testDevice(), [](SuppleContextDesc& desc) {
        desc.flags |= SUPPLE_CONTEXT_ASYNC_COMPUTE;
        desc.drawQueueFamily = desc.queueFamily;
    });
    ASSERT_EQ(suppleSetUploadBudget(own.handle(), kBudget), SUPPLE_OK);
    SuppleAsset asset{};
    ASSERT_EQ(createTube(own.handle(), asset), SUPPLE_OK);
    const SmallGroup group = createGroup(own.handle(), asset, {.scheme = SUPPLE_SCHEME_PM, .rate = 8});
    ASSERT_EQ(group.result, SUPPLE_OK);
    const VkBuffer indices = outputOf(own.handle(), group.group).grid.indices.buffer;
    const auto handedOver = [&] {
        std::vector<VkBufferMemoryBarrier2> barriers(64);
        auto count = static_cast<uint32_t>(barriers.size());
        EXPECT_EQ(suppleGetAcquireBarriers(own.handle(), &group.group, 1, kAnyUse, barriers.data(), &count), SUPPLE_OK);
        barriers.resize(count);
        EXPECT_GT(count, 1u);
        return std::ranges::count(barriers, indices, &VkBufferMemoryBarrier2::buffer);
    };
    SuppleUploadState state{};
    state.structSize = sizeof(state);
    uint32_t frames = 0;
    do {
        own.evaluate({&group.group, 1});
        EXPECT_EQ(suppleGetGroupUploadState(own.handle(), group.group, &state), SUPPLE_OK);
        EXPECT_EQ(handedOver(), static_cast<ptrdiff_t>(state.complete)) << "frame " << frames;
    } while (state.complete == 0 && ++frames < kMostFrames);
    EXPECT_GT(frames, 1u);
    own.evaluate({&group.group, 1});
    EXPECT_EQ(handedOver(), 0);
    own.beginFrame();
    ASSERT_EQ(suppleSetCapacity(own.handle(), group.group, 2), SUPPLE_OK);
    own.evaluate({&group.group, 1});
    EXPECT_EQ(outputOf(own.handle(), group.group).grid.indices.buffer, indices);
    EXPECT_EQ(handedOver(), 0) << "the draws have it";
}

TEST_F(BudgetedUploads, AllocateNothingWhileTheyAreRecorded) {
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    UploadedTubes tubes(*own, plainTubes(own->createAsset(uploadedTube())));
    const SuppleGroup group = tubes.crowd.group();
    SuppleMemoryUse before{}, after{};
    before.structSize = after.structSize = sizeof(before);
    for (uint32_t frames = 0; frames < 3; ++frames) {
        own->beginFrame();
        EXPECT_EQ(suppleGetContextMemory(own->handle(), &before), SUPPLE_OK);
        ASSERT_TRUE(own->device()
                        .submitAndWait([&](VkCommandBuffer commands) {
                            SuppleRecordDesc desc{};
                            desc.structSize = sizeof(desc);
                            desc.groups = &group;
                            desc.groupCount = 1;
                            desc.before = desc.after = kAnyUse;
                            EXPECT_EQ(suppleRecord(own->handle(), commands, &desc), SUPPLE_OK);
                        })
                        .ok());
        EXPECT_EQ(suppleGetContextMemory(own->handle(), &after), SUPPLE_OK);
        EXPECT_EQ(before.deviceLocal + before.hostVisible, after.deviceLocal + after.hostVisible);
    }
    EXPECT_EQ(stateOf(*own, group).complete, 0u);
}

TEST_F(BudgetedUploads, AreRefusedWhereThereIsNoMemoryForThem) {
    const auto own = bounded(SUPPLE_MAPPING_NARROW);
    UploadedTubes tubes(*own, plainTubes(own->createAsset(uploadedTube())));
    ASSERT_EQ(suppleSetMemoryBudget(own->handle(), 1, nullptr, nullptr), SUPPLE_OK);
    own->takeLines();
    EXPECT_EQ(suppleSetUploadBudget(own->handle(), 2 * kBudget), SUPPLE_ERROR_DEVICE_MEMORY);
    EXPECT_EQ(own->takeError(), SUPPLE_MESSAGE_DEVICE_MEMORY);
    EXPECT_EQ(suppleSetUploadBudget(own->handle(), 0), SUPPLE_ERROR_DEVICE_MEMORY);
    EXPECT_EQ(own->takeError(), SUPPLE_MESSAGE_DEVICE_MEMORY);
    tubes.await([&] { EXPECT_LE(stateOf(*own).frameBytes, kBudget); });
}

} // namespace
} // namespace supple::test
