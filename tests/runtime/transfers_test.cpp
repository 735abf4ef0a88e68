// Buffers that change hands between queue families: any number of them, each once.
#include "runtime/transfers.h"
#include "tests/gpu/fake_vulkan.h"

#include <gtest/gtest.h>
#include <vector>

namespace supple::runtime {
namespace {

constexpr QueueFamilies kFamilies{3, 5};
constexpr uint64_t kNumbers[] = {0, 1, Releases::kAtOnce - 1, Releases::kAtOnce, Releases::kAtOnce + 1, 1000};

VkBuffer bufferNumber(uint64_t number) {
    return reinterpret_cast<VkBuffer>(number); // NOLINT: a handle that nobody looks behind
}

void addBuffers(Transfers& transfers, uint64_t count) {
    for (uint64_t i = 1; i <= count; ++i) {
        transfers.add(bufferNumber(i), 4 * i);
        transfers.add(VK_NULL_HANDLE);
    }
}

template <class Barrier>
void expectBuffer(const Barrier& barrier, uint64_t number) {
    EXPECT_EQ(barrier.buffer, bufferNumber(number));
    EXPECT_EQ(barrier.offset, 4 * number);
    EXPECT_EQ(barrier.size, VK_WHOLE_SIZE);
    EXPECT_EQ(barrier.srcQueueFamilyIndex, kFamilies.compute);
    EXPECT_EQ(barrier.dstQueueFamilyIndex, kFamilies.draw);
}

TEST(Transfers, AnyNumberIsReleasedEachOnce) {
    for (const uint64_t count : kNumbers) {
        gpu::test::FakeVulkan fake;
        {
            Releases releases(fake.device, gpu::test::kCommands, kFamilies,
                              {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT});
            addBuffers(releases, count);
        }
        uint64_t number = 0;
        for (const std::vector<gpu::test::BufferBarrier>& call : fake.bufferBarriers) {
            EXPECT_LE(call.size(), Releases::kAtOnce);
            for (const gpu::test::BufferBarrier& release : call) {
                expectBuffer(release.barrier, ++number);
                EXPECT_EQ(release.before, VkPipelineStageFlags{VK_PIPELINE_STAGE_TRANSFER_BIT});
                EXPECT_EQ(release.barrier.srcAccessMask, VkAccessFlags{VK_ACCESS_TRANSFER_WRITE_BIT});
                EXPECT_EQ(release.after, VkPipelineStageFlags{VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT});
                EXPECT_EQ(release.barrier.dstAccessMask, VkAccessFlags{0});
            }
        }
        EXPECT_EQ(number, count);
    }
}

TEST(Transfers, AcquiresFillWhatThereIsAndCountTheRest) {
    for (const uint64_t count : kNumbers) {
        for (const size_t room : {size_t{0}, size_t{7}, size_t{2000}}) {
            std::vector<VkBufferMemoryBarrier2> out(room);
            Acquires acquires(kFamilies, {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT},
                              out);
            addBuffers(acquires, count);
            EXPECT_EQ(acquires.count(), count);
            for (uint64_t i = 0; i < room; ++i) {
                if (i >= count) {
                    EXPECT_EQ(out[i].buffer, VK_NULL_HANDLE);
                    continue;
                }
                expectBuffer(out[i], i + 1);
                EXPECT_EQ(out[i].srcStageMask, VK_PIPELINE_STAGE_2_NONE);
                EXPECT_EQ(out[i].dstStageMask, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT);
                EXPECT_EQ(out[i].dstAccessMask, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
            }
        }
    }
}

} // namespace
} // namespace supple::runtime
