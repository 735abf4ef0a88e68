// What the host synchronizes itself: the handover to a draw queue family, and the barrier before a frame's passes.
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"
#include "tests/support/wrapped_vulkan.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

constexpr SuppleSyncScope kDraw{
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT,
    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT};

std::vector<VkBufferMemoryBarrier2> acquires(const LoggedContext& context, std::span<const SuppleGroup> groups) {
    uint32_t count = 0;
    EXPECT_EQ(suppleGetAcquireBarriers(context.handle(), groups.data(), static_cast<uint32_t>(groups.size()), kDraw,
                                       nullptr, &count),
              SUPPLE_OK);
    std::vector<VkBufferMemoryBarrier2> barriers(count);
    EXPECT_EQ(suppleGetAcquireBarriers(context.handle(), groups.data(), static_cast<uint32_t>(groups.size()), kDraw,
                                       barriers.data(), &count),
              SUPPLE_OK);
    EXPECT_EQ(count, barriers.size());
    return barriers;
}

std::vector<VkBuffer> buffersOf(const std::vector<VkBufferMemoryBarrier2>& barriers) {
    std::vector<VkBuffer> buffers;
    for (const VkBufferMemoryBarrier2& barrier : barriers) {
        buffers.push_back(barrier.buffer);
    }
    std::ranges::sort(buffers);
    return buffers;
}
std::vector<VkBuffer> sorted(std::vector<VkBuffer> buffers) {
    std::erase(buffers, VkBuffer{VK_NULL_HANDLE});
    std::ranges::sort(buffers);
    return buffers;
}

/// The two halves of a handover are what the specification asks for, and fit each other. `partly`: the buffer of which
/// not all changes hands.
void expectHalves(const WrappedVulkan& recorded, const std::vector<VkBufferMemoryBarrier2>& acquired, uint32_t from,
                  uint32_t to, VkBuffer partly) {
    const std::vector<VkBufferMemoryBarrier>& releases = recorded.bufferBarriers;
    SuppleSyncScope last{};
    ASSERT_EQ(suppleGetRecordScopes(nullptr, &last), SUPPLE_OK);
    ASSERT_EQ(releases.size(), acquired.size());
    for (size_t i = 0; i < releases.size(); ++i) {
        const VkBufferMemoryBarrier& r = releases[i];
        const VkBufferMemoryBarrier2& a = acquired[i];
        EXPECT_EQ(r.sType, VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER);
        EXPECT_EQ(a.sType, VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2);
        EXPECT_EQ(r.pNext, nullptr);
        EXPECT_EQ(a.pNext, nullptr);
        EXPECT_EQ(r.buffer, a.buffer);
        EXPECT_EQ(r.offset, a.offset);
        EXPECT_EQ(a.offset > 0, a.buffer == partly);
        EXPECT_EQ(r.size, VK_WHOLE_SIZE);
        EXPECT_EQ(a.size, VK_WHOLE_SIZE);
        EXPECT_EQ(r.srcQueueFamilyIndex, from);
        EXPECT_EQ(r.dstQueueFamilyIndex, to);
        EXPECT_EQ(a.srcQueueFamilyIndex, from);
        EXPECT_EQ(a.dstQueueFamilyIndex, to);
        const auto [before, after] = recorded.bufferBarrierStages[i];
        EXPECT_EQ(before, last.stages);
        EXPECT_EQ(r.srcAccessMask, last.access);
        EXPECT_EQ(after, VkPipelineStageFlags{VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT})
            << "the semaphore's wait is the second scope";
        EXPECT_EQ(r.dstAccessMask, VkAccessFlags{0});
        EXPECT_EQ(a.srcStageMask, VK_PIPELINE_STAGE_2_NONE);
        EXPECT_EQ(a.srcAccessMask, VK_ACCESS_2_NONE);
        EXPECT_EQ(a.dstStageMask, kDraw.stages);
        EXPECT_EQ(a.dstAccessMask, kDraw.access);
    }
}

