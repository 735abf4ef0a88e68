// Groups recorded and posed on several threads at the same time: the bits of one thread.
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"
#include "tests/support/recorder.h"

#include <algorithm>
#include <array>
#include <barrier>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>

namespace supple::test {
namespace {

constexpr uint32_t kFrames = 24;
constexpr uint32_t kCapacity = 3;

/// What a frame does to a group's instances: poses, transforms, who is there and who is seen.
void change(SuppleContext context, uint32_t g, uint32_t frame, SmallGroup& group) {
    const auto ok = [](SuppleResult result) { EXPECT_EQ(result, SUPPLE_OK); };
    for (uint32_t i = 0; i < kCapacity; ++i) {
        ok(suppleSetClipPose(context, group.instances[i], 0, 0.11 * frame + 0.3 * i + g));
        const glm::mat4 transform =
            glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(g, i, 0.1f * static_cast<float>(frame))),
                        0.05f * static_cast<float>(frame), {0.0f, 1.0f, 0.0f});
        ok(suppleSetTransform(context, group.instances[i], glm::value_ptr(transform)));
    }
    const float weights[] = {0.1f * static_cast<float>(frame % 7), 0.5f, 0.0f, -0.2f};
    ok(suppleSetMorphWeights(context, group.instances[1], frame % 3 == 0 ? nullptr : weights, 4));
    // Seen at first: what was never written has no bits to compare.
    ok(suppleSetVisible(context, group.instances[2], frame < 4 || (frame + g) % 4 != 0 ? 1 : 0));
    ok(suppleSetPartVisible(context, group.instances[1], 0, (frame + g) % 3 != 0 ? 1 : 0));
    if (frame % 5 == g) {
        ok(suppleDestroyInstance(context, group.instances[0]));
        ok(suppleCreateInstance(context, group.group, &group.instances[0]));
    }
    if (frame % 6 == 2) {
        ok(suppleTeleport(context, group.instances[1]));
    }
    host::GroupOutput output{};
    ok(host::getGroupOutput(context, group.group, output));
}

enum class Order { oneThread, asRecorded, reversed };

