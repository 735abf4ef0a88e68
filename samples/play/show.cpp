#include "show.h"

#include "ground.h"
#include "host/draw_target.h"
#include "host/must.h"

#include <cstring>

namespace play {

Show::Show(Device& device, const HeroOptions& options)
    : device_(device), graph_(device), buffers_(graph_.addBuffers()), shown_(graph_.addImage()), hero_(device, options),
      game_(hero_), drawing_(device, graph_, hero_) {}

void Show::resize(VkExtent2D extent) {
    drawing_.resize(extent);
}

float Show::aspect() const {
    const VkExtent2D extent = drawing_.picture().desc().extent;
    return static_cast<float>(extent.width) / static_cast<float>(extent.height);
}

void Show::update(uint64_t frame, uint64_t completed, const Input& input, float seconds) {
    hero_.beginFrame(frame, completed);
    game_.update(input, seconds);
    hero_.addToGraph(graph_, buffers_);
}

void Show::draw(uint32_t slot, const Camera& camera) {
    const std::optional<glm::vec2>& goal = game_.walker().goal();
    drawing_.update(slot, camera, game_.pose(), goal ? glm::vec4(onGround(*goal), 1.0f) : glm::vec4(0.0f));
    drawing_.addToGraph(slot, buffers_);
}

void Show::addReading() {
    graph_.add("copied", {reads(drawing_.pictureUse(), kCopied, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)},
               [](VkCommandBuffer) {}); // only the barrier
}

void Show::addPresenting(const Swapchain& swapchain) {
    addPresent(graph_, swapchain, shown_, drawing_.picture(), drawing_.pictureUse());
}

void Show::finish(uint64_t frame) {
    device_.waitIdle();
    hero_.beginFrame(frame + 1, frame);
}

Picture Show::readPicture() const {
    return must(supple::host::readPicture(device_, drawing_.picture()));
}

std::vector<glm::vec3> Show::readSurface() const {
    device_.waitIdle();
    SuppleVertexStreams streams{};
    must(hero_.group().vertexStreams(streams), "suppleGetVertexStreams");
    SuppleGridOutput grid{};
    must(hero_.group().gridOutput(grid), "suppleGetGridOutput");
    const std::vector<std::byte> bytes = must(device_.readBuffer(streams.vertices));
    std::vector<glm::vec3> vertices;
    for (uint32_t i = 0; i < grid.drawRangeCount; ++i) {
        const SuppleDrawRange& range = grid.drawRanges[i];
        for (uint32_t v = 0; hero_.isShown(range.part) && v < range.patchCount * range.samplesPerPatch; ++v)
            std::memcpy(&vertices.emplace_back(),
                        bytes.data() + size_t{range.firstVertex + v} * streams.vertices.stride, sizeof(glm::vec3));
    }
    return vertices;
}

} // namespace play
