// A thousand characters of three kinds, drawn at levels of detail under one budget. See README.md.
#include "scene.h"

#include "host/draw_target.h"
#include "host/must.h"
#include "host/picture_options.h"
#include "host/sdl_window.h"

#include <glm/gtc/matrix_transform.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

namespace {

using namespace supple::host;

struct Options : PictureOptions {
    crowd::CrowdOptions crowd{.files = {SUPPLE_SAMPLE_ASSETS "/pip.glb", SUPPLE_SAMPLE_ASSETS "/pip_quads.glb",
                                        SUPPLE_SAMPLE_ASSETS "/pip_quads.glb"}};
    bool offscreen = false;
    bool levels = false;
    bool mesh = false; ///< characters that are evaluated while drawing: by a mesh shader
};

Options readOptions(int argc, char** argv) {
    Options options;
    CLI::App app("A crowd at levels of detail under one budget", "supple_crowd");
    addPictureOptions(app, options);
    app.remove_option(app.get_option("--rate"));
    app.get_option("--frames")->description("end after so many, a sixtieth of a second each; 0: with the window");
    app.get_option("--screenshot")->description("save the last frame as PNG; needs --frames");
    app.add_flag("--offscreen", options.offscreen, "no window; needs --frames");
    app.add_flag("--levels", options.levels, "paint how fine patches are");
    app.add_flag("--wall", options.crowd.wall, "a wall across the crowd");
    app.add_flag("--occlusion", options.crowd.occlusion, "leave out who was hidden in the frame before");
    app.add_flag("--back-faces", options.crowd.backFaces, "leave out patches that face away");
    app.add_option("--count", options.crowd.count, "characters")->check(CLI::Range(3u, 100000u))->capture_default_str();
    app.add_option("--fixed", options.crowd.fixedRate, "no levels of detail: all have this rate, in sight or not")
        ->check(CLI::Range(1u, 64u));
    app.add_flag("--direct", options.crowd.direct, "with --fixed: evaluate while drawing, without stored vertices")
        ->needs("--fixed");
    app.add_flag("--mesh", options.mesh, "with --direct: by a mesh shader; needs VK_EXT_mesh_shader")
        ->needs("--direct");
    app.add_option("--budget", options.crowd.budget, "surface vertices a frame")
        ->check(CLI::Range(1024u, SUPPLE_MAX_VIEW_VERTICES))
        ->capture_default_str();
    app.add_option("--coefficients", options.crowd.coefficients,
                   "MiB that those share who are drawn; 0: memory for all characters")
        ->check(CLI::Range(0u, 4095u))
        ->capture_default_str();
    app.add_option("characters", options.crowd.files, "three GLB files, the second all of quads")
        ->capture_default_str();
    app.callback([&] {
        if (options.crowd.fixedRate != 0 && (options.levels || options.crowd.occlusion || options.crowd.backFaces))
            throw CLI::ValidationError("--fixed", "does not go with --levels, --occlusion and --back-faces");
        if (options.frames == 0 && (options.offscreen || !options.screenshot.empty()))
            throw CLI::RequiredError("--frames");
    });
    parse(app, argc, argv);
    options.crowd.record = options.record;
    return options;
}

/// Over the crowd and slowly down to its edge.
crowd::Camera cameraAt(double time, float reach, VkExtent2D extent) {
    const float t = static_cast<float>(time);
    const float height = 1.5f + 2.2f * (0.5f + 0.5f * std::cos(0.13f * t));
    const float angle = 0.35f + 0.03f * t;
    crowd::Camera camera;
    camera.eye = {std::sin(angle) * (reach + 2.0f), height, std::cos(angle) * (reach + 2.0f)};
    const float fovY = glm::radians(38.0f);
    const float aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
    glm::mat4 projection = glm::perspectiveRH_ZO(fovY, aspect, 0.1f, 400.0f);
    projection[1][1] = -projection[1][1]; // Vulkan's y points down
    const glm::mat4 view = glm::lookAt(camera.eye, glm::vec3(0.0f, -0.12f * reach, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
    camera.viewProjection = projection * view;
    camera.castersViewProjection = glm::perspectiveRH_ZO(fovY + glm::radians(14.0f), aspect, 0.1f, 400.0f) * view;
    camera.pixelsPerUnit = 0.5f * static_cast<float>(extent.height) / std::tan(0.5f * fovY);
    return camera;
}

std::shared_ptr<const ValidationLog> run(const Options& options) {
    std::unique_ptr<SdlWindow> window;
    if (!options.offscreen)
        window = std::make_unique<SdlWindow>("Supple: a crowd", options.size);
    const std::unique_ptr<Device> owner = mustCreateDevice({.window = window != nullptr, .meshShaders = options.mesh});
    Device& device = *owner;
    Graph graph(device);
    const Resource buffers = graph.addBuffers();
    crowd::Crowd crowd(device, options.crowd);
    crowd::Scene scene(device, graph, crowd, options.crowd.wall, options.crowd.occlusion);
    std::unique_ptr<Swapchain> swapchain;
    const Resource shown = graph.addImage();
    if (window)
        swapchain = window->createSwapchain(device);
    Frames frames(device);

    VkExtent2D extent{};
    bool stale = true; // sizes must be looked at
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now();
    double time = 0.0, frameMilliseconds = 0.0, hostMilliseconds = 0.0;
    uint64_t ended = 0; ///< the newest frame that was seen to be complete
    std::vector<std::string> report;
    glm::mat4 depthViewProjection{1.0f}; ///< of the depth that the pyramid holds
    bool hasDepth = false;

    while (options.frames == 0 || frames.frame() < options.frames) {
        if (window && !window->pollEvents())
            break;
        stale = stale || (window && window->takeResized());
        if (stale) {
            device.waitIdle();
            if (swapchain && !must(swapchain->resize(window->drawableSize()))) {
                SDL_Delay(50);
                continue;
            }
            extent = swapchain ? swapchain->extent() : options.size;
            scene.resize(device, graph, extent);
            stale = false;
            hasDepth = false;
        }
        frames.waitForRoom();
        if (const uint64_t completed = frames.completed(); completed > ended) { // since the frame before was complete
            const Clock::time_point now = Clock::now();
            frameMilliseconds =
                std::chrono::duration<double, std::milli>(now - last).count() / static_cast<double>(completed - ended);
            last = now;
            ended = completed;
        }
        if (swapchain && !must(swapchain->acquire(frames.nextSlot()))) {
            stale = true;
            continue;
        }

        const VkCommandBuffer commands = frames.begin();
        const uint32_t slot = frames.slot();
        // Reading timestamps waits for the device on lavapipe; what the host does begins behind that.
        crowd.beginFrame(frames.frame(), frames.completed());
        report = crowd.report();
        for (const PassTime& pass : graph.readTimes(slot)) {
            char line[80];
            std::snprintf(line, sizeof line, "%-10s %8.3f ms", pass.name, pass.milliseconds);
            if (std::string_view(pass.name) != "supple")
                report.emplace_back(line);
        }
        char line[80];
        std::snprintf(line, sizeof line, "host %.2f ms, frame %.1f ms", hostMilliseconds, frameMilliseconds);
        if (ended > 0) // as a whole, from the end of the frame before to its own
            report.emplace_back(line);
        const Clock::time_point begun = Clock::now();
        const crowd::Camera camera = cameraAt(time, crowd.reach(), extent);
        crowd.update(time, camera);
        scene.update(slot, camera, report);
        const Resource pyramidUse = scene.pyramidUse();
        if (scene.pyramid() != nullptr) {
            const SuppleDepthPyramidDesc pyramid =
                scene.pyramid()->desc(std::span<const float, 16>(&depthViewProjection[0][0], 16));
            crowd.setPyramid(hasDepth ? &pyramid : nullptr);
            depthViewProjection = camera.viewProjection;
        }
        crowd.addToGraph(graph, buffers, hasDepth ? &pyramidUse : nullptr);
        hasDepth = scene.pyramid() != nullptr;
        scene.addToGraph(graph, slot, buffers, options.levels);
        if (!options.screenshot.empty() && frames.frame() == options.frames)
            graph.add("screenshot", {reads(scene.pictureUse(), kCopied, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)},
                      [](VkCommandBuffer) {}); // only the barrier
        if (swapchain)
            addPresent(graph, *swapchain, shown, scene.picture(), scene.pictureUse());
        graph.execute(commands, slot);
        hostMilliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begun).count();

        if (swapchain) {
            frames.submit(swapchain->acquired(slot), Swapchain::kFirstUse, swapchain->drawn());
            stale = !must(swapchain->present());
        } else {
            frames.submit();
        }
        time += options.frames != 0 ? 1.0 / 60.0 : std::min(1e-3 * frameMilliseconds, 0.1);
    }
    device.waitIdle();
    if (!options.screenshot.empty() && frames.frame() == options.frames)
        must(writePng(must(readPicture(device, scene.picture())), options.screenshot));
    for (const std::string& line : report)
        std::printf("%s\n", line.c_str());
    return device.validation();
}

} // namespace

int main(int argc, char** argv) {
    mustBeSilent(*run(readOptions(argc, argv)));
    return 0;
}