/// Every frame's bits of every group.
std::vector<std::vector<std::byte>> run(LoggedContext& context, uint32_t groupCount, Order order) {
    host::Device& device = context.device();
    SuppleAsset asset{};
    EXPECT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    // Some share their tables.
    const SuppleGroupDesc descs[] = {
        {.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, .capacity = kCapacity},
        {.capacity = kCapacity, .skinning = SUPPLE_SKINNING_DUAL_QUATERNION},
        {.flags = SUPPLE_GROUP_MOTION, .capacity = kCapacity, .scheme = SUPPLE_SCHEME_FRAGMENTS},
        {.capacity = kCapacity, .vertexFormat = SUPPLE_VERTEX_24}};
    std::vector<SmallGroup> groups;
    for (uint32_t g = 0; g < groupCount; ++g) {
        groups.push_back(createGroup(context.handle(), asset, descs[g]));
        EXPECT_EQ(groups.back().result, SUPPLE_OK);
    }
    context.takeLines();
    std::vector<std::unique_ptr<Recorder>> recorders;
    for (uint32_t g = 0; g <= groupCount; ++g) {
        recorders.push_back(std::make_unique<Recorder>(device));
    }
    const auto changeAndRecord = [&](uint32_t g, uint32_t frame) {
        change(context.handle(), g, frame, groups[g]);
        EXPECT_EQ(context.record(recorders[g]->begin(), {&groups[g].group, 1}, SUPPLE_RECORD_TIMINGS), SUPPLE_OK);
        recorders[g]->end();
    };

    std::barrier ready(static_cast<ptrdiff_t>(groupCount) + 1), done(static_cast<ptrdiff_t>(groupCount) + 1);
    std::vector<std::jthread> threads;
    for (uint32_t g = 0; g < groupCount && order != Order::oneThread; ++g) {
        threads.emplace_back([&, g] {
            for (uint32_t frame = 1; frame <= kFrames; ++frame) {
                ready.arrive_and_wait();
                changeAndRecord(g, frame);
                done.arrive_and_wait();
            }
        });
    }
    std::vector<std::vector<std::byte>> bits;
    for (uint32_t frame = 1; frame <= kFrames; ++frame) {
        context.beginFrame();
        EXPECT_EQ(suppleRecordUploads(context.handle(), recorders[groupCount]->begin()), SUPPLE_OK);
        std::vector<VkCommandBuffer> commands;
        if (order == Order::oneThread) {
            for (uint32_t g = 0; g < groupCount; ++g) {
                changeAndRecord(g, frame);
            }
        } else {
            ready.arrive_and_wait();
            done.arrive_and_wait();
        }
        for (uint32_t g = 0; g < groupCount; ++g) {
            commands.push_back(recorders[g]->handle());
        }
        if (order == Order::reversed) {
            std::ranges::reverse(commands);
        }
        recorders[groupCount]->end();
        commands.insert(commands.begin(), recorders[groupCount]->handle());
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = static_cast<uint32_t>(commands.size());
        submit.pCommandBuffers = commands.data();
        EXPECT_EQ(vkQueueSubmit(device.queue(), 1, &submit, VK_NULL_HANDLE), VK_SUCCESS);
        EXPECT_EQ(vkQueueWaitIdle(device.queue()), VK_SUCCESS);
        for (const SmallGroup& group : groups) {
            if (frame % 4 == 0 || frame < 3) {
                bits.push_back(surfaceBits(context, group.group));
            }
        }
        // What was timed is of every group, and of this frame alone.
        if (frame > 1) {
            uint32_t count = 0;
            EXPECT_EQ(suppleGetTimings(context.handle(), sizeof(SuppleTiming), nullptr, &count), SUPPLE_OK);
            std::vector<SuppleTiming> timings(count);
            EXPECT_EQ(suppleGetTimings(context.handle(), sizeof(SuppleTiming), timings.data(), &count), SUPPLE_OK);
            uint32_t evaluations = 0;
            for (const SuppleTiming& timing : timings) {
                EXPECT_EQ(timing.frame, context.frame - 1);
                EXPECT_GE(timing.gpuEnd, timing.gpuBegin);
                evaluations += timing.pass == SUPPLE_PASS_EVALUATE ? 1 : 0;
            }
            EXPECT_EQ(evaluations, groupCount);
        }
    }
    EXPECT_EQ(context.takeLines().size(), 0u);
    for (const SmallGroup& group : groups) {
        EXPECT_EQ(suppleDestroyGroup(context.handle(), group.group), SUPPLE_OK);
    }
    EXPECT_EQ(suppleDestroyAsset(context.handle(), asset), SUPPLE_OK);
    return bits;
}

TEST(Threads, RecordTheBitsOfOneThread) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    LoggedContext context(*device);
    ASSERT_EQ(context.result(), SUPPLE_OK);
    for (const uint32_t groups : {2u, 4u}) {
        const std::vector<std::vector<std::byte>> alone = run(context, groups, Order::oneThread);
        ASSERT_FALSE(alone.empty());
        EXPECT_FALSE(alone[0].empty());
        EXPECT_TRUE(alone == run(context, groups, Order::asRecorded)) << groups;
        EXPECT_TRUE(alone == run(context, groups, Order::reversed)) << groups;
    }
}

/// Two threads, each with a group to record and a pool to ask. Both pools have both groups.
class Askers {
public:
    static constexpr uint32_t kCount = 2;
    static constexpr uint32_t kRays = 4;

    Askers(LoggedContext& context, SuppleAsset asset) : context_(context) {
        for (uint32_t g = 0; g < kCount; ++g) {
            groups_.push_back(
                createGroup(context.handle(), asset, {.capacity = kCapacity, .scheme = SUPPLE_SCHEME_PM}));
            EXPECT_EQ(groups_.back().result, SUPPLE_OK);
            handles_[g] = groups_.back().group;
            recorders_.push_back(std::make_unique<Recorder>(context.device()));
        }
        SuppleQueryPoolDesc desc{};
        desc.structSize = sizeof(desc);
        desc.groups = handles_.data();
        desc.groupCount = kCount;
        desc.rayCount = kRays;
        for (SuppleQueryPool& pool : pools_) {
            EXPECT_EQ(suppleCreateQueryPool(context.handle(), &desc, &pool), SUPPLE_OK);
        }
        // Made anew for both pools at once: what is uploaded of it they have in common.
        const SuppleAssetDesc again = tubeDesc();
        EXPECT_EQ(suppleReloadAsset(context.handle(), asset, &again), SUPPLE_OK);
    }
    ~Askers() {
        for (uint32_t g = 0; g < kCount; ++g) {
            EXPECT_EQ(suppleDestroyQueryPool(context_.handle(), pools_[g]), SUPPLE_OK);
            EXPECT_EQ(suppleDestroyGroup(context_.handle(), handles_[g]), SUPPLE_OK);
        }
    }
    Askers(const Askers&) = delete;
    Askers& operator=(const Askers&) = delete;

