// Counts and prints what the validation layer says from before the instance exists until after it is gone.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>
#include <vulkan/vulkan.h>

namespace supple::host {

class ValidationLog {
public:
    /// Warnings and errors so far.
    [[nodiscard]] uint32_t messageCount() const { return count_.load(); }
    /// Their texts.
    [[nodiscard]] std::vector<std::string> messages() const;

    /// For VkInstanceCreateInfo::pNext and vkCreateDebugUtilsMessengerEXT; the log must outlive both.
    [[nodiscard]] VkDebugUtilsMessengerCreateInfoEXT messengerInfo();

private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT types,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);

    std::atomic<uint32_t> count_ = 0;
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
};

} // namespace supple::host
