// Compute pipelines that outlive their contexts. A driver takes a tenth of a second to compile what a context needs,
// and a row of calls takes a millisecond. So a pipeline is compiled once, and the next context that asks for the same
// gets it.
#pragma once

#include <vulkan/vulkan.h>

namespace supple::fuzz {

/// What stands between Supple, or the faults above it, and the driver.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL keepingGetInstanceProcAddr(VkInstance instance, const char* name);

/// Before the device goes.
void destroyKeptPipelines(VkDevice device);

} // namespace supple::fuzz
