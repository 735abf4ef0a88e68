#include "host/device.h"
#include "host/vk_struct.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>

namespace supple::host {

namespace {

/// What the instance is created for. Drawing takes the newer one.
uint32_t versionFor(const DeviceOptions& options) {
    return options.onlyCompute ? VK_API_VERSION_1_1 : VK_API_VERSION_1_3;
}
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

/// Every platform's surface extension; those the instance has are enabled, so that this file needs no window library.
constexpr const char* kSurfaceExtensions[] = {
    "VK_KHR_surface",         "VK_KHR_xcb_surface",   "VK_KHR_xlib_surface",
    "VK_KHR_wayland_surface", "VK_KHR_win32_surface", "VK_EXT_metal_surface",
};

bool hasExtension(const std::vector<VkExtensionProperties>& extensions, std::string_view name) {
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const VkExtensionProperties& extension) { return name == extension.extensionName; });
}

std::vector<VkExtensionProperties> instanceExtensions(const char* layer) {
    uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(layer, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data());
    extensions.resize(count);
    return extensions;
}

void addSurfaceExtensions(const std::vector<VkExtensionProperties>& available, std::vector<const char*>& extensions) {
    // Drivers that are told of Wayland look for a compositor and complain on stderr where there is none.
    const bool wayland = std::getenv("WAYLAND_DISPLAY") != nullptr;
    for (const char* name : kSurfaceExtensions) {
        const bool wanted = wayland || std::strcmp(name, "VK_KHR_wayland_surface") != 0;
        if (wanted && hasExtension(available, name))
            extensions.push_back(name);
    }
}

bool hasLayer(std::string_view name) {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    layers.resize(count);
    return std::any_of(layers.begin(), layers.end(),
                       [&](const VkLayerProperties& layer) { return name == layer.layerName; });
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

/// Lower is better.
int deviceRank(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 3;
    default:
        return 4;
    }
}

/// The first family that does graphics and compute, or no value.
bool findQueueFamily(VkPhysicalDevice physicalDevice, uint32_t& family) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice, &count, families.data());
    constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & kNeeded) == kNeeded) {
            family = i;
            return true;
        }
    }
    return false;
}

std::vector<VkExtensionProperties> deviceExtensions(VkPhysicalDevice physicalDevice) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physicalDevice, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(physicalDevice, nullptr, &count, extensions.data());
    extensions.resize(count);
    return extensions;
}

SuppleRequirements askedRequirements(const DeviceOptions& options) {
    SuppleRequirements requirements{};
    requirements.structSize = sizeof requirements;
    requirements.instanceVersion = versionFor(options);
    if (options.rayTracing)
        requirements.contextFlags = SUPPLE_CONTEXT_RAY_TRACING;
    return requirements;
}

bool hasRayQueries(VkPhysicalDevice physicalDevice) {
    if (!hasExtension(deviceExtensions(physicalDevice), VK_KHR_RAY_QUERY_EXTENSION_NAME))
        return false;
    auto rayQuery =
        vkStruct<VkPhysicalDeviceRayQueryFeaturesKHR>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR);
    auto features = vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &rayQuery);
    vkGetPhysicalDeviceFeatures2(physicalDevice, &features);
    return rayQuery.rayQuery == VK_TRUE;
}

bool hasMeshShaders(VkPhysicalDevice physicalDevice) {
    if (!hasExtension(deviceExtensions(physicalDevice), VK_EXT_MESH_SHADER_EXTENSION_NAME))
        return false;
    auto meshShader =
        vkStruct<VkPhysicalDeviceMeshShaderFeaturesEXT>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_FEATURES_EXT);
    auto features = vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &meshShader);
    vkGetPhysicalDeviceFeatures2(physicalDevice, &features);
    return meshShader.meshShader == VK_TRUE;
}

/// What drawing lacks, or empty.
std::string shortcomingForDrawing(VkPhysicalDevice physicalDevice) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physicalDevice, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_3)
        return "needs Vulkan 1.3 to draw";
    auto features13 = vkStruct<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    auto features = vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features13);
    vkGetPhysicalDeviceFeatures2(physicalDevice, &features);
    if (features13.dynamicRendering == VK_FALSE)
        return "missing feature dynamicRendering";
    if (features13.synchronization2 == VK_FALSE)
        return "missing feature synchronization2";
    return {};
}

