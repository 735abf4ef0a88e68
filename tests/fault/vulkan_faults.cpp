#include "tests/fault/vulkan_faults.h"

#include "gpu/functions.h"
#include "tests/support/host_memory.h"

#include <cstring>
#include <type_traits>
#include <utility>

namespace supple::test {
namespace {

PFN_vkGetInstanceProcAddr driver = &vkGetInstanceProcAddr;
gpu::Functions real;

constexpr int64_t kNever = -1;
int64_t callsUntilFailure = kNever;
bool failed = false;
VkResult failure = VK_SUCCESS;
uint64_t calls = 0;
std::vector<const char*>* names = nullptr;

bool failsNow(const char* name) {
    ++calls;
    if (names != nullptr) {
        names->push_back(name);
    }
    if (callsUntilFailure == kNever || failed) {
        return false;
    }
    failed = callsUntilFailure-- == 0;
    return failed;
}

#define IS_DEBUG(own) std::strcmp(name, #own) == 0 ||
bool isDebug(const char* name) {
    return SUPPLE_DEBUG_FUNCTIONS(IS_DEBUG) false;
}
#undef IS_DEBUG

template <auto Member, class F>
struct Faulty;
template <auto Member, class R, class... A>
struct Faulty<Member, R(VKAPI_PTR*)(A...)> {
    static inline const char* name = "";
    static VKAPI_ATTR R VKAPI_CALL call(A... arguments) {
        const HostMemoryPause pause;
        if constexpr (std::is_same_v<R, VkResult>) {
            if (!isDebug(name) && failsNow(name)) {
                return failure;
            }
        }
        return (real.*Member)(arguments...);
    }
};

template <auto Member, class F>
PFN_vkVoidFunction faulty(F& slot, PFN_vkVoidFunction function, const char* name) {
    slot = reinterpret_cast<F>(function);
    Faulty<Member, F>::name = name;
    return reinterpret_cast<PFN_vkVoidFunction>(&Faulty<Member, F>::call);
}

PFN_vkVoidFunction wrap(const char* name, PFN_vkVoidFunction function) {
#define WRAP(own)                                                                                                      \
    if (std::strcmp(name, "vk" #own) == 0) {                                                                           \
        return faulty<&gpu::Functions::own>(real.own, function, #own);                                                 \
    }
    SUPPLE_INSTANCE_FUNCTIONS(WRAP)
    SUPPLE_DEVICE_FUNCTIONS(WRAP)
    SUPPLE_DEBUG_FUNCTIONS(WRAP)
#undef WRAP
    return function;
}

PFN_vkGetDeviceProcAddr realDeviceProcAddr = nullptr;

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL faultyGetDeviceProcAddr(VkDevice device, const char* name) {
    const HostMemoryPause pause;
    return wrap(name, realDeviceProcAddr(device, name));
}

} // namespace

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL faultyGetInstanceProcAddr(VkInstance instance, const char* name) {
    const HostMemoryPause pause;
    const PFN_vkVoidFunction function = driver(instance, name);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        realDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(&faultyGetDeviceProcAddr);
    }
    return wrap(name, function);
}

void setVulkanBelow(PFN_vkGetInstanceProcAddr below) {
    driver = below;
}

void failVulkan(uint64_t n, VkResult result) {
    callsUntilFailure = static_cast<int64_t>(n);
    failure = result;
    failed = false;
}

bool liftVulkanFailure() {
    callsUntilFailure = kNever;
    return std::exchange(failed, false);
}

uint64_t vulkanCalls() {
    return calls;
}

void listVulkanCalls(std::vector<const char*>* into) {
    names = into;
}

} // namespace supple::test
