#include "host/validation_log.h"
#include "host/vk_struct.h"

#include <cstdio>

namespace supple::host {

std::vector<std::string> ValidationLog::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

VkDebugUtilsMessengerCreateInfoEXT ValidationLog::messengerInfo() {
    auto info = vkStruct<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // GENERAL is left out: there the loader complains of drivers that have nothing to do with this program.
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = receive;
    info.pUserData = this;
    return info;
}

VKAPI_ATTR VkBool32 VKAPI_CALL ValidationLog::receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                      VkDebugUtilsMessageTypeFlagsEXT,
                                                      const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& log = *static_cast<ValidationLog*>(user);
    const bool isError = (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0;
    const char* text = data->pMessage != nullptr ? data->pMessage : "";
    std::fprintf(stderr, "validation %s: %s\n", isError ? "error" : "warning", text);
    {
        const std::lock_guard lock(log.mutex_);
        log.messages_.emplace_back(text);
    }
    ++log.count_;
    return VK_FALSE;
}

} // namespace supple::host