/// Why this device will not do, or empty.
std::string shortcoming(VkInstance instance, VkPhysicalDevice physicalDevice, const DeviceOptions& options) {
    SuppleRequirements requirements = askedRequirements(options);
    if (suppleQueryRequirements(instance, physicalDevice, vkGetInstanceProcAddr, &requirements) != SUPPLE_OK)
        return requirements.reason[0] != 0 ? requirements.reason : "does not meet Supple's requirements";
    if (!options.onlyCompute) {
        if (std::string missing = shortcomingForDrawing(physicalDevice); !missing.empty())
            return missing;
    }
    uint32_t family = 0;
    if (!findQueueFamily(physicalDevice, family))
        return "no queue that does graphics and compute";
    if (options.rayTracing && !hasRayQueries(physicalDevice))
        return "missing extension VK_KHR_ray_query";
    if (options.meshShaders && !hasMeshShaders(physicalDevice))
        return "missing extension VK_EXT_mesh_shader";
    if (options.window && !hasExtension(deviceExtensions(physicalDevice), VK_KHR_SWAPCHAIN_EXTENSION_NAME))
        return "missing extension VK_KHR_swapchain";
    return {};
}

} // namespace

const char* vulkanResultName(VkResult result) {
    switch (result) {
    case VK_SUCCESS:
        return "VK_SUCCESS";
    case VK_NOT_READY:
        return "VK_NOT_READY";
    case VK_TIMEOUT:
        return "VK_TIMEOUT";
    case VK_INCOMPLETE:
        return "VK_INCOMPLETE";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
        return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_MEMORY_MAP_FAILED:
        return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "VK_ERROR_TOO_MANY_OBJECTS";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
        return "VK_ERROR_FORMAT_NOT_SUPPORTED";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        return "VK_ERROR_OUT_OF_POOL_MEMORY";
    case VK_ERROR_SURFACE_LOST_KHR:
        return "VK_ERROR_SURFACE_LOST_KHR";
    case VK_SUBOPTIMAL_KHR:
        return "VK_SUBOPTIMAL_KHR";
    case VK_ERROR_OUT_OF_DATE_KHR:
        return "VK_ERROR_OUT_OF_DATE_KHR";
    default:
        return "an unnamed VkResult";
    }
}

Error vulkanError(VkResult result, std::string_view what) {
    ErrorCode code = ErrorCode::vulkan;
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY)
        code = ErrorCode::hostMemory;
    else if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_POOL_MEMORY)
        code = ErrorCode::deviceMemory;
    else if (result == VK_ERROR_DEVICE_LOST)
        code = ErrorCode::deviceLost;
    return Error{code, std::string(what) + ": " + vulkanResultName(result)};
}

namespace {

Error instanceError(VkResult result) {
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        return Error{ErrorCode::unsupported, "no Vulkan device: no driver is installed"};
    return Error{ErrorCode::unsupported, vulkanError(result, "vkCreateInstance").message};
}

struct SupportedFeatures {
    VkPhysicalDeviceFeatures2 of10{};
    VkPhysicalDeviceVulkan11Features of11{};
    VkPhysicalDeviceVulkan12Features of12{};
};

void readSupportedFeatures(VkPhysicalDevice device, SupportedFeatures& out) {
    out.of12 = vkStruct<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
    out.of11 =
        vkStruct<VkPhysicalDeviceVulkan11Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, &out.of12);
    out.of10 = vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &out.of11);
    vkGetPhysicalDeviceFeatures2(device, &out.of10);
}

} // namespace

Result<std::unique_ptr<Device>> Device::create(const DeviceOptions& options) {
    std::unique_ptr<Device> device(new Device());
    device->getInstanceProcAddr_ =
        options.suppleGetInstanceProcAddr != nullptr ? options.suppleGetInstanceProcAddr : vkGetInstanceProcAddr;
    if (const Status status = device->createInstance(options); !status)
        return status.error();
    if (const Status status = device->choosePhysicalDevice(options); !status)
        return status.error();
    if (const Status status = device->createDevice(options); !status)
        return status.error();
    return device;
}

