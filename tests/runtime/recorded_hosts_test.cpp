// Recordings of hosts that do more than one thing at a time: several threads, frames in flight, groups in windows, a
// queue family for draws. A replay does one thing after the other, and has the same hashes.
#include "tests/support/recorder.h"
#include "tests/support/recordings.h"
#include "tests/support/sample_assets.h"
#include "tests/support/wrapped_vulkan.h"

#include <barrier>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <thread>
#include <vector>

namespace supple::test {
namespace {

class RecordedHosts : public CrowdContexts {};

constexpr uint32_t kBusyGroups = 3, kBusyFrames = 12;

/// A group that plays, one that the host poses, and one of fragments.
struct BusyHost {
    explicit BusyHost(SuppleContext ofHost, uint32_t capacity = 3) : context(ofHost) {
        SuppleAsset asset{};
        EXPECT_EQ(createTube(context, asset), SUPPLE_OK);
        const SuppleGroupDesc descs[kBusyGroups] = {
            {.capacity = capacity, .scheme = SUPPLE_SCHEME_PM, .poseSource = SUPPLE_POSES_PLAYBACK},
            {.capacity = capacity, .scheme = SUPPLE_SCHEME_CATMULL_CLARK, .skinning = SUPPLE_SKINNING_DUAL_QUATERNION},
            {.capacity = capacity, .scheme = SUPPLE_SCHEME_FRAGMENTS}};
        for (const SuppleGroupDesc& desc : descs) {
            groups.push_back(createGroup(context, asset, desc));
            EXPECT_EQ(groups.back().result, SUPPLE_OK);
        }
    }
    /// What a frame does to the instances of one group.
    void change(uint32_t g, uint32_t frame) {
        SmallGroup& group = groups[g];
        for (uint32_t i = 0; i < group.instances.size(); ++i) {
            const double time = 0.11 * frame + 0.3 * i;
            if (g == 0) {
                play(group.instances[i], time, frame);
            } else {
                ok(suppleSetClipPose(context, group.instances[i], 0, time));
            }
            const glm::mat4 place = glm::translate(glm::mat4(1.0f), glm::vec3(g, i, 0.1f * static_cast<float>(frame)));
            ok(suppleSetTransform(context, group.instances[i], glm::value_ptr(place)));
            ok(suppleSetVisible(context, group.instances[i], (frame + i + g) % 4 != 0 ? 1 : 0));
        }
        if (g == 0) {
            ok(suppleSetTime(context, group.group, 0.07 * frame));
        }
        if (frame % 5 == g) {
            ok(suppleDestroyInstance(context, group.instances[0]));
            ok(suppleCreateInstance(context, group.group, group.instances.data()));
        }
    }
    [[nodiscard]] std::vector<SuppleGroup> handles() const {
        std::vector<SuppleGroup> all;
        for (const SmallGroup& group : groups) {
            all.push_back(group.group);
        }
        return all;
    }

