// Preloaded into the command, it records the first dispatch of every command buffer twice: a build whose pass deform is
// slow.
#include <cstring>
#include <dlfcn.h>
#include <map>
#include <mutex>
#include <vulkan/vulkan.h>

namespace {

constexpr int kTimes = 2;

struct State {
    std::mutex mutex;
    std::map<VkCommandBuffer, bool> fresh; ///< no dispatch yet
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;
    PFN_vkCmdDispatch dispatch = nullptr;
    PFN_vkCmdDispatchIndirect dispatchIndirect = nullptr;
};
State& state() {
    static State kept;
    return kept;
}
int timesOf(VkCommandBuffer commands) {
    const std::lock_guard lock(state().mutex);
    bool& fresh = state().fresh[commands];
    const int times = fresh ? kTimes : 1;
    fresh = false;
    return times;
}

void VKAPI_CALL dispatch(VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z) {
    for (int i = timesOf(commands); i > 0; --i) {
        state().dispatch(commands, x, y, z);
    }
}
void VKAPI_CALL dispatchIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
    for (int i = timesOf(commands); i > 0; --i) {
        state().dispatchIndirect(commands, buffer, offset);
    }
}
PFN_vkVoidFunction VKAPI_CALL deviceProcAddr(VkDevice device, const char* name) {
    const PFN_vkVoidFunction found = state().getDeviceProcAddr(device, name);
    if (std::strcmp(name, "vkCmdDispatch") == 0) {
        state().dispatch = reinterpret_cast<PFN_vkCmdDispatch>(found);
        return reinterpret_cast<PFN_vkVoidFunction>(dispatch);
    }
    if (std::strcmp(name, "vkCmdDispatchIndirect") == 0) {
        state().dispatchIndirect = reinterpret_cast<PFN_vkCmdDispatchIndirect>(found);
        return reinterpret_cast<PFN_vkVoidFunction>(dispatchIndirect);
    }
    return found;
}
template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction found = next<PFN_vkGetInstanceProcAddr>("vkGetInstanceProcAddr")(instance, name);
    if (std::strcmp(name, "vkGetDeviceProcAddr") != 0) {
        return found;
    }
    state().getDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(deviceProcAddr);
}

VKAPI_ATTR VkResult VKAPI_CALL vkBeginCommandBuffer(VkCommandBuffer commands, const VkCommandBufferBeginInfo* info) {
    {
        const std::lock_guard lock(state().mutex);
        state().fresh[commands] = true;
    }
    return next<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(commands, info);
}
}
