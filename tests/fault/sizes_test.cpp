// What descriptions say of sizes: structSize as it is in memory that nobody has filled, and memoryLimit.
#include "cage/memory_budget.h"
#include "tests/cage/gltf/builder.h"
#include "tests/support/host_memory.h"
#include "tests/support/logged_context.h"

#include <cstddef>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

TEST(StructSize, GarbageIsNotBelieved) {
    const std::unique_ptr<host::Device> device = deviceThrough(nullptr);
    ASSERT_NE(device, nullptr);
    LoggedContext context(*device);
    ASSERT_EQ(context.result(), SUPPLE_OK);
    const auto expectLine = [&](const std::string& text) {
        const std::vector<LogLine> lines = context.takeLines();
        ASSERT_EQ(lines.size(), 1u) << text;
        EXPECT_EQ(lines[0].text, text);
        EXPECT_EQ(lines[0].message, SUPPLE_MESSAGE_STRUCT_SIZE);
    };
    for (const uint32_t size : {0xFFFFFFFFu, 0xCDCDCDCDu, 0x80000000u}) {
        const std::string is =
            ".structSize is " + std::to_string(size) + ": more than in any version; set it to sizeof(";
        SuppleAssetDesc asset{};
        asset.structSize = size;
        SuppleAsset made{};
        EXPECT_EQ(suppleCreateAsset(context.handle(), &asset, &made), SUPPLE_ERROR_ARGUMENT);
        expectLine("suppleCreateAsset: desc" + is + "SuppleAssetDesc)");
        SuppleMemoryUse use{};
        use.structSize = size;
        EXPECT_EQ(suppleGetContextMemory(context.handle(), &use), SUPPLE_ERROR_ARGUMENT);
        expectLine("suppleGetContextMemory: out" + is + "SuppleMemoryUse)");
        SuppleRequirements requirements{};
        requirements.structSize = size;
        EXPECT_EQ(
            suppleQueryRequirements(device->instance(), device->physicalDevice(), vkGetInstanceProcAddr, &requirements),
            SUPPLE_ERROR_ARGUMENT);
        SuppleContextDesc desc = host::contextDesc(*device);
        desc.structSize = size;
        SuppleContext none = nullptr;
        EXPECT_EQ(suppleCreateContext(&desc, &none), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(none, nullptr);
    }
}

TEST(MemoryLimit, AnAssetIsRefusedBeforeItTakesMore) {
    const std::unique_ptr<host::Device> device = deviceThrough(nullptr);
    ASSERT_NE(device, nullptr);
    LoggedContext context(*device);
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = "tube";
    desc.bytes = tubeFile().data();
    desc.byteCount = tubeFile().size();
    desc.memoryLimit = 1000;
    SuppleAsset asset{};
    EXPECT_EQ(suppleCreateAsset(context.handle(), &desc, &asset), SUPPLE_ERROR_LIMIT);
    const std::vector<LogLine> lines = context.takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].text, "tube: JSON: the file needs more memory than the 1000 bytes of memoryLimit");
    desc.memoryLimit = 1u << 24;
    EXPECT_EQ(suppleCreateAsset(context.handle(), &desc, &asset), SUPPLE_OK);
    desc.structSize = offsetof(SuppleAssetDesc, memoryLimit); // of a host that knows no limit
    desc.memoryLimit = 1000;
    EXPECT_EQ(suppleCreateAsset(context.handle(), &desc, &asset), SUPPLE_OK);
}

/// As few bytes a corner as can be: positions alone, with indices of 16 bits.
std::vector<std::byte> denseGrid() {
    constexpr uint32_t kSide = 255;
    std::vector<float> positions;
    std::vector<uint32_t> indices;
    for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) {
            positions.insert(positions.end(), {static_cast<float>(x), static_cast<float>(y), 0.0f});
            if (x + 1 < kSide && y + 1 < kSide) {
                const uint32_t a = y * kSide + x;
                indices.insert(indices.end(), {a, a + 1, a + kSide + 1, a, a + kSide + 1, a + kSide});
            }
        }
    }
    GltfBuilder b;
    b.addFloats("VEC3", positions);
    b.addIntegers("SCALAR", 5123, indices);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";
    return b.glb();
}

TEST(MemoryLimit, ADenseMeshIsRightAndStaysBelowIt) {
    const std::unique_ptr<host::Device> device = deviceThrough(nullptr, false);
    ASSERT_NE(device, nullptr);
    LoggedContext context(*device);
    const std::vector<std::byte> bytes = denseGrid();
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = "grid";
    desc.bytes = bytes.data();
    desc.byteCount = bytes.size();
    SuppleAsset asset{};
    resetHostMemory();
    ASSERT_EQ(suppleCreateAsset(context.handle(), &desc, &asset), SUPPLE_OK);
    const uint64_t peak = hostMemory().peak;
    EXPECT_LE(peak, cage::kBaseMemory + cage::kMemoryPerByte * bytes.size());
    std::printf("  %zu bytes: %.1f MB at a time\n", bytes.size(), static_cast<double>(peak) / 1e6);
}

} // namespace
} // namespace supple::test
