#include "device.h"

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace sample {

namespace {

int messages = 0;

VKAPI_ATTR VkBool32 VKAPI_CALL onValidation(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    ++messages;
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo() {
    return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            .messageSeverity =
                VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
            .messageType =
                VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
            .pfnUserCallback = onValidation};
}

} // namespace

void fail(const std::string& what, int exitCode) {
    std::fprintf(stderr, "%s\n", what.c_str());
    std::exit(exitCode);
}

void check(VkResult result, const char* what) {
    if (result != VK_SUCCESS)
        fail(std::string(what) + ": VkResult " + std::to_string(result));
}

void check(SuppleResult result, const char* what) {
    if (result != SUPPLE_OK)
        fail(std::string(what) + ": " + suppleResultString(result));
}

bool validationWanted() {
    const char* value = std::getenv("SUPPLE_VALIDATION");
    return value != nullptr && *value != 0 && std::string_view(value) != "0";
}

int validationMessages() {
    return messages;
}

// ---------------------------------------------------------------------------------------------------- device

Device::Device(const DeviceOptions& options) {
    createInstance(options);
    if (options.createSurface)
        surface_ = options.createSurface(instance_);
    choosePhysicalDevice();
    createDevice();
}

Device::~Device() {
    vkDeviceWaitIdle(device_);
    while (!atEnd_.empty()) {
        atEnd_.back()();
        atEnd_.pop_back();
    }
    vkDestroyDevice(device_, nullptr);
    if (surface_ != VK_NULL_HANDLE)
        vkDestroySurfaceKHR(instance_, surface_, nullptr);
    if (messenger_ != VK_NULL_HANDLE) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    vkDestroyInstance(instance_, nullptr);
}

void Device::createInstance(const DeviceOptions& options) {
    const bool validate = validationWanted();
    const char* layer = "VK_LAYER_KHRONOS_validation";
    std::vector<const char*> extensions = options.instanceExtensions;
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(); // listens while the instance comes and goes
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = &messenger,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &synchronization};
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = options.name,
                                        .apiVersion = VK_API_VERSION_1_3};
    VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
    if (validate) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
    }
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
    if (validate) {
        messenger = messengerInfo();
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
        check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
    }
}

/// The first device that Supple can use and that has a queue for everything: compute, drawing and, with a surface,
/// showing.
void Device::choosePhysicalDevice() {
    uint32_t count = 0;
    vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(instance_, &count, devices.data());
    for (const VkPhysicalDevice candidate : devices) {
        requirements_ = supple::sized<SuppleRequirements>();
        vkGetPhysicalDeviceProperties(candidate, &properties_);
        if (suppleQueryRequirements(instance_, candidate, vkGetInstanceProcAddr, &requirements_) != SUPPLE_OK) {
            std::fprintf(stderr, "%s will not do: %s\n", properties_.deviceName, requirements_.reason);
            continue;
        }
        uint32_t familyCount = 0;
        vkGetPhysicalDeviceQueueFamilyProperties(candidate, &familyCount, nullptr);
        std::vector<VkQueueFamilyProperties> families(familyCount);
        vkGetPhysicalDeviceQueueFamilyProperties(candidate, &familyCount, families.data());
        for (queueFamily_ = 0; queueFamily_ < familyCount; ++queueFamily_) {
            constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
            VkBool32 presents = VK_TRUE;
            if (surface_ != VK_NULL_HANDLE)
                vkGetPhysicalDeviceSurfaceSupportKHR(candidate, queueFamily_, surface_, &presents);
            if ((families[queueFamily_].queueFlags & kNeeded) == kNeeded && presents == VK_TRUE) {
                physicalDevice_ = candidate;
                return;
            }
        }
        std::fprintf(stderr, "%s will not do: no queue that computes, draws and shows\n", properties_.deviceName);
    }
    fail("no suitable Vulkan device", 3);
}

/// Supple's features as they are, and a few of our own on top.
void Device::createDevice() {
    requirements_.features12.timelineSemaphore = VK_TRUE;
    requirements_.features13.dynamicRendering = VK_TRUE;
    requirements_.features13.synchronization2 = VK_TRUE;
    requirements_.features12.pNext = &requirements_.features13;
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = queueFamily_,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    const char* swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = enabledFeatures(),
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = surface_ != VK_NULL_HANDLE ? 1u : 0u,
                                  .ppEnabledExtensionNames = &swapchain};
    check(vkCreateDevice(physicalDevice_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);
}

uint32_t Device::memoryType(uint32_t bits, VkMemoryPropertyFlags wanted) const {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physicalDevice_, &memory);
    for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        if ((bits >> type & 1u) != 0 && (memory.memoryTypes[type].propertyFlags & wanted) == wanted)
            return type;
    }
    fail("no memory of a type that is needed");
}

// ---------------------------------------------------------------------------------------------------- resources

namespace {

VkDeviceMemory allocate(const Device& device, const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) {
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .allocationSize = needs.size,
                                    .memoryTypeIndex = device.memoryType(needs.memoryTypeBits, wanted)};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device.handle(), &info, nullptr, &memory), "vkAllocateMemory");
    return memory;
}

} // namespace

