#include "runtime/queries/query_tree.h"

#include <algorithm>
#include <string>

namespace supple::runtime {

using namespace supple::shared;

namespace {

/// Two nodes a piece, of two elements.
constexpr VkDeviceSize kTreeBytesPerPiece = VkDeviceSize{4} * gpu::kVec4Bytes;
/// Trees that are there at a time take no more, unless one alone is larger: all of a crowd would be hundreds of
/// megabytes.
constexpr VkDeviceSize kMostTreeBytes = VkDeviceSize{64} << 20;

} // namespace

Result<QueryTree::Plan> QueryTree::planFor(const gpu::Device& device, uint32_t pieceCount, uint32_t windowSize) {
    const VkDeviceSize texels =
        device.mapping.wide ? VK_WHOLE_SIZE : VkDeviceSize{device.limits.maxTexelBufferElements} * gpu::kVec4Bytes;
    const VkDeviceSize bindable = std::min<VkDeviceSize>(device.limits.maxStorageBufferRange, texels);
    const VkDeviceSize each = std::max<VkDeviceSize>(pieceCount, 1) * kTreeBytesPerPiece;
    if (each > bindable) {
        return Error{ErrorCode::limit, "a tree over its " + std::to_string(pieceCount) + " pieces takes " +
                                           std::to_string(each) + " bytes: the device binds " +
                                           std::to_string(bindable)};
    }
    const VkDeviceSize most = std::max<VkDeviceSize>(std::min(kMostTreeBytes, bindable) / each, 1);
    Plan plan;
    plan.count = static_cast<uint32_t>(std::min<VkDeviceSize>(most, windowSize));
    plan.turns = (windowSize + plan.count - 1) / plan.count;
    return plan;
}

Status QueryTree::create(const gpu::Device& device, const TreeKernels& kernels, uint32_t pieceCount, Plan plan,
                         uint32_t windowCount) {
    plan_ = plan;
    kernels_ = &kernels;
    const VkDeviceSize bytes = std::max(pieceCount, 1u) * kTreeBytesPerPiece * plan.count;
    const gpu::BufferRequest request{"supple query trees", bytes,
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT, // for tests
                                     gpu::MemoryPurpose::scratch};
    Result<gpu::BufferSet> made = gpu::BufferSet::create(device, {&request, 1}, gpu::MemoryKind::deviceLocal);
    if (!made) {
        return made.error();
    }
    nodes_ = std::move(*made);
    Status status = sets_.create(device, kernels.layout(), windowCount, "supple queries, trees");
    texels_ = views_.make(device, nodes(), gpu::kFloat4, 0, bytes, "supple query trees", status);
    return status;
}

void QueryTree::write(const gpu::Device& device, uint32_t window, std::span<const gpu::BoundResource> resources) {
    sets_.write(device, kernels_->layout(), window, resources);
    const gpu::BoundResource own[] = {{kTreeBinding, {nodes(), 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
                                      {kTreeTexelBinding, {}, texels_}};
    sets_.write(device, kernels_->layout(), window, own);
}

void QueryTree::record(gpu::Dispatches& dispatches, TreeKernels::Pass pass, uint32_t window, const QueryPush& push,
                       VkBuffer sizes) const {
    kernels_->record(dispatches, pass, sets_[window], push, sizes,
                     push.firstDispatch + 1 + kTreeDispatches * push.turn);
}

} // namespace supple::runtime
