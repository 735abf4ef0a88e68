// A market place: sixty different characters in one view, under one budget. See README.md.
#include "drawing.h"
#include "panel.h"

#include "host/draw_target.h"
#include "host/must.h"
#include "host/overlay.h"
#include "host/picture_options.h"

#include <glm/gtc/matrix_transform.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace {

using namespace supple::host;

struct Options : PictureOptions {
    bool offscreen = false;
    bool paint = false;
    uint32_t figures = market::kMostFigures;
    uint32_t budget = 2'500'000;
};

Options readOptions(int argc, char** argv) {
    Options options;
    CLI::App app("A market place of sixty characters under one budget", "supple_scene");
    addPictureOptions(app, options);
    app.remove_option(app.get_option("--rate"));
    app.get_option("--frames")->description("end after so many, a sixtieth of a second each; 0: with the window");
    app.get_option("--screenshot")->description("save the last frame as PNG; needs --offscreen");
    app.add_flag("--offscreen", options.offscreen, "no window; needs --frames");
    app.add_flag("--levels", options.paint, "paint how fine patches are");
    app.add_option("--figures", options.figures, "how many are there")
        ->check(CLI::Range(1u, market::kMostFigures))
        ->capture_default_str();
    app.add_option("--budget", options.budget, "surface vertices a frame, at first")
        ->check(CLI::Range(20'000u, SUPPLE_MAX_VIEW_VERTICES))
        ->capture_default_str();
    app.callback([&] {
        if (options.frames == 0 && options.offscreen)
            throw CLI::RequiredError("--frames");
        if (!options.screenshot.empty() && !options.offscreen)
            throw CLI::RequiredError("--offscreen");
    });
    parse(app, argc, argv);
    return options;
}

/// At the edge of the place, a little above the heads, slowly from side to side.
market::Camera cameraAt(double time, VkExtent2D extent) {
    const float sway = 0.16f * std::sin(0.11f * static_cast<float>(time));
    market::Camera camera;
    camera.eye = {11.2f * std::sin(sway), 2.9f, 11.2f * std::cos(sway)};
    const glm::vec3 target(0.0f, 0.95f, -1.0f);
    const float fovY = glm::radians(37.0f);
    const float aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
    glm::mat4 projection = glm::perspectiveRH_ZO(fovY, aspect, 0.1f, 200.0f);
    projection[1][1] = -projection[1][1]; // Vulkan's y points down
    const glm::mat4 view = glm::lookAt(camera.eye, target, glm::vec3(0.0f, 1.0f, 0.0f));
    camera.viewProjection = projection * view;
    camera.castersViewProjection = glm::perspectiveRH_ZO(fovY + glm::radians(16.0f), aspect, 0.1f, 200.0f) * view;
    camera.pixelsPerUnit = 0.5f * static_cast<float>(extent.height) / std::tan(0.5f * fovY);
    camera.ahead = glm::normalize(target - camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(camera.ahead, glm::vec3(0.0f, 1.0f, 0.0f)));
    camera.right = aspect * std::tan(0.5f * fovY) * right;
    camera.up = std::tan(0.5f * fovY) * glm::cross(right, camera.ahead);
    return camera;
}

/// The market place with its frames, in a window or not.
class Show {
public:
    Show(Device& device, const Options& options)
        : graph_(device), buffers_(graph_.addBuffers()), mostVertices_(std::max(options.budget, kMostVertices)),
          market_(device, options.figures, mostVertices_, options.record), drawing_(device, graph_, market_) {
        settings.budget = options.budget;
        settings.paint = options.paint;
    }

    void resize(VkExtent2D extent) {
        drawing_.resize(extent);
        extent_ = extent;
    }
    /// What was measured of the newest completed frame.
    [[nodiscard]] market::PanelFacts begin(uint32_t slot, uint64_t frame, uint64_t completed) {
        market_.beginFrame(frame, completed);
        market::PanelFacts facts{.figures = static_cast<uint32_t>(market_.cast().size()),
                                 .mostVertices = mostVertices_,
                                 .drawCount = drawing_.drawCount(),
                                 .callCount = drawing_.callCount(),
                                 .statistics = market_.statistics(),
                                 .memory = market_.memory(),
                                 .supple = market_.passTimes()};
        for (const PassTime& pass : graph_.readTimes(slot)) {
            if (std::string_view(pass.name) != "supple")
                facts.drawing.push_back({pass.name, pass.milliseconds});
        }
        return facts;
    }
    /// last: the picture is read then.
    void record(VkCommandBuffer commands, uint32_t slot, double time, bool isRead) {
        const market::Camera camera = cameraAt(time, extent_);
        market_.update(time, camera, settings.budget);
        drawing_.update(slot, camera, time);
        market_.addToGraph(graph_, buffers_);
        drawing_.addToGraph(slot, buffers_, settings.paint);
        if (isRead)
            graph_.add("copied", {reads(drawing_.pictureUse(), kTransferred, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)},
                       [](VkCommandBuffer) {}); // only the barrier
        graph_.execute(commands, slot);
    }
    [[nodiscard]] const Image& picture() const { return drawing_.picture(); }

    market::PanelSettings settings;

private:
    static constexpr uint32_t kMostVertices = 4'000'000;
    /// Read back, or brought into a window.
    static constexpr Scope kTransferred{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};

    Graph graph_;
    Resource buffers_;
    uint32_t mostVertices_;
    market::Market market_;
    market::Drawing drawing_;
    VkExtent2D extent_{};
};

void print(const market::PanelFacts& facts, uint32_t budget) {
    const SuppleViewStatistics& drawn = facts.statistics;
    std::printf("figures %u\ndrawn %u\ndropped %u\nbudget %u\nvertices %u\npatches %u\nscale %.4f\ncalls %u\n",
                facts.figures, drawn.drawnInstanceCount, drawn.droppedInstanceCount, budget, drawn.vertexCount,
                drawn.patchCount, static_cast<double>(drawn.levelScales[0]), facts.callCount);
    for (const std::vector<market::PassMilliseconds>* const passes : {&facts.supple, &facts.drawing}) {
        for (const market::PassMilliseconds& pass : *passes)
            std::printf("%-10s %8.3f ms\n", pass.name.c_str(), pass.milliseconds);
    }
}

constexpr double kFrameSeconds = 1.0 / 60.0;

std::shared_ptr<const ValidationLog> runOffscreen(const Options& options) {
    const std::unique_ptr<Device> device = mustCreateDevice();
    Show show(*device, options);
    show.resize(options.size);
    Frames frames(*device);
    market::PanelFacts facts;
    while (frames.frame() < options.frames) {
        frames.waitForRoom();
        const VkCommandBuffer commands = frames.begin();
        facts = show.begin(frames.slot(), frames.frame(), frames.completed());
        show.record(commands, frames.slot(), kFrameSeconds * static_cast<double>(frames.frame()), true);
        frames.submit();
    }
    device->waitIdle();
    if (!options.screenshot.empty())
        must(writePng(must(readPicture(*device, show.picture())), options.screenshot));
    print(facts, options.budget);
    return device->validation();
}

/// Into the window's image, which is ready for the panel then.
void copyToWindow(const WindowFrame& frame, const Window& window, const Image& picture) {
    constexpr VkImageSubresourceRange kWhole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    constexpr SuppleSyncScope kWritten{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
    constexpr SuppleSyncScope kDrawnOver{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                         VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT |
                                             VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    const VkImage image = window.swapchain().image(frame.image);
    imageBarrier(frame.commands, image, kWhole, {VK_IMAGE_LAYOUT_UNDEFINED, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0}},
                 {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, kWritten});
    const VkExtent2D extent = window.swapchain().extent();
    const VkOffset3D end{static_cast<int32_t>(extent.width), static_cast<int32_t>(extent.height), 1};
    VkImageBlit region{};
    region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.srcOffsets[1] = region.dstOffsets[1] = end;
    vkCmdBlitImage(frame.commands, picture.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST); // which changes the format
    imageBarrier(frame.commands, image, kWhole, {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, kWritten},
                 {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, kDrawnOver});
}

std::shared_ptr<const ValidationLog> runInWindow(const Options& options) {
    const std::unique_ptr<Device> device = mustCreateDevice({.window = true});
    const std::unique_ptr<Window> window = must(Window::create(*device, "Supple: a market place", options.size));
    const std::unique_ptr<Overlay> overlay = must(Overlay::create(*device, *window));
    Show show(*device, options);
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now();
    uint64_t number = 0;
    uint32_t generation = 0;
    double time = 0.0, frameMilliseconds = 0.0;
    while (!window->shouldClose() && (options.frames == 0 || number < options.frames)) {
        std::optional<WindowFrame> frame = must(window->begin());
        if (!frame)
            continue;
        if (generation != window->swapchain().generation()) {
            device->waitIdle();
            show.resize(window->swapchain().extent());
            generation = window->swapchain().generation();
        }
        const Clock::time_point now = Clock::now();
        frameMilliseconds = std::chrono::duration<double, std::milli>(now - last).count();
        last = now;
        market::PanelFacts facts = show.begin(frame->slot, ++number, window->completedFrame());
        facts.frameMilliseconds = frameMilliseconds;
        overlay->beginPanels();
        market::showPanel(facts, show.settings);
        overlay->endPanels();
        show.record(frame->commands, frame->slot, time, true);
        copyToWindow(*frame, *window, show.picture());
        must(overlay->record(*frame));
        must(window->end(*frame, number));
        if (show.settings.moves)
            time += options.frames != 0 ? kFrameSeconds : std::min(1e-3 * frameMilliseconds, 0.1);
    }
    window->waitIdle(number);
    return device->validation();
}

} // namespace

int main(int argc, char** argv) {
    const Options options = readOptions(argc, argv);
    mustBeSilent(*(options.offscreen ? runOffscreen(options) : runInWindow(options)));
    return 0;
}