Buffer::Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, bool hostVisible)
    : device_(device.handle()), size_(size) {
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
    check(vkCreateBuffer(device_, &info, nullptr, &buffer_), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device_, buffer_, &needs);
    memory_ = allocate(device, needs,
                       hostVisible ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
                                   : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkBindBufferMemory(device_, buffer_, memory_, 0), "vkBindBufferMemory");
    if (hostVisible)
        check(vkMapMemory(device_, memory_, 0, VK_WHOLE_SIZE, 0, &mapped_), "vkMapMemory");
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(buffer_, other.buffer_);
    std::swap(memory_, other.memory_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
    return *this;
}

Buffer::~Buffer() {
    if (device_ != VK_NULL_HANDLE) {
        vkDestroyBuffer(device_, buffer_, nullptr);
        vkFreeMemory(device_, memory_, nullptr);
    }
}

Image::Image(const Device& device, const ImageDesc& desc) : device_(device.handle()), desc_(desc) {
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = desc.format,
                                 .extent = {desc.extent.width, desc.extent.height, 1},
                                 .mipLevels = desc.mipLevels,
                                 .arrayLayers = 1,
                                 .samples = desc.samples,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = desc.usage,
                                 .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    check(vkCreateImage(device_, &info, nullptr, &image_), "vkCreateImage");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device_, image_, &needs);
    memory_ = allocate(device, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkBindImageMemory(device_, image_, memory_, 0), "vkBindImageMemory");
    const VkImageViewCreateInfo viewInfo{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                         .image = image_,
                                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                         .format = desc.format,
                                         .subresourceRange = {desc.aspect, 0, desc.mipLevels, 0, 1}};
    check(vkCreateImageView(device_, &viewInfo, nullptr, &view_), "vkCreateImageView");
}

Image& Image::operator=(Image&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(image_, other.image_);
    std::swap(memory_, other.memory_);
    std::swap(view_, other.view_);
    std::swap(desc_, other.desc_);
    return *this;
}

Image::~Image() {
    if (device_ != VK_NULL_HANDLE) {
        vkDestroyImageView(device_, view_, nullptr);
        vkDestroyImage(device_, image_, nullptr);
        vkFreeMemory(device_, memory_, nullptr);
    }
}

// ---------------------------------------------------------------------------------------------------- frames

Frames::Frames(const Device& device) : device_(device) {
    const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                         .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
    check(vkCreateSemaphore(device.handle(), &info, nullptr, &timeline_), "vkCreateSemaphore");
    for (uint32_t i = 0; i < kFramesInFlight; ++i) {
        const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                               .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                               .queueFamilyIndex = device.queueFamily()};
        check(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pools_[i]), "vkCreateCommandPool");
        const VkCommandBufferAllocateInfo commandInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                      .commandPool = pools_[i],
                                                      .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                      .commandBufferCount = 1};
        check(vkAllocateCommandBuffers(device.handle(), &commandInfo, &commands_[i]), "vkAllocateCommandBuffers");
    }
}

Frames::~Frames() {
    device_.waitIdle();
    for (const VkCommandPool pool : pools_)
        vkDestroyCommandPool(device_.handle(), pool, nullptr);
    vkDestroySemaphore(device_.handle(), timeline_, nullptr);
}

void Frames::waitForRoom() const {
    const uint64_t earlier = frame_ + 1 > kFramesInFlight ? frame_ + 1 - kFramesInFlight : 0;
    const VkSemaphoreWaitInfo wait{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                   .semaphoreCount = 1,
                                   .pSemaphores = &timeline_,
                                   .pValues = &earlier};
    check(vkWaitSemaphores(device_.handle(), &wait, UINT64_MAX), "vkWaitSemaphores");
}

VkCommandBuffer Frames::begin() {
    waitForRoom();
    ++frame_;
    check(vkResetCommandPool(device_.handle(), pools_[slot()], 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(commands_[slot()], &info), "vkBeginCommandBuffer");
    return commands_[slot()];
}

void Frames::submit(VkSemaphore acquired, VkPipelineStageFlags2 acquiredStages, VkSemaphore drawn) {
    check(vkEndCommandBuffer(commands_[slot()]), "vkEndCommandBuffer");
    const VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                             .commandBuffer = commands_[slot()]};
    const VkSemaphoreSubmitInfo wait{
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, .semaphore = acquired, .stageMask = acquiredStages};
    const VkSemaphoreSubmitInfo signals[] = {{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                              .semaphore = timeline_,
                                              .value = frame_,
                                              .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT},
                                             {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                              .semaphore = drawn,
                                              .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}};
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .waitSemaphoreInfoCount = acquired != VK_NULL_HANDLE ? 1u : 0u,
                             .pWaitSemaphoreInfos = &wait,
                             .commandBufferInfoCount = 1,
                             .pCommandBufferInfos = &commands,
                             .signalSemaphoreInfoCount = drawn != VK_NULL_HANDLE ? 2u : 1u,
                             .pSignalSemaphoreInfos = signals};
    check(vkQueueSubmit2(device_.queue(), 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
}

uint64_t Frames::completed() const {
    uint64_t value = 0;
    check(vkGetSemaphoreCounterValue(device_.handle(), timeline_, &value), "vkGetSemaphoreCounterValue");
    return value;
}

} // namespace sample
