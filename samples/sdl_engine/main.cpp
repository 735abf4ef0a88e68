// A small engine with Supple in it. See README.md for what it shows; this file is the loop.
#include "taa.h"

#include "host/draw_target.h"
#include "host/must.h"
#include "host/picture_options.h"
#include "host/sdl_window.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string_view>

namespace {

using namespace engine;

struct Options : PictureOptions {
    std::string character = SUPPLE_SAMPLE_ASSETS "/pip.glb";
    double start = 0.0;
    bool offscreen = false;
};

Options readOptions(int argc, char** argv) {
    Options options;
    options.rate = 4;
    CLI::App app("A small engine with Supple in it", "supple_sdl_engine");
    addPictureOptions(app, options);
    app.get_option("--frames")->description("end after so many, a sixtieth of a second each; 0: with the window");
    app.get_option("--screenshot")->description("save the last frame as PNG; needs --frames");
    app.add_flag("--offscreen", options.offscreen, "no window; needs --frames");
    app.add_option("--start", options.start, "where in the show to begin")
        ->type_name("SECONDS")
        ->check(CLI::NonNegativeNumber);
    app.add_option("character", options.character, "a .glb")->capture_default_str();
    app.callback([&] {
        if (options.frames == 0 && (options.offscreen || !options.screenshot.empty()))
            throw CLI::RequiredError("--frames");
    });
    parse(app, argc, argv);
    return options;
}

std::string describe(double supple, double frameMilliseconds, const std::vector<PassTime>& times) {
    char text[256];
    int length = std::snprintf(text, sizeof text, "Supple %.2f ms of %.1f", supple, frameMilliseconds);
    for (const PassTime& time : times)
        if (length < static_cast<int>(sizeof text) && std::string_view(time.name) != "show")
            length += std::snprintf(text + length, sizeof text - static_cast<std::size_t>(length), " | %s %.2f",
                                    time.name, time.milliseconds);
    return text;
}

/// Milliseconds of the graph's passes, averaged over the run.
class Averages {
public:
    void add(const std::vector<PassTime>& times) {
        for (const PassTime& time : times) {
            auto& [sum, count] = sums_[time.name];
            sum += time.milliseconds;
            ++count;
        }
    }
    void print() const {
        for (const auto& [name, entry] : sums_)
            std::printf("%-10s %8.3f ms over %d frames\n", std::string(name).c_str(), entry.first / entry.second,
                        entry.second);
    }

private:
    std::map<std::string_view, std::pair<double, int>> sums_;
};

std::shared_ptr<const ValidationLog> run(const Options& options) {
    std::unique_ptr<SdlWindow> window;
    if (!options.offscreen)
        window = std::make_unique<SdlWindow>("Supple", options.size);
    const std::unique_ptr<Device> owner = mustCreateDevice({.window = window != nullptr});
    Device& device = *owner;
    Graph graph(device);
    const Resource characterBuffers = graph.addBuffers();
    Characters characters(device, options.character, options.rate, options.record);
    Passes passes(device, graph, characters);
    Taa taa(device, graph);
    std::unique_ptr<Swapchain> swapchain;
    const Resource shown = graph.addImage();
    if (window)
        swapchain = window->createSwapchain(device);
    Frames frames(device);

    Averages averages;
    VkExtent2D extent{};
    bool stale = true; // sizes must be looked at
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now();
    double time = options.start;
    double frameMilliseconds = 0.0;

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
            passes.resize(device, graph, extent);
            taa.resize(device, graph, passes.images());
            stale = false;
        }
        frames.waitForRoom();
        if (swapchain && !must(swapchain->acquire(frames.nextSlot()))) {
            stale = true;
            continue;
        }

        const VkCommandBuffer commands = frames.begin();
        const uint32_t slot = frames.slot();
        characters.beginFrame(frames.frame(), frames.completed());
        const std::vector<PassTime>& times = graph.readTimes(slot);
        averages.add(times);
        if (window && frames.frame() % 30 == 0)
            window->setTitle(describe(characters.milliseconds(), frameMilliseconds, times));

        characters.update(time);
        const float aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
        passes.update(slot, frames.frame(), cameraAt(time, aspect), Taa::jitter(frames.frame()),
                      characters.footprints());
        characters.addToGraph(graph, characterBuffers);
        passes.addToGraph(graph, slot, characterBuffers);
        taa.addToGraph(graph, passes.images());
        if (!options.screenshot.empty() && frames.frame() == options.frames)
            graph.add("screenshot", {reads(taa.pictureUse(), kCopied, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)},
                      [](VkCommandBuffer) {}); // only the barrier
        if (swapchain)
            addPresent(graph, *swapchain, shown, taa.picture(), taa.pictureUse());
        graph.execute(commands, slot);

        if (swapchain) {
            frames.submit(swapchain->acquired(slot), Swapchain::kFirstUse, swapchain->drawn());
            stale = !must(swapchain->present());
        } else {
            frames.submit();
        }

        const Clock::time_point now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - last).count();
        last = now;
        frameMilliseconds += 0.1 * (1e3 * seconds - frameMilliseconds);
        time += options.frames != 0 ? 1.0 / 60.0 : std::min(seconds, 0.1);
    }
    device.waitIdle();
    if (!options.screenshot.empty() && frames.frame() == options.frames)
        must(writePng(must(readPicture(device, taa.picture())), options.screenshot));
    if (options.frames != 0)
        averages.print();
    return device.validation();
}

} // namespace

int main(int argc, char** argv) {
    mustBeSilent(*run(readOptions(argc, argv)));
    return 0;
}
