#include "runtime/instance_set.h"

#include <algorithm>

namespace supple::runtime {

namespace {

// Descriptor offsets need at most 256-byte alignment (VkPhysicalDeviceLimits). Deformed cages start on such multiples,
// and so do poses if there is more than one window.
constexpr uint32_t kCagePadding = 16;
constexpr uint32_t kPosePadding = 16;

} // namespace

Result<std::unique_ptr<InstanceSet>> InstanceSet::create(const Desc& desc) {
    auto set = std::make_unique<InstanceSet>();
    set->desc_ = desc;
    set->cageStride_ = cageStrideOf(desc.asset->character.cage.vertexCount());
    Status status = success();
    if (desc.source != SUPPLE_POSES_CAGE_BUFFER) {
        status = desc.deform->prepare(desc.mode, desc.asset->firstInfluences != 0);
    }
    if (status && desc.source == SUPPLE_POSES_PLAYBACK) {
        status = desc.pose->prepare(desc.mode);
        status = status ? desc.asset->makeClips(*desc.device) : status;
    }
    status = status ? set->layOutWindows() : status;
    if (!status) {
        return status.error();
    }
    set->slots_ = InstanceSlots(desc.capacity, desc.firstGeneration, desc.partPatches);
    set->windows_.parts.resize(desc.listsParts ? desc.partPatches.size() : 0);
    set->poses_ = makePoseSource(
        desc.source, {desc.device, desc.pose, desc.asset, set->layout_, desc.capacity, desc.framesInFlight});
    return set;
}

uint32_t InstanceSet::cageStrideOf(uint32_t cageVertices) {
    return (cageVertices + kCagePadding - 1) / kCagePadding * kCagePadding;
}

Status InstanceSet::layOutWindows() {
    const gpu::Device& device = *desc_.device;
    const uint32_t capacity = desc_.capacity;
    layout_ = poseLayoutOf(*desc_.asset, desc_.mode, 1);
    const VkDeviceSize texelLimit = device.bufferWindow(16), storageLimit = device.limits.maxStorageBufferRange;
    const VkDeviceSize largest = std::max(VkDeviceSize{cageStride_} * gpu::kVec4Bytes, desc_.surface.texels);
    VkDeviceSize fit = texelLimit / std::max(largest, poseWindowBytes(desc_.source, *desc_.asset, layout_));
    if (desc_.surface.storage > 0) {
        fit = std::min(fit, storageLimit / desc_.surface.storage);
    }
    if (fit < capacity) {
        layout_ = poseLayoutOf(*desc_.asset, desc_.mode, kPosePadding);
        fit = std::min<VkDeviceSize>(fit, texelLimit / (layout_.stride * gpu::kVec4Bytes));
    }
    if (!device.mapping.wide && uint64_t{desc_.lists} * capacity > device.limits.maxTexelBufferElements) {
        return Error{ErrorCode::limit,
                     std::to_string(capacity) + " instances exceed the device's texel-buffer elements"};
    }
    if (fit == 0) {
        return Error{ErrorCode::limit, "one instance exceeds the device's storage-buffer range of " +
                                           std::to_string(storageLimit) + " bytes"};
    }
    windows_.capacity = capacity;
    windows_.size = static_cast<uint32_t>(std::min<VkDeviceSize>(fit, capacity));
    windows_.listed.resize((capacity + windows_.size - 1) / windows_.size);
    return success();
}

void InstanceSet::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging) {
    constexpr VkBufferUsageFlags kInput = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                          VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                          VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const VkDeviceSize n = desc_.capacity;
    const bool deforms = desc_.source != SUPPLE_POSES_CAGE_BUFFER;
    palettes_ = device.add(
        {"supple poses", deforms ? n * layout_.stride * gpu::kVec4Bytes : 0, kInput, gpu::MemoryPurpose::poses});
    cages_ = device.add({"supple deformed cage", n * cageStride_ * gpu::kVec4Bytes,
                         kInput | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, gpu::MemoryPurpose::cages});
    const VkDeviceSize listBytes = passListBytes() + windows_.parts.size() * n * sizeof(uint32_t);
    list_ = device.add({"supple instances", listBytes, kInput});
    lists_.plan(staging, "supple list staging", listBytes, desc_.framesInFlight);
    poses_->plan(staging);
}