Device::~Device() {
    if (device_ != VK_NULL_HANDLE) {
        vkDeviceWaitIdle(device_);
        for (; !atEnd_.empty(); atEnd_.pop_back())
            atEnd_.back()();
        vkDestroyFence(device_, fence_, nullptr);
        vkDestroyCommandPool(device_, commandPool_, nullptr);
        vkDestroyDevice(device_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) {
        if (messenger_ != VK_NULL_HANDLE) {
            const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
                vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
            destroy(instance_, messenger_, nullptr);
        }
        // From here the messenger chained to VkInstanceCreateInfo listens again.
        vkDestroyInstance(instance_, nullptr);
    }
}

Status Device::createInstance(const DeviceOptions& options) {
    uint32_t version = 0;
    if (vkEnumerateInstanceVersion(&version) != VK_SUCCESS || version < versionFor(options))
        return Error{ErrorCode::unsupported, options.onlyCompute ? "no Vulkan 1.1 loader" : "no Vulkan 1.3 loader"};

    std::vector<VkExtensionProperties> available = instanceExtensions(nullptr);
    std::vector<const char*> layers;
    if (options.validation) {
        if (!hasLayer(kValidationLayer))
            return Error{ErrorCode::unsupported,
                         std::string("validation asked for, but the layer ") + kValidationLayer + " is not installed"};
        layers.push_back(kValidationLayer);
        const std::vector<VkExtensionProperties> layerExtensions = instanceExtensions(kValidationLayer);
        available.insert(available.end(), layerExtensions.begin(), layerExtensions.end());
    }

    std::vector<const char*> extensions;
    debugUtils_ = hasExtension(available, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (debugUtils_)
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (options.window) {
        addSurfaceExtensions(available, extensions);
        if (!hasExtension(available, VK_KHR_SURFACE_EXTENSION_NAME))
            return Error{ErrorCode::unsupported, "this Vulkan cannot draw to windows (no VK_KHR_surface)"};
    }

    auto application = vkStruct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "supple";
    application.apiVersion = versionFor(options);
    auto info = vkStruct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;

    VkDebugUtilsMessengerCreateInfoEXT messengerInfo = validation_->messengerInfo();
    constexpr VkValidationFeatureEnableEXT kEnabled[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    auto validationFeatures = vkStruct<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    validationFeatures.enabledValidationFeatureCount = static_cast<uint32_t>(std::size(kEnabled));
    validationFeatures.pEnabledValidationFeatures = kEnabled;
    if (options.validation) {
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        // The chained messenger hears what no other can: creation and destruction of the instance.
        validationFeatures.pNext = &messengerInfo;
        info.pNext = &validationFeatures;
    }
    info.enabledLayerCount = static_cast<uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (const VkResult result = vkCreateInstance(&info, nullptr, &instance_); result != VK_SUCCESS)
        return instanceError(result);
    if (options.validation) {
        if (const Status status = createMessenger(); !status)
            return status.error();
    }
    if (debugUtils_)
        setObjectName_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
            vkGetInstanceProcAddr(instance_, "vkSetDebugUtilsObjectNameEXT"));
    return success();
}

Status Device::createMessenger() {
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    if (create == nullptr)
        return Error{ErrorCode::unsupported, "validation asked for, but VK_EXT_debug_utils is missing"};
    const VkDebugUtilsMessengerCreateInfoEXT info = validation_->messengerInfo();
    if (const VkResult result = create(instance_, &info, nullptr, &messenger_); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateDebugUtilsMessengerEXT");
    return success();
}

Status Device::choosePhysicalDevice(const DeviceOptions& options) {
    uint32_t count = 0;
    VkResult result = vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    if (result == VK_SUCCESS && count > 0)
        result = vkEnumeratePhysicalDevices(instance_, &count, devices.data());
    if (result != VK_SUCCESS && result != VK_ERROR_INITIALIZATION_FAILED)
        return vulkanError(result, "vkEnumeratePhysicalDevices");
    if (result != VK_SUCCESS || devices.empty())
        return Error{ErrorCode::unsupported, "no Vulkan device"};

    uint32_t index = UINT32_MAX;
    const char* end = options.device.data() + options.device.size();
    const auto [parsed, parseError] = std::from_chars(options.device.data(), end, index);
    const bool byIndex =
        !options.device.empty() && parseError == std::errc() && parsed == end && index < devices.size();
    const std::string wanted = lowerCase(options.device);

    std::string have;
    std::string firstShortcoming;
    int bestRank = INT32_MAX;
    for (uint32_t i = 0; i < devices.size(); ++i) {
        VkPhysicalDeviceProperties properties{};
        vkGetPhysicalDeviceProperties(devices[i], &properties);
        have += (i > 0 ? ", " : "") + std::to_string(i) + " " + properties.deviceName;
        const bool matches = byIndex ? i == index : lowerCase(properties.deviceName).find(wanted) != std::string::npos;
        if (!matches)
            continue;
        if (const std::string reason = shortcoming(instance_, devices[i], options); !reason.empty()) {
            if (firstShortcoming.empty())
                firstShortcoming = std::string("device ") + properties.deviceName + " will not do: " + reason;
            continue;
        }
        if (const int rank = deviceRank(properties.deviceType); rank < bestRank) {
            bestRank = rank;
            physicalDevice_ = devices[i];
            properties_ = properties;
        }
    }
    if (physicalDevice_ != VK_NULL_HANDLE)
        return success();
    if (!firstShortcoming.empty())
        return Error{ErrorCode::unsupported, firstShortcoming};
    return Error{ErrorCode::unsupported, "device " + options.device + " not found (have: " + have + ")"};
}

void Device::enableFeatures(const DeviceOptions& options) {
    if (options.onlyCompute) {
        features_ = vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
        return;
    }
    SupportedFeatures all;
    readSupportedFeatures(physicalDevice_, all);
    const VkPhysicalDeviceFeatures& supported = all.of10.features;

    // Supple's features as they are, and what the hosts' own drawing wants on top.
    requirements_.features12.timelineSemaphore = VK_TRUE; // every Vulkan 1.3 device has it
    requirements_.features13.dynamicRendering = VK_TRUE;
    requirements_.features13.synchronization2 = VK_TRUE;
    requirements_.features12.drawIndirectCount = all.of12.drawIndirectCount; // host/view_draws.h
    requirements_.features12.bufferDeviceAddress = VK_TRUE; // every Vulkan 1.3 device: SUPPLE_CONTEXT_SHARED_DISPATCHES
    requirements_.features12.pNext = &requirements_.features13;
    // Many draws by one command (docs/integration.md).
    features11_ = vkStruct<VkPhysicalDeviceVulkan11Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
    const bool manyDraws = supported.multiDrawIndirect == VK_TRUE && all.of11.shaderDrawParameters == VK_TRUE;
    features11_.shaderDrawParameters = manyDraws ? VK_TRUE : VK_FALSE;
    requirements_.features13.pNext = &features11_;
    if (options.rayTracing) {
        rayQuery_ = vkStruct<VkPhysicalDeviceRayQueryFeaturesKHR>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR, &requirements_.accelerationStructure);
        rayQuery_.rayQuery = VK_TRUE;
        features11_.pNext = &rayQuery_;
    }
    if (options.meshShaders) {
        meshShader_ = vkStruct<VkPhysicalDeviceMeshShaderFeaturesEXT>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_FEATURES_EXT, features11_.pNext);
        meshShader_.meshShader = VK_TRUE;
        features11_.pNext = &meshShader_;
    }
    features_ =
        vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &requirements_.features12);
    features_.features.samplerAnisotropy = supported.samplerAnisotropy;
    features_.features.multiDrawIndirect = manyDraws ? VK_TRUE : VK_FALSE;
    features_.features.drawIndirectFirstInstance = supported.drawIndirectFirstInstance; // suppleSetPartVisible
    features_.features.shaderStorageBufferArrayDynamicIndexing = supported.shaderStorageBufferArrayDynamicIndexing;
    anisotropy_ = supported.samplerAnisotropy == VK_TRUE;
}

