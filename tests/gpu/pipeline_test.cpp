// Layouts, pipelines and dispatches, as they reach Vulkan.
#include "gpu/pipeline.h"
#include "shaders/shared/specialization.h"
#include "tests/gpu/fake_vulkan.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace supple::gpu {
namespace {

using Pair = std::pair<uint32_t, uint32_t>;

std::vector<Binding> storageBuffers(uint32_t count) {
    std::vector<Binding> bindings;
    for (uint32_t i = 0; i < count; ++i) {
        bindings.push_back({i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
    }
    return bindings;
}

TEST(ComputeLayout, BindsNoMoreThanTheRequirementsName) {
    test::FakeVulkan vulkan;
    const Result<ComputeLayout> all =
        ComputeLayout::create(vulkan.device, storageBuffers(kMaxStorageBuffers), 16, "evaluate");
    EXPECT_TRUE(all.ok());
    EXPECT_EQ(vulkan.layouts, 1u);
    const Result<ComputeLayout> oneMore =
        ComputeLayout::create(vulkan.device, storageBuffers(kMaxStorageBuffers + 1), 16, "evaluate");
    ASSERT_FALSE(oneMore.ok());
    EXPECT_EQ(oneMore.error().message, "evaluate: more bindings than the requirements name");
    EXPECT_EQ(vulkan.layouts, 1u);
}

TEST(ComputePipeline, HasTheCodeAndTheConstantsOfTheMapping) {
    test::FakeVulkan vulkan;
    const Result<ComputeLayout> layout = ComputeLayout::create(vulkan.device, storageBuffers(1), 16, "evaluate");
    ASSERT_TRUE(layout.ok());
    const std::vector<uint32_t> narrow{1, 2};
    const std::vector<uint32_t> wide{3, 4, 5};
    const Constant rate{shared::kRateConstant, 8};
    for (const bool isWide : {false, true}) {
        Mapping& mapping = vulkan.device.mapping;
        mapping.wide = isWide;
        mapping.localSize = isWide ? 128 : 32;
        mapping.exactDivision = !isWide;
        ASSERT_TRUE(
            createComputePipeline(vulkan.device, layout->pipelineLayout.get(), {narrow, wide}, {&rate, 1}, "evaluate")
                .ok());
        const test::FakeVulkan::Pipeline& made = vulkan.pipelines.back();
        EXPECT_EQ(made.code, isWide ? wide : narrow);
        EXPECT_EQ(made.constants, (std::vector<Pair>{{shared::kLocalSizeConstant, isWide ? 128 : 32},
                                                     {shared::kExactDivisionConstant, isWide ? VK_FALSE : VK_TRUE},
                                                     {shared::kRateConstant, 8}}));
    }
    const Constant own[] = {rate, {shared::kLocalSizeConstant, 16}};
    ASSERT_TRUE(
        createComputePipeline(vulkan.device, layout->pipelineLayout.get(), {narrow, wide}, own, "evaluate").ok());
    EXPECT_EQ(
        vulkan.pipelines.back().constants,
        (std::vector<Pair>{{shared::kLocalSizeConstant, 16}, {shared::kExactDivisionConstant, VK_FALSE}, {rate.id, 8}}))
        << "a kernel may have a local size of its own";
    EXPECT_TRUE(vulkan.shaders.empty()) << "modules go when their pipeline is made";
}

TEST(DescriptorPool, HoldsEveryBindingOfEverySet) {
    test::FakeVulkan vulkan;
    std::vector<Binding> bindings = storageBuffers(3);
    bindings.push_back({3, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER});
    const Result<ComputeLayout> layout = ComputeLayout::create(vulkan.device, bindings, 16, "evaluate");
    ASSERT_TRUE(layout.ok());
    ASSERT_TRUE(createDescriptorPool(vulkan.device, *layout, 5, "evaluate").ok());
    ASSERT_EQ(vulkan.poolSizes.size(), 2u);
    EXPECT_EQ(vulkan.poolSizes[0].type, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    EXPECT_EQ(vulkan.poolSizes[0].descriptorCount, 15u);
    EXPECT_EQ(vulkan.poolSizes[1].type, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    EXPECT_EQ(vulkan.poolSizes[1].descriptorCount, 5u);
}

TEST(DispatchLinear, CoversTheGroupsInEvenRows) {
    for (const uint32_t limit : {7u, 1000u, 65535u, 0xFFFFFFFFu}) {
        for (const uint64_t groups : {1ull, 6ull, 7ull, 8ull, 49ull, 65535ull, 65536ull, 131071ull}) {
            test::FakeVulkan vulkan;
            vulkan.device.limits.maxComputeWorkGroupCount[0] = limit;
            const uint64_t widest = maxGroupsInX(vulkan.device);
            EXPECT_LE(widest, 65535u) << "splits are the same on every device that offers more";
            dispatchLinear(vulkan.device, test::kCommands, groups);
            ASSERT_EQ(vulkan.dispatches.size(), 1u);
            const uint64_t x = vulkan.dispatches[0].first;
            const uint64_t y = vulkan.dispatches[0].second;
            EXPECT_LE(x, widest) << groups;
            EXPECT_EQ(y, (groups + widest - 1) / widest) << groups;
            EXPECT_GE(x * y, groups);
            EXPECT_LT(x * y - groups, y) << groups << ": no row has more than one group too many";
        }
    }
}

} // namespace
} // namespace supple::gpu
