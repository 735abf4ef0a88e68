#include "gpu/functions.h"

namespace supple::gpu {

const char* Functions::loadInstance(VkInstance instance, PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
#define SUPPLE_LOAD(name)                                                                                              \
    name = reinterpret_cast<PFN_vk##name>(getInstanceProcAddr(instance, "vk" #name));                                  \
    if (name == nullptr)                                                                                               \
        return "vk" #name;
    SUPPLE_INSTANCE_FUNCTIONS(SUPPLE_LOAD)
#undef SUPPLE_LOAD
    return nullptr;
}

const char* Functions::loadDevice(VkInstance instance, VkDevice device, PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                  bool debugUtils) {
#define SUPPLE_LOAD(name)                                                                                              \
    name = reinterpret_cast<PFN_vk##name>(GetDeviceProcAddr(device, "vk" #name));                                      \
    if (name == nullptr)                                                                                               \
        return "vk" #name;
    SUPPLE_DEVICE_FUNCTIONS(SUPPLE_LOAD)
#undef SUPPLE_LOAD
#define SUPPLE_LOAD(name) name = reinterpret_cast<PFN_vk##name>(GetDeviceProcAddr(device, "vk" #name));
    SUPPLE_NEWER_FUNCTIONS(SUPPLE_LOAD)
#undef SUPPLE_LOAD
    if (debugUtils) {
        // An instance extension: some loaders hand its device-level functions out through the instance only.
#define SUPPLE_LOAD(name)                                                                                              \
    name = reinterpret_cast<PFN_vk##name>(getInstanceProcAddr(instance, "vk" #name));                                  \
    if (name == nullptr)                                                                                               \
        return "vk" #name;
        SUPPLE_DEBUG_FUNCTIONS(SUPPLE_LOAD)
#undef SUPPLE_LOAD
    }
    return nullptr;
}

} // namespace supple::gpu
