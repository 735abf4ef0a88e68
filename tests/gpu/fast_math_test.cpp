// What MoltenVK is told so that Metal computes as kernels say, and no other driver.
#include "gpu/fast_math.h"

#include "gpu/pipeline.h"
#include "tests/gpu/fake_vulkan.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace supple::gpu {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kCapability[] = {2u << 16 | 17, 4466};
/// "SPV_KHR_float_controls"
constexpr uint32_t kExtension[] = {7u << 16 | 10, 0x5F565053, 0x5F52484B, 0x616F6C66,
                                   0x6F635F74,    0x6F72746E, 0x0000736C};
constexpr uint32_t kHeader[] = {0x07230203, 0x00010300, 0, 9, 0};
constexpr uint32_t kEntryPoint[] = {5u << 16 | 15, 5, 4, 0x6E69616D, 0}; // compute, %4, "main"
constexpr uint32_t kMode[] = {4u << 16 | 16, 4, 4461, 32};

std::vector<uint32_t> joined(std::initializer_list<std::span<const uint32_t>> parts) {
    std::vector<uint32_t> words;
    for (const std::span<const uint32_t> part : parts) {
        words.insert(words.end(), part.begin(), part.end());
    }
    return words;
}

std::vector<uint32_t> codeOf(VkDriverId driver, VkBool32 keepsSignedZeros) {
    test::FakeVulkan vulkan;
    vulkan.driver = driver;
    vulkan.keepsSignedZeros = keepsSignedZeros;
    vulkan.device.fastMath = hasFastMath(vulkan.device.vk, vulkan.device.physicalDevice);
    const Result<ComputeLayout> layout = ComputeLayout::create(vulkan.device, {}, 16, "kernel");
    EXPECT_TRUE(layout.ok());
    const std::vector<uint32_t> code = joined({kHeader, kEntryPoint});
    EXPECT_TRUE(
        createComputePipeline(vulkan.device, layout->pipelineLayout.get(), {code, code, {}}, {}, "kernel").ok());
    return vulkan.pipelines.back().code;
}

TEST(FastMath, IsForbiddenWhereADriverHasIt) {
    const std::vector<uint32_t> plain = joined({kHeader, kEntryPoint});
    EXPECT_EQ(codeOf(VK_DRIVER_ID_MOLTENVK, VK_TRUE), joined({kHeader, kCapability, kExtension, kEntryPoint, kMode}));
    EXPECT_EQ(codeOf(VK_DRIVER_ID_MOLTENVK, VK_FALSE), plain) << "it does not know the mode";
    EXPECT_EQ(codeOf(VK_DRIVER_ID_MESA_RADV, VK_TRUE), plain) << "it keeps to NoContraction";
}

TEST(FastMath, KernelsThatForbidItAreValid) {
    ASSERT_TRUE(fs::exists(SUPPLE_SPIRV_VAL)) << "spirv-val is not installed (Debian package spirv-tools)";
    const fs::path file =
        fs::temp_directory_path() / ("supple_fast_math_" + std::to_string(std::random_device()()) + ".spv");
    uint32_t kernels = 0;
    for (const auto& entry : fs::directory_iterator(SUPPLE_SPIRV_DIR)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("pose_") || !name.ends_with("_WIDE.opt.spv")) {
            continue;
        }
        std::vector<uint32_t> words(fs::file_size(entry.path()) / sizeof(uint32_t));
        std::ifstream(entry.path(), std::ios::binary)
            .read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(4 * words.size()));
        const std::vector<uint32_t> changed = withoutFastMath(words);
        EXPECT_EQ(changed.size(), words.size() + std::size(kCapability) + std::size(kExtension) + std::size(kMode))
            << name;
        std::ofstream(file, std::ios::binary)
            .write(reinterpret_cast<const char*>(changed.data()), static_cast<std::streamsize>(4 * changed.size()));
        const std::string command = std::string(SUPPLE_SPIRV_VAL) + " --target-env vulkan1.2 " + file.string();
        EXPECT_EQ(std::system(command.c_str()), 0) << name;
        ++kernels;
    }
    fs::remove(file);
    EXPECT_GT(kernels, 5u);
}

} // namespace
} // namespace supple::gpu
