// Characters at levels of detail: one call draws all kinds (host/view_draws.h).
#include "characters.h"
#include "host/must.h"
#include "host/rendering.h"
#include "host/view_draws.h"
#include "shaders/character_frag.h"
#include "shaders/character_vert.h"

namespace crowd {

namespace {

struct CharacterPush {
    uint32_t firstDraw; ///< of the call, among ViewDraws::drawn()
    uint32_t paint;
    uint32_t sun;
};

/// All characters have one look: one bin, so one call.
ViewDraws drawsOf(Device& device, const Crowd& crowd) {
    std::array<SuppleLevelOutput, kKinds> surfaces{};
    for (size_t k = 0; k < kKinds; ++k)
        surfaces[k] = crowd.kinds()[k].levels;
    return must(ViewDraws::create(device, surfaces, 1, [](uint32_t, const SuppleLevelDraw&) { return 0u; }));
}

class LevelCharacters final : public Characters {
public:
    LevelCharacters(Device& device, Graph& graph, const Crowd& crowd, VkDescriptorSetLayout scene);
    void addToGraph(Graph& graph, Resource buffers) const override {
        graph.add("gather", {reads(buffers, ViewDraws::kReads), writes(drawsUse_, ViewDraws::kWrites)},
                  [this](VkCommandBuffer commands) { draws_.record(commands); });
    }
    [[nodiscard]] std::vector<Use> uses(Resource buffers) const override {
        return {reads(buffers, kDrawn), reads(drawsUse_, kDrawn)};
    }
    void draw(VkCommandBuffer commands, VkDescriptorSet scene, bool sun, bool paint) const override;

private:
    ViewDraws draws_;
    Resource drawsUse_; ///< the buffers of draws_
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline sunPipeline_ = VK_NULL_HANDLE, picturePipeline_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

LevelCharacters::LevelCharacters(Device& device, Graph& graph, const Crowd& crowd, VkDescriptorSetLayout scene)
    : draws_(drawsOf(device, crowd)), drawsUse_(graph.addBuffers()) {
    if (!device.indexesBuffers())
        fail("the device lacks arrays of buffers that a draw chooses from", 3);
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    // The bindings of shaders/supple_surface.glsl at levels of detail: vertices, attributes, buckets, patches, which
    // are the view's. Then the draws, and the user data of every kind.
    const VkDescriptorSetLayout setLayout =
        must(createSetLayout(device, {{1, kStorage, VK_SHADER_STAGE_VERTEX_BIT},
                                      {3, kStorage, VK_SHADER_STAGE_VERTEX_BIT},
                                      {4, kStorage, VK_SHADER_STAGE_VERTEX_BIT},
                                      {5, kStorage, VK_SHADER_STAGE_VERTEX_BIT},
                                      {6, kStorage, VK_SHADER_STAGE_VERTEX_BIT},
                                      {7, kStorage, VK_SHADER_STAGE_VERTEX_BIT, kKinds}}));
    layout_ = must(createPipelineLayout(device, {scene, setLayout}, sizeof(CharacterPush), VK_SHADER_STAGE_VERTEX_BIT));
    const SuppleVertexStreams& streams = crowd.kinds().front().streams;
    std::vector<Write> writes{storageBuffer(1, streams.vertices), storageBuffer(3, streams.attributes),
                              storageBuffer(4, draws_.buckets()), storageBuffer(5, draws_.patches()),
                              storageBuffer(6, draws_.drawn().handle(), 0, VK_WHOLE_SIZE)};
    for (uint32_t k = 0; k < kKinds; ++k) {
        writes.push_back(storageBuffer(7, crowd.kinds()[k].info.userData));
        writes.back().element = k;
    }
    DescriptorPool pool = must(DescriptorPool::create(device, 2)); // room for eight storage buffers
    set_ = must(pool.allocate(setLayout));
    pool.write(set_, writes);
    sunPipeline_ = must(createGraphicsPipeline(device, {.layout = layout_,
                                                        .vertexShader = character_vert,
                                                        .depth = kDepthFormat,
                                                        .depthBias = 1.0f,
                                                        .depthBiasSlope = 1.5f}));
    picturePipeline_ = must(createGraphicsPipeline(device, {.layout = layout_,
                                                            .vertexShader = character_vert,
                                                            .fragmentShader = character_frag,
                                                            .colors = {kColorFormat},
                                                            .depth = kDepthFormat}));
}

void LevelCharacters::draw(VkCommandBuffer commands, VkDescriptorSet scene, bool sun, bool paint) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, sun ? sunPipeline_ : picturePipeline_);
    const VkDescriptorSet sets[] = {scene, set_};
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 2, sets, 0, nullptr);
    const CharacterPush push{draws_.firstDraw(0), paint ? 1u : 0u, sun ? 1u : 0u};
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
    draws_.draw(commands, 0);
}

} // namespace

std::unique_ptr<Characters> makeLevelCharacters(Device& device, Graph& graph, const Crowd& crowd,
                                                VkDescriptorSetLayout scene) {
    return std::make_unique<LevelCharacters>(device, graph, crowd, scene);
}

} // namespace crowd
