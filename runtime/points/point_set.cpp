#include "runtime/points/point_set.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace supple::runtime {

using namespace supple::shared;

namespace {

constexpr VkDeviceSize kPastBytes = 16;
/// Descriptor offsets need at most this alignment.
constexpr VkDeviceSize kOffsetAlignment = 256;

/// A range of a buffer as a descriptor takes it, and the element of 16 bytes in it where the range begins.
struct AlignedRange {
    VkDescriptorBufferInfo info{};
    uint32_t first = 0;
};
AlignedRange alignedRange(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize bytes) {
    const VkDeviceSize before = offset % kOffsetAlignment;
    return {{buffer, offset - before, bytes + before}, static_cast<uint32_t>(before / gpu::kVec4Bytes)};
}

uint32_t bytesOf(SupplePointFormat format) {
    return static_cast<uint32_t>(gpu::kVec4Bytes) * shared::pointElements(format);
}
/// What a descriptor reaches behind the alignment of its offset.
VkDeviceSize roomOf(const gpu::Device& device) {
    const VkDeviceSize limit = device.limits.maxStorageBufferRange;
    return limit - std::min(limit, kOffsetAlignment);
}

} // namespace

Result<PointTableBuffer> makePointTable(const gpu::Device& device, std::vector<uint32_t> words,
                                        VertexPoints onVertices) {
    std::vector<gpu::StaticRequest> requests;
    const auto add = [&](const char* name, VkBufferUsageFlags usage, std::vector<uint32_t> own) {
        const auto keeper = std::make_shared<const std::vector<uint32_t>>(std::move(own));
        requests.push_back(
            {name, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | usage, std::as_bytes(std::span(*keeper)), keeper});
    };
    add("supple points table", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, std::move(words));
    if (!onVertices.runs.empty()) {
        add("supple points on vertices", 0, std::move(onVertices.words));
    }
    Result<gpu::StaticBuffers> made = gpu::StaticBuffers::create(device, requests);
    if (!made) {
        return made.error();
    }
    return std::make_shared<PointTable>(PointTable{std::move(*made), std::move(onVertices.runs)});
}

uint64_t mostTableElements(const gpu::Device& device) {
    return device.mapping.wide ? device.limits.maxStorageBufferRange / gpu::kVec4Bytes
                               : device.limits.maxTexelBufferElements;
}

Status PointSet::check(const PointSource& source, uint32_t points, SupplePointFormat format) {
    const VkDeviceSize stride = bytesOf(format), room = roomOf(*source.device);
    if (points * stride > room) {
        return Error{ErrorCode::limit, std::to_string(points) +
                                           " points exceed the device's storage-buffer range: the most is " +
                                           std::to_string(room / stride)};
    }
    const uint32_t instances = source.listing->windows().size;
    if (uint64_t{points} * instances > std::numeric_limits<uint32_t>::max()) {
        return Error{ErrorCode::limit, std::to_string(points) + " points of " + std::to_string(instances) +
                                           " instances are more than 32 bits number"};
    }
    return success();
}

Result<std::shared_ptr<PointSet>> PointSet::create(const PointSource& source, PointKernels& kernels, PointRecipe recipe,
                                                   PointTableBuffer table, uint64_t group) {
    auto set = std::make_shared<PointSet>();
    set->source_ = source;
    set->kernels_ = &kernels;
    set->recipe_ = std::move(recipe);
    set->table_ = std::move(table);
    set->group_ = group;
    set->findReaches();
    Status status = set->createBuffers();
    status = status ? set->createSets() : status;
    status = status && set->recipe_.onVertices ? set->createCopies() : status;
    if (!status) {
        return status.error();
    }
    return set;
}

void PointSet::findReaches() {
    const InstanceWindows& windows = source_.listing->windows();
    const uint64_t fit = roomOf(*source_.device) / (VkDeviceSize{pointCount()} * bytesOf(recipe_.format));
    for (uint32_t w = 0; w < windows.count(); ++w) {
        for (uint32_t first = 0; first < windows.slots(w);) {
            const auto count = static_cast<uint32_t>(std::min<uint64_t>(fit, windows.slots(w) - first));
            reaches_.push_back({w, first, count, 0, 0});
            first += count;
        }
    }
}