// Most CPU devices have one queue family, and the test's device has queues of one only. Both names of it are the same
// here: a handover within a family is a barrier as any other, so that validation has nothing to say.
class AsyncCompute : public testing::Test {
protected:
    static void SetUpTestSuite() {
        wrappedVulkan();
        device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        context = std::make_unique<LoggedContext>(*device, [&](SuppleContextDesc& desc) {
            desc.flags |= SUPPLE_CONTEXT_ASYNC_COMPUTE;
            desc.drawQueueFamily = device->queueFamily();
        });
    }
    static void TearDownTestSuite() {
        if (device != nullptr) {
            const auto log = device->validation();
            context = nullptr;
            device = nullptr;
            EXPECT_EQ(log->messageCount(), 0u);
        }
    }
    void SetUp() override {
        ASSERT_NE(context, nullptr);
        ASSERT_EQ(context->result(), SUPPLE_OK);
        ASSERT_EQ(createTube(context->handle(), asset), SUPPLE_OK);
        group = createGroup(context->handle(), asset,
                            {.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_MOTION | SUPPLE_GROUP_PATCHES})
                    .group;
        const host::GroupOutput output = outputOf(context->handle(), group);
        always = {output.streams.vertices.buffer,  output.streams.previousPositions.buffer,
                  output.info.deformedCage.buffer, output.info.poses.buffer,
                  output.info.instances.buffer,    output.indirect().buffer,
                  output.info.userData.buffer};
        attributes = {output.streams.attributes.buffer, output.streams.uvs1.buffer, output.streams.faceUvs.buffer};
        indices = output.indices().buffer;
        EXPECT_EQ(sorted(always).size(), 7u);
    }
    /// A frame of the groups, drawn from in a second submission; the buffers that change hands.
    std::vector<VkBuffer> handedOver(std::span<const SuppleGroup> groups) { return buffersOf(barriersOf(groups)); }
    std::vector<VkBufferMemoryBarrier2> barriersOf(std::span<const SuppleGroup> groups,
                                                   VkBuffer partly = VK_NULL_HANDLE) {
        context->beginFrame();
        EXPECT_TRUE(device
                        ->submitAndWait([&](VkCommandBuffer commands) {
                            wrappedVulkan();
                            SuppleRecordDesc desc{};
                            desc.structSize = sizeof(desc);
                            desc.groups = groups.data();
                            desc.groupCount = static_cast<uint32_t>(groups.size());
                            EXPECT_EQ(suppleRecord(context->handle(), commands, &desc), SUPPLE_OK);
                        })
                        .ok());
        std::vector<VkBufferMemoryBarrier2> acquired = acquires(*context, groups);
        expectHalves(currentWrappedVulkan(), acquired, device->queueFamily(), device->queueFamily(), partly);
        EXPECT_TRUE(device
                        ->submitAndWait([&](VkCommandBuffer commands) {
                            VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
                            info.bufferMemoryBarrierCount = static_cast<uint32_t>(acquired.size());
                            info.pBufferMemoryBarriers = acquired.data();
                            vkCmdPipelineBarrier2(commands, &info);
                        })
                        .ok());
        return acquired;
    }
    /// Of the fixture's group.
    [[nodiscard]] std::vector<VkBuffer> wanted(bool withAttributes, bool withIndices) const {
        std::vector<VkBuffer> buffers = always;
        if (withAttributes) {
            buffers.insert(buffers.end(), attributes.begin(), attributes.end());
        }
        if (withIndices) {
            buffers.push_back(indices);
        }
        return sorted(buffers);
    }
    void refused(SuppleResult result, SuppleMessage message) {
        EXPECT_EQ(result, SUPPLE_ERROR_ARGUMENT);
        std::vector<LogLine> lines = context->takeLines();
        // The context warns of groups of earlier tests.
        std::erase_if(lines, [](const LogLine& line) { return line.message == SUPPLE_MESSAGE_NEVER_RECORDED; });
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_EQ(lines[0].message, message) << lines[0].text;
    }

    static inline std::unique_ptr<host::Device> device;
    static inline std::unique_ptr<LoggedContext> context;
    SuppleAsset asset{};
    SuppleGroup group{};
    std::vector<VkBuffer> always, attributes;
    VkBuffer indices = VK_NULL_HANDLE;
};

