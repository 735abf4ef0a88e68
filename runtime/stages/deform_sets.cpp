#include "runtime/stages/deform_sets.h"

#include "shaders/shared/deform.h"

namespace supple::runtime {

using namespace supple::shared;

Status DeformSets::create(const Desc& desc) {
    const gpu::Device& device = *desc.device;
    const InstanceWindows& windows = *desc.windows;
    Status status = sets_.create(device, *desc.layout, windows.count(), "supple deform");
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size, const char* name) {
        return views_.make(device, buffer, format, offset, size, name, status);
    };
    const VkBufferView table = view(desc.table, VK_FORMAT_R32G32B32A32_UINT, 0, desc.tableBytes, "supple deform table");
    const VkBufferView list = view(desc.list, VK_FORMAT_R32_UINT, 0, desc.listBytes, "supple instances");
    for (uint32_t w = 0; w < windows.count() && status; ++w) {
        const auto range = [&](const InstanceArray& run) {
            const VkDeviceSize bytes = run.stride * gpu::kVec4Bytes;
            return VkDescriptorBufferInfo{run.buffer, windows.firstSlot(w) * bytes, windows.slots(w) * bytes};
        };
        const VkDescriptorBufferInfo source = range(desc.source);
        const gpu::BoundResource resources[] = {
            {kDeformTableBinding, {desc.table, 0, desc.tableBytes}, VK_NULL_HANDLE},
            {kDeformTableTexelBinding, {}, table},
            {kPoseBinding, source, VK_NULL_HANDLE},
            {kPoseTexelBinding,
             {},
             view(source.buffer, VK_FORMAT_R32G32B32A32_SFLOAT, source.offset, source.range, "supple poses")},
            {kDeformedCageBinding, range(desc.target), VK_NULL_HANDLE},
            {kInstanceBinding, {desc.list, 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kInstanceTexelBinding, {}, list},
        };
        if (status) {
            sets_.write(device, *desc.layout, w, resources);
        }
    }
    return status;
}

} // namespace supple::runtime