    SuppleContext context;
    std::vector<SmallGroup> groups;

private:
    static void ok(SuppleResult result) { EXPECT_EQ(result, SUPPLE_OK); }
    void play(const SuppleInstance& instance, double offset, uint32_t frame) {
        SupplePlaybackLayer layer{};
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = layer.speed = 1.0f;
        layer.offset = offset;
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof desc;
        desc.layers = &layer;
        desc.layerCount = frame % 3 == 0 ? 1 : 0;
        ok(suppleSetPlayback(context, instance, &desc));
    }
};

/// Ends the recording and makes it again, in both mappings.
void expectReplayed(SuppleContext context, Recorded& recorded) {
    ASSERT_EQ(suppleStopRecording(context), SUPPLE_OK);
    const ReadRecording own = read(recorded.bytes);
    EXPECT_TRUE(own.ended);
    EXPECT_GE(own.hashes.size(), size_t{3} * kBusyGroups * kBusyFrames) << "three stages of each group and frame";
    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        tools::Replayer::Options options;
        options.mapping = mapping;
        EXPECT_EQ(expectSame(own.hashes, replay(*testDevice(), recorded.bytes, options)), own.hashes.size());
    }
}

TEST_F(RecordedHosts, OnSeveralThreads) {
    const ValidationGuard guard;
    LoggedContext context(*testDevice());
    Recorded recorded;
    ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    BusyHost host(context.handle());
    std::vector<std::unique_ptr<Recorder>> recorders;
    for (uint32_t g = 0; g <= kBusyGroups; ++g) {
        recorders.push_back(std::make_unique<Recorder>(context.device()));
    }
    std::barrier ready(kBusyGroups + 1), done(kBusyGroups + 1);
    std::vector<std::jthread> threads;
    for (uint32_t g = 0; g < kBusyGroups; ++g) {
        threads.emplace_back([&, g] {
            for (uint32_t frame = 1; frame <= kBusyFrames; ++frame) {
                ready.arrive_and_wait();
                host.change(g, frame);
                EXPECT_EQ(context.record(recorders[g]->begin(), {&host.groups[g].group, 1}), SUPPLE_OK);
                recorders[g]->end();
                done.arrive_and_wait();
            }
        });
    }
    for (uint32_t frame = 1; frame <= kBusyFrames; ++frame) {
        context.beginFrame();
        EXPECT_EQ(suppleRecordUploads(context.handle(), recorders[kBusyGroups]->begin()), SUPPLE_OK);
        recorders[kBusyGroups]->end();
        ready.arrive_and_wait();
        done.arrive_and_wait();
        std::vector<VkCommandBuffer> commands = {recorders[kBusyGroups]->handle()};
        for (uint32_t g = kBusyGroups; g-- > 0;) {
            commands.push_back(recorders[g]->handle());
        }
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = static_cast<uint32_t>(commands.size());
        submit.pCommandBuffers = commands.data();
        EXPECT_EQ(vkQueueSubmit(context.device().queue(), 1, &submit, VK_NULL_HANDLE), VK_SUCCESS);
        EXPECT_EQ(vkQueueWaitIdle(context.device().queue()), VK_SUCCESS);
    }
    context.beginFrame();
    expectReplayed(context.handle(), recorded);
}

TEST_F(RecordedHosts, WithFramesInFlight) {
    const ValidationGuard guard;
    constexpr uint32_t kInFlight = 3;
    LoggedContext context(*testDevice(), [](SuppleContextDesc& desc) { desc.framesInFlight = kInFlight; });
    Recorded recorded;
    ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    BusyHost host(context.handle());
    const std::vector<SuppleGroup> groups = host.handles();
    std::vector<std::unique_ptr<Commands>> commands;
    for (uint32_t i = 0; i < kInFlight; ++i) {
        commands.push_back(std::make_unique<Commands>(context.device()));
    }
    for (uint64_t frame = 1; frame <= kBusyFrames; ++frame) {
        Commands& own = *commands[frame % kInFlight];
        own.wait(); // of frame - kInFlight
        const uint64_t completed = frame > kInFlight ? frame - kInFlight : 0;
        ASSERT_EQ(suppleBeginFrame(context.handle(), frame, completed), SUPPLE_OK);
        for (uint32_t g = 0; g < kBusyGroups; ++g) {
            host.change(g, static_cast<uint32_t>(frame));
        }
        own.record([&](VkCommandBuffer buffer) { EXPECT_EQ(context.record(buffer, groups), SUPPLE_OK); });
        own.submit();
    }
    for (const std::unique_ptr<Commands>& own : commands) {
        own->wait();
    }
    ASSERT_EQ(suppleBeginFrame(context.handle(), kBusyFrames + 1, kBusyFrames), SUPPLE_OK);
    expectReplayed(context.handle(), recorded);
}

TEST_F(RecordedHosts, WithAQueueFamilyForDraws) {
    const ValidationGuard guard;
    LoggedContext context(*testDevice(), [](SuppleContextDesc& desc) {
        desc.flags |= SUPPLE_CONTEXT_ASYNC_COMPUTE;
        desc.drawQueueFamily = desc.queueFamily; // CPU devices have no other
    });
    Recorded recorded;
    ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    BusyHost host(context.handle());
    for (uint32_t frame = 1; frame <= kBusyFrames; ++frame) {
        for (uint32_t g = 0; g < kBusyGroups; ++g) {
            host.change(g, frame);
        }
        context.evaluate(host.handles());
    }
    context.beginFrame();
    expectReplayed(context.handle(), recorded);
}

/// Whether windows cut the groups or not, the words are the same, and so are their places.
TEST_F(RecordedHosts, InWindows) {
    constexpr uint32_t kCapacity = 23, kRange = 1u << 18;
    WrappedVulkan& wrapped = wrappedVulkan();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    wrapped.maxStorageBufferRange = kRange;
    {
        CrowdContext context(*device, SUPPLE_MAPPING_NARROW);
        Recorded recorded;
        ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
        SuppleGroupDesc desc{};
        desc.structSize = sizeof desc;
        desc.flags = SUPPLE_GROUP_WINDOWS;
        desc.asset = context.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb");
        desc.capacity = kCapacity;
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.rate = 5;
        Crowd crowd(context, desc);
        ASSERT_TRUE(crowd.valid());
        EXPECT_GT(crowd.output().info.windowCount, 1u);
        std::vector<SuppleInstance> instances;
        for (uint32_t i = 0; i < kCapacity; ++i) {
            instances.push_back(crowd.spawn());
        }
        for (uint32_t frame = 0; frame < 4; ++frame) {
            for (uint32_t i = 0; i < kCapacity; ++i) {
                crowd.setVisible(instances[i], (7 * i + frame) % 5 != 0 && (frame != 2 || i > 9));
                crowd.pose(instances[i], SUPPLE_BIND_POSE, 0.0,
                           glm::translate(glm::mat4(1.0f), glm::vec3(i, 0.3f * static_cast<float>(frame), 0.0f)));
            }
            context.run(crowd.group());
        }
        context.beginFrame();
        ASSERT_EQ(suppleStopRecording(context.handle()), SUPPLE_OK);
        const ReadRecording own = read(recorded.bytes);
        EXPECT_EQ(own.hashes.size(), 12u);
        EXPECT_EQ(expectSame(own.hashes, replay(*testDevice(), recorded.bytes)), own.hashes.size());
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
    wrapped.maxStorageBufferRange = 0;
}

} // namespace
} // namespace supple::test