Status Device::createDevice(const DeviceOptions& options) {
    if (!findQueueFamily(physicalDevice_, queueFamily_))
        return Error{ErrorCode::unsupported, "no queue that does graphics and compute"};
    vkGetPhysicalDeviceMemoryProperties(physicalDevice_, &memoryProperties_);

    requirements_ = askedRequirements(options);
    if (suppleQueryRequirements(instance_, physicalDevice_, vkGetInstanceProcAddr, &requirements_) != SUPPLE_OK)
        return Error{ErrorCode::unsupported, requirements_.reason};
    enableFeatures(options);

    constexpr float kPriority = 1.0f;
    auto queueInfo = vkStruct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queueInfo.queueFamilyIndex = queueFamily_;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &kPriority;
    std::vector<const char*> extensions(requirements_.extensions,
                                        requirements_.extensions + requirements_.extensionCount);
    if (options.rayTracing)
        extensions.push_back(VK_KHR_RAY_QUERY_EXTENSION_NAME);
    if (options.meshShaders)
        extensions.push_back(VK_EXT_MESH_SHADER_EXTENSION_NAME);
    if (options.window)
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (readsClocks())
        extensions.push_back(VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME);
    auto info = vkStruct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, enabledFeatures());
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (const VkResult result = vkCreateDevice(physicalDevice_, &info, nullptr, &device_); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateDevice");
    vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);
    getCalibratedTimestamps_ = reinterpret_cast<PFN_vkGetCalibratedTimestampsEXT>(
        vkGetDeviceProcAddr(device_, "vkGetCalibratedTimestampsEXT")); // null without the extension
    if (options.meshShaders)
        drawMeshTasks_ =
            reinterpret_cast<PFN_vkCmdDrawMeshTasksEXT>(vkGetDeviceProcAddr(device_, "vkCmdDrawMeshTasksEXT"));

    auto poolInfo = vkStruct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    poolInfo.queueFamilyIndex = queueFamily_;
    if (const VkResult result = vkCreateCommandPool(device_, &poolInfo, nullptr, &commandPool_); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateCommandPool");
    return createCommands();
}

