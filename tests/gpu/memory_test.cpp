// Buffers and the memory they share: placed without overlap, refused by name, freed whatever fails.
#include "gpu/memory.h"
#include "tests/gpu/fake_vulkan.h"

#include <array>
#include <bit>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace supple::gpu {
namespace {

constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

TEST(BufferSet, SharesOneAllocation) {
    test::FakeVulkan vulkan;
    const std::vector<BufferRequest> requests{
        {"a", 10, kUsage}, {"none", 0, kUsage}, {"b", 64, kUsage}, {"c", 1, kUsage}};
    {
        const Result<BufferSet> set = BufferSet::create(vulkan.device, requests, MemoryKind::upload);
        ASSERT_TRUE(set.ok()) << set.error().message;
        EXPECT_EQ(set->buffer(1), VkBuffer{VK_NULL_HANDLE}) << "of no size";
        EXPECT_EQ(vulkan.allocations, 1u);
        VkDeviceSize end = 0;
        for (const size_t i : {0, 2, 3}) {
            const test::FakeVulkan::BoundBuffer& bound = vulkan.buffers.at(set->buffer(i));
            EXPECT_EQ(bound.offset % vulkan.alignment, 0u);
            EXPECT_GE(bound.offset, end) << "overlaps the one before";
            end = bound.offset + bound.size;
            EXPECT_EQ(set->mapped(i), vulkan.memory.at(bound.memory).data() + bound.offset);
        }
        EXPECT_EQ(set->use().total(), end);
        EXPECT_EQ(vulkan.memory.begin()->second.size(), end);
    }
    EXPECT_TRUE(vulkan.buffers.empty());
    EXPECT_TRUE(vulkan.memory.empty());
}

TEST(BufferSet, TakesAsManyAllocationsAsTheDeviceWants) {
    test::FakeVulkan vulkan;
    vulkan.device.maxAllocationSize = 128;
    const std::vector<BufferRequest> requests{
        {"a", 64, kUsage}, {"b", 64, kUsage}, {"c", 100, kUsage}, {"d", 20, kUsage}};
    const Result<BufferSet> set = BufferSet::create(vulkan.device, requests, MemoryKind::deviceLocal);
    ASSERT_TRUE(set.ok()) << set.error().message;
    EXPECT_EQ(vulkan.allocations, 3u) << "a and b, c, d";
    std::set<VkDeviceMemory> memories;
    for (size_t i = 0; i < requests.size(); ++i) {
        memories.insert(vulkan.buffers.at(set->buffer(i)).memory);
    }
    EXPECT_EQ(memories.size(), 3u);
    EXPECT_EQ(set->use().total(), 128u + 100u + 20u);
}

TEST(BufferSet, NamesTheBufferThatIsTooLarge) {
    test::FakeVulkan vulkan;
    vulkan.device.maxBufferSize = 100;
    const std::vector<BufferRequest> requests{{"small", 64, kUsage}, {"large", 101, kUsage}};
    const Result<BufferSet> set = BufferSet::create(vulkan.device, requests, MemoryKind::deviceLocal);
    ASSERT_FALSE(set.ok());
    EXPECT_EQ(set.error().code, ErrorCode::limit);
    EXPECT_EQ(set.error().message, "buffer large of 101 bytes: the device's largest has 100 bytes");
    EXPECT_TRUE(vulkan.buffers.empty());
}

TEST(BufferSet, FreesEverythingWhereAnAllocationFails) {
    test::FakeVulkan vulkan;
    vulkan.device.maxAllocationSize = 64;
    vulkan.failAllocation = 1;
    const std::vector<BufferRequest> requests{{"a", 64, kUsage}, {"b", 64, kUsage}};
    const Result<BufferSet> set = BufferSet::create(vulkan.device, requests, MemoryKind::deviceLocal);
    ASSERT_FALSE(set.ok());
    EXPECT_EQ(set.error().code, ErrorCode::deviceMemory);
    EXPECT_EQ(vulkan.allocations, 2u);
    EXPECT_TRUE(vulkan.buffers.empty());
    EXPECT_TRUE(vulkan.memory.empty());
}

/// A host's allocator that gives the same piece to everyone, and counts.
struct HostAllocator {
    explicit HostAllocator(Device& device) {
        device.memorySource.allocate = [this](const VkMemoryRequirements&, VkMemoryPropertyFlags, VkMemoryPropertyFlags,
                                              const char*, HostMemory& out) {
            ++allocations;
            out.memory = piece;
            out.offset = 4096;
            out.mapped = mapped;
            return VK_SUCCESS;
        };
        device.memorySource.free = [this](const HostMemory&) { ++frees; };
    }
    std::array<std::byte, 256> bytes{};
    VkDeviceMemory piece = std::bit_cast<VkDeviceMemory>(uintptr_t{77});
    std::byte* mapped = bytes.data();
    int allocations = 0;
    int frees = 0;
};

TEST(BufferSet, LivesInTheHostsMemory) {
    test::FakeVulkan vulkan;
    HostAllocator host(vulkan.device);
    const std::vector<BufferRequest> requests{{"a", 10, kUsage}, {"b", 10, kUsage}};
    {
        const Result<BufferSet> set = BufferSet::create(vulkan.device, requests, MemoryKind::upload);
        ASSERT_TRUE(set.ok()) << set.error().message;
        EXPECT_EQ(vulkan.buffers.at(set->buffer(1)).memory, host.piece);
        EXPECT_EQ(vulkan.buffers.at(set->buffer(1)).offset, 4096u + vulkan.alignment);
        EXPECT_EQ(set->mapped(1), host.bytes.data() + vulkan.alignment);
    }
    EXPECT_EQ(host.allocations, 1);
    EXPECT_EQ(host.frees, 1);
    EXPECT_EQ(vulkan.allocations, 0u);
}

TEST(BufferSet, GivesBackMemoryThatTheHostDidNotMap) {
    test::FakeVulkan vulkan;
    HostAllocator host(vulkan.device);
    host.mapped = nullptr;
    const std::vector<BufferRequest> requests{{"a", 10, kUsage}};
    const Result<BufferSet> set = BufferSet::create(vulkan.device, requests, MemoryKind::upload);
    ASSERT_FALSE(set.ok());
    EXPECT_EQ(set.error().code, ErrorCode::argument);
    EXPECT_EQ(host.frees, 1);
}

TEST(BufferSet, CountsByPurposeAndGivesBack) {
    test::FakeVulkan vulkan; // aligns to 64
    const std::vector<BufferRequest> requests{{"a", 10, kUsage, MemoryPurpose::cages},
                                              {"none", 0, kUsage, MemoryPurpose::tables},
                                              {"b", 100, kUsage, MemoryPurpose::vertices},
                                              {"c", 1, kUsage, MemoryPurpose::cages}};
    const MemoryLedger& ledger = *vulkan.device.ledger;
    {
        Result<BufferSet> set = BufferSet::create(vulkan.device, requests, MemoryKind::deviceLocal);
        ASSERT_TRUE(set.ok());
        EXPECT_EQ(set->use().of(MemoryPurpose::vertices), 54u + 100u) << "the gap before it is its own";
        EXPECT_EQ(set->use().of(MemoryPurpose::cages), 10u + 28u + 1u);
        EXPECT_EQ(set->use().of(MemoryPurpose::tables), 0u);
        EXPECT_EQ(set->use().total(), 193u);
        EXPECT_EQ(set->use().allocations, 1u);
        const BufferSet moved = std::move(*set);
        Result<BufferSet> staging = BufferSet::create(vulkan.device, requests, MemoryKind::upload);
        ASSERT_TRUE(staging.ok());
        EXPECT_EQ(staging->use().of(MemoryPurpose::staging), 193u) << "whatever the requests say";
        EXPECT_EQ(ledger.use.total(), 2u * 193u);
        EXPECT_EQ(ledger.use.hostVisible(), 193u);
    }
    EXPECT_EQ(ledger.use.total(), 0u);
    EXPECT_EQ(ledger.use.allocations, 0u);
}

TEST(BufferSet, AsksBeforeTheBudgetIsExceeded) {
    test::FakeVulkan vulkan;
    MemoryLedger& ledger = *vulkan.device.ledger;
    const std::vector<BufferRequest> requests{{"a", 100, kUsage}};
    ledger.budget = 100;
    const Result<BufferSet> first = BufferSet::create(vulkan.device, requests, MemoryKind::deviceLocal);
    ASSERT_TRUE(first.ok()) << "it fits";
    const Result<BufferSet> refused = BufferSet::create(vulkan.device, requests, MemoryKind::upload);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::deviceMemory);
    EXPECT_EQ(vulkan.allocations, 1u);
    EXPECT_EQ(vulkan.buffers.size(), 1u) << "its buffer is gone";
    uint32_t asked = 0;
    ledger.allowsMore = [&](const MemoryRequest& request) {
        ++asked;
        EXPECT_EQ(request.bytes, 100u);
        EXPECT_EQ(request.used, 100u);
        EXPECT_EQ(request.budget, 100u);
        EXPECT_TRUE(request.hostVisible);
        return true;
    };
    const Result<BufferSet> allowed = BufferSet::create(vulkan.device, requests, MemoryKind::upload);
    EXPECT_TRUE(allowed.ok());
    EXPECT_EQ(asked, 1u);
}