TEST_F(AsyncCompute, HandsOverWhatTheFrameWrote) {
    EXPECT_EQ(handedOver({&group, 1}), wanted(true, true)) << "the first frame writes it all";
    EXPECT_EQ(handedOver({&group, 1}), wanted(false, false));
    ASSERT_EQ(suppleSetRate(context->handle(), group, 1), SUPPLE_OK);
    EXPECT_EQ(handedOver({&group, 1}), wanted(true, false)) << "another rate has other attributes";
    EXPECT_EQ(handedOver({&group, 1}), wanted(false, false));
    // A second group of the same asset brings its own.
    const SmallGroup second =
        createGroup(context->handle(), asset, {.flags = SUPPLE_GROUP_BOUNDS, .scheme = SUPPLE_SCHEME_FRAGMENTS});
    SuppleBufferRange bounds{};
    ASSERT_EQ(suppleGetInstanceBounds(context->handle(), second.group, &bounds), SUPPLE_OK);
    const SuppleGroup both[] = {group, second.group};
    const host::GroupOutput output = outputOf(context->handle(), second.group);
    std::vector<VkBuffer> buffers = wanted(false, false);
    for (const VkBuffer buffer : {output.streams.vertices.buffer, output.info.deformedCage.buffer,
                                  output.info.poses.buffer, output.info.instances.buffer, output.info.userData.buffer,
                                  output.indirect().buffer, output.indices().buffer, bounds.buffer}) {
        buffers.push_back(buffer);
    }
    EXPECT_EQ(handedOver(both), sorted(buffers));
}

/// Coefficients in every frame, the tables that say where they lie once.
TEST_F(AsyncCompute, HandsOverWhatPatchesAreEvaluatedFrom) {
    const SmallGroup direct = createGroup(
        context->handle(), asset, {.flags = SUPPLE_GROUP_DIRECT | SUPPLE_GROUP_ATTRIBUTES, .scheme = SUPPLE_SCHEME_PM});
    ASSERT_EQ(direct.result, SUPPLE_OK);
    const host::GroupOutput output = outputOf(context->handle(), direct.group);
    SuppleDirectOutput from{};
    from.structSize = sizeof(from);
    ASSERT_EQ(suppleGetDirectOutput(context->handle(), direct.group, 0, &from), SUPPLE_OK);
    std::vector<VkBuffer> buffers{from.coefficients.buffer,    output.info.deformedCage.buffer,
                                  output.info.poses.buffer,    output.info.instances.buffer,
                                  output.info.userData.buffer, output.indirect().buffer};
    std::vector<VkBuffer> first = buffers;
    for (const VkBuffer once : {from.tables.buffer, output.indices().buffer, output.streams.attributes.buffer,
                                output.streams.uvs1.buffer, output.streams.faceUvs.buffer}) {
        if (once != VK_NULL_HANDLE) {
            first.push_back(once);
        }
    }
    EXPECT_EQ(handedOver({&direct.group, 1}), sorted(first));
    EXPECT_EQ(handedOver({&direct.group, 1}), sorted(buffers));
}

#if defined(SUPPLE_WITH_CPU)
/// Of point sets, those that were there when the group was recorded.
TEST_F(AsyncCompute, HandsOverPointsThatTheFrameHad) {
    (void)handedOver({&group, 1});
    const SuppleSurfacePoint point{0, 0, 0.25f, 0.5f};
    SupplePointSetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.group = group;
    desc.points = &point;
    desc.pointCount = 1;
    const auto make = [&](SupplePointSet& set) {
        EXPECT_EQ(suppleCreatePointSet(context->handle(), &desc, &set), SUPPLE_OK);
        SupplePointOutput output{};
        output.structSize = sizeof(output);
        EXPECT_EQ(suppleGetPointOutput(context->handle(), set, &output), SUPPLE_OK);
        return output.frames.buffer;
    };
    SupplePointSet first{}, second{};
    std::vector<VkBuffer> buffers = wanted(false, false);
    buffers.push_back(make(first));
    EXPECT_EQ(handedOver({&group, 1}), sorted(buffers));
    // One that is made behind the recording: nothing has released it.
    const VkBuffer late = make(second);
    std::vector<VkBuffer> acquired = buffersOf(acquires(*context, {&group, 1}));
    EXPECT_EQ(acquired, sorted(buffers));
    EXPECT_EQ(suppleDestroyPointSet(context->handle(), first), SUPPLE_OK);
    EXPECT_EQ(buffersOf(acquires(*context, {&group, 1})), sorted(buffers)) << "its release is recorded";
    buffers = wanted(false, false);
    buffers.push_back(late);
    EXPECT_EQ(handedOver({&group, 1}), sorted(buffers));
    EXPECT_EQ(suppleDestroyPointSet(context->handle(), second), SUPPLE_OK);
}
#endif