Status PointSet::createBuffers() {
    const VkDeviceSize points = VkDeviceSize{pointCount()} * source_.listing->windows().capacity;
    constexpr VkBufferUsageFlags kUse = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const gpu::BufferRequest requests[] = {
        {"supple points", points * bytesOf(recipe_.format),
         kUse | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
             VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
         gpu::MemoryPurpose::streams},
        {"supple points before", hasPasts() ? points * kPastBytes : 0, kUse, gpu::MemoryPurpose::streams},
    };
    Result<gpu::BufferSet> made = gpu::BufferSet::create(*source_.device, requests, gpu::MemoryKind::deviceLocal);
    if (!made) {
        return made.error();
    }
    output_ = std::move(*made);
    clear_.add(*source_.device, gpu::PlannedBuffer(output_, 0));
    if (hasPasts()) {
        clear_.add(*source_.device, gpu::PlannedBuffer(output_, 1));
    }
    return success();
}

PointSet::Written PointSet::writtenOf(const Reach& reach) const {
    const VkDeviceSize pointBytes = VkDeviceSize{pointCount()} * bytesOf(recipe_.format),
                       pastBytes = VkDeviceSize{pointCount()} * kPastBytes,
                       slot = source_.listing->windows().firstSlot(reach.window) + reach.firstSlot;
    const AlignedRange points = alignedRange(output_.buffer(0), slot * pointBytes, reach.slotCount * pointBytes);
    // Formats that have no past never look at it.
    const AlignedRange pasts =
        hasPasts() ? alignedRange(output_.buffer(1), slot * pastBytes, reach.slotCount * pastBytes) : points;
    return {points.info, pasts.info, points.first, pasts.first};
}

Status PointSet::createCopies() {
    std::vector<VertexCopies::Target> targets;
    for (const Reach& reach : reaches_) {
        const Written written = writtenOf(reach);
        targets.push_back({written.points, written.pasts, reach.window});
    }
    const VkBuffer entries = table_->runs.empty() ? VK_NULL_HANDLE : table_->buffers.buffer(1);
    copies_.emplace(
        VertexCopies::Source{source_.device, kernels_, source_.surfaces, source_.listing, entries, table_->runs},
        std::move(targets));
    return copies_->bind();
}

void PointSet::unbindVertices() {
    if (copies_) {
        copies_->unbind();
    }
}

Status PointSet::createSets() {
    const gpu::Device& device = *source_.device;
    const InstanceWindows& windows = source_.listing->windows();
    const VkBuffer list = source_.listing->buffer().buffer();
    const VkDeviceSize listBytes = source_.listing->passBytes(),
                       cageBytes = VkDeviceSize{source_.cageStride} * gpu::kVec4Bytes;
    const gpu::StaticBuffers& tables = table_->buffers;
    Status status = sets_.create(device, kernels_->layout(), static_cast<uint32_t>(reaches_.size()), "supple points");
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size, const char* name) {
        return views_.make(device, buffer, format, offset, size, name, status);
    };
    const VkBufferView table = view(tables.buffer(0), gpu::kUint4, 0, tables.size(0), "supple points table");
    const VkBufferView instances = view(list, VK_FORMAT_R32_UINT, 0, listBytes, "supple instances");
    for (size_t r = 0; r < reaches_.size() && status; ++r) {
        Reach& reach = reaches_[r];
        const Written written = writtenOf(reach);
        reach.firstElement = written.firstElement;
        reach.firstPast = written.firstPast;
        const VkDeviceSize firstCage = windows.firstSlot(reach.window) * cageBytes,
                           cages = windows.slots(reach.window) * cageBytes;
        const gpu::BoundResource resources[] = {
            {kPointTableBinding, {tables.buffer(0), 0, tables.size(0)}, VK_NULL_HANDLE},
            {kPointTableTexelBinding, {}, table},
            {kPointCageBinding, {source_.cages, firstCage, cages}, VK_NULL_HANDLE},
            {kPointCageTexelBinding, {}, view(source_.cages, gpu::kFloat4, firstCage, cages, "supple deformed cage")},
            {kPointBinding, written.points, VK_NULL_HANDLE},
            {kPointPastBinding, written.pasts, VK_NULL_HANDLE},
            {kInstanceBinding, {list, 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kInstanceTexelBinding, {}, instances},
        };
        if (status) {
            sets_.write(device, kernels_->layout(), r, resources);
        }
    }
    return status;
}