TEST(TexelViews, SeeNoMoreThanTheDeviceReads) {
    test::FakeVulkan vulkan;
    vulkan.device.limits.maxTexelBufferElements = 100;
    TexelViews views;
    Status status = success();
    const auto buffer = std::bit_cast<VkBuffer>(uintptr_t{1});
    const VkBufferView whole = views.make(vulkan.device, buffer, VK_FORMAT_R32_UINT, 0, 80, "a", status);
    EXPECT_EQ(vulkan.views.at(whole).range, 80u);
    const VkBufferView cut = views.make(vulkan.device, buffer, VK_FORMAT_R32G32B32A32_SFLOAT, 64, 5000, "b", status);
    EXPECT_EQ(vulkan.views.at(cut).range, 1600u);
    EXPECT_EQ(vulkan.views.at(cut).offset, 64u);
    EXPECT_TRUE(status.ok());

    status = Error{ErrorCode::vulkan, "from before"};
    EXPECT_EQ(views.make(vulkan.device, buffer, VK_FORMAT_R32_UINT, 0, 4, "c", status), VkBufferView{VK_NULL_HANDLE});
    EXPECT_EQ(status.error().message, "from before");
    EXPECT_EQ(vulkan.views.size(), 2u);
}

} // namespace
} // namespace supple::gpu
