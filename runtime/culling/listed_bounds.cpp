#include "runtime/culling/listed_bounds.h"

namespace supple::runtime {

using namespace supple::shared;

namespace {

constexpr VkDeviceSize kViewBytes = 256; ///< descriptor offsets need at most 256-byte alignment
static_assert(sizeof(CullView) <= kViewBytes);

} // namespace

void ListedBounds::plan(gpu::BufferPlan& device) {
    constexpr VkBufferUsageFlags kStorage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    const VkDeviceSize n = desc_.windows->capacity;
    bounds_ = device.add({"supple bounds", n * kBoundsBytes, kStorage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    rest_ = device.add(
        {"supple bounds, no view", kViewBytes + n * kStateBytes, kStorage | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
}

Status ListedBounds::createSets(VkBuffer cages, VkBuffer list) {
    const gpu::Device& device = *desc_.device;
    clear_.add(device, rest_);
    addMember(clear_);
    const gpu::ComputeLayout& layout = desc_.kernels->boundsLayout();
    const InstanceWindows& windows = *desc_.windows;
    Status status = sets_.create(device, layout, windows.count(), "supple bounds");
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size, const char* name) {
        return views_.make(device, buffer, format, offset, size, name, status);
    };
    const VkDeviceSize listBytes = VkDeviceSize{windows.capacity} * sizeof(uint32_t);
    const VkDeviceSize cageBytes = VkDeviceSize{desc_.cageStride} * gpu::kVec4Bytes;
    const VkBufferView listView = view(list, VK_FORMAT_R32_UINT, 0, listBytes, "supple instances");
    for (uint32_t w = 0; w < windows.count() && status; ++w) {
        const VkDeviceSize first = windows.firstSlot(w) * cageBytes, bytes = windows.slots(w) * cageBytes;
        const gpu::BoundResource resources[] = {
            {kBoundsCageBinding, {cages, first, bytes}, VK_NULL_HANDLE},
            {kBoundsCageTexelBinding,
             {},
             view(cages, VK_FORMAT_R32G32B32A32_SFLOAT, first, bytes, "supple deformed cage")},
            {kBoundsBinding, {bounds_.buffer(), 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kBoundsStateBinding, {rest_.buffer(), kViewBytes, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kHostListBinding, {list, 0, listBytes}, VK_NULL_HANDLE},
            {kHostListTexelBinding, {}, listView},
            {kCullViewBinding, {rest_.buffer(), 0, kViewBytes}, VK_NULL_HANDLE},
            {kWantedBinding, {rest_.buffer(), kViewBytes, VK_WHOLE_SIZE}, VK_NULL_HANDLE}, // nothing is noted
        };
        if (status) {
            sets_.write(device, layout, w, resources);
        }
    }
    return status;
}

SuppleBufferRange ListedBounds::bounds() const {
    return {bounds_.buffer(), 0, bounds_.size(), static_cast<uint32_t>(kBoundsBytes)};
}

PassCost ListedBounds::record(gpu::Dispatches& dispatches) const {
    const InstanceWindows& windows = *desc_.windows;
    BoundsPush push{};
    push.vertexCount = desc_.cageVertices;
    push.cageStride = desc_.cageStride;
    push.margin = desc_.margin;
    for (uint32_t w = 0; w < windows.count(); ++w) {
        push.instanceCount = windows.listed[w].count;
        push.firstSlot = windows.firstSlot(w);
        if (windows.drawCount() > 1) { // each window has a place of its own in the list
            push.firstEntry = windows.firstDrawnSlot(w);
        }
        desc_.kernels->recordBounds(dispatches, sets_[w], push);
        push.firstEntry += push.instanceCount;
    }
    return {windows.visible, windows.visible * kBoundsBytes};
}

} // namespace supple::runtime