// What hosts read of a view's words changes hands, and nothing comes back: whatever stands there afterwards, the next
// frame is right.
TEST_F(AsyncCompute, OfAViewsWordsOnlyWhatHostsReadIsHandedOver) {
    SuppleViewDesc viewDesc{};
    viewDesc.structSize = sizeof(viewDesc);
    viewDesc.flags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL;
    viewDesc.maxVertices = 50'000;
    SuppleView view{};
    ASSERT_EQ(suppleCreateView(context->handle(), &viewDesc, &view), SUPPLE_OK);
    SuppleCameraDesc camera{};
    camera.structSize = sizeof(camera);
    camera.position[2] = 5.0f;
    camera.pixelsPerUnit = 500.0f;
    ASSERT_EQ(suppleSetCamera(context->handle(), view, &camera), SUPPLE_OK);
    const SmallGroup first =
        createGroup(context->handle(), asset, {.capacity = 3, .scheme = SUPPLE_SCHEME_PREP, .view = view});
    const SmallGroup second =
        createGroup(context->handle(), asset, {.capacity = 2, .scheme = SUPPLE_SCHEME_PM, .view = view});
    ASSERT_EQ(first.result, SUPPLE_OK);
    ASSERT_EQ(second.result, SUPPLE_OK);
    const SuppleGroup both[] = {first.group, second.group};
    const host::GroupOutput outputs[] = {outputOf(context->handle(), first.group),
                                         outputOf(context->handle(), second.group)};
    const VkBuffer words = outputs[0].levels.buckets.buffer;
    std::vector<std::vector<std::byte>> frames;
    for (int frame = 0; frame < 4; ++frame) {
        VkDeviceSize from = 0;
        for (const VkBufferMemoryBarrier2& barrier : barriersOf(both, words)) {
            from = barrier.buffer == words ? barrier.offset : from;
        }
        EXPECT_GT(from, 0u);
        std::vector<std::byte> drawn;
        for (const host::GroupOutput& output : outputs) {
            for (const SuppleBufferRange& range : {output.levels.buckets, output.levels.patches, output.indirect()}) {
                EXPECT_EQ(range.buffer, words);
                EXPECT_GE(range.offset, from);
            }
            EXPECT_EQ(output.levels.buckets.offset % 256, 0u);
            EXPECT_EQ(output.levels.patches.offset % 256, 0u);
            const Result<std::vector<std::byte>> commands = device->readBuffer(output.indirect());
            ASSERT_TRUE(commands.ok());
            drawn.insert(drawn.end(), commands->begin(), commands->end());
        }
        frames.push_back(drawn);
        SuppleViewStatistics statistics{};
        statistics.structSize = sizeof(statistics);
        if (frame > 0) {
            ASSERT_EQ(suppleGetViewStatistics(context->handle(), view, &statistics), SUPPLE_OK);
            EXPECT_EQ(statistics.patchCount, 3 * outputs[0].surface.patchCount + 2 * outputs[1].surface.patchCount);
        }
        EXPECT_TRUE(
            device
                ->submitAndWait([&](VkCommandBuffer commands) {
                    vkCmdFillBuffer(commands, words, from, VK_WHOLE_SIZE, 0xCDCDCDCDu);
                    const VkMemoryBarrier2 all{
                        VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr,        VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                        VK_ACCESS_2_TRANSFER_WRITE_BIT,     kAnyUse.stages, kAnyUse.access};
                    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
                    info.memoryBarrierCount = 1;
                    info.pMemoryBarriers = &all;
                    vkCmdPipelineBarrier2(commands, &info);
                })
                .ok());
    }
    EXPECT_EQ(frames[1], frames[0]);
    EXPECT_EQ(frames[3], frames[0]);
    EXPECT_EQ(suppleDestroyGroup(context->handle(), first.group), SUPPLE_OK);
    EXPECT_EQ(suppleDestroyGroup(context->handle(), second.group), SUPPLE_OK);
    EXPECT_EQ(suppleDestroyView(context->handle(), view), SUPPLE_OK);
}