    /// What one of the threads does in a frame.
    void recordAndAsk(uint32_t g, uint32_t frame) {
        change(context_.handle(), g, frame, groups_[g]);
        const VkCommandBuffer commands = recorders_[g]->begin();
        EXPECT_EQ(context_.record(commands, {&handles_[g], 1}), SUPPLE_OK);
        std::array<SuppleRay, kRays> rays{};
        for (uint32_t r = 0; r < kRays; ++r) {
            rays[r] = {{static_cast<float>(g + 1), 0.7f * static_cast<float>(r), -50.0f}, 0.0f, {0, 0, 1}, 100.0f};
        }
        SuppleQueryDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = SUPPLE_QUERY_READ_BACK;
        desc.groups = &handles_[g];
        desc.groupCount = 1;
        desc.hostRays = rays.data();
        desc.rayCount = kRays;
        desc.before = desc.after = kAnyUse;
        EXPECT_EQ(suppleRecordQueries(context_.handle(), commands, pools_[g], &desc), SUPPLE_OK);
        recorders_[g]->end();
    }
    void submit() const {
        for (const std::unique_ptr<Recorder>& recorder : recorders_) {
            const VkCommandBuffer commands = recorder->handle();
            VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
            submit.commandBufferCount = 1;
            submit.pCommandBuffers = &commands;
            EXPECT_EQ(vkQueueSubmit(context_.device().queue(), 1, &submit, VK_NULL_HANDLE), VK_SUCCESS);
        }
        EXPECT_EQ(vkQueueWaitIdle(context_.device().queue()), VK_SUCCESS);
    }
    void appendHits(std::vector<SuppleHit>& found) const {
        for (const SuppleQueryPool pool : pools_) {
            std::array<SuppleHit, kRays> hits{};
            uint32_t count = kRays;
            EXPECT_EQ(suppleReadHits(context_.handle(), pool, hits.data(), &count, nullptr), SUPPLE_OK);
            found.insert(found.end(), hits.begin(), hits.begin() + count);
        }
    }

private:
    LoggedContext& context_;
    std::vector<SmallGroup> groups_;
    std::array<SuppleGroup, kCount> handles_{};
    std::array<SuppleQueryPool, kCount> pools_{};
    std::vector<std::unique_ptr<Recorder>> recorders_;
};

