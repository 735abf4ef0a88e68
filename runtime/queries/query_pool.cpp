#include "runtime/queries/query_pool.h"

#include "gpu/barriers.h"

#include <algorithm>
#include <utility>

namespace supple::runtime {
namespace {

constexpr VkDeviceSize kBestBytes = 8;
/// What vkCmdUpdateBuffer takes at once.
constexpr VkDeviceSize kBytesPerUpdate = 65536;
static_assert(sizeof(SuppleRay) == sizeof(SuppleTriangleHit));

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr gpu::SyncScope kCopied{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr gpu::SyncScope kByKernels{kCompute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                                                  VK_ACCESS_2_SHADER_SAMPLED_READ_BIT |
                                                  VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};

} // namespace

Result<std::shared_ptr<QueryPool>> QueryPool::create(const gpu::Device& device, uint32_t rayCount,
                                                     uint32_t framesInFlight, bool findsNearest) {
    auto pool = std::make_shared<QueryPool>();
    pool->owner_ = &device;
    pool->rayCount_ = rayCount;
    pool->findsNearest_ = findsNearest;
    pool->copies_.resize(framesInFlight + size_t{1});
    constexpr VkBufferUsageFlags kUse = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const gpu::BufferRequest requests[] = {
        {"supple rays", 2 * rayCount * sizeof(SuppleRay), kUse, gpu::MemoryPurpose::scratch},
        {"supple rays, what is met", rayCount * kBestBytes, kUse, gpu::MemoryPurpose::scratch},
        {"supple hits", rayCount * sizeof(SuppleHit), kUse | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
         gpu::MemoryPurpose::streams},
    };
    Result<gpu::BufferSet> made = gpu::BufferSet::create(device, requests, gpu::MemoryKind::deviceLocal);
    if (!made) {
        return made.error();
    }
    pool->device_ = std::move(*made);
    const gpu::BufferRequest readback{"supple hits, read back", rayCount * sizeof(SuppleHit) * pool->copies_.size(),
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    Result<gpu::BufferSet> read = gpu::BufferSet::create(device, {&readback, 1}, gpu::MemoryKind::readback);
    if (!read) {
        return read.error();
    }
    pool->readback_ = std::move(*read);
    return pool;
}

QueryPool::Member* QueryPool::find(uint64_t id) {
    const auto found = std::find_if(members_.begin(), members_.end(),
                                    [&](const Member& own) { return own.id == id && own.group != nullptr; });
    return found != members_.end() ? &*found : nullptr;
}

void QueryPool::put(Member& member, std::shared_ptr<QueryGroup> group, uint64_t lastFrame) {
    std::swap(member.group, group);
    retired_.push_back({std::move(group), lastFrame});
}

void QueryPool::fill(SuppleQueryOutput& out) const {
    out.rayCount = rayCount_;
    out.hits = {device_.buffer(2), 0, device_.size(2), sizeof(SuppleHit)};
}

template <class F>
void QueryPool::forGroups(F&& visit) const {
    for (const Member& member : members_) {
        if (member.group != nullptr) {
            visit(*member.group);
        }
    }
}

template <class F>
void QueryPool::forStatics(F&& visit) const {
    forGroups([&](const QueryGroup& group) { group.forStatics(visit); });
}

template <class F>
void QueryPool::forAsked(uint32_t rays, F&& record) const {
    QueryGroup::Batch batch;
    batch.rayCount = rays;
    batch.firstTriangle = rayCount_;
    batch.writesMisses = true;
    for (const Member& member : members_) {
        if (member.group == nullptr || !member.isAsked) {
            continue;
        }
        batch.group = static_cast<uint32_t>(&member - members_.data());
        batch.isEmpty = member.isEmpty;
        batch.rate = member.rate;
        record(*member.group, batch);
        batch.firstLane += batch.isEmpty ? 0 : member.group->lanes();
        batch.writesMisses = false;
    }
}

void QueryPool::recordCopy(VkCommandBuffer commandBuffer, const Source& source, uint32_t first, uint32_t count) const {
    const gpu::Functions& vk = owner_->vk;
    const VkDeviceSize target = first * sizeof(SuppleRay);
    const VkDeviceSize bytes = VkDeviceSize{count} * source.elementBytes;
    if (source.host == nullptr) {
        const VkBufferCopy region{source.offset, target, bytes};
        vk.CmdCopyBuffer(commandBuffer, source.buffer, device_.buffer(0), 1, &region);
        return;
    }
    for (VkDeviceSize done = 0; done < bytes; done += kBytesPerUpdate) {
        vk.CmdUpdateBuffer(commandBuffer, device_.buffer(0), target + done, std::min(kBytesPerUpdate, bytes - done),
                           static_cast<const std::byte*>(source.host) + done);
    }
}

template <class F>
void QueryPool::recordEach(gpu::Dispatches& dispatches, uint32_t rays, F&& record) const {
    forAsked(rays, [&](const QueryGroup& group, const QueryGroup::Batch& batch) {
        record(group, batch);
        dispatches.disjointBarrier();
    });
    dispatches.computeBarrier();
}

void QueryPool::recordPick(gpu::Dispatches& dispatches, uint32_t rays) const {
    for (const uint32_t work : {shared::kFindLeast, shared::kFindOwner}) {
        recordEach(dispatches, rays, [&](const QueryGroup& group, const QueryGroup::Batch& batch) {
            group.recordPick(dispatches, batch, work);
        });
    }
}

void QueryPool::recordCast(gpu::Dispatches& dispatches, uint32_t rays) const {
    using Pass = TreeKernels::Pass;
    uint32_t turns = 0;
    forAsked(rays, [&](const QueryGroup& group, const QueryGroup::Batch& /*batch*/) {
        turns = std::max(turns, group.turns());
    });
    for (uint32_t turn = 0; turn < turns; ++turn) {
        for (const Pass pass : {Pass::fit, Pass::refit, Pass::cast}) {
            recordEach(dispatches, rays, [&](const QueryGroup& group, const QueryGroup::Batch& batch) {
                if (turn >= group.turns()) {
                    return;
                }
                group.recordTree(dispatches, batch, pass, turn);
                if (pass == Pass::cast) {
                    dispatches.computeBarrier(); // the next group's rays begin with what these have met
                }
            });
        }
    }
}

void QueryPool::recordRays(gpu::Dispatches& dispatches, uint32_t rays) const {
    const auto each = [&](auto&& record) { recordEach(dispatches, rays, record); };
    each([&](const QueryGroup& group, const QueryGroup::Batch& batch) { group.recordBoxes(dispatches, batch); });
    each([&](const QueryGroup& group, const QueryGroup::Batch& batch) { group.recordAim(dispatches, batch); });
    forAsked(rays, [&](const QueryGroup& group, const QueryGroup::Batch& batch) {
        group.recordList(dispatches, batch);
        dispatches.disjointBarrier();
    });
    gpu::memoryBarrier(*owner_, dispatches.commandBuffer(), {kCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                       {kByKernels.stages | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                        kByKernels.access | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT});
    if (rays > shared::kRaysPerLane) {
        recordCast(dispatches, rays);
    } else {
        recordPick(dispatches, rays);
    }
    forAsked(rays, [&](const QueryGroup& group, const QueryGroup::Batch& batch) {
        group.recordFinish(dispatches, batch);
        dispatches.disjointBarrier();
    });
}

void QueryPool::recordRefine(gpu::Dispatches& dispatches, uint32_t rays) const {
    // Nothing is met, until a triangle says so.
    forAsked(rays, [&](const QueryGroup& group, QueryGroup::Batch batch) {
        batch.isEmpty = true;
        group.recordFinish(dispatches, batch);
    });
    dispatches.computeBarrier();
    forAsked(rays, [&](const QueryGroup& group, const QueryGroup::Batch& batch) {
        group.recordRefine(dispatches, batch);
        dispatches.disjointBarrier();
    });
}

void QueryPool::recordNearest(gpu::Dispatches& dispatches, uint32_t places) const {
    const auto each = [&](auto&& record) { recordEach(dispatches, places, record); };
    each([&](const QueryGroup& group, const QueryGroup::Batch& batch) { group.recordBoxes(dispatches, batch); });
    for (const uint32_t work : {shared::kFindBound, shared::kFindLeast, shared::kFindOwner}) {
        each([&](const QueryGroup& group, const QueryGroup::Batch& batch) {
            group.recordNearest(dispatches, batch, work);
        });
    }
    forAsked(places, [&](const QueryGroup& group, const QueryGroup::Batch& batch) {
        group.recordNearestFinish(dispatches, batch);
        dispatches.disjointBarrier();
    });
}

void QueryPool::record(VkCommandBuffer commandBuffer, uint64_t frame, const Asked& asked) {
    recordedFrame_ = queriedFrame_ = frame;
    recordCopy(commandBuffer, asked.places.isThere() ? asked.places : asked.rays, 0, asked.count);
    if (asked.triangles.isThere()) {
        recordCopy(commandBuffer, asked.triangles, rayCount_, asked.count);
    }
    owner_->vk.CmdFillBuffer(commandBuffer, device_.buffer(1), 0, asked.count * kBestBytes, shared::kNothingMet);
    gpu::memoryBarrier(*owner_, commandBuffer, kCopied, kByKernels);
    gpu::SingleDispatches dispatches(*owner_, commandBuffer);
    if (asked.places.isThere()) {
        recordNearest(dispatches, asked.count);
    } else if (asked.triangles.isThere()) {
        recordRefine(dispatches, asked.count);
    } else {
        recordRays(dispatches, asked.count);
    }
    if (asked.readsBack) {
        recordReadback(commandBuffer, frame, asked.count);
    }
}

void QueryPool::recordReadback(VkCommandBuffer commandBuffer, uint64_t frame, uint32_t count) {
    copies_[next_] = {frame, count};
    gpu::memoryBarrier(*owner_, commandBuffer, {kCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT});
    const VkBufferCopy region{0, next_ * rayCount_ * sizeof(SuppleHit), count * sizeof(SuppleHit)};
    owner_->vk.CmdCopyBuffer(commandBuffer, device_.buffer(2), readback_.buffer(0), 1, &region);
    gpu::memoryBarrier(*owner_, commandBuffer, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    next_ = (next_ + 1) % copies_.size();
}

std::optional<QueryPool::Batch> QueryPool::newest() const {
    const Copy* newest = nullptr;
    for (const Copy& copy : copies_) {
        const bool isComplete = copy.frame != 0 && copy.frame <= completedFrame_;
        newest = isComplete && (newest == nullptr || copy.frame > newest->frame) ? &copy : newest;
    }
    if (newest == nullptr) {
        return std::nullopt;
    }
    const auto place = static_cast<size_t>(newest - copies_.data());
    const auto* const hits = reinterpret_cast<const SuppleHit*>(readback_.mapped(0)) + place * rayCount_;
    return Batch{newest->frame, std::span(hits, newest->count)};
}

bool QueryPool::staticsPending() const {
    bool pending = false;
    forGroups([&](const QueryGroup& group) { pending = pending || group.staticsPending(); });
    return pending;
}

VkDeviceSize QueryPool::recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) {
    VkDeviceSize bytes = 0;
    forStatics([&](gpu::StaticBuffers& table) { bytes += table.recordStatics(commandBuffer, frame); });
    recordedFrame_ = bytes > 0 ? frame : recordedFrame_;
    return bytes;
}

void QueryPool::countStatics(gpu::StaticCount& count) const {
    forStatics([&](const gpu::StaticBuffers& table) { table.countStatics(count); });
}

Status QueryPool::stageStatics() {
    Status status = success();
    forStatics([&](gpu::StaticBuffers& table) { status = status ? table.stageStatics() : status; });
    return status;
}

void QueryPool::beginFrame(uint64_t completedFrame) {
    completedFrame_ = completedFrame;
    std::erase_if(retired_, [&](const Retired& own) { return own.lastFrame <= completedFrame; });
    forStatics([&](gpu::StaticBuffers& table) { table.beginFrame(completedFrame); });
}

void QueryPool::cancelFrame(uint64_t frame) {
    for (size_t k = 0; k < copies_.size(); ++k) {
        if (copies_[k].frame == frame) { // the last that was taken: the others stay
            copies_[k].frame = 0;
            next_ = k;
        }
    }
    queriedFrame_ = queriedFrame_ == frame ? 0 : queriedFrame_;
    forStatics([&](gpu::StaticBuffers& table) { table.cancelFrame(frame); });
}

} // namespace supple::runtime
