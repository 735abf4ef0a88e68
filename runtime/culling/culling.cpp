#include "runtime/culling/culling.h"

#include "shaders/shared/surface.h"

#include <algorithm>

namespace supple::runtime {

using namespace supple::shared;

namespace {

constexpr VkDeviceSize kWordBytes = 4;
constexpr uint32_t kDrawWords = 5;    ///< VkDrawIndexedIndirectCommand
constexpr uint32_t kOffsetWords = 64; ///< descriptor offsets need at most 256-byte alignment

VkDescriptorBufferInfo whole(VkBuffer buffer) {
    return {buffer, 0, VK_WHOLE_SIZE};
}

} // namespace

uint32_t Culling::firstPool() const {
    const uint32_t capacity = windows_->capacity,
                   first = firstMask(capacity) + DrawnParts::wordsOf(partCount()) * capacity;
    return first + first % 2; // harness.glsl tells a slot's two words apart by the lowest bit
}

uint32_t Culling::firstRateList() const {
    return (firstConstructed() + windows_->capacity + kOffsetWords - 1) / kOffsetWords * kOffsetWords;
}

uint32_t Culling::stateStride() const {
    constexpr uint32_t kSlots = kOffsetWords * kWordBytes / kStateBytes;
    return (windows_->capacity + kSlots - 1) / kSlots * kSlots;
}

uint32_t Culling::rateStride() const {
    return ((2 + partCount()) * windows_->capacity + kOffsetWords - 1) / kOffsetWords * kOffsetWords;
}

void Culling::add(const Surface& surface) {
    const auto add = [&](const surface::DispatchSize& size, uint32_t count) {
        const auto target = headerWords() + 3 * static_cast<uint32_t>(arguments_.size());
        arguments_.push_back({size.elements, size.perGroup, count, target});
    };
    Place place{static_cast<uint32_t>(arguments_.size()), {}, static_cast<uint32_t>(draws_.size())};
    place.coefficients = surface.coefficients;
    place.firstCoefficient = kPoolUnit * instanceUnits_;
    instanceUnits_ += (surface.coefficients + kPoolUnit - 1) / kPoolUnit;
    for (uint32_t i = 0; i < surface.sizes.size(); ++i) {
        add(surface.sizes[i], i < surface.constructions ? kCountConstructed : kCountWindow);
    }
    for (uint32_t r = 0; r < surface.rates.size(); ++r) {
        const Rate& rate = surface.rates[r];
        rateVertices_[r] += rate.vertices;
        place.firstRateArguments.push_back(static_cast<uint32_t>(arguments_.size()));
        for (const surface::DispatchSize& size : rate.sizes) {
            add(size, kCountRate + r);
        }
        for (const SuppleDrawRange& draw : rate.draws) {
            draws_.push_back({draw.indexCount, draw.firstIndex, draw.patchCount, r});
            drawParts_.push_back(draw.part);
        }
    }
    places_.push_back(std::move(place));
    push_.margin = std::max(push_.margin, surface.margin);
    push_.longest = std::max(push_.longest, surface.measure.longest);
    push_.bend = std::max(push_.bend, surface.measure.bend);
    rateCount_ = std::max(rateCount_, static_cast<uint32_t>(surface.rates.size()));
}

std::unique_ptr<Culling> Culling::create(Desc desc, std::span<const Surface> surfaces) {
    auto culling = std::make_unique<Culling>();
    culling->device_ = desc.device;
    culling->kernels_ = desc.kernels;
    culling->occlusion_ = desc.occlusion;
    culling->windows_ = desc.windows;
    culling->framesInFlight_ = desc.framesInFlight;
    culling->listed_.resize(desc.windows->count());
    culling->firstRate_ = desc.firstRate;
    culling->poolUnits_ = desc.poolUnits;
    culling->push_.vertexCount = desc.cageVertices;
    culling->push_.cageStride = desc.cageStride;
    culling->drawnParts_ = desc.parts;
    culling->leader_ = desc.leader;
    culling->place_ = std::move(desc.place);
    culling->push_.wanted = culling->place_.number() ? 1 : 0;
    culling->parts_.resize(desc.parts->count());
    for (const Surface& own : surfaces) {
        culling->add(own);
    }
    return culling;
}

void Culling::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging) {
    constexpr VkBufferUsageFlags kStorage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    constexpr VkBufferUsageFlags kCopied = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const VkDeviceSize n = windows_->capacity;
    const VkDeviceSize words = firstArgument() + firstDraw() + kDrawWords * VkDeviceSize{draws_.size()};
    const VkDeviceSize tableBytes = listTableBytes(windows_->count(), arguments_.size(), draws_.size(), parts_.size());
    bounds_ = device.add({"supple bounds", n * kBoundsBytes, kStorage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    states_ = device.add({"supple visibility", kStateRuns * stateStride() * kStateBytes, kStorage | kCopied});
    list_ = device.add({"supple instances seen", words * kWordBytes,
                        kStorage | kCopied | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT});
    table_ = device.add({"supple list table", tableBytes, kStorage | kCopied});
    tables_.plan(staging, "supple list table staging", tableBytes, framesInFlight_);
    masks_.plan(staging, "supple parts staging", n * DrawnParts::wordsOf(parts_.size()) * kWordBytes, framesInFlight_);
}

Status Culling::createSets(const Buffers& buffers) {
    clear_.add(*device_, states_);
    addMember(clear_);
    Status status = boundsSets_.create(*device_, kernels_->boundsLayout(), windows_->count(), "supple bounds");
    status = status ? listSets_.create(*device_, kernels_->listLayout(), 1, "supple list") : status;
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size, const char* name) {
        return views_.make(*device_, buffer, format, offset, size, name, status);
    };
    const VkDeviceSize hostListBytes = VkDeviceSize{windows_->capacity} * kWordBytes;
    const VkDeviceSize arguments = VkDeviceSize{firstArgument()} * kWordBytes;
    const VkDeviceSize cageBytes = VkDeviceSize{push_.cageStride} * gpu::kVec4Bytes;
    std::vector<gpu::BoundResource> resources = {
        {kBoundsBinding, whole(bounds_.buffer()), VK_NULL_HANDLE},
        {kBoundsStateBinding, whole(states_.buffer()), VK_NULL_HANDLE},
        {kBoundsStateTexelBinding,
         {},
         view(states_.buffer(), VK_FORMAT_R32G32_UINT, 0, states_.size(), "supple visibility")},
        {kHostListBinding, {buffers.hostList, 0, hostListBytes}, VK_NULL_HANDLE},
        {kHostListTexelBinding, {}, view(buffers.hostList, VK_FORMAT_R32_UINT, 0, hostListBytes, "supple instances")},
        {kListBinding, {list_.buffer(), 0, arguments}, VK_NULL_HANDLE},
        {kListArgumentBinding, {list_.buffer(), arguments, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
        {kListTableBinding, whole(table_.buffer()), VK_NULL_HANDLE},
        {kCullViewBinding, whole(buffers.view), VK_NULL_HANDLE},
        {kSizeBinding, whole(buffers.sizes), VK_NULL_HANDLE},
        {kViewWordsBinding, whole(buffers.words), VK_NULL_HANDLE},
    };
    if (!status) {
        return status;
    }
    listSets_.write(*device_, kernels_->listLayout(), 0, resources);
    // The other runs of the states are those of other groups.
    const VkDeviceSize stateBytes = windows_->capacity * kStateBytes;
    resources[1].buffer.range = stateBytes;
    const Culling& noted = leader_ != nullptr ? *leader_ : *this; // without a place nothing is noted
    const VkDeviceSize run = (1 + place_.number().value_or(0)) * VkDeviceSize{noted.stateStride()} * kStateBytes;
    resources.push_back({kWantedBinding, {noted.states_.buffer(), run, stateBytes}, VK_NULL_HANDLE});
    leader_ = nullptr;
    const size_t own = resources.size();
    for (uint32_t w = 0; w < windows_->count() && status; ++w) {
        const VkDeviceSize first = windows_->firstSlot(w) * cageBytes, bytes = windows_->slots(w) * cageBytes;
        resources.resize(own);
        resources.push_back({kBoundsCageBinding, {buffers.cages, first, bytes}, VK_NULL_HANDLE});
        resources.push_back({kBoundsCageTexelBinding,
                             {},
                             view(buffers.cages, VK_FORMAT_R32G32B32A32_SFLOAT, first, bytes, "supple deformed cage")});
        if (status) {
            boundsSets_.write(*device_, kernels_->boundsLayout(), w, resources);
        }
    }
    if (status && occlusion_ != nullptr) {
        status = occlusionSets_.create(*device_, occlusion_->layout(), framesInFlight_, "supple occlusion");
        for (uint32_t f = 0; f < framesInFlight_ && status; ++f) {
            occlusionSets_.write(*device_, occlusion_->layout(), f, std::span(resources).first(own));
        }
        pyramids_.assign(framesInFlight_, 0);
    }
    return status;
}

void Culling::listParts(const InstanceSlots& slots) {
    const HiddenParts& hidden = slots.hiddenParts();
    hiddenParts_ = 0;
    maskBytes_ = hidden.any() ? drawnParts_->write(hidden, slots.end(), masks_.next()) : 0;
    for (size_t d = 0; d < draws_.size(); ++d) {
        draws_[d].rate &= (1u << kDrawListShift) - 1;
    }
    for (const uint32_t part : drawnParts_->order()) {
        if (draws_.empty() || !hidden.any() || !slots.isHidden(part)) {
            continue;
        }
        parts_[hiddenParts_++].part = part;
        for (size_t d = 0; d < draws_.size(); ++d) {
            draws_[d].rate |= drawParts_[d] == part ? hiddenParts_ << kDrawListShift : 0;
        }
    }
}

void Culling::list(const InstanceSlots& slots, InstanceListing& listing) {
    const InstanceListing::Lists lists = listing.next();
    listing.listForCulling(slots, lists.all);
    listing.list(slots, lists.byWindow);
    listParts(slots);
    const InstanceWindows& windows = listing.windows();
    uint32_t first = 0;
    for (uint32_t w = 0; w < windows.count(); ++w) {
        listed_[w] = {first, windows.listed[w].count, windows.firstSlot(w), windows.firstEntry(w)};
        first += windows.listed[w].count;
    }
    writeListTable(listed_, arguments_, draws_, std::span(parts_).first(hiddenParts_), tables_.next());
}

VkDeviceSize Culling::recordUpload(VkCommandBuffer commandBuffer) {
    const VkDeviceSize masks = VkDeviceSize{firstMask(windows_->capacity)} * kWordBytes;
    const VkDeviceSize table = listTableBytes(windows_->count(), arguments_.size(), draws_.size(), hiddenParts_);
    return tables_.recordCopy(*device_, commandBuffer, 0, table_.buffer(), 0, table) +
           masks_.recordCopy(*device_, commandBuffer, 0, list_.buffer(), masks, maskBytes_);
}

PassCost Culling::cost(uint64_t points, uint64_t) const {
    return {0, 0, points > 0 && windows_->visible > 0};
}

SuppleBufferRange Culling::bounds() const {
    return {bounds_.buffer(), 0, bounds_.size(), static_cast<uint32_t>(kBoundsBytes)};
}

void Culling::addTransfers(Transfers& transfers) const {
    // Not the places in the view's pool: the next frame reads them.
    const VkDeviceSize pools = firstPool() * kWordBytes, behind = firstRateList() * kWordBytes;
    transfers.add(list_.buffer(), 0, instanceUnits_ > 0 ? pools : VK_WHOLE_SIZE);
    if (instanceUnits_ > 0) {
        transfers.add(list_.buffer(), behind);
    }
    transfers.add(bounds_.buffer());
}

PassCost Culling::recordBounds(gpu::Dispatches& dispatches) const {
    BoundsPush push = push_;
    for (uint32_t w = 0; w < windows_->count(); ++w) {
        push.instanceCount = windows_->listed[w].count;
        push.firstSlot = windows_->firstSlot(w);
        kernels_->recordBounds(dispatches, boundsSets_[w], push);
        push.firstEntry += push.instanceCount;
    }
    return {windows_->visible, windows_->visible * kBoundsBytes};
}

PassCost Culling::recordOcclusion(VkCommandBuffer commandBuffer, uint64_t place, const SuppleDepthPyramidDesc& pyramid,
                                  uint64_t generation) {
    if (windows_->visible == 0) {
        return {};
    }
    const VkDescriptorSet set = occlusionSets_[place].set;
    if (pyramids_[place] != generation) {
        occlusion_->writePyramid(set, pyramid.imageView, pyramid.layout);
        pyramids_[place] = generation;
    }
    OcclusionPush push{};
    std::copy_n(pyramid.viewProjection, 16, push.columns);
    push.instanceCount = windows_->visible;
    push.width = pyramid.width;
    push.height = pyramid.height;
    push.levels = pyramid.mipLevels;
    push.reversed = (pyramid.flags & SUPPLE_DEPTH_REVERSED) != 0 ? 1 : 0;
    occlusion_->record(commandBuffer, set, push);
    return {0, 0, true};
}

void Culling::recordSizes(gpu::Dispatches& dispatches, uint32_t leastVertices) const {
    kernels_->recordSizes(dispatches, listSets_[0], {0, windows_->visible, leastVertices, instanceUnits_});
}

PassCost Culling::recordList(gpu::Dispatches& dispatches, uint32_t room, uint32_t number) const {
    ListPush push{};
    push.room = room;
    push.poolRoom = poolUnits_;
    push.poolUnits = instanceUnits_;
    push.pools = firstPool() + pool_;
    push.levels = windows_->capacity;
    push.windowCount = windows_->count();
    push.argumentCount = static_cast<uint32_t>(arguments_.size());
    push.argumentStride = argumentStride();
    push.counts = 2 * kSizeRanks + kListHeaderWords * number;
    push.sharers = sharers_->end();
    push.sharerStride = stateStride();
    push.constructed = firstConstructed();
    kernels_->recordList(dispatches, listSets_[0], push);
    return {0, 0, true};
}

PassCost Culling::recordDemand(gpu::Dispatches& dispatches) const {
    DemandPush push{};
    push.instanceCount = windows_->visible;
    push.rateCount = rateCount_;
    push.firstRate = firstRate_;
    std::copy(std::begin(rateVertices_), std::end(rateVertices_), push.vertices);
    kernels_->recordDemand(dispatches, listSets_[0], push);
    return {0, 0, windows_->visible > 0};
}

PassCost Culling::recordRates(gpu::Dispatches& dispatches, bool counted) const {
    RatesPush push{};
    push.windowCount = windows_->count();
    push.argumentCount = static_cast<uint32_t>(arguments_.size());
    push.argumentStride = argumentStride();
    push.rateCount = rateCount_;
    push.firstRate = firstRate_;
    push.rateLists = firstRateList();
    push.rateStride = rateStride();
    push.rateCounts = firstRateCount();
    push.firstDraw = firstDraw();
    push.drawCount = static_cast<uint32_t>(draws_.size());
    push.counted = counted ? 1 : 0;
    push.capacity = windows_->capacity;
    push.partCount = hiddenParts_;
    push.masks = firstMask(windows_->capacity);
    push.maskWords = DrawnParts::wordsOf(parts_.size());
    std::copy(std::begin(rateVertices_), std::end(rateVertices_), push.vertices);
    kernels_->recordRates(dispatches, listSets_[0], push);
    return {0, 0, windows_->visible > 0};
}

void Culling::tellPool(WindowPush& push, size_t surface) const {
    const Place& place = places_[surface];
    if (place.coefficients > 0) {
        push.pools = firstPool() + pool_;
        push.lastPool = poolUnits_ - instanceUnits_;
        push.firstCoefficient = place.firstCoefficient;
    }
}

surface::Window Culling::window(uint32_t window, size_t surface) const {
    const uint32_t arguments = firstArgument() + headerWords() + argumentStride() * window;
    surface::Window result;
    result.push.firstInstance = windows_->firstEntry(window);
    result.push.instanceCount = (firstArgument() + kListHeaderWords * (1 + window)) | kCountOnDevice;
    result.push.slots = windows_->slots(window);
    result.push.firstSlot = windows_->firstSlot(window);
    tellPool(result.push, surface);
    result.arguments = list_.buffer();
    result.firstArgument = (arguments + VkDeviceSize{3} * places_[surface].firstArgument) * kWordBytes;
    return result;
}

surface::Window Culling::constructed(uint32_t window, size_t surface) const {
    surface::Window result = this->window(window, surface);
    if (sharers_->end() > 0) {
        result.push.firstInstance = firstConstructed() + windows_->firstSlot(window);
        result.push.instanceCount += kConstructedWord;
    }
    return result;
}

surface::Window Culling::window(uint32_t window, size_t surface, uint32_t rate) const {
    const Place& place = places_[surface];
    surface::Window result = this->window(window, surface);
    result.push.firstInstance = firstRateList() + rate * rateStride() + windows_->firstEntry(window);
    result.push.instanceCount =
        (firstArgument() + firstRateCount() + rate * windows_->count() + window) | kCountOnDevice;
    result.firstArgument += VkDeviceSize{3} * (place.firstRateArguments[rate] - place.firstArgument) * kWordBytes;
    return result;
}

SuppleBufferRange Culling::rateList(uint32_t rate) const {
    const VkDeviceSize first = firstRateList() + rate * rateStride();
    return {list_.buffer(), first * kWordBytes, (2 + partCount()) * windows_->capacity * kWordBytes, kWordBytes};
}

void Culling::recordNoDraws(VkCommandBuffer commandBuffer) const {
    if (!draws_.empty()) {
        const VkDeviceSize first = VkDeviceSize{firstArgument() + firstDraw()} * kWordBytes;
        device_->vk.CmdFillBuffer(commandBuffer, list_.buffer(), first, kDrawWords * draws_.size() * kWordBytes, 0);
    }
}

VkDeviceSize Culling::drawOffset(size_t surface) const {
    return VkDeviceSize{firstArgument() + firstDraw() + kDrawWords * places_[surface].firstDraw} * kWordBytes;
}

} // namespace supple::runtime
