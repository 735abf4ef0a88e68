// Descriptor sets and pipelines, which live as long as the device.
#pragma once

#include "device.h"

#include <initializer_list>
#include <span>
#include <variant>

namespace sample {

struct Binding {
    uint32_t binding;
    VkDescriptorType type;
    VkShaderStageFlags stages;
};

VkDescriptorSetLayout createSetLayout(Device& device, std::initializer_list<Binding> bindings);

/// One push constant range from byte 0, if pushBytes is not 0.
VkPipelineLayout createPipelineLayout(Device& device, std::initializer_list<VkDescriptorSetLayout> sets,
                                      uint32_t pushBytes, VkShaderStageFlags pushStages);

VkPipeline createComputePipeline(Device& device, VkPipelineLayout layout, std::span<const uint32_t> shader);

/// For dynamic rendering, without vertex buffers; viewport, scissor and cull mode are dynamic.
struct GraphicsDesc {
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::span<const uint32_t> vertexShader;
    std::span<const uint32_t> fragmentShader; ///< empty: depth only
    std::vector<VkFormat> colors;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    bool depthWrite = true;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    float depthBias = 0.0f;
    float depthBiasSlope = 0.0f;
};

VkPipeline createGraphicsPipeline(Device& device, const GraphicsDesc& desc);

VkSampler createSampler(Device& device, VkFilter filter, bool compare = false);

/// What a descriptor points at.
struct Write {
    uint32_t binding;
    VkDescriptorType type;
    std::variant<VkDescriptorBufferInfo, VkDescriptorImageInfo> what;
};

Write uniformBuffer(uint32_t binding, const Buffer& buffer);
Write storageBuffer(uint32_t binding, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size);
Write storageBuffer(uint32_t binding, const SuppleBufferRange& view);
Write sampledImage(uint32_t binding, const Image& image, VkSampler sampler,
                   VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
Write storageImage(uint32_t binding, const Image& image);

/// Sets are allocated once and may be written again while no frame that uses them is in flight.
class DescriptorPool {
public:
    DescriptorPool(Device& device, uint32_t maxSets);
    VkDescriptorSet allocate(VkDescriptorSetLayout layout);
    void write(VkDescriptorSet set, std::initializer_list<Write> writes);

private:
    VkDevice device_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
};

} // namespace sample