Status InstanceSet::createSets() {
    Status status = poses_->create({palettes_.buffer(), list_.buffer(), passListBytes(), windows_.size});
    if (!status || palettes_.buffer() == VK_NULL_HANDLE) {
        return status;
    }
    return deformSets_.create({desc_.device,
                               &desc_.deform->layout(),
                               &windows_,
                               desc_.asset->buffers.buffer(0),
                               desc_.asset->buffers.size(0),
                               {palettes_.buffer(), layout_.stride},
                               {cages_.buffer(), cageStride_},
                               list_.buffer(),
                               passListBytes()});
}

void InstanceSet::fill(SuppleGroupInfo& output) const {
    const auto whole = [](const gpu::PlannedBuffer& buffer, uint32_t stride) {
        return SuppleBufferRange{buffer.buffer(), 0, buffer.size(), stride};
    };
    output.capacity = desc_.capacity;
    output.cageVertexCount = desc_.asset->character.cage.vertexCount();
    output.cageVerticesPerInstance = cageStride_;
    output.deformedCage = whole(cages_, 16);
    output.poses = whole(palettes_, layout_.stride * 16);
}

void InstanceSet::addTransfers(Transfers& transfers) const {
    if (!deformSets_.empty()) {
        transfers.add(cages_.buffer());
    }
    // What the host writes on the device is its own to hand over.
    if (desc_.source == SUPPLE_POSES_SET || desc_.source == SUPPLE_POSES_PLAYBACK) {
        transfers.add(palettes_.buffer());
    }
    transfers.add(list_.buffer());
}

PassCost InstanceSet::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, Visibility& visibility) {
    const gpu::Device& device = *desc_.device;
    PassCost cost = poses_->recordUpload(commandBuffer, frame, slots_.end());
    const bool listed = slots_.changed();
    if (listed) {
        const std::span entries(reinterpret_cast<uint32_t*>(lists_.next()), list_.size() / sizeof(uint32_t));
        const uint32_t n = windows_.capacity;
        visibility.list(slots_, {entries.first(n), entries.subspan(n, n), entries.subspan(windows_.firstPartEntry())},
                        windows_);
    }
    if (listed || desc_.handsOver) {
        const auto copy = [&](VkDeviceSize first, VkDeviceSize count) {
            const VkDeviceSize at = first * sizeof(uint32_t);
            cost.bytes += lists_.recordCopy(device, commandBuffer, at, list_.buffer(), at, count * sizeof(uint32_t));
        };
        copy(0, windows_.visible);
        windows_.forEach([&](uint32_t w) { copy(windows_.firstEntry(w), windows_.listed[w].count); });
        copy(windows_.firstPartEntry(), windows_.partEntries);
        cost.bytes += visibility.recordUpload(commandBuffer);
    }
    return cost;
}

void InstanceSet::recordWarmUp(VkCommandBuffer commandBuffer) const {
    poses_->recordWarmUp(commandBuffer);
    if (!deformSets_.empty()) {
        gpu::computeBarrier(*desc_.device, commandBuffer);
        shared::DeformPush push{}; // of no instances
        push.firstInfluences = desc_.asset->firstInfluences;
        desc_.deform->record(commandBuffer, deformSets_[0], layout_.mode, push);
    }
}

PassCost InstanceSet::recordDeform(VkCommandBuffer commandBuffer) const {
    if (deformSets_.empty()) {
        return {};
    }
    const uint32_t vertices = desc_.asset->character.cage.vertexCount();
    windows_.forEach([&](uint32_t w) {
        desc_.deform->record(commandBuffer, deformSets_[w], layout_.mode,
                             {vertices, windows_.firstEntry(w), windows_.listed[w].count, layout_.stride, cageStride_,
                              layout_.morphWeights, desc_.asset->firstInfluences});
    });
    const uint64_t points = uint64_t{vertices} * windows_.visible;
    return {points, points * gpu::kVec4Bytes};
}

} // namespace supple::runtime
