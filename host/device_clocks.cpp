// Device::readClocks: the device's clock beside the host's.
#include "host/device.h"
#include "host/vk_struct.h"

#include <algorithm>

namespace supple::host {

bool Device::readsClocks() const {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physicalDevice_, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(physicalDevice_, nullptr, &count, extensions.data());
    const bool has = std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& extension) {
        return std::string_view(extension.extensionName) == VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME;
    });
    const auto getDomains = reinterpret_cast<PFN_vkGetPhysicalDeviceCalibrateableTimeDomainsEXT>(
        vkGetInstanceProcAddr(instance_, "vkGetPhysicalDeviceCalibrateableTimeDomainsEXT"));
    if (!has || getDomains == nullptr) {
        return false;
    }
    VkTimeDomainEXT domains[8]{};
    count = 8;
    getDomains(physicalDevice_, &count, domains);
    const auto known = [&](VkTimeDomainEXT domain) {
        return std::find(domains, domains + count, domain) != domains + count;
    };
    return known(VK_TIME_DOMAIN_DEVICE_EXT) && known(VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT);
}

std::optional<ClockPair> Device::readClocks() const {
    if (getCalibratedTimestamps_ == nullptr) {
        return std::nullopt;
    }
    VkCalibratedTimestampInfoEXT clocks[2] = {
        vkStruct<VkCalibratedTimestampInfoEXT>(VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT),
        vkStruct<VkCalibratedTimestampInfoEXT>(VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT)};
    clocks[0].timeDomain = VK_TIME_DOMAIN_DEVICE_EXT;
    clocks[1].timeDomain = VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT;
    uint64_t ticks[2]{}, deviation = 0;
    if (getCalibratedTimestamps_(device_, 2, clocks, ticks, &deviation) != VK_SUCCESS) {
        return std::nullopt;
    }
    return ClockPair{ticks[0], ticks[1], deviation};
}

} // namespace supple::host
