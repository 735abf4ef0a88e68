#include "tests/fault/vulkan_pause.h"

#include "gpu/functions.h"
#include "tests/support/host_memory.h"

#include <cstring>

namespace supple::test {
namespace {

gpu::Functions real;

template <auto Member, class F>
struct Pausing;
template <auto Member, class R, class... A>
struct Pausing<Member, R(VKAPI_PTR*)(A...)> {
    static VKAPI_ATTR R VKAPI_CALL call(A... arguments) {
        const HostMemoryPause pause;
        return (real.*Member)(arguments...);
    }
};

template <auto Member, class F>
PFN_vkVoidFunction pausing(F& slot, PFN_vkVoidFunction function) {
    slot = reinterpret_cast<F>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(&Pausing<Member, F>::call);
}

PFN_vkVoidFunction wrap(const char* name, PFN_vkVoidFunction function) {
#define WRAP(own)                                                                                                      \
    if (std::strcmp(name, "vk" #own) == 0) {                                                                           \
        return pausing<&gpu::Functions::own>(real.own, function);                                                      \
    }
    SUPPLE_INSTANCE_FUNCTIONS(WRAP)
    SUPPLE_DEVICE_FUNCTIONS(WRAP)
    SUPPLE_DEBUG_FUNCTIONS(WRAP)
#undef WRAP
    return function;
}

PFN_vkGetDeviceProcAddr realDeviceProcAddr = nullptr;

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL pausingGetDeviceProcAddr(VkDevice device, const char* name) {
    const HostMemoryPause pause;
    return wrap(name, realDeviceProcAddr(device, name));
}

} // namespace

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL pausingGetInstanceProcAddr(VkInstance instance, const char* name) {
    const HostMemoryPause pause;
    const PFN_vkVoidFunction function = vkGetInstanceProcAddr(instance, name);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        realDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(&pausingGetDeviceProcAddr);
    }
    return wrap(name, function);
}

} // namespace supple::test
