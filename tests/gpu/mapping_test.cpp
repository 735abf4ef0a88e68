// Which mapping a device gets.
#include "gpu/mapping.h"

#include <gtest/gtest.h>

namespace supple::gpu {
namespace {

constexpr VkPhysicalDeviceType kGpus[] = {VK_PHYSICAL_DEVICE_TYPE_OTHER, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
                                          VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU};

constexpr uint32_t kManyTexels = 1u << 27;

TEST(Mapping, IsWideOnCpusThatReadFewTexels) {
    const auto chosen = [](uint32_t texels, MappingChoice choice) {
        return chooseMapping(VK_PHYSICAL_DEVICE_TYPE_CPU, VK_DRIVER_ID_GOOGLE_SWIFTSHADER, texels, choice);
    };
    EXPECT_TRUE(chosen(65536, MappingChoice::automatic).wide);
    EXPECT_TRUE(chosen(65536, MappingChoice::automatic).lacksTexels);
    EXPECT_FALSE(chosen(65536, MappingChoice::narrow).wide);
    EXPECT_FALSE(chosen(65536, MappingChoice::wide).lacksTexels);
    EXPECT_FALSE(chosen(kManyTexels, MappingChoice::automatic).lacksTexels);
}

TEST(Mapping, IsNarrowOnCpusAndWideElsewhere) {
    EXPECT_FALSE(
        chooseMapping(VK_PHYSICAL_DEVICE_TYPE_CPU, VK_DRIVER_ID_MESA_LLVMPIPE, kManyTexels, MappingChoice::automatic)
            .wide);
    for (const VkPhysicalDeviceType type : kGpus) {
        EXPECT_TRUE(chooseMapping(type, VK_DRIVER_ID_MESA_RADV, kManyTexels, MappingChoice::automatic).wide) << type;
    }
}

TEST(Mapping, IsWhatTheCallerChooses) {
    EXPECT_TRUE(
        chooseMapping(VK_PHYSICAL_DEVICE_TYPE_CPU, VK_DRIVER_ID_MESA_LLVMPIPE, kManyTexels, MappingChoice::wide).wide);
    for (const VkPhysicalDeviceType type : kGpus) {
        EXPECT_FALSE(chooseMapping(type, VK_DRIVER_ID_MESA_RADV, kManyTexels, MappingChoice::narrow).wide) << type;
    }
}

TEST(Mapping, WaitsForTimestampsOnCpusAlone) {
    for (const MappingChoice choice : {MappingChoice::automatic, MappingChoice::narrow, MappingChoice::wide}) {
        EXPECT_TRUE(
            chooseMapping(VK_PHYSICAL_DEVICE_TYPE_CPU, VK_DRIVER_ID_MESA_LLVMPIPE, kManyTexels, choice).lazyTimestamps);
        for (const VkPhysicalDeviceType type : kGpus) {
            EXPECT_FALSE(chooseMapping(type, VK_DRIVER_ID_MESA_RADV, kManyTexels, choice).lazyTimestamps) << type;
        }
    }
}

TEST(Mapping, TrustsTheDivisionOfLlvmpipeAlone) {
    const auto exact = [](VkDriverId driver, MappingChoice choice) {
        return chooseMapping(VK_PHYSICAL_DEVICE_TYPE_CPU, driver, kManyTexels, choice).exactDivision;
    };
    EXPECT_TRUE(exact(VK_DRIVER_ID_MESA_LLVMPIPE, MappingChoice::narrow));
    EXPECT_FALSE(exact(VK_DRIVER_ID_MESA_LLVMPIPE, MappingChoice::wide)) << "the table is tested here";
    EXPECT_FALSE(exact(VK_DRIVER_ID_GOOGLE_SWIFTSHADER, MappingChoice::narrow));
}

} // namespace
} // namespace supple::gpu
