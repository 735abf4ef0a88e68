// Cloth in the wind. The simulation is the host's, on the device: nothing of a frame passes through the CPU.
#include "scene.h"

#include "common/options.h"
#include "common/picture.h"

#include <cstdio>

namespace {

sample::PictureOptions readOptions(int argc, char** argv) {
    sample::PictureOptions options;
    options.rate = 6;
    options.frames = 240;
    CLI::App app("Cloth in the wind, simulated by the host on the device", "supple_cloth_host");
    sample::addPictureOptions(app, options);
    app.get_option("--frames")->check(CLI::PositiveNumber);
    sample::parse(app, argc, argv);
    return options;
}

void run(const sample::PictureOptions& options) {
    sample::Device device({.name = "supple_cloth_host"});
    cloth::Cloth cloth(device, options.rate);
    const cloth::Scene scene(device, cloth, options.size);
    const sample::Buffer readback(device, VkDeviceSize{4} * options.size.width * options.size.height,
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT, true);
    sample::Frames frames(device);
    while (frames.frame() < options.frames) {
        const VkCommandBuffer commands = frames.begin();
        const bool last = frames.frame() == options.frames;
        cloth.beginFrame(frames.frame(), frames.completed());
        cloth.record(commands, static_cast<double>(frames.frame()) / 60.0);
        if (last || options.screenshot.empty()) { // else only the last frame is seen
            scene.record(commands);
            sample::copyPicture(commands, scene.picture(), readback);
        }
        frames.submit();
    }
    device.waitIdle();
    if (!options.screenshot.empty())
        sample::writePng(options.screenshot, options.size.width, options.size.height, readback.mapped());
    std::printf("%llu frames; a sheet: %u cage vertices, %u patches, %u surface vertices\n",
                static_cast<unsigned long long>(options.frames), cloth.info().cageVertexCount, cloth.info().patchCount,
                cloth.grid().vertexCount);
}

} // namespace

int main(int argc, char** argv) {
    run(readOptions(argc, argv));
    if (sample::validationMessages() != 0)
        sample::fail("failed: " + std::to_string(sample::validationMessages()) + " validation messages");
    return 0;
}
