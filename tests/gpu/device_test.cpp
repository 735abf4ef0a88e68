// What a device must offer, and what it is asked for.
#include "gpu/device.h"
#include "tests/gpu/fake_vulkan.h"

#include <gtest/gtest.h>
#include <string>

namespace supple::gpu {
namespace {

TEST(Device, NamesTheEntryPointThatIsMissing) {
    const auto nothing = [](VkInstance, const char*) -> PFN_vkVoidFunction { return nullptr; };
    const std::string text = "the VkInstance must be created with apiVersion 1.1 or more: this one has ";
    EXPECT_EQ(missingInInstance(VK_NULL_HANDLE, VK_NULL_HANDLE, nothing, 0),
              text + "no vkGetPhysicalDeviceProperties2");
    EXPECT_EQ(missingInInstance(VK_NULL_HANDLE, VK_NULL_HANDLE, nothing, VK_API_VERSION_1_0), text + "1.0");

    const auto allButOne = [](VkInstance, const char* name) -> PFN_vkVoidFunction {
        return std::string(name) == "vkGetDeviceProcAddr" ? nullptr : reinterpret_cast<PFN_vkVoidFunction>(1);
    };
    Functions functions;
    EXPECT_STREQ(functions.loadInstance(VK_NULL_HANDLE, allButOne), "vkGetDeviceProcAddr");
}

TEST(Device, ErrorsSayWhatRanOut) {
    EXPECT_EQ(vulkanError(VK_ERROR_OUT_OF_HOST_MEMORY, "a").code, ErrorCode::hostMemory);
    EXPECT_EQ(vulkanError(VK_ERROR_OUT_OF_DEVICE_MEMORY, "a").code, ErrorCode::deviceMemory);
    EXPECT_EQ(vulkanError(VK_ERROR_DEVICE_LOST, "a").code, ErrorCode::deviceLost);
    const Error other = vulkanError(VK_ERROR_TOO_MANY_OBJECTS, "buffer of skins");
    EXPECT_EQ(other.code, ErrorCode::vulkan);
    EXPECT_EQ(other.message, "buffer of skins: VK_ERROR_TOO_MANY_OBJECTS (-10)");
}

TEST(Device, FindsInEitherStructWhetherAddressesAreEnabled) {
    EXPECT_FALSE(enablesAddresses(nullptr));
    VkPhysicalDeviceVulkan12Features all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceBufferDeviceAddressFeatures alone{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
    // Something that Supple does not know stands between.
    VkPhysicalDeviceSamplerYcbcrConversionFeatures between{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SAMPLER_YCBCR_CONVERSION_FEATURES};
    VkPhysicalDeviceFeatures2 first{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    first.pNext = &between;
    for (const VkBool32 enabled : {VK_FALSE, VK_TRUE}) {
        all.bufferDeviceAddress = alone.bufferDeviceAddress = enabled;
        for (void* const last : {static_cast<void*>(&all), static_cast<void*>(&alone)}) {
            between.pNext = last;
            EXPECT_EQ(enablesAddresses(&first), enabled == VK_TRUE);
        }
    }
}

TEST(Device, WindowsFitEveryDescriptor) {
    test::FakeVulkan vulkan;
    Device& device = vulkan.device;
    device.limits.maxStorageBufferRange = 1000000;
    device.limits.maxTexelBufferElements = 10000;
    EXPECT_EQ(device.bufferWindow(4), 40000u) << "narrow: texels are read";
    EXPECT_EQ(device.bufferWindow(128), 1000000u) << "narrow: the storage buffer ends first";
    device.mapping.wide = true;
    EXPECT_EQ(device.bufferWindow(4), 1000000u) << "wide: none are";
}

} // namespace
} // namespace supple::gpu
