// That memory is filled in this run, so that the other tests prove what they are to prove.
#include "host/device.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <string>

namespace supple::test {
namespace {

TEST(Poison, MemoryIsNeverZeroAndNotAlwaysTheSame) {
    if (std::getenv("SUPPLE_POISON") == nullptr) {
        GTEST_SKIP() << "SUPPLE_POISON is not set: memory comes as the driver has it. tools/test.sh sets it";
    }
    const Result<std::unique_ptr<host::Device>> device = host::Device::create();
    ASSERT_TRUE(device.ok()) << device.error().message;
    std::map<uint64_t, uint32_t> firstWords;
    constexpr VkDeviceSize kBytes = 4096;
    for (uint32_t i = 0; i < 40; ++i) {
        const Result<host::Buffer> buffer =
            (*device)->createBuffer(kBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, host::MemoryKind::readback);
        ASSERT_TRUE(buffer.ok());
        const auto* const words = static_cast<const uint64_t*>(buffer->mapped());
        for (size_t w = 0; w < kBytes / sizeof(uint64_t); ++w) {
            ASSERT_NE(words[w], 0u) << "buffer " << i << ", word " << w;
        }
        ++firstWords[words[0]];
    }
    EXPECT_GT(firstWords.size(), 5u) << "random ones differ from each other";
    for (const uint64_t pattern :
         {0xFFFFFFFFFFFFFFFFu, 0x3F3F3F3F3F3F3F3Fu, 0x0101010101010101u, 0x7FC000007FC00000u}) {
        EXPECT_GT(firstWords[pattern], 0u) << std::hex << pattern;
    }
}

} // namespace
} // namespace supple::test
