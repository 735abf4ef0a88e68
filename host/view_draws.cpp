#include "host/view_draws.h"

#include "shaders/view_draws_comp.h"

#include <algorithm>

namespace supple::host {

namespace {

constexpr VkDeviceSize kWordBytes = sizeof(uint32_t), kBucketBytes = 4 * kWordBytes;
constexpr VkDeviceSize kCommandBytes = sizeof(VkDrawIndexedIndirectCommand);
static_assert(kCommandBytes == shared::kCommandWords * kWordBytes);

bool isSameRange(const SuppleBufferRange& a, const SuppleBufferRange& b) {
    return a.buffer == b.buffer && a.offset == b.offset;
}

/// Every device binds buffers at multiples of this.
constexpr VkDeviceSize kBindingAlignment = 256;

/// What holds a range of every surface.
SuppleBufferRange covering(std::span<const SuppleLevelOutput> surfaces, SuppleBufferRange SuppleLevelOutput::*range) {
    SuppleBufferRange all = surfaces.front().*range;
    VkDeviceSize end = all.offset + all.size;
    for (const SuppleLevelOutput& surface : surfaces) {
        const SuppleBufferRange& one = surface.*range;
        all.offset = std::min(all.offset, one.offset);
        end = std::max(end, one.offset + one.size);
    }
    all.offset -= all.offset % kBindingAlignment;
    all.size = end - all.offset;
    return all;
}

} // namespace

Result<ViewDraws> ViewDraws::create(Device& device, std::span<const SuppleLevelOutput> surfaces, uint32_t bins,
                                    const BinOf& binOf) {
    if (!device.drawsMany())
        return Error{ErrorCode::unsupported,
                     "the device cannot draw a view by few calls: it lacks multiDrawIndirect or shaderDrawParameters"};
    ViewDraws made(device);
    made.bins_.resize(bins);
    if (const Status status = made.takeBuffers(surfaces); !status)
        return status.error();
    const std::vector<shared::ViewDraw> draws = made.sorted(surfaces, binOf);
    if (const Status status = made.createBuffers(device, draws); !status)
        return status.error();
    if (const Status status = made.createPipeline(device); !status)
        return status.error();
    return made;
}

Status ViewDraws::takeBuffers(std::span<const SuppleLevelOutput> surfaces) {
    if (surfaces.empty() || bins_.empty())
        return Error{ErrorCode::argument, "draws of a view: there are no surfaces or no bins"};
    const SuppleLevelOutput& first = surfaces.front();
    for (const SuppleLevelOutput& surface : surfaces) {
        if (!isSameRange(surface.indices, first.indices) || !isSameRange(surface.patches, first.patches) ||
            surface.indirect.buffer != first.indirect.buffer || surface.buckets.buffer != first.buckets.buffer)
            return Error{ErrorCode::argument, "draws of a view: the surfaces are of several views"};
    }
    indices_ = first.indices;
    patches_ = first.patches;
    indirect_ = covering(surfaces, &SuppleLevelOutput::indirect);
    buckets_ = covering(surfaces, &SuppleLevelOutput::buckets);
    return success();
}

std::vector<shared::ViewDraw> ViewDraws::sorted(std::span<const SuppleLevelOutput> surfaces, const BinOf& binOf) {
    std::vector<std::vector<shared::ViewDraw>> byBin(bins_.size());
    for (uint32_t s = 0; s < surfaces.size(); ++s) {
        const SuppleLevelOutput& surface = surfaces[s];
        const auto firstBucket = static_cast<uint32_t>((surface.buckets.offset - buckets_.offset) / kBucketBytes);
        for (uint32_t i = 0; i < surface.drawCount; ++i) {
            const SuppleLevelDraw& draw = surface.draws[i];
            const uint32_t bin = binOf(s, draw);
            if (bin == kNoBin)
                continue;
            const VkDeviceSize command =
                surface.indirect.offset - indirect_.offset + VkDeviceSize{i} * surface.indirect.stride;
            byBin[bin].push_back({.index = firstBucket + i,
                                  .verticesPerInstance = draw.verticesPerInstance,
                                  .samplesPerPatch = draw.samplesPerPatch,
                                  .previousWords = 0,
                                  .surface = s,
                                  .material = draw.material,
                                  .capacity = draw.capacity,
                                  .command = static_cast<uint32_t>(command / kWordBytes)});
        }
    }
    std::vector<shared::ViewDraw> all;
    for (size_t b = 0; b < bins_.size(); ++b) {
        bins_[b] = {static_cast<uint32_t>(all.size()), static_cast<uint32_t>(byBin[b].size())};
        all.insert(all.end(), byBin[b].begin(), byBin[b].end());
    }
    return all;
}

Status ViewDraws::createBuffers(Device& device, std::span<const shared::ViewDraw> draws) {
    constexpr VkBufferUsageFlags kTable = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    constexpr VkBufferUsageFlags kArguments = kTable | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    const VkDeviceSize count = std::max<VkDeviceSize>(draws.size(), 1); // buffers are never empty
    const auto take = [](Result<Buffer> made, Buffer& into) -> Status {
        if (!made)
            return made.error();
        into = std::move(*made);
        return success();
    };
    const std::vector<shared::ViewDraw> none(1);
    Status status =
        take(device.uploadBuffer(draws.empty() ? none.data() : draws.data(), count * sizeof(shared::ViewDraw), kTable),
             draws_);
    if (status)
        status = take(device.uploadBuffer(bins_.data(), bins_.size() * sizeof(Bin), kTable), binTable_);
    if (status)
        status = take(device.createBuffer(count * kCommandBytes, kArguments, MemoryKind::device), commands_);
    if (status)
        status = take(device.createBuffer(count * sizeof(shared::ViewDraw), kTable, MemoryKind::device), drawn_);
    if (status)
        status = take(device.createBuffer(bins_.size() * kWordBytes, kArguments, MemoryKind::device), counts_);
    return status;
}

Status ViewDraws::createPipeline(Device& device) {
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    constexpr VkShaderStageFlags kCompute = VK_SHADER_STAGE_COMPUTE_BIT;
    const Result<VkDescriptorSetLayout> setLayout = createSetLayout(device, {{0, kStorage, kCompute},
                                                                             {1, kStorage, kCompute},
                                                                             {2, kStorage, kCompute},
                                                                             {3, kStorage, kCompute},
                                                                             {4, kStorage, kCompute},
                                                                             {5, kStorage, kCompute}});
    if (!setLayout)
        return setLayout.error();
    const Result<VkPipelineLayout> layout = createPipelineLayout(device, {*setLayout}, 0, kCompute);
    const Result<VkPipeline> pipeline =
        layout ? createComputePipeline(device, *layout, view_draws_comp) : Result<VkPipeline>(layout.error());
    if (!pipeline)
        return pipeline.error();
    Result<DescriptorPool> pool = DescriptorPool::create(device, 2); // of twice four storage buffers
    const Result<VkDescriptorSet> set = pool ? pool->allocate(*setLayout) : Result<VkDescriptorSet>(pool.error());
    if (!set)
        return set.error();
    const auto whole = [](uint32_t binding, const Buffer& buffer) {
        return storageBuffer(binding, buffer.handle(), 0, VK_WHOLE_SIZE);
    };
    pool->write(*set, {storageBuffer(0, indirect_), whole(1, draws_), whole(2, binTable_), whole(3, commands_),
                       whole(4, drawn_), whole(5, counts_)});
    layout_ = *layout;
    pipeline_ = *pipeline;
    set_ = *set;
    return success();
}

void ViewDraws::record(VkCommandBuffer commands) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
    vkCmdDispatch(commands, static_cast<uint32_t>(bins_.size()), 1, 1);
}

void ViewDraws::draw(VkCommandBuffer commands, uint32_t bin) const {
    const auto [first, count] = bins_[bin];
    if (count == 0)
        return;
    vkCmdBindIndexBuffer(commands, indices_.buffer, indices_.offset, VK_INDEX_TYPE_UINT16);
    if (countsDraws_)
        vkCmdDrawIndexedIndirectCount(commands, commands_.handle(), first * kCommandBytes, counts_.handle(),
                                      bin * kWordBytes, count, kCommandBytes);
    else
        vkCmdDrawIndexedIndirect(commands, commands_.handle(), first * kCommandBytes, count, kCommandBytes);
}

} // namespace supple::host