TEST_F(AsyncCompute, UploadsOfAnEarlierFrameAreHandedOverByTheFirstThatRecords) {
    context->beginFrame();
    ASSERT_TRUE(device
                    ->submitAndWait([&](VkCommandBuffer commands) {
                        EXPECT_EQ(suppleRecordUploads(context->handle(), commands), SUPPLE_OK);
                    })
                    .ok());
    context->beginFrame();
    EXPECT_EQ(handedOver({&group, 1}), wanted(true, true));
    EXPECT_EQ(handedOver({&group, 1}), wanted(false, false));
}

TEST_F(AsyncCompute, ACancelledFrameHandsNothingOver) {
    context->beginFrame();
    ASSERT_TRUE(device
                    ->submitAndWait([&](VkCommandBuffer commands) {
                        EXPECT_EQ(suppleRecordUploads(context->handle(), commands), SUPPLE_OK);
                    })
                    .ok());
    context->beginFrame();
    // Recorded, and thrown away.
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = device->commandPool();
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    ASSERT_EQ(vkAllocateCommandBuffers(device->handle(), &info, &commands), VK_SUCCESS);
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, 0, nullptr};
    ASSERT_EQ(vkBeginCommandBuffer(commands, &begin), VK_SUCCESS);
    EXPECT_EQ(context->record(commands, {&group, 1}), SUPPLE_OK);
    vkFreeCommandBuffers(device->handle(), device->commandPool(), 1, &commands);
    ASSERT_EQ(suppleCancelFrame(context->handle()), SUPPLE_OK);
    uint32_t count = 0;
    refused(suppleGetAcquireBarriers(context->handle(), &group, 1, kDraw, nullptr, &count),
            SUPPLE_MESSAGE_OUT_OF_ORDER);
    EXPECT_EQ(handedOver({&group, 1}), wanted(true, true));
    EXPECT_EQ(handedOver({&group, 1}), wanted(false, false));
}

TEST_F(AsyncCompute, ShortArraysAndWrongCalls) {
    uint32_t count = 3;
    refused(suppleGetAcquireBarriers(context->handle(), &group, 1, kDraw, nullptr, &count),
            SUPPLE_MESSAGE_OUT_OF_ORDER);
    EXPECT_EQ(count, 3u);
    handedOver({&group, 1});
    const std::vector<VkBufferMemoryBarrier2> all = acquires(*context, {&group, 1});
    VkBufferMemoryBarrier2 some[3]{};
    some[2].size = 1234;
    count = 2;
    EXPECT_EQ(suppleGetAcquireBarriers(context->handle(), &group, 1, kDraw, some, &count), SUPPLE_INCOMPLETE);
    EXPECT_EQ(count, all.size());
    EXPECT_EQ(some[0].buffer, all[0].buffer);
    EXPECT_EQ(some[1].buffer, all[1].buffer);
    EXPECT_EQ(some[2].size, 1234u);
    // A group that is not there: nothing is written for the one before it.
    some[0].size = 1234;
    count = 3;
    const SuppleGroup groups[] = {group, SuppleGroup{99}};
    refused(suppleGetAcquireBarriers(context->handle(), groups, 2, kDraw, some, &count), SUPPLE_MESSAGE_STALE_HANDLE);
    EXPECT_EQ(some[0].size, 1234u);
    EXPECT_EQ(count, 3u);
}

