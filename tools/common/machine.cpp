#include "tools/common/machine.h"

#include "host/device.h"
#include "host/operating_system.h"

namespace supple::tools {
Machine describeMachine(const host::Device& device, const std::string& mapping) {
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device.physicalDevice(), &properties);
    return {device.name(), driver.driverName, driver.driverInfo, mapping, host::cpuName(), device.isCpu()};
}

} // namespace supple::tools
