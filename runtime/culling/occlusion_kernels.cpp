#include "runtime/culling/occlusion_kernels.h"

#include "shaders/bounds_occlude_comp.h"

namespace supple::runtime {

using namespace supple::shared;

static_assert(sizeof(OcclusionPush) <= gpu::kPushConstantBytes);

Result<OcclusionKernels> OcclusionKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    const gpu::Binding bindings[] = {
        {kBoundsBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kBoundsStateBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kHostListBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {kHostListTexelBinding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
        {kPyramidBinding, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
    };
    OcclusionKernels made;
    made.device_ = &device;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::create(device, bindings, sizeof(OcclusionPush), "supple occlusion");
    if (!layout) {
        return layout.error();
    }
    made.layout_ = std::move(*layout);
    made.pipelines_ = &pipelines;
    return made;
}

Result<gpu::Kernel> OcclusionKernels::make() const {
    return pipelines_->get(layout_, bounds_occlude_comp, {}, "supple occlusion");
}

Status OcclusionKernels::prepare() {
    const Result<gpu::Kernel> made = make();
    kernel_ = made ? *made : kernel_;
    return made ? success() : made.error();
}

void OcclusionKernels::writePyramid(VkDescriptorSet set, VkImageView pyramid, VkImageLayout imageLayout) const {
    const VkDescriptorImageInfo image{VK_NULL_HANDLE, pyramid, imageLayout};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.dstBinding = kPyramidBinding;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    write.pImageInfo = &image;
    device_->vk.UpdateDescriptorSets(device_->handle, 1, &write, 0, nullptr);
}

void OcclusionKernels::record(VkCommandBuffer commandBuffer, VkDescriptorSet set, const OcclusionPush& push) const {
    if (push.instanceCount == 0) {
        return;
    }
    gpu::bind(*device_, commandBuffer, kernel_, set, push);
    const uint32_t local = device_->mapping.localSize;
    gpu::dispatchLinear(*device_, commandBuffer, (push.instanceCount + local - 1) / local);
}

} // namespace supple::runtime
