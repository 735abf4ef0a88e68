// Cloth in the wind. The simulation is the host's, on the device: nothing of a frame passes through the CPU.
#include "scene.h"

#include "host/draw_target.h"
#include "host/frames.h"
#include "host/must.h"
#include "host/picture_options.h"

#include <cstdio>

namespace {

using namespace supple::host;

PictureOptions readOptions(int argc, char** argv) {
    PictureOptions options;
    options.rate = 6;
    options.frames = 240;
    CLI::App app("Cloth in the wind, simulated by the host on the device", "supple_cloth_host");
    addPictureOptions(app, options);
    app.get_option("--frames")->check(CLI::PositiveNumber);
    parse(app, argc, argv);
    return options;
}

std::shared_ptr<const ValidationLog> run(const PictureOptions& options) {
    const std::unique_ptr<Device> owner = mustCreateDevice();
    Device& device = *owner;
    cloth::Cloth cloth(device, options.rate, options.record);
    const cloth::Scene scene(device, cloth, options.size);
    Frames frames(device);
    while (frames.frame() < options.frames) {
        const VkCommandBuffer commands = frames.begin();
        const bool last = frames.frame() == options.frames;
        cloth.beginFrame(frames.frame(), frames.completed());
        cloth.record(commands, static_cast<double>(frames.frame()) / 60.0);
        if (last || options.screenshot.empty()) // else only the last frame is seen
            scene.record(commands);
        frames.submit();
    }
    device.waitIdle();
    if (!options.screenshot.empty())
        must(writePng(must(readPicture(device, scene.picture())), options.screenshot));
    std::printf("%llu frames; a sheet: %u cage vertices, %u patches, %u surface vertices\n",
                static_cast<unsigned long long>(options.frames), cloth.info().cageVertexCount,
                cloth.surface().patchCount, cloth.grid().vertexCount);
    return device.validation();
}

} // namespace

int main(int argc, char** argv) {
    mustBeSilent(*run(readOptions(argc, argv)));
    return 0;
}
