// A window whose surface is out of date, lost, or on a device that is lost. This program's own functions stand before
// the loader's. Needs a display; view_test.sh brings one.
#include "host/window.h"
#include "tests/tools/validated_device.h"

#include <cstdlib>
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace {

VkResult acquireFault = VK_SUCCESS; ///< of the next acquire, once
VkResult presentFault = VK_SUCCESS;

template <class F>
F next(const char* name) {
    return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkAcquireNextImageKHR(VkDevice device, VkSwapchainKHR swapchain,
                                                                uint64_t timeout, VkSemaphore semaphore, VkFence fence,
                                                                uint32_t* index) {
    const VkResult fault = std::exchange(acquireFault, VK_SUCCESS);
    return fault != VK_SUCCESS ? fault
                               : next<PFN_vkAcquireNextImageKHR>("vkAcquireNextImageKHR")(device, swapchain, timeout,
                                                                                          semaphore, fence, index);
}

/// A presentation that fails has waited for its semaphores all the same.
extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkQueuePresentKHR(VkQueue queue, const VkPresentInfoKHR* info) {
    const VkResult result = next<PFN_vkQueuePresentKHR>("vkQueuePresentKHR")(queue, info);
    const VkResult fault = std::exchange(presentFault, VK_SUCCESS);
    return fault != VK_SUCCESS ? fault : result;
}

namespace supple::host {
namespace {

/// Shows a frame; false where there was none to draw.
Result<bool> showFrame(Window& window, uint64_t number) {
    Result<std::optional<WindowFrame>> frame = window.begin();
    if (!frame)
        return frame.error();
    if (!frame->has_value())
        return false;
    constexpr VkImageSubresourceRange kWhole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    imageBarrier((*frame)->commands, window.swapchain().image((*frame)->image), kWhole,
                 {VK_IMAGE_LAYOUT_UNDEFINED, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0}},
                 {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0}});
    if (const Status status = window.end(**frame, number); !status)
        return status.error();
    return true;
}

/// Of frames until one is shown: how many there were, and what was wrong.
struct Shown {
    int tries = 0;
    std::string error;
};
Shown showOne(Window& window, uint64_t& number) {
    Shown shown;
    for (bool done = false; !done && shown.tries < 1000; ++shown.tries) {
        const Result<bool> frame = showFrame(window, ++number);
        shown.error = frame ? "" : frame.error().message;
        done = !frame || *frame;
    }
    return shown;
}

class WindowFaults : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr) << "no display";
        Result<std::unique_ptr<Device>> device = createValidatedDevice({.window = true});
        ASSERT_TRUE(device.ok()) << device.error().message;
        device_ = std::move(*device);
        validation_ = device_->validation();
        Result<std::unique_ptr<Window>> window = Window::create(*device_, "supple test", {64, 64});
        ASSERT_TRUE(window.ok()) << window.error().message;
        window_ = std::move(*window);
        EXPECT_EQ(showOne(*window_, number_).error, "");
    }
    void TearDown() override {
        window_ = nullptr;
        device_ = nullptr;
        EXPECT_EQ(validation_->messageCount(), 0u);
    }

    std::unique_ptr<Device> device_;
    std::shared_ptr<const ValidationLog> validation_;
    std::unique_ptr<Window> window_;
    uint64_t number_ = 0;
};

TEST_F(WindowFaults, WhatIsOutOfDateIsMadeAnew) {
    for (VkResult* const fault : {&acquireFault, &presentFault}) {
        const uint32_t before = window_->swapchain().generation();
        *fault = VK_ERROR_OUT_OF_DATE_KHR;
        EXPECT_EQ(showOne(*window_, number_).error, "");
        EXPECT_EQ(showOne(*window_, number_).error, "");
        EXPECT_GT(window_->swapchain().generation(), before);
    }
}

TEST_F(WindowFaults, ALostSurfaceIsSaid) {
    acquireFault = VK_ERROR_SURFACE_LOST_KHR;
    EXPECT_NE(showOne(*window_, number_).error.find("vkAcquireNextImageKHR: VK_ERROR_SURFACE_LOST_KHR"),
              std::string::npos);
    presentFault = VK_ERROR_SURFACE_LOST_KHR;
    EXPECT_NE(showOne(*window_, number_).error.find("vkQueuePresentKHR: VK_ERROR_SURFACE_LOST_KHR"), std::string::npos);
}

TEST_F(WindowFaults, ALostDeviceIsSaid) {
    presentFault = VK_ERROR_DEVICE_LOST;
    EXPECT_NE(showOne(*window_, number_).error.find("vkQueuePresentKHR: VK_ERROR_DEVICE_LOST"), std::string::npos);
}

} // namespace
} // namespace supple::host
