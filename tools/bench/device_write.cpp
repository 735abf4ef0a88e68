#include "tools/bench/device_write.h"

#include "host/vk_struct.h"

#include <algorithm>
#include <shaders/store_comp.h>

namespace supple::bench {

namespace {

using host::vkStruct;

constexpr VkDeviceSize kGroupBytes = 256 * 16; ///< of a workgroup of store.comp
constexpr uint32_t kGroupsAcross = 4096;
constexpr uint32_t kValue = 0x3F800000; // some float: nothing that a driver might know better

} // namespace

Result<std::unique_ptr<DeviceWrite>> DeviceWrite::create(host::Device& device, VkDeviceSize bytes) {
    std::unique_ptr<DeviceWrite> write(new DeviceWrite(device));
    const VkPhysicalDeviceLimits& limits = device.properties().limits;
    const VkDeviceSize groups =
        std::max<VkDeviceSize>(std::min<VkDeviceSize>(bytes, limits.maxStorageBufferRange) / kGroupBytes, 1);
    write->groupsAcross_ = static_cast<uint32_t>(std::min<VkDeviceSize>(groups, kGroupsAcross));
    write->groupsDown_ = static_cast<uint32_t>(
        std::min<VkDeviceSize>(groups / write->groupsAcross_, limits.maxComputeWorkGroupCount[1]));
    Result<host::Buffer> buffer = device.createBuffer(
        VkDeviceSize{write->groupsAcross_} * write->groupsDown_ * kGroupBytes,
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, host::MemoryKind::device);
    if (!buffer) {
        return buffer.error();
    }
    write->buffer_ = std::move(*buffer);
    VkResult result = write->createPipeline();
    if (result == VK_SUCCESS) {
        result = write->createSet();
    }
    if (result != VK_SUCCESS) {
        return host::vulkanError(result, "making what the write bandwidth is measured with");
    }
    return write;
}

VkResult DeviceWrite::createPipeline() {
    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    binding.descriptorCount = 1;
    binding.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    auto setInfo = vkStruct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    setInfo.bindingCount = 1;
    setInfo.pBindings = &binding;
    VkResult result = vkCreateDescriptorSetLayout(device_.handle(), &setInfo, nullptr, &setLayout_);
    if (result != VK_SUCCESS) {
        return result;
    }
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof kValue};
    auto layoutInfo = vkStruct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout_;
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &push;
    result = vkCreatePipelineLayout(device_.handle(), &layoutInfo, nullptr, &layout_);
    if (result != VK_SUCCESS) {
        return result;
    }
    auto moduleInfo = vkStruct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    moduleInfo.codeSize = sizeof store_comp;
    moduleInfo.pCode = store_comp;
    VkShaderModule module = VK_NULL_HANDLE;
    result = vkCreateShaderModule(device_.handle(), &moduleInfo, nullptr, &module);
    if (result != VK_SUCCESS) {
        return result;
    }
    auto info = vkStruct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage = vkStruct<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.layout = layout_;
    result = vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    vkDestroyShaderModule(device_.handle(), module, nullptr);
    return result;
}

VkResult DeviceWrite::createSet() {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
    auto poolInfo = vkStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = 1;
    poolInfo.pPoolSizes = &size;
    VkResult result = vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool_);
    if (result != VK_SUCCESS) {
        return result;
    }
    auto allocate = vkStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocate.descriptorPool = pool_;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &setLayout_;
    result = vkAllocateDescriptorSets(device_.handle(), &allocate, &set_);
    if (result != VK_SUCCESS) {
        return result;
    }
    const VkDescriptorBufferInfo whole{buffer_.handle(), 0, VK_WHOLE_SIZE};
    auto write = vkStruct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = set_;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &whole;
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    return VK_SUCCESS;
}

DeviceWrite::~DeviceWrite() {
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
    vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

void DeviceWrite::recordFill(VkCommandBuffer commands) const {
    vkCmdFillBuffer(commands, buffer_.handle(), 0, VK_WHOLE_SIZE, kValue);
}

void DeviceWrite::recordStore(VkCommandBuffer commands) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof kValue, &kValue);
    vkCmdDispatch(commands, groupsAcross_, groupsDown_, 1);
}

} // namespace supple::bench
