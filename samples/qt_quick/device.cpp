#include "device.h"

#include "validation.h"

#include <QQuickGraphicsConfiguration>
#include <QQuickGraphicsDevice>
#include <QVersionNumber>

#include <vector>

namespace qt_quick {

Device::Device(QQuickWindow& window) {
    if (validationWanted())
        askForValidation(instance_);
    // A VkInstance of an older version would hide what the device has of 1.3.
    instance_.setApiVersion(QVersionNumber(1, 3));
    instance_.setExtensions(instance_.extensions() + QQuickGraphicsConfiguration::preferredInstanceExtensions());
    if (!instance_.create())
        fail("Qt found no Vulkan", 3);
    if (validationWanted())
        messenger_ = listen(instance());
    window.setVulkanInstance(&instance_);
    window.create(); // which device can present is known of a window alone
    choosePhysical(window);
    create();
    window.setGraphicsDevice(
        QQuickGraphicsDevice::fromDeviceObjects(physical_, device_, static_cast<int>(queueFamily_), 0));
}

Device::~Device() {
    vkDestroyDevice(device_, nullptr);
    if (messenger_ != VK_NULL_HANDLE)
        stopListening(instance(), messenger_);
}

/// The first device that suits Supple and can present to the window.
void Device::choosePhysical(QQuickWindow& window) {
    uint32_t count = 0;
    must(vkEnumeratePhysicalDevices(instance(), &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> candidates(count);
    must(vkEnumeratePhysicalDevices(instance(), &count, candidates.data()), "vkEnumeratePhysicalDevices");
    for (VkPhysicalDevice candidate : candidates) {
        if (suppleQueryRequirements(instance(), candidate, vkGetInstanceProcAddr, &requirements_) != SUPPLE_OK)
            std::fprintf(stderr, "a device will not do: %s\n", requirements_.reason);
        else if (chooseQueueFamily(candidate, window)) {
            physical_ = candidate;
            return;
        }
    }
    fail("no device suits", 3);
}

/// Qt submits one command buffer to one queue, with Supple's passes, the drawing and the scene graph in it.
bool Device::chooseQueueFamily(VkPhysicalDevice candidate, QQuickWindow& window) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(candidate, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(candidate, &count, families.data());
    const VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (queueFamily_ = 0; queueFamily_ < count; ++queueFamily_)
        if ((families[queueFamily_].queueFlags & needed) == needed &&
            instance_.supportsPresent(candidate, queueFamily_, &window))
            return true;
    return false;
}

void Device::create() {
    // Qt takes it for granted that the features of 1.0 that the device has are enabled.
    vkGetPhysicalDeviceFeatures(physical_, &features_.features);
    features_.features.robustBufferAccess = VK_FALSE;
    features_.pNext = &requirements_.features12;
    requirements_.features12.pNext = &requirements_.features13;
    // The sample's own passes.
    requirements_.features13.dynamicRendering = VK_TRUE;
    requirements_.features13.synchronization2 = VK_TRUE;
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = queueFamily_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const char* extensions[] = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &features_;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = extensions;
    must(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
}

} // namespace qt_quick