/// What they find in all frames. In the first ones, groups wait for their uploads.
std::vector<SuppleHit> hitsOf(host::Device& device, bool atOnce) {
    LoggedContext context(device);
    SuppleAsset asset{};
    EXPECT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    EXPECT_EQ(suppleSetUploadBudget(context.handle(), 20'000), SUPPLE_OK);
    Askers askers(context, asset);
    std::vector<SuppleHit> found;
    for (uint32_t frame = 1; frame <= kFrames / 2; ++frame) {
        context.beginFrame();
        EXPECT_TRUE(context.device().submitAndWait(
            [&](VkCommandBuffer commands) { EXPECT_EQ(suppleRecordUploads(context.handle(), commands), SUPPLE_OK); }));
        if (atOnce) {
            const std::jthread other([&] { askers.recordAndAsk(1, frame); });
            askers.recordAndAsk(0, frame);
        } else {
            askers.recordAndAsk(1, frame);
            askers.recordAndAsk(0, frame);
        }
        askers.submit();
        context.beginFrame();
        askers.appendHits(found);
    }
    return found;
}

TEST(Threads, AskWhatRaysMeetOfTheirGroups) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const std::vector<SuppleHit> alone = hitsOf(*device, false), atOnce = hitsOf(*device, true);
    ASSERT_EQ(alone.size(), atOnce.size());
    EXPECT_EQ(std::memcmp(alone.data(), atOnce.data(), alone.size() * sizeof(SuppleHit)), 0);
    for (const uint32_t group : {0u, 1u}) {
        EXPECT_TRUE(std::any_of(alone.begin(), alone.end(), [&](const SuppleHit& hit) { return hit.group == group; }));
    }
    EXPECT_EQ(alone[0].group, SUPPLE_NO_HIT) << "it waits";
}

/// Prepared characters on their way from threads that make them to the one that records.
class Handover {
public:
    void give(SupplePrepared prepared) {
        const std::scoped_lock lock(mutex_);
        ready_.push_back(prepared);
    }
    [[nodiscard]] SupplePrepared take() {
        const std::scoped_lock lock(mutex_);
        if (ready_.empty()) {
            return nullptr;
        }
        const SupplePrepared prepared = ready_.back();
        ready_.pop_back();
        return prepared;
    }

private:
    std::mutex mutex_;
    std::vector<SupplePrepared> ready_;
};

/// The tube, for a group as the tests below make it. With a context: and the group's pipelines in it.
SupplePrepared prepareTube(SuppleScheme scheme, SuppleContext context = nullptr) {
    SuppleGroupDesc group{};
    group.structSize = sizeof(group);
    group.scheme = scheme;
    group.rate = 2;
    group.capacity = 1;
    const SupplePlannedGroup planned{&group, 0, 0};
    const SuppleAssetDesc asset = tubeDesc();
    SupplePrepareDesc desc{};
    desc.structSize = sizeof(desc);
    desc.mapping = SUPPLE_MAPPING_NARROW;
    desc.asset = &asset;
    desc.groups = &planned;
    desc.groupCount = 1;
    SupplePrepared prepared = nullptr;
    EXPECT_EQ(supplePrepare(&desc, &prepared), SUPPLE_OK);
    if (context != nullptr) {
        EXPECT_EQ(suppleMakePipelines(context, prepared, &planned, 1), SUPPLE_OK);
    }
    return prepared;
}

TEST(Threads, PrepareCharactersWhileFramesAreRecorded) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    LoggedContext context(*device, [](SuppleContextDesc& desc) { desc.mapping = SUPPLE_MAPPING_NARROW; });
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    SmallGroup group = createGroup(context.handle(), asset, {.scheme = SUPPLE_SCHEME_PM});
    ASSERT_EQ(group.result, SUPPLE_OK);
    context.evaluate({&group.group, 1});
    const std::vector<std::byte> expected = surfaceBits(context, group.group);
    context.takeLines();

    constexpr uint32_t kEach = 12;
    Handover handover;
    std::vector<std::jthread> threads;
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK}) {
        threads.emplace_back([&, scheme] {
            for (uint32_t i = 0; i < kEach; ++i) {
                handover.give(prepareTube(scheme));
                suppleDestroyPrepared(prepareTube(scheme)); // one that nobody wants
            }
        });
    }
    uint32_t taken = 0;
    while (taken < 2 * kEach && !testing::Test::HasFailure()) {
        const SupplePrepared prepared = handover.take();
        context.evaluate({&group.group, 1});
        if (prepared == nullptr) {
            continue;
        }
        ++taken;
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.prepared = prepared;
        SuppleAsset own{};
        EXPECT_EQ(suppleCreateAsset(context.handle(), &desc, &own), SUPPLE_OK);
        suppleDestroyPrepared(prepared);
        const SmallGroup made = createGroup(context.handle(), own, {.scheme = SUPPLE_SCHEME_PM});
        EXPECT_EQ(made.result, SUPPLE_OK);
        context.evaluate({&made.group, 1});
        EXPECT_TRUE(surfaceBits(context, made.group) == expected);
        EXPECT_EQ(suppleDestroyGroup(context.handle(), made.group), SUPPLE_OK);
        EXPECT_EQ(suppleDestroyAsset(context.handle(), own), SUPPLE_OK);
    }
    EXPECT_EQ(taken, 2 * kEach);
    EXPECT_TRUE(surfaceBits(context, group.group) == expected);
}

/// Characters as a game has them: made elsewhere, waiting for their data, drawn, gone.
class Guests {
public:
    Guests(LoggedContext& context, SuppleScheme scheme) : context_(context), scheme_(scheme) {}

