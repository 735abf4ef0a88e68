#include "runtime/culling.h"

#include <algorithm>

namespace supple::runtime {

using namespace supple::shared;

namespace {

constexpr VkDeviceSize kBoundsBytes = 32, kStateBytes = 8, kWordBytes = 4, kElementBytes = 16;
constexpr uint32_t kDrawWords = 5;    ///< VkDrawIndexedIndirectCommand
constexpr uint32_t kOffsetWords = 64; ///< descriptor offsets need at most 256-byte alignment

} // namespace

uint32_t Culling::firstRateList() const {
    return (3 * capacity_ + kOffsetWords - 1) / kOffsetWords * kOffsetWords;
}

uint32_t Culling::rateStride() const {
    return (2 * capacity_ + kOffsetWords - 1) / kOffsetWords * kOffsetWords;
}

VkDeviceSize Culling::tableBytes() const {
    return surface::listTableBytes(windows_, arguments_.size(), draws_.size());
}

Result<Culling> Culling::create(const Desc& desc) {
    Culling culling;
    culling.device_ = desc.device;
    culling.pass_ = desc.pass;
    culling.occlusion_ = desc.occlusion;
    culling.capacity_ = desc.capacity;
    culling.windowSize_ = desc.windowSize;
    culling.windows_ = desc.windows;
    culling.listed_.resize(desc.windows);
    const auto addDispatch = [&](uint32_t elements, uint32_t perGroup, uint32_t count) {
        const auto dispatches = static_cast<uint32_t>(culling.arguments_.size());
        culling.arguments_.push_back({elements, perGroup, count, culling.headerWords() + 3 * dispatches});
    };
    for (const uint32_t elements : desc.elements) {
        addDispatch(elements, desc.device->mapping.localSize, kCountWindow);
    }
    culling.firstRate_ = desc.firstRate;
    for (uint32_t r = 0; r < desc.rates.size(); ++r) {
        culling.rateVertices_[r] = desc.rates[r].vertices;
        culling.firstDispatches_.push_back(static_cast<uint32_t>(culling.arguments_.size()));
        for (const surface::DispatchSize& dispatch : desc.rates[r].dispatches) {
            addDispatch(dispatch.elements, dispatch.perGroup, kCountRate + r);
        }
        for (const SuppleDrawRange& draw : desc.rates[r].draws) {
            culling.draws_.push_back({draw.indexCount, draw.firstIndex, draw.patchCount, r});
        }
    }
    culling.push_.vertexCount = desc.cageVertices;
    culling.push_.cageStride = desc.cageStride;
    culling.push_.margin = desc.margin;
    culling.push_.longest = desc.measure.longest;
    culling.push_.bend = desc.measure.bend;
    culling.leastVertices_ = desc.leastVertices;

    constexpr VkBufferUsageFlags kStorage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    constexpr VkBufferUsageFlags kCopied = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const VkDeviceSize n = desc.capacity;
    const VkDeviceSize words =
        culling.firstArgument() + culling.firstDraw() + kDrawWords * VkDeviceSize{culling.draws_.size()};
    gpu::BufferRequest requests[kBufferCount];
    requests[kBounds] = {"supple bounds", n * kBoundsBytes, kStorage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    requests[kStates] = {"supple visibility", n * kStateBytes, kStorage | kCopied};
    requests[kList] = {"supple instances seen", words * kWordBytes,
                       kStorage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT};
    requests[kTable] = {"supple list table", culling.tableBytes(), kStorage | kCopied};
    Result<gpu::BufferSet> buffers = gpu::BufferSet::create(*desc.device, requests, gpu::MemoryKind::deviceLocal);
    if (!buffers) {
        return buffers.error();
    }
    culling.buffers_ = std::move(*buffers);
    const Status sets = culling.createSets(desc);
    if (!sets) {
        return sets.error();
    }
    return culling;
}

Status Culling::createSets(const Desc& desc) {
    const gpu::Device& device = *device_;
    Result<gpu::DescriptorPoolHandle> pool =
        gpu::createDescriptorPool(device, pass_->layout(), windows_, "supple bounds");
    if (!pool) {
        return pool.error();
    }
    pool_ = std::move(*pool);
    Status status = success();
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size, const char* name) {
        return views_.make(device, buffer, format, offset, size, name, status);
    };
    const VkBufferView states =
        view(buffers_.buffer(kStates), VK_FORMAT_R32G32_UINT, 0, buffers_.size(kStates), "supple visibility");
    const VkBufferView hostList =
        view(desc.hostList, VK_FORMAT_R32_UINT, 0, VkDeviceSize{capacity_} * kWordBytes, "supple instances");
    const VkDeviceSize cageBytes = VkDeviceSize{desc.cageStride} * kElementBytes;
    const auto whole = [&](VkBuffer buffer) { return VkDescriptorBufferInfo{buffer, 0, VK_WHOLE_SIZE}; };
    for (uint32_t w = 0; w < windows_ && status; ++w) {
        const VkDeviceSize first = VkDeviceSize{w} * windowSize_;
        const VkDeviceSize count = std::min<VkDeviceSize>(windowSize_, capacity_ - first);
        const VkBufferView cages = view(desc.cages, VK_FORMAT_R32G32B32A32_SFLOAT, first * cageBytes, count * cageBytes,
                                        "supple deformed cage");
        const Result<VkDescriptorSet> set = gpu::allocateSet(device, pass_->layout(), pool_.get(), "supple bounds");
        if (!set) {
            return set.error();
        }
        const VkDeviceSize arguments = VkDeviceSize{firstArgument()} * kWordBytes;
        const gpu::BoundResource resources[] = {
            {kBoundsCageBinding, {desc.cages, first * cageBytes, count * cageBytes}, VK_NULL_HANDLE},
            {kBoundsCageTexelBinding, {}, cages},
            {kBoundsBinding, whole(buffers_.buffer(kBounds)), VK_NULL_HANDLE},
            {kBoundsStateBinding, whole(buffers_.buffer(kStates)), VK_NULL_HANDLE},
            {kBoundsStateTexelBinding, {}, states},
            {kHostListBinding, {desc.hostList, 0, VkDeviceSize{capacity_} * kWordBytes}, VK_NULL_HANDLE},
            {kHostListTexelBinding, {}, hostList},
            {kListBinding, {buffers_.buffer(kList), 0, arguments}, VK_NULL_HANDLE},
            {kListArgumentBinding, {buffers_.buffer(kList), arguments, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kListTableBinding, whole(buffers_.buffer(kTable)), VK_NULL_HANDLE},
            {kCullViewBinding, whole(desc.view), VK_NULL_HANDLE},
            {kSizeBinding, whole(desc.sizes), VK_NULL_HANDLE},
            {kViewWordsBinding, whole(desc.words), VK_NULL_HANDLE},
        };
        if (status) {
            gpu::writeSet(device, *set, resources);
            sets_.push_back(*set);
        }
    }
    return status && occlusion_ != nullptr ? createOcclusionSets(desc, hostList) : status;
}

Status Culling::createOcclusionSets(const Desc& desc, VkBufferView hostList) {
    Result<gpu::DescriptorPoolHandle> pool =
        gpu::createDescriptorPool(*device_, occlusion_->layout(), desc.framesInFlight, "supple occlusion");
    if (!pool) {
        return pool.error();
    }
    occlusionPool_ = std::move(*pool);
    for (uint32_t f = 0; f < desc.framesInFlight; ++f) {
        const Result<VkDescriptorSet> set =
            gpu::allocateSet(*device_, occlusion_->layout(), occlusionPool_.get(), "supple occlusion");
        if (!set) {
            return set.error();
        }
        const gpu::BoundResource resources[] = {
            {kBoundsBinding, {buffers_.buffer(kBounds), 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kBoundsStateBinding, {buffers_.buffer(kStates), 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kHostListBinding, {desc.hostList, 0, VkDeviceSize{capacity_} * kWordBytes}, VK_NULL_HANDLE},
            {kHostListTexelBinding, {}, hostList},
        };
        gpu::writeSet(*device_, *set, resources);
        occlusionSets_.push_back({*set, 0});
    }
    return success();
}

void Culling::writeTable(std::span<const InstanceSlots::Listed> windows, std::byte* target) {
    uint32_t first = 0;
    for (uint32_t w = 0; w < windows_; ++w) {
        listed_[w] = {first, windows[w].count, w * windowSize_, capacity_ + w * windowSize_};
        first += windows[w].count;
    }
    surface::writeListTable(listed_, arguments_, draws_, target);
}

void Culling::recordClear(VkCommandBuffer commandBuffer) const {
    device_->vk.CmdFillBuffer(commandBuffer, buffers_.buffer(kStates), 0, VK_WHOLE_SIZE, 0);
}

void Culling::recordBounds(VkCommandBuffer commandBuffer, std::span<const InstanceSlots::Listed> windows) const {
    BoundsPush push = push_;
    for (uint32_t w = 0; w < windows_; ++w) {
        push.instanceCount = windows[w].count;
        push.firstSlot = w * windowSize_;
        pass_->recordBounds(commandBuffer, sets_[w], push);
        push.firstEntry += windows[w].count;
    }
}

void Culling::recordOcclusion(VkCommandBuffer commandBuffer, uint64_t place, const SuppleDepthPyramidDesc& pyramid,
                              uint64_t generation, uint32_t instanceCount) {
    OcclusionSet& own = occlusionSets_[place];
    if (own.generation != generation) {
        occlusion_->writePyramid(own.set, pyramid.view, pyramid.layout);
        own.generation = generation;
    }
    OcclusionPush push{};
    std::copy_n(pyramid.viewProjection, 16, push.columns);
    push.instanceCount = instanceCount;
    push.width = pyramid.width;
    push.height = pyramid.height;
    push.levels = pyramid.levels;
    push.reversed = (pyramid.flags & SUPPLE_DEPTH_REVERSED) != 0 ? 1 : 0;
    occlusion_->record(commandBuffer, own.set, push);
}

void Culling::recordSizes(VkCommandBuffer commandBuffer, uint32_t listed) const {
    pass_->recordSizes(commandBuffer, sets_.front(), {0, listed, leastVertices_});
}

void Culling::recordList(VkCommandBuffer commandBuffer, uint32_t room) const {
    ListPush push{};
    push.room = room;
    push.levels = levelOffset();
    push.windowCount = windows_;
    push.argumentCount = static_cast<uint32_t>(arguments_.size());
    push.argumentStride = argumentStride();
    pass_->recordList(commandBuffer, sets_.front(), push);
}

void Culling::recordDemand(VkCommandBuffer commandBuffer, uint32_t listed) const {
    DemandPush push{};
    push.instanceCount = listed;
    push.rateCount = rateCount();
    push.firstRate = firstRate_;
    std::ranges::copy(rateVertices_, push.vertices);
    pass_->recordDemand(commandBuffer, sets_.front(), push);
}

void Culling::recordRates(VkCommandBuffer commandBuffer, bool counted) const {
    RatesPush push{};
    push.windowCount = windows_;
    push.argumentCount = static_cast<uint32_t>(arguments_.size());
    push.argumentStride = argumentStride();
    push.rateCount = rateCount();
    push.firstRate = firstRate_;
    push.rateLists = firstRateList();
    push.rateStride = rateStride();
    push.rateCounts = firstRateCount();
    push.firstDraw = firstDraw();
    push.drawCount = static_cast<uint32_t>(draws_.size());
    push.counted = counted ? 1 : 0;
    std::ranges::copy(rateVertices_, push.vertices);
    pass_->recordRates(commandBuffer, sets_.front(), push);
}

surface::Window Culling::window(uint32_t window, VkDescriptorSet set) const {
    const uint32_t count = firstArgument() + kListHeaderWords * (1 + window);
    return {set, capacity_ + window * windowSize_, count | kCountOnDevice, buffers_.buffer(kList),
            VkDeviceSize{firstArgument() + headerWords() + argumentStride() * window} * kWordBytes};
}

surface::Window Culling::window(uint32_t window, VkDescriptorSet set, uint32_t rate) const {
    const uint32_t count = firstArgument() + firstRateCount() + rate * windows_ + window;
    return {set, firstRateList() + rate * rateStride() + capacity_ + window * windowSize_, count | kCountOnDevice,
            buffers_.buffer(kList),
            VkDeviceSize{firstArgument() + headerWords() + argumentStride() * window + 3 * firstDispatches_[rate]} *
                kWordBytes};
}

VkDeviceSize Culling::rateListOffset(uint32_t rate) const {
    return VkDeviceSize{firstRateList() + rate * rateStride()} * kWordBytes;
}

VkDeviceSize Culling::drawOffset() const {
    return VkDeviceSize{firstArgument() + firstDraw()} * kWordBytes;
}

} // namespace supple::runtime
