#include "validation.h"

#include <QByteArrayList>

#include <atomic>

namespace qt_quick {

namespace {

std::atomic<int> messages = 0; // from Qt's render thread as well

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    ++messages;
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    return VK_FALSE;
}

} // namespace

bool validationWanted() {
    return qgetenv("SUPPLE_VALIDATION") == "1";
}

void askForValidation(QVulkanInstance& instance) {
    // QVulkanInstance passes no VkValidationFeaturesEXT on, but the layer also reads its options from here.
    qputenv("VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT");
    instance.setLayers({"VK_LAYER_KHRONOS_validation"});
    instance.setExtensions({VK_EXT_DEBUG_UTILS_EXTENSION_NAME});
    instance.setFlags(QVulkanInstance::NoDebugOutputRedirect); // Qt's own listener would only print
}

VkDebugUtilsMessengerEXT listen(VkInstance instance) {
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = onMessage;
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    if (create == nullptr)
        fail("SUPPLE_VALIDATION=1, but the validation layer is not installed");
    must(create(instance, &info, nullptr, &messenger), "vkCreateDebugUtilsMessengerEXT");
    return messenger;
}

void stopListening(VkInstance instance, VkDebugUtilsMessengerEXT messenger) {
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"))(instance, messenger, nullptr);
}

int validationMessages() {
    return messages;
}

} // namespace qt_quick
