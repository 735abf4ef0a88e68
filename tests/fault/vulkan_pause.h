// A function table whose functions are the driver's, called with HostMemoryPause: what a driver allocates is its own
// business, and does not fail.
#pragma once

#include <vulkan/vulkan.h>

namespace supple::test {

/// What goes into DeviceOptions::suppleGetInstanceProcAddr.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL pausingGetInstanceProcAddr(VkInstance instance, const char* name);

} // namespace supple::test
