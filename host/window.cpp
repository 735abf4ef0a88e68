#include "host/window.h"

#include "host/vk_struct.h"

#include <algorithm>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace supple::host {

namespace {

std::string glfwReason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "unknown";
}

} // namespace

Result<std::unique_ptr<Window>> Window::create(Device& device, const std::string& title, VkExtent2D size) {
    std::unique_ptr<Window> window(new Window(device));
    if (const Status status = window->open(title, size); !status)
        return status.error();
    if (const Status status = window->createSlots(); !status)
        return status.error();
    if (const Status status = window->resize(); !status)
        return status.error();
    return window;
}

Window::~Window() {
    const VkDevice device = device_.handle();
    device_.waitIdle();
    swapchain_.reset(); // its surface goes before the window
    for (const Slot& slot : slots_) {
        vkDestroyFence(device, slot.done, nullptr);
        if (slot.commands != VK_NULL_HANDLE)
            vkFreeCommandBuffers(device, device_.commandPool(), 1, &slot.commands);
    }
    if (window_ != nullptr)
        glfwDestroyWindow(window_);
    if (glfwReady_)
        glfwTerminate();
}

Status Window::open(const std::string& title, VkExtent2D size) {
    if (glfwInit() == GLFW_FALSE)
        return Error{ErrorCode::unsupported, "no window: " + glfwReason()};
    glfwReady_ = true;
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ =
        glfwCreateWindow(static_cast<int>(size.width), static_cast<int>(size.height), title.c_str(), nullptr, nullptr);
    if (window_ == nullptr)
        return Error{ErrorCode::unsupported, "no window: " + glfwReason()};
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (const VkResult result = glfwCreateWindowSurface(device_.instance(), window_, nullptr, &surface);
        result != VK_SUCCESS) {
        Error error = vulkanError(result, "no surface for the window");
        error.code = ErrorCode::unsupported;
        return error;
    }
    Result<std::unique_ptr<Swapchain>> swapchain = Swapchain::create(device_, surface);
    if (!swapchain)
        return swapchain.error();
    swapchain_ = std::move(*swapchain);
    glfwSetWindowUserPointer(window_, this);
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) {
        static_cast<Window*>(glfwGetWindowUserPointer(window))->stale_ = true;
    });
    // Dear ImGui looks at keys once a frame; it calls this function as well.
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
        if (action == GLFW_PRESS)
            static_cast<Window*>(glfwGetWindowUserPointer(window))->keys_.push_back({key, modifiers});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        std::vector<std::string>& dropped = static_cast<Window*>(glfwGetWindowUserPointer(window))->dropped_;
        dropped.insert(dropped.end(), paths, paths + count);
    });
    return success();
}

void Window::copyText(const std::string& text) {
    glfwSetClipboardString(window_, text.c_str());
}

bool Window::shouldClose() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

Status Window::createSlots() {
    const VkDevice device = device_.handle();
    for (Slot& slot : slots_) {
        auto commandInfo = vkStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
        commandInfo.commandPool = device_.commandPool();
        commandInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        commandInfo.commandBufferCount = 1;
        auto fenceInfo = vkStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
        fenceInfo.flags = VK_FENCE_CREATE_SIGNALED_BIT;
        for (const VkResult result : {vkAllocateCommandBuffers(device, &commandInfo, &slot.commands),
                                      vkCreateFence(device, &fenceInfo, nullptr, &slot.done)}) {
            if (result != VK_SUCCESS)
                return vulkanError(result, "the window's frames");
        }
    }
    return success();
}

Status Window::resize() {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    const Result<bool> resized = swapchain_->resize({static_cast<uint32_t>(width), static_cast<uint32_t>(height)});
    if (!resized)
        return resized.error();
    stale_ = !*resized;
    return success();
}

Result<std::optional<WindowFrame>> Window::begin(double patience) {
    if (patience > 0.0)
        glfwWaitEventsTimeout(patience);
    else
        glfwPollEvents();
    if (stale_) {
        if (const Status status = resize(); !status)
            return status.error();
        if (stale_) {
            glfwWaitEventsTimeout(0.1);
            return std::optional<WindowFrame>();
        }
    }
    Slot& slot = slots_[slot_];
    if (const VkResult result = vkWaitForFences(device_.handle(), 1, &slot.done, VK_TRUE, UINT64_MAX);
        result != VK_SUCCESS)
        return vulkanError(result, "vkWaitForFences");
    completedFrame_ = std::max(completedFrame_, slot.number);
    const Result<bool> acquired = swapchain_->acquire(slot_);
    if (!acquired)
        return acquired.error();
    if (!*acquired) {
        stale_ = true;
        return std::optional<WindowFrame>();
    }
    vkResetFences(device_.handle(), 1, &slot.done);
    auto beginInfo = vkStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    beginInfo.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    if (const VkResult result = vkBeginCommandBuffer(slot.commands, &beginInfo); result != VK_SUCCESS)
        return vulkanError(result, "vkBeginCommandBuffer");
    return std::optional<WindowFrame>({slot.commands, slot_, swapchain_->index()});
}

Status Window::end(const WindowFrame& frame, uint64_t number) {
    Slot& slot = slots_[frame.slot];
    if (const VkResult result = vkEndCommandBuffer(slot.commands); result != VK_SUCCESS)
        return vulkanError(result, "vkEndCommandBuffer");
    auto wait = vkStruct<VkSemaphoreSubmitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO);
    wait.semaphore = swapchain_->acquired(frame.slot);
    wait.stageMask = Swapchain::kFirstUse;
    auto signal = vkStruct<VkSemaphoreSubmitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO);
    signal.semaphore = swapchain_->drawn();
    signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    auto commands = vkStruct<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO);
    commands.commandBuffer = slot.commands;
    auto submit = vkStruct<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
    submit.waitSemaphoreInfoCount = 1;
    submit.pWaitSemaphoreInfos = &wait;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &commands;
    submit.signalSemaphoreInfoCount = 1;
    submit.pSignalSemaphoreInfos = &signal;
    if (const VkResult result = vkQueueSubmit2(device_.queue(), 1, &submit, slot.done); result != VK_SUCCESS)
        return vulkanError(result, "vkQueueSubmit2");
    slot.number = number;
    slot_ = (slot_ + 1) % kFramesInFlight;

    const Result<bool> presented = swapchain_->present();
    if (!presented)
        return presented.error();
    stale_ = stale_ || !*presented;
    return success();
}

void Window::waitIdle(uint64_t number) {
    vkDeviceWaitIdle(device_.handle());
    completedFrame_ = std::max(completedFrame_, number);
}

} // namespace supple::host
