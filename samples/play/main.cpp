// One room, one character: click, and she comes; right-click, and she falls. See README.md.
#include "show.h"
#include "story.h"
#include "watch.h"

#include "host/must.h"
#include "host/picture_options.h"
#include "host/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace {

using namespace play;

struct Options : PictureOptions {
    bool script = false;
    bool bare = false;
    uint32_t framesPerSecond = 30;
    std::string strip;
    std::vector<double> moments = {1.3, 2.3, 4.25, 5.5, 7.0, 9.125};
};

Options readOptions(int argc, char** argv) {
    Options options;
    options.rate = 4;
    CLI::App app("A character walks where you click, falls when hit, and gets up", "supple_play");
    addPictureOptions(app, options);
    app.remove_option(app.get_option("--screenshot"));
    app.get_option("--frames")->description("end after so many, a sixtieth of a second each; 0: with the window");
    app.get_option("--size")->description("of the window, or of each picture of the strip");
    CLI::Option* const script = app.add_flag("--script", options.script, "a story without a window, always the same");
    app.add_option("-o,--strip", options.strip, "save pictures of the story side by side, as PNG")
        ->type_name("FILE")
        ->needs(script);
    app.add_option("--at", options.moments, "seconds of the story at which pictures are taken")
        ->delimiter(',')
        ->check(CLI::Range(0.0, kStorySeconds))
        ->needs(script);
    app.add_option("--fps", options.framesPerSecond, "frames a second of the story")
        ->check(CLI::Range(4u, 120u))
        ->needs(script)
        ->capture_default_str();
    app.add_flag("--bare", options.bare, "the recording has the character's hash instead of the character")
        ->needs(app.get_option("--record"));
    script->excludes(app.get_option("--frames"));
    parse(app, argc, argv);
    std::sort(options.moments.begin(), options.moments.end());
    return options;
}

HeroOptions heroOptions(const Options& options) {
    return {.rate = options.rate, .record = options.record, .bareRecording = options.bare};
}

constexpr float kStoryDistance = 3.95f, kWindowDistance = 5.5f; ///< of the camera

/// Between head and feet, whatever they do.
glm::vec3 middleOf(const Game& game) {
    const glm::vec3 hips(game.pose()[kHips][3]);
    return onGround(placeOf(hips)) + glm::vec3(0.0f, 0.72f, 0.0f);
}

/// What the window shows: her, and some of what there is to walk on.
glm::vec3 seenMiddle(const Game& game) {
    return glm::mix(middleOf(game), glm::vec3(1.0f, 0.72f, 0.0f), 0.3f);
}

std::shared_ptr<const ValidationLog> runStory(const Options& options) {
    const std::unique_ptr<Device> device = mustCreateDevice();
    Show show(*device, heroOptions(options));
    show.resize(options.size);
    Frames frames(*device);
    Watch watch(show.game());
    const auto pictureCount = static_cast<uint32_t>(options.moments.size());
    Picture strip = Picture::blank(options.size.width * pictureCount, options.size.height);
    const double seconds = 1.0 / options.framesPerSecond;
    const auto count = static_cast<uint64_t>(std::ceil(kStorySeconds * options.framesPerSecond));
    uint32_t pictures = 0;
    while (frames.frame() < count) {
        frames.waitForRoom();
        const VkCommandBuffer commands = frames.begin();
        const double time = seconds * static_cast<double>(frames.frame());
        show.update(frames.frame(), frames.completed(), storyInput(time, seconds), static_cast<float>(seconds));
        const bool isShown =
            !options.strip.empty() && pictures < pictureCount && time >= options.moments[pictures] - 1e-9;
        if (isShown) {
            show.draw(frames.slot(), cameraBeside(middleOf(show.game()), kStoryDistance));
            show.addReading();
        }
        show.execute(commands, frames.slot());
        frames.submit();
        watch.see(show.game(), show.readSurface(), static_cast<float>(seconds));
        if (isShown)
            strip.paste(show.readPicture(), options.size.width * pictures++, 0);
    }
    show.finish(frames.frame());
    if (!options.strip.empty())
        must(writePng(strip, options.strip));
    watch.print();
    return device->validation();
}

/// What mouse and keyboard say.
class Player {
public:
    /// Clicks are kept until they are read, however short they are.
    explicit Player(const Window& window) { glfwSetInputMode(window.handle(), GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE); }
    Input read(Window& window, const Show& show, const Camera& camera) {
        double x = 0.0, y = 0.0;
        int width = 1, height = 1;
        glfwGetCursorPos(window.handle(), &x, &y);
        glfwGetWindowSize(window.handle(), &width, &height);
        const glm::vec2 at(2.0 * x / std::max(width, 1) - 1.0, 2.0 * y / std::max(height, 1) - 1.0);
        const glm::vec3 ray = camera.ray(at, show.aspect());
        const std::optional<glm::vec3> ground = meetGround(camera.eye, ray);
        Input input;
        input.lookAt = ground.value_or(camera.eye + 6.0f * ray);
        if (wasPressed(window, GLFW_MOUSE_BUTTON_LEFT, left_) && ground)
            input.goal = placeOf(*ground);
        bool hits = wasPressed(window, GLFW_MOUSE_BUTTON_RIGHT, right_);
        for (const KeyPress& press : window.takeKeys())
            hits = hits || press.key == GLFW_KEY_SPACE;
        if (hits)
            input.push = 2.6f * glm::normalize(glm::vec3(ray.x, 0.1f, ray.z));
        return input;
    }

private:
    static bool wasPressed(const Window& window, int button, bool& down) {
        const bool before = std::exchange(down, glfwGetMouseButton(window.handle(), button) == GLFW_PRESS);
        return down && !before;
    }

    bool left_ = false, right_ = false;
};

std::shared_ptr<const ValidationLog> runInWindow(const Options& options) {
    const std::unique_ptr<Device> device = mustCreateDevice({.window = true});
    const std::unique_ptr<Window> window =
        must(Window::create(*device, "Supple: click to walk, right-click or press the space bar to hit", options.size));
    Show show(*device, heroOptions(options));
    Player player(*window);
    Camera camera = cameraBeside(seenMiddle(show.game()), kWindowDistance);
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now();
    uint64_t number = 0;
    uint32_t generation = 0;
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
        const float passed = std::chrono::duration<float>(now - last).count();
        last = now;
        const float seconds = options.frames != 0 ? 1.0f / 60.0f : std::clamp(passed, 0.001f, 0.1f);
        show.update(++number, window->completedFrame(), player.read(*window, show, camera), seconds);
        const glm::vec3 middle = glm::mix(camera.target, seenMiddle(show.game()), 1.0f - std::exp(-2.0f * seconds));
        camera = cameraBeside(middle, kWindowDistance);
        show.draw(frame->slot, camera);
        show.addPresenting(window->swapchain());
        show.execute(frame->commands, frame->slot);
        must(window->end(*frame, number));
    }
    window->waitIdle(number);
    show.finish(number);
    return device->validation();
}

} // namespace

int main(int argc, char** argv) {
    const Options options = readOptions(argc, argv);
    mustBeSilent(*(options.script ? runStory(options) : runInWindow(options)));
    return 0;
}