    void add(SupplePrepared prepared) {
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.prepared = prepared;
        Guest guest;
        EXPECT_EQ(suppleCreateAsset(context_.handle(), &desc, &guest.asset), SUPPLE_OK);
        suppleDestroyPrepared(prepared);
        guest.group = createGroup(context_.handle(), guest.asset, {.scheme = scheme_});
        EXPECT_EQ(guest.group.result, SUPPLE_OK);
        guests_.push_back(guest);
    }
    [[nodiscard]] size_t count() const { return guests_.size(); }
    void appendTo(std::vector<SuppleGroup>& groups) const {
        for (const Guest& guest : guests_) {
            groups.push_back(guest.group.group);
        }
    }
    /// Behind a frame of all: those that are there have the right bits, and go. Every third goes while it waits.
    void leave(const std::vector<std::byte>& expected) {
        std::erase_if(guests_, [&](const Guest& guest) {
            SuppleUploadState state{};
            state.structSize = sizeof(state);
            EXPECT_EQ(suppleGetGroupUploadState(context_.handle(), guest.group.group, &state), SUPPLE_OK);
            const bool there = state.complete != 0;
            if (!there && ++looked_ % 3 != 0) {
                return false;
            }
            EXPECT_TRUE(!there || surfaceBits(context_, guest.group.group) == expected);
            drawn += there ? 1 : 0;
            EXPECT_EQ(suppleDestroyGroup(context_.handle(), guest.group.group), SUPPLE_OK);
            EXPECT_EQ(suppleDestroyAsset(context_.handle(), guest.asset), SUPPLE_OK);
            return true;
        });
    }
    uint32_t drawn = 0;

private:
    struct Guest {
        SuppleAsset asset{};
        SmallGroup group;
    };
    LoggedContext& context_;
    SuppleScheme scheme_;
    std::vector<Guest> guests_;
    uint32_t looked_ = 0;
};

/// Of a context of its own, which makes everything itself.
std::vector<std::byte> tubeBits(SuppleScheme scheme) {
    LoggedContext context(*testDevice(), [](SuppleContextDesc& desc) { desc.mapping = SUPPLE_MAPPING_NARROW; });
    SuppleAsset asset{};
    EXPECT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    const SmallGroup group = createGroup(context.handle(), asset, {.scheme = scheme});
    EXPECT_EQ(group.result, SUPPLE_OK);
    context.evaluate({&group.group, 1});
    return surfaceBits(context, group.group);
}

TEST(Threads, MakeCharactersAndPipelinesWhileFramesUploadByABudget) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    LoggedContext context(*device, [](SuppleContextDesc& desc) { desc.mapping = SUPPLE_MAPPING_NARROW; });
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    // One that is drawn from the first frame to the last, by a scheme that no other thread makes pipelines of.
    const SmallGroup stays = createGroup(context.handle(), asset, {.scheme = SUPPLE_SCHEME_PREP});
    ASSERT_EQ(stays.result, SUPPLE_OK);
    context.evaluate({&stays.group, 1});
    const std::vector<std::byte> expected = surfaceBits(context, stays.group);
    const std::vector<std::byte> guestBits = tubeBits(SUPPLE_SCHEME_PM);
    ASSERT_EQ(suppleSetUploadBudget(context.handle(), 6000), SUPPLE_OK);

    constexpr uint32_t kEach = 10;
    Handover handover;
    std::vector<std::jthread> threads;
    for (const SuppleScheme unwanted : {SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_CATMULL_CLARK}) {
        threads.emplace_back([&, unwanted] {
            for (uint32_t i = 0; i < kEach; ++i) {
                handover.give(prepareTube(SUPPLE_SCHEME_PM, context.handle()));
                suppleDestroyPrepared(prepareTube(unwanted, context.handle()));
            }
        });
    }
    Guests guests(context, SUPPLE_SCHEME_PM);
    uint32_t taken = 0;
    while ((taken < 2 * kEach || guests.count() > 0) && !testing::Test::HasFailure()) {
        if (const SupplePrepared prepared = guests.count() < 3 ? handover.take() : nullptr) {
            ++taken;
            guests.add(prepared);
        }
        std::vector<SuppleGroup> groups{stays.group};
        guests.appendTo(groups);
        context.evaluate(groups);
        guests.leave(guestBits);
    }
    threads.clear();
    EXPECT_EQ(taken, 2 * kEach);
    EXPECT_GT(guests.drawn, 0u);
    EXPECT_TRUE(surfaceBits(context, stays.group) == expected);
    EXPECT_EQ(context.takeLines().size(), 0u);
}

} // namespace
} // namespace supple::test
