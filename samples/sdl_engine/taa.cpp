#include "taa.h"

#include "host/must.h"
#include "shaders/taa_comp.h"
#include "shaders/tone_comp.h"

namespace engine {

namespace {

struct ResolvePush {
    int32_t width;
    int32_t height;
    uint32_t hasHistory;
};

float halton(uint64_t index, uint64_t base) {
    float result = 0.0f;
    float part = 1.0f;
    for (; index > 0; index /= base) {
        part /= static_cast<float>(base);
        result += part * static_cast<float>(index % base);
    }
    return result;
}

} // namespace

Taa::Taa(Device& device, Graph& graph) : pool_(must(DescriptorPool::create(device, 4))) {
    constexpr VkShaderStageFlags kCompute = VK_SHADER_STAGE_COMPUTE_BIT;
    constexpr VkDescriptorType kSampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    const VkDescriptorSetLayout resolve = must(createSetLayout(device, {{0, kSampled, kCompute},
                                                                        {1, kSampled, kCompute},
                                                                        {2, kSampled, kCompute},
                                                                        {3, kSampled, kCompute},
                                                                        {4, kStorage, kCompute}}));
    const VkDescriptorSetLayout tone =
        must(createSetLayout(device, {{0, kSampled, kCompute}, {1, kStorage, kCompute}}));
    resolveLayout_ = must(createPipelineLayout(device, {resolve}, sizeof(ResolvePush), kCompute));
    toneLayout_ = must(createPipelineLayout(device, {tone}, sizeof(ResolvePush), kCompute));
    resolvePipeline_ = must(createComputePipeline(device, resolveLayout_, taa_comp));
    tonePipeline_ = must(createComputePipeline(device, toneLayout_, tone_comp));
    linear_ = must(createSampler(device, VK_FILTER_LINEAR));
    nearest_ = must(createSampler(device, VK_FILTER_NEAREST));
    for (int i = 0; i < 2; ++i) {
        historyUses_[i] = graph.addImage();
        resolveSets_[i] = must(pool_.allocate(resolve));
        toneSets_[i] = must(pool_.allocate(tone));
    }
    pictureUse_ = graph.addImage();
}

void Taa::resize(Device& device, Graph& graph, const SceneImages& scene) {
    const VkExtent2D extent = scene.color.desc().extent;
    for (int i = 0; i < 2; ++i) {
        histories_[i] = must(device.createImage({.format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                                 .extent = extent,
                                                 .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT}));
        graph.setImage(historyUses_[i], histories_[i].handle());
    }
    picture_ = must(device.createImage({.format = VK_FORMAT_R8G8B8A8_UNORM,
                                        .extent = extent,
                                        .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}));
    graph.setImage(pictureUse_, picture_.handle());
    for (int i = 0; i < 2; ++i) {
        pool_.write(resolveSets_[i], {sampledImage(0, scene.color, nearest_), sampledImage(1, scene.motion, nearest_),
                                      sampledImage(2, scene.depth, nearest_),
                                      sampledImage(3, histories_[1 - i], linear_), storageImage(4, histories_[i])});
        pool_.write(toneSets_[i], {sampledImage(0, histories_[i], nearest_), storageImage(1, picture_)});
    }
    hasHistory_ = false;
}

glm::vec2 Taa::jitter(uint64_t frame) {
    const uint64_t index = frame % 16 + 1;
    return {halton(index, 2) - 0.5f, halton(index, 3) - 0.5f};
}

void Taa::addToGraph(Graph& graph, const SceneImages& scene) {
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    current_ = 1 - current_;
    const VkExtent2D extent = scene.color.desc().extent;
    const ResolvePush push{static_cast<int32_t>(extent.width), static_cast<int32_t>(extent.height),
                           hasHistory_ ? 1u : 0u};
    const auto dispatch = [push](VkCommandBuffer commands, VkPipeline pipeline, VkPipelineLayout layout,
                                 VkDescriptorSet set) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
        vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, &push);
        vkCmdDispatch(commands, static_cast<uint32_t>(push.width + 7) / 8, static_cast<uint32_t>(push.height + 7) / 8,
                      1);
    };
    graph.add("taa",
              {reads(scene.colorUse, kSampledInCompute, kRead), reads(scene.motionUse, kSampledInCompute, kRead),
               reads(scene.depthUse, kSampledInCompute, kRead),
               reads(historyUses_[1 - current_], kSampledInCompute, kRead),
               writes(historyUses_[current_], kStorageInCompute, VK_IMAGE_LAYOUT_GENERAL, true)},
              [this, dispatch, set = resolveSets_[current_]](VkCommandBuffer commands) {
                  dispatch(commands, resolvePipeline_, resolveLayout_, set);
              });
    graph.add("tone",
              {reads(historyUses_[current_], kSampledInCompute, kRead),
               writes(pictureUse_, kStorageInCompute, VK_IMAGE_LAYOUT_GENERAL, true)},
              [this, dispatch, set = toneSets_[current_]](VkCommandBuffer commands) {
                  dispatch(commands, tonePipeline_, toneLayout_, set);
              });
    hasHistory_ = true;
}

} // namespace engine
