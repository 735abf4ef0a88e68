// Descriptor sets and pipelines, which live as long as the device.
#pragma once

#include "host/device.h"

#include <initializer_list>
#include <span>
#include <variant>

namespace supple::host {

struct Binding {
    uint32_t binding;
    VkDescriptorType type;
    VkShaderStageFlags stages;
    uint32_t count = 1; ///< of an array
};

[[nodiscard]] Result<VkDescriptorSetLayout> createSetLayout(Device& device, std::span<const Binding> bindings);
[[nodiscard]] inline Result<VkDescriptorSetLayout> createSetLayout(Device& device,
                                                                   std::initializer_list<Binding> bindings) {
    return createSetLayout(device, std::span(bindings.begin(), bindings.size()));
}

/// One push constant range from byte 0, if pushBytes is not 0.
[[nodiscard]] Result<VkPipelineLayout> createPipelineLayout(Device& device,
                                                            std::initializer_list<VkDescriptorSetLayout> sets,
                                                            uint32_t pushBytes, VkShaderStageFlags pushStages);

[[nodiscard]] Result<VkPipeline> createComputePipeline(Device& device, VkPipelineLayout layout,
                                                       std::span<const uint32_t> shader);

/// How a color comes to what is there.
enum class Blend {
    none,
    over,     ///< by its alpha
    multiply, ///< what is there is multiplied by it
    add
};

/// For dynamic rendering, without vertex buffers; viewport, scissor and cull mode are dynamic (beginRendering sets
/// them).
struct GraphicsDesc {
    const char* name = "";
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::span<const uint32_t> vertexShader;
    std::span<const uint32_t> meshShader;     ///< instead of a vertex shader
    std::span<const uint32_t> fragmentShader; ///< empty: depth only
    std::vector<uint32_t> constants; ///< of the specialization constants from 0 on, where the shaders have them
    std::vector<VkFormat> colors;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    bool depthWrite = true;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool alphaToCoverage = false;
    Blend blend = Blend::none;
    float depthBias = 0.0f;
    float depthBiasSlope = 0.0f;
};

[[nodiscard]] Result<VkPipeline> createGraphicsPipeline(Device& device, const GraphicsDesc& desc);

/// Clamps to the edge; `compare`: of depths.
[[nodiscard]] Result<VkSampler> createSampler(Device& device, VkFilter filter, bool compare = false);
/// Linear, with mip levels; repeats.
[[nodiscard]] Result<VkSampler> createTextureSampler(Device& device);

/// Texels of a part of a buffer, which the device must be able to read so many of.
[[nodiscard]] Result<VkBufferView> createTexels(Device& device, const SuppleBufferRange& range, VkFormat format);

/// What a descriptor points at.
struct Write {
    uint32_t binding;
    VkDescriptorType type;
    std::variant<VkDescriptorBufferInfo, VkDescriptorImageInfo, VkAccelerationStructureKHR, VkBufferView> what;
    uint32_t element = 0; ///< of an array
};

[[nodiscard]] Write uniformBuffer(uint32_t binding, const Buffer& buffer);
[[nodiscard]] Write storageBuffer(uint32_t binding, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size);
[[nodiscard]] Write storageBuffer(uint32_t binding, const SuppleBufferRange& view);
[[nodiscard]] Write texels(uint32_t binding, VkBufferView view); ///< of createTexels()
[[nodiscard]] Write sampledImage(uint32_t binding, const Image& image, VkSampler sampler,
                                 VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
[[nodiscard]] Write storageImage(uint32_t binding, const Image& image);
[[nodiscard]] Write accelerationStructure(uint32_t binding, VkAccelerationStructureKHR structure);

/// Sets are allocated once and may be written again while no frame that uses them is in flight.
class DescriptorPool {
public:
    /// Room for four storage buffers and four textures a set, for two texel buffers, and for one of each other type.
    [[nodiscard]] static Result<DescriptorPool> create(Device& device, uint32_t maxSets);
    [[nodiscard]] Result<VkDescriptorSet> allocate(VkDescriptorSetLayout layout);
    void write(VkDescriptorSet set, std::initializer_list<Write> writes) {
        write(set, std::span(writes.begin(), writes.size()));
    }
    void write(VkDescriptorSet set, std::span<const Write> writes);

private:
    VkDevice device_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
};

} // namespace supple::host