void PointSet::fill(SupplePointOutput& out) const {
    out.format = recipe_.format;
    out.pointCount = pointCount();
    out.frames = {output_.buffer(0), 0, output_.size(0), bytesOf(recipe_.format)};
}

gpu::MemoryUse PointSet::memoryUse() const {
    gpu::MemoryUse use = output_.use();
    use += table_->buffers.use();
    return use;
}

gpu::TaskNeeds PointSet::taskNeeds() const {
    const uint32_t sets = static_cast<uint32_t>(reaches_.size()) + (copies_ ? copies_->count() : 0);
    return {sets, sets};
}

PointPush PointSet::pushOf(const Reach& reach) const {
    const InstanceWindows& windows = source_.listing->windows();
    PointPush push{};
    push.pointCount = pointCount();
    push.firstInstance = windows.firstEntry(reach.window);
    push.instanceCount = windows.listed[reach.window].count;
    push.cageStride = source_.cageStride;
    push.firstSlot = reach.firstSlot;
    push.slotCount = reach.slotCount;
    push.firstElement = reach.firstElement;
    push.firstPast = reach.firstPast;
    return push;
}

PassCost PointSet::record(gpu::Dispatches& dispatches, uint64_t frame, const glm::vec3& pastStep) {
    if (staticsPending()) {
        return {};
    }
    isFirst_ = first_.due();
    first_.record(frame);
    lastRecordedFrame_ = frame;
    const InstanceWindows& windows = source_.listing->windows();
    for (size_t r = 0; r < reaches_.size(); ++r) {
        PointPush push = pushOf(reaches_[r]);
        push.isFirst = isFirst_ ? 1 : 0;
        push.pastX = pastStep.x;
        push.pastY = pastStep.y;
        push.pastZ = pastStep.z;
        if (push.instanceCount > 0) {
            kernels_->record(dispatches, sets_[r], recipe_.format, push);
        }
    }
    const uint64_t points = uint64_t{pointCount()} * windows.visible;
    return {points, points * (bytesOf(recipe_.format) + (hasPasts() ? kPastBytes : 0))};
}

PassCost PointSet::recordCopies(gpu::Dispatches& dispatches) const {
    if (staticsPending() || !copiesVertices()) {
        return {};
    }
    for (size_t r = 0; r < reaches_.size(); ++r) {
        const PointPush own = pushOf(reaches_[r]);
        VertexPointPush push{};
        push.pointCount = own.pointCount;
        push.firstInstance = own.firstInstance;
        push.instanceCount = own.instanceCount;
        push.firstSlot = own.firstSlot;
        push.slotCount = own.slotCount;
        push.firstElement = own.firstElement;
        push.firstPast = own.firstPast;
        push.isFirst = isFirst_ ? 1 : 0;
        if (push.instanceCount > 0) {
            copies_->record(dispatches, r, recipe_.format, push);
        }
    }
    const uint64_t points = copies_->points() * source_.listing->windows().visible;
    return {points, points * (sizeof(glm::vec3) + (hasPasts() ? kPastBytes : 0))};
}

VkDeviceSize PointSet::recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) {
    if (!staticsPending()) {
        return 0;
    }
    lastRecordedFrame_ = frame;
    return table_->buffers.recordStatics(commandBuffer, frame) + clear_.recordStatics(commandBuffer, frame);
}

void PointSet::recordWarmUp(VkCommandBuffer commandBuffer) const {
    gpu::OwnDispatches dispatches(*source_.device, commandBuffer);
    dispatches->computeBarrier();
    kernels_->record(*dispatches, sets_[0], recipe_.format, {}); // of no instances
    if (copies_) {
        copies_->recordWarmUp(*dispatches, recipe_.format);
    }
}

void PointSet::cancelFrame(uint64_t frame) {
    table_->buffers.cancelFrame(frame);
    clear_.cancelFrame(frame);
    first_.cancelFrame(frame);
}

} // namespace supple::runtime
