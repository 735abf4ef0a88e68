// A function table between Supple and the driver. A call of the driver fails where it is told to. What a driver
// allocates is its own business: its calls are made with HostMemoryPause.
#pragma once

#include <cstdint>
#include <vector>
#include <vulkan/vulkan.h>

namespace supple::test {

/// What goes into DeviceOptions::suppleGetInstanceProcAddr.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL faultyGetInstanceProcAddr(VkInstance instance, const char* name);
/// Where it takes the driver's functions from, before a device is made; by default from the loader.
void setVulkanBelow(PFN_vkGetInstanceProcAddr below);

/// The n-th call from now on returns `result` and does nothing; 0 is the next one. Only calls that return a VkResult
/// count, and not those that name objects, whose failures change nothing.
void failVulkan(uint64_t n, VkResult result);
/// Ends that. Whether the n-th call came.
bool liftVulkanFailure();

/// How many of these calls there were so far.
[[nodiscard]] uint64_t vulkanCalls();
/// The names of those from now on go there; null ends that.
void listVulkanCalls(std::vector<const char*>* into);

} // namespace supple::test
