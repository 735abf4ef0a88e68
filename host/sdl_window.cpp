#include "host/sdl_window.h"

#include "host/must.h"

#include <SDL_vulkan.h>

namespace supple::host {

SdlWindow::SdlWindow(const char* title, VkExtent2D size) {
    SDL_SetMainReady();
    if (SDL_Init(SDL_INIT_VIDEO) != 0)
        fail(std::string("no window: ") + SDL_GetError(), 3);
    window_ = SDL_CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, static_cast<int>(size.width),
                               static_cast<int>(size.height), SDL_WINDOW_VULKAN | SDL_WINDOW_RESIZABLE);
    if (window_ == nullptr)
        fail(std::string("no window: ") + SDL_GetError(), 3);
}

SdlWindow::~SdlWindow() {
    SDL_DestroyWindow(window_);
    SDL_Quit();
}

std::unique_ptr<Swapchain> SdlWindow::createSwapchain(Device& device) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (SDL_Vulkan_CreateSurface(window_, device.instance(), &surface) == SDL_FALSE)
        fail(std::string("no surface: ") + SDL_GetError(), 3);
    return must(Swapchain::create(device, surface));
}

VkExtent2D SdlWindow::drawableSize() const {
    int width = 0;
    int height = 0;
    SDL_Vulkan_GetDrawableSize(window_, &width, &height);
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

bool SdlWindow::pollEvents() {
    bool stays = true;
    for (SDL_Event event; SDL_PollEvent(&event) != 0;) {
        const bool escape = event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE;
        resized_ = resized_ || (event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_SIZE_CHANGED);
        stays = stays && event.type != SDL_QUIT && !escape;
    }
    return stays;
}

} // namespace supple::host