Status Device::createCommands() {
    auto allocateInfo = vkStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocateInfo.commandPool = commandPool_;
    allocateInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocateInfo.commandBufferCount = 1;
    const auto fenceInfo = vkStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    if (const VkResult result = vkAllocateCommandBuffers(device_, &allocateInfo, &commands_); result != VK_SUCCESS)
        return vulkanError(result, "vkAllocateCommandBuffers");
    if (const VkResult result = vkCreateFence(device_, &fenceInfo, nullptr, &fence_); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateFence");
    return success();
}

Status Device::submitAndWait(const std::function<void(VkCommandBuffer)>& record) {
    auto beginInfo = vkStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    beginInfo.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    VkResult result = vkBeginCommandBuffer(commands_, &beginInfo);
    if (result == VK_SUCCESS) {
        record(commands_);
        result = vkEndCommandBuffer(commands_);
    }
    if (result == VK_SUCCESS)
        result = vkResetFences(device_, 1, &fence_);
    if (result == VK_SUCCESS) {
        auto submitInfo = vkStruct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
        submitInfo.commandBufferCount = 1;
        submitInfo.pCommandBuffers = &commands_;
        result = vkQueueSubmit(queue_, 1, &submitInfo, fence_);
    }
    if (result == VK_SUCCESS)
        result = vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX);
    if (result != VK_SUCCESS)
        return vulkanError(result, "submitting work to the device");
    return success();
}

void Device::setName(VkObjectType type, uint64_t object, const char* name) const {
    if (setObjectName_ == nullptr)
        return;
    auto info = vkStruct<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = name;
    setObjectName_(device_, &info);
}

} // namespace supple::host
