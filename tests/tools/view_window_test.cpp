// The window under the validation layer: frames go on while it is resized. Needs a display; view_test.sh brings one.
#include "host/overlay.h"
#include "host/window.h"
#include "tests/tools/validated_device.h"

#include <cstdlib>
#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

namespace supple::host {
namespace {

constexpr VkImageSubresourceRange kWholeImage{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

/// A cleared picture with a panel on it.
Status drawFrame(Window& window, Overlay& overlay, const WindowFrame& frame, uint64_t number) {
    const SuppleSyncScope transfer{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
    const VkImage image = window.swapchain().image(frame.image);
    imageBarrier(frame.commands, image, kWholeImage,
                 {VK_IMAGE_LAYOUT_UNDEFINED, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0}},
                 {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, transfer});
    const VkClearColorValue color{{0.2f, 0.3f, 0.4f, 1.0f}};
    vkCmdClearColorImage(frame.commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &color, 1, &kWholeImage);
    imageBarrier(frame.commands, image, kWholeImage, {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, transfer},
                 {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                  {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                   VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT}});
    overlay.beginPanels();
    ImGui::Begin("panel");
    ImGui::Text("frame %u", static_cast<unsigned>(number));
    ImGui::End();
    overlay.endPanels();
    if (const Status status = overlay.record(frame); !status)
        return status.error();
    return window.end(frame, number);
}

TEST(WindowTest, SurvivesResizing) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr)
        GTEST_SKIP() << "no display";
    Result<std::unique_ptr<Device>> device = createValidatedDevice({.window = true});
    ASSERT_TRUE(device.ok()) << device.error().message;
    const std::shared_ptr<const ValidationLog> validation = (*device)->validation();
    {
        Result<std::unique_ptr<Window>> window = Window::create(**device, "supple test", {320, 240});
        ASSERT_TRUE(window.ok()) << window.error().message;
        Result<std::unique_ptr<Overlay>> overlay = Overlay::create(**device, **window);
        ASSERT_TRUE(overlay.ok()) << overlay.error().message;
        uint64_t number = 0;
        for (const VkExtent2D size : {VkExtent2D{320, 240}, VkExtent2D{500, 180}, VkExtent2D{64, 400}}) {
            glfwSetWindowSize((*window)->handle(), static_cast<int>(size.width), static_cast<int>(size.height));
            // How many frames a display takes to follow is its own affair.
            for (bool fits = false; !fits;) {
                Result<std::optional<WindowFrame>> frame = (*window)->begin();
                ASSERT_TRUE(frame.ok()) << frame.error().message;
                if (!frame->has_value())
                    continue;
                const Status status = drawFrame(**window, **overlay, **frame, ++number);
                ASSERT_TRUE(status.ok()) << status.error().message;
                // Letters that nothing has shown yet: fonts are exchanged between frames that the device still draws.
                std::string letter = "\xD0\xB0";
                letter.back() = static_cast<char>(letter.back() + static_cast<char>(number % 14));
                const Status shown = (*overlay)->showText(letter);
                ASSERT_TRUE(shown.ok()) << shown.error().message;
                fits = (*window)->swapchain().extent().width == size.width &&
                       (*window)->swapchain().extent().height == size.height;
            }
        }
        EXPECT_LE(number - (*window)->completedFrame(), kFramesInFlight);
        (*window)->waitIdle(number);
        EXPECT_EQ((*window)->completedFrame(), number);
    }
    device->reset();
    EXPECT_EQ(validation->messageCount(), 0u);
}

/// What a display tells GLFW reaches the host: dropped files, and keys however short the press.
TEST(WindowTest, KeepsDropsAndKeysUntilTheyAreTaken) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr)
        GTEST_SKIP() << "no display";
    Result<std::unique_ptr<Device>> device = createValidatedDevice({.window = true});
    ASSERT_TRUE(device.ok()) << device.error().message;
    Result<std::unique_ptr<Window>> window = Window::create(**device, "supple test", {64, 64});
    ASSERT_TRUE(window.ok()) << window.error().message;
    GLFWwindow* const handle = (*window)->handle();
    const GLFWdropfun drop = glfwSetDropCallback(handle, nullptr);
    const GLFWkeyfun key = glfwSetKeyCallback(handle, nullptr);
    ASSERT_NE(drop, nullptr);
    ASSERT_NE(key, nullptr);
    const char* paths[] = {"/a b.glb", "/folder"};
    drop(handle, 2, paths);
    EXPECT_EQ((*window)->takeDropped(), (std::vector<std::string>{"/a b.glb", "/folder"}));
    EXPECT_TRUE((*window)->takeDropped().empty());
    key(handle, GLFW_KEY_V, 0, GLFW_PRESS, GLFW_MOD_SHIFT);
    key(handle, GLFW_KEY_V, 0, GLFW_RELEASE, 0);
    const std::vector<KeyPress> keys = (*window)->takeKeys();
    ASSERT_EQ(keys.size(), 1u);
    EXPECT_EQ(keys[0].key, GLFW_KEY_V);
    EXPECT_EQ(keys[0].modifiers, GLFW_MOD_SHIFT);
}

} // namespace
} // namespace supple::host
