// The device. Qt would create one without the features that the sample needs, so the application creates it, and Qt's
// scene graph and Supple both borrow it. Nobody but Qt submits.
#pragma once

#include "vk.h"

#include <QQuickWindow>
#include <QVulkanInstance>

namespace qt_quick {

class Device {
public:
    /// Vulkan 1.3 and, if wanted, validation. The window is not shown yet.
    explicit Device(QQuickWindow& window);
    ~Device(); ///< the window must be gone

    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkInstance instance() const { return instance_.vkInstance(); }
    VkPhysicalDevice physical() const { return physical_; }
    VkDevice handle() const { return device_; }
    uint32_t queueFamily() const { return queueFamily_; }
    /// The features that were enabled, for SuppleContextDesc.
    const void* enabledFeatures() const { return &features_; }

private:
    void choosePhysical(QQuickWindow& window);
    bool chooseQueueFamily(VkPhysicalDevice candidate, QQuickWindow& window);
    void create();

    QVulkanInstance instance_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    uint32_t queueFamily_ = 0;
    SuppleRequirements requirements_ = supple::sized<SuppleRequirements>();
    VkPhysicalDeviceFeatures2 features_{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
};

} // namespace qt_quick