TEST(RecordScopes, AreMadeOfFlagsOfVulkan10) {
    constexpr VkPipelineStageFlags kStages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    constexpr VkAccessFlags kWrites = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    SuppleSyncScope first{}, last{};
    ASSERT_EQ(suppleGetRecordScopes(&first, &last), SUPPLE_OK);
    EXPECT_EQ(first.stages, kStages);
    EXPECT_EQ(first.access, VkAccessFlags{VK_ACCESS_SHADER_READ_BIT} | kWrites);
    EXPECT_EQ(last.stages, kStages);
    EXPECT_EQ(last.access, kWrites);
}

TEST(RecordScopes, AHostsOwnBarrierIsEnoughAndNeeded) {
    SuppleSyncScope first{}, last{};
    ASSERT_EQ(suppleGetRecordScopes(&first, &last), SUPPLE_OK);
    EXPECT_EQ(suppleGetRecordScopes(nullptr, nullptr), SUPPLE_OK);
    constexpr SuppleSyncScope kCopy{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    constexpr SuppleSyncScope kCopy10{VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT};
    wrappedVulkan();
    std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    const auto validation = device->validation();
    {
        LoggedContext context(*device, [](SuppleContextDesc& desc) { desc.framesInFlight = 4; });
        ASSERT_EQ(context.result(), SUPPLE_OK);
        SuppleAsset asset{};
        ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
        const SmallGroup group =
            createGroup(context.handle(), asset, {.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_PATCHES});
        const host::GroupOutput output = outputOf(context.handle(), group.group);
        Result<host::Buffer> copy = device->createBuffer(output.info.deformedCage.size,
                                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT, host::MemoryKind::device);
        ASSERT_TRUE(copy.ok());
        // Four frames that follow each other in one command buffer, each read by a copy of the host's.
        enum class Barriers { none, synchronization2, vulkan10 };
        const auto barrier = [&](VkCommandBuffer commands, Barriers kind, SuppleSyncScope before,
                                 SuppleSyncScope after) {
            if (kind == Barriers::synchronization2) {
                host::memoryBarrier(commands, before, after);
                return;
            }
            VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
            memory.srcAccessMask = static_cast<VkAccessFlags>(before.access);
            memory.dstAccessMask = static_cast<VkAccessFlags>(after.access);
            vkCmdPipelineBarrier(commands, static_cast<VkPipelineStageFlags>(before.stages),
                                 static_cast<VkPipelineStageFlags>(after.stages), 0, 1, &memory, 0, nullptr, 0,
                                 nullptr);
        };
        const auto frames = [&](uint64_t completed, Barriers barriers) {
            const SuppleSyncScope copied = barriers == Barriers::vulkan10 ? kCopy10 : kCopy;
            ASSERT_TRUE(device
                            ->submitAndWait([&](VkCommandBuffer commands) {
                                for (uint64_t frame = completed + 1; frame <= completed + 4; ++frame) {
                                    EXPECT_EQ(suppleBeginFrame(context.handle(), frame, completed), SUPPLE_OK);
                                    if (barriers != Barriers::none) {
                                        barrier(commands, barriers,
                                                {last.stages | copied.stages, last.access | copied.access}, first);
                                    }
                                    SuppleRecordDesc desc{};
                                    desc.structSize = sizeof(desc);
                                    desc.flags = SUPPLE_RECORD_NO_ENTRY_BARRIER;
                                    if (barriers != Barriers::none) { // on CPU devices marks have barriers of their own
                                        desc.flags |= SUPPLE_RECORD_TIMINGS;
                                    }
                                    desc.groups = &group.group;
                                    desc.groupCount = 1;
                                    EXPECT_EQ(suppleRecord(context.handle(), commands, &desc), SUPPLE_OK);
                                    if (barriers != Barriers::none) {
                                        barrier(commands, barriers, last, copied);
                                        const VkBufferCopy region{0, 0, output.info.deformedCage.size};
                                        vkCmdCopyBuffer(commands, output.info.deformedCage.buffer, copy->handle(), 1,
                                                        &region);
                                    }
                                }
                            })
                            .ok());
        };
        frames(0, Barriers::synchronization2);
        frames(4, Barriers::vulkan10);
        EXPECT_EQ(validation->messageCount(), 0u);
        frames(8, Barriers::none);
        EXPECT_GT(validation->messageCount(), 0u);
    }
}

} // namespace
} // namespace supple::test
