// Barriers between passes, and scopes by the flags of Vulkan 1.0.
#include "gpu/barriers.h"
#include "tests/gpu/fake_vulkan.h"

#include <gtest/gtest.h>

namespace supple::gpu {
namespace {

TEST(Barriers, DisjointWritesNeedOneWhereTexelsAreRead) {
    test::FakeVulkan vulkan;
    disjointBarrier(vulkan.device, test::kCommands);
    EXPECT_EQ(vulkan.barriers.size(), 1u);
    vulkan.device.mapping.wide = true;
    disjointBarrier(vulkan.device, test::kCommands);
    EXPECT_EQ(vulkan.barriers.size(), 1u);
}

TEST(Barriers, ComputeSeesWhatComputeWrote) {
    test::FakeVulkan vulkan;
    vulkan.device.mapping.wide = true;
    computeBarrier(vulkan.device, test::kCommands);
    ASSERT_EQ(vulkan.barriers.size(), 1u);
    const test::GlobalBarrier& call = vulkan.barriers[0];
    EXPECT_EQ(call.before, VkPipelineStageFlags{VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT});
    EXPECT_EQ(call.after, VkPipelineStageFlags{VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT});
    EXPECT_EQ(call.barrier.srcAccessMask, VkAccessFlags{VK_ACCESS_SHADER_WRITE_BIT});
    EXPECT_EQ(call.barrier.dstAccessMask, VkAccessFlags{VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT});
}

TEST(Barriers, ScopesKeepWhatVulkanOneKnowsAndWidenTheRest) {
    const auto expect = [](SyncScope scope, VkPipelineStageFlags stages, VkAccessFlags access) {
        const BasicScope result = basic(scope);
        EXPECT_EQ(result.stages, stages);
        EXPECT_EQ(result.access, access);
    };
    expect({}, 0, 0);
    expect({VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_TRANSFER_READ_BIT},
           VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_TRANSFER_READ_BIT);
    expect({VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT}, VK_PIPELINE_STAGE_TRANSFER_BIT,
           VK_ACCESS_TRANSFER_WRITE_BIT);
    expect({VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT}, VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
           VK_ACCESS_INDEX_READ_BIT);
    expect({VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT},
           VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
    // What has no counterpart at all.
    expect({VkPipelineStageFlags2{1} << 28u, 0}, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0);
    expect({VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT},
           VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_ACCESS_SHADER_READ_BIT);
    expect({VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VkAccessFlags2{1} << 50u},
           VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
           VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT);
}

TEST(Barriers, NoStagesAreTheEndsOfThePipe) {
    test::FakeVulkan vulkan;
    memoryBarrier(vulkan.device, test::kCommands, {}, {});
    ASSERT_EQ(vulkan.barriers.size(), 1u);
    EXPECT_EQ(vulkan.barriers[0].before, VkPipelineStageFlags{VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT});
    EXPECT_EQ(vulkan.barriers[0].after, VkPipelineStageFlags{VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT});
}

} // namespace
} // namespace supple::gpu
