#include "gpu/tasks.h"

#include "gpu/barriers.h"
#include "gpu/device.h"

#include <algorithm>
#include <cstring>

namespace supple::gpu {

namespace {

using shared::kMaxTasks;
using shared::Task;
using shared::TaskRun;
using shared::TasksPush;

constexpr VkDeviceSize kTaskBytes = sizeof(Task), kPushBytes = kPushConstantBytes, kListBytes = sizeof(TaskRun),
                       kBuffersBytes = sizeof(VkDeviceAddress) * shared::kTaskBindings,
                       kArgumentBytes = sizeof(VkDispatchIndirectCommand);
static_assert(kTaskBytes == 32 && kPushBytes % 16 == 0 && kBuffersBytes % 16 == 0, "as the shaders read them");
constexpr VkDeviceSize kPartAlignment = 256;
/// Workgroups of a dispatch: firstGroup has 32 bits.
constexpr uint64_t kMaxGroups = 0xFFFF0000u;
/// Workgroups of the kernel that counts. Each takes its share of the dispatches.
constexpr uint32_t kCountingGroups = 64;

constexpr VkDeviceSize aligned(VkDeviceSize bytes) {
    return (bytes + kPartAlignment - 1) / kPartAlignment * kPartAlignment;
}
/// Entries of lists: each task, and one behind each list.
constexpr VkDeviceSize entries(uint32_t tasks) {
    return VkDeviceSize{2} * tasks;
}

} // namespace

VkDeviceAddress addressOf(const Device& device, VkBuffer buffer) {
    VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
    info.buffer = buffer;
    return buffer == VK_NULL_HANDLE ? 0 : device.vk.GetBufferDeviceAddress(device.handle, &info);
}

Result<std::unique_ptr<TaskRoom>> TaskRoom::create(const Device& device, const TaskNeeds& needs, uint32_t number) {
    auto room = std::make_unique<TaskRoom>();
    Offsets& at = room->offsets_;
    at.pushes = aligned(entries(needs.tasks) * kTaskBytes);
    at.buffers = aligned(at.pushes + needs.tasks * kPushBytes);
    at.lists = aligned(at.buffers + needs.buffers * kBuffersBytes);
    at.nothing = aligned(at.lists + needs.tasks * kListBytes);
    at.arguments = at.nothing + kPartAlignment;
    const VkDeviceSize bytes = at.arguments + needs.tasks * kArgumentBytes;
    const BufferRequest staging{"supple tasks staging", at.arguments, VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    const BufferRequest local{"supple tasks", bytes,
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                  VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT};
    Result<BufferSet> written = BufferSet::create(device, {&staging, 1}, MemoryKind::upload);
    Result<BufferSet> read =
        written ? BufferSet::create(device, {&local, 1}, MemoryKind::deviceLocal) : Result<BufferSet>(written.error());
    if (!read) {
        return read.error();
    }
    room->capacity_ = needs;
    room->staging_ = std::move(*written);
    room->local_ = std::move(*read);
    room->address_ = addressOf(device, room->local_.buffer(0));
    room->recorded_.resize(needs.tasks);
    room->kept_.reserve(needs.tasks);
    std::memset(room->mapped(at.nothing), 0, kArgumentBytes);
    room->recordings_ = uint64_t{number} << 32u;
    return room;
}

std::byte* TaskRoom::pushOf(const RecordedTask& task) const {
    return mapped(offsets_.pushes + static_cast<VkDeviceSize>(&task - recorded_.data()) * kPushBytes);
}

Status TaskRooms::create(const Device& device, Pipelines& pipelines, const Spirv& counts, uint32_t framesInFlight) {
    frames_.resize((framesInFlight + 1) / 2 * 2);
    if (!device.mapping.sharesDispatches) {
        return success();
    }
    Result<ComputeLayout> layout =
        ComputeLayout::create(device, {}, sizeof(shared::CountTasksPush), "supple shared dispatches");
    if (!layout) {
        return layout.error();
    }
    layout_ = std::move(*layout);
    const Result<Kernel> kernel = pipelines.get(layout_, counts, {}, "supple sizes of shared dispatches");
    if (!kernel) {
        return kernel.error();
    }
    counts_ = *kernel;
    return success();
}

void TaskRooms::beginFrame(uint64_t frame) {
    Frame& own = frames_[frame % frames_.size()];
    own.outgrown.clear();
    if (own.room != nullptr) {
        own.room->clear();
    }
}

void TaskRooms::cancelFrame(uint64_t frame) {
    if (TaskRoom* const room = roomOf(frame)) {
        room->forget();
    }
}

bool TaskRooms::holds(const Device& device, uint64_t frame, const TaskNeeds& needs) const {
    const TaskRoom* const room = roomOf(frame);
    return !device.mapping.sharesDispatches || needs.tasks == 0 || (room != nullptr && room->holds(needs));
}

Status TaskRooms::reserve(const Device& device, uint64_t frame, const TaskNeeds& needs) {
    if (holds(device, frame, needs)) {
        return success();
    }
    Frame& own = frames_[frame % frames_.size()];
    // Half as many more: groups come one by one.
    Result<std::unique_ptr<TaskRoom>> room =
        TaskRoom::create(device, {needs.tasks + needs.tasks / 2, needs.buffers + needs.buffers / 2}, ++made_);
    if (!room) {
        return room.error();
    }
    if (own.room != nullptr) {
        own.outgrown.push_back(std::move(own.room));
    }
    own.room = std::move(*room);
    return success();
}

TaskDispatches::TaskDispatches(const Device& device, VkCommandBuffer commandBuffer, TaskRoom& room,
                               const Kernel& counts, const TaskNeeds& needs)
    : Dispatches(device, commandBuffer), room_(&room), counts_(&counts), needs_(needs), recording_(++room.recordings_) {
    const TaskNeeds taken = room.take(needs);
    isFirst_ = taken == TaskNeeds{};
    nextTask_ = nextList_ = taken.tasks;
    nextListed_ = 2 * nextTask_;
    nextBuffers_ = taken.buffers;
    firstPhase_ = nextList_ + needs.tasks - kPhases;
}

void TaskDispatches::begin(bool keeps) {
    if (isFirst_) {
        room_->kept_.begin(needs_); // whatever is there is overwritten
    }
    keeps_ = keeps && isFirst_;
    std::fill_n(lists() + firstPhase_, kPhases, TaskRun{});
    const auto part = [](VkDeviceSize first, VkDeviceSize each, VkDeviceSize from, VkDeviceSize count) {
        return VkBufferCopy{first + from * each, first + from * each, count * each};
    };
    const TaskRoom::Offsets& at = room_->offsets_;
    const VkBufferCopy parts[] = {part(0, kTaskBytes, nextListed_, entries(needs_.tasks)),
                                  part(at.pushes, kPushBytes, nextTask_, needs_.tasks),
                                  part(at.buffers, kBuffersBytes, nextBuffers_, needs_.buffers),
                                  part(at.lists, kListBytes, nextList_, needs_.tasks),
                                  {at.nothing, at.nothing, kArgumentBytes}}; // once a frame
    const auto count = static_cast<uint32_t>(std::size(parts)) - (isFirst_ ? 0 : 1);
    device().vk.CmdCopyBuffer(commandBuffer(), room_->staging_.buffer(0), room_->local_.buffer(0), count, parts);
}

void TaskDispatches::addOwner(const TaskOwner& owner) {
    if (keeps_) {
        room_->kept_.addOwner(owner);
    }
}

void TaskDispatches::enter(uint32_t place) {
    if (keeps_) {
        room_->kept_.enter(place, nextTask_);
    }
}

void TaskDispatches::leave() {
    if (keeps()) {
        room_->kept_.leave(nextTask_);
    }
}

void TaskDispatches::end() {
    if (keeps_) {
        room_->kept_.complete();
    }
}

KeptTasks* TaskDispatches::kept() const {
    return isFirst_ && room_->kept_.stands(needs_) ? &room_->kept_ : nullptr;
}

void TaskDispatches::rewrite(const KeptTasks::Owner& owner, uint32_t first, uint32_t last, size_t offset,
                             std::span<const std::byte> bytes) {
    for (const RecordedTask* task = owner.first; task != nullptr && task->place <= last; task = task->nextOfOwner) {
        if (task->place >= first) {
            std::memcpy(room_->pushOf(*task) + offset, bytes.data(), bytes.size());
            room_->kept_.places()[task->place].changed = true;
        }
    }
}

bool TaskDispatches::resume() {
    for (KeptTasks::Dispatch& dispatch : room_->kept_.dispatches()) {
        if (dispatch.changed) {
            dispatch.groups = list(dispatch);
            if (dispatch.groups > kMaxGroups) {
                return false;
            }
        }
    }
    resumed_ = true;
    copyChanged();
    return true;
}

void TaskDispatches::copyChanged() {
    constexpr size_t kRegions = 96;
    std::array<VkBufferCopy, kRegions> regions;
    uint32_t count = 0;
    const TaskRoom::Offsets& at = room_->offsets_;
    const auto recordCopy = [&] {
        device().vk.CmdCopyBuffer(commandBuffer(), room_->staging_.buffer(0), room_->local_.buffer(0), count,
                                  regions.data());
        count = 0;
    };
    const auto copy = [&](VkDeviceSize first, VkDeviceSize bytes) {
        if (count == kRegions) {
            recordCopy();
        }
        regions[count++] = {first, first, bytes};
    };
    for (KeptTasks::Place& place : room_->kept_.places()) {
        if (std::exchange(place.changed, false)) {
            copy(at.pushes + place.firstTask * kPushBytes, (place.endTask - place.firstTask) * kPushBytes);
        }
    }
    for (KeptTasks::Dispatch& dispatch : room_->kept_.dispatches()) {
        if (std::exchange(dispatch.changed, false)) {
            copy(dispatch.firstEntry * kTaskBytes, (dispatch.count + 1) * kTaskBytes);
        }
    }
    if (count > 0) {
        recordCopy();
    }
}

void TaskDispatches::recordKept(uint32_t place) {
    for (const uint32_t command : room_->kept_.commandsOf(place)) {
        if (command == KeptTasks::kBarrier) {
            gpu::computeBarrier(device(), commandBuffer());
        } else {
            record(room_->kept_.dispatches()[command]);
        }
    }
}

void TaskDispatches::computeBarrier() {
    Dispatches::computeBarrier();
    if (keeps()) {
        room_->kept_.addBarrier();
    }
}

TaskRun* TaskDispatches::lists() const {
    return reinterpret_cast<TaskRun*>(room_->mapped(room_->offsets_.lists));
}

VkDeviceAddress TaskDispatches::addressOfBuffers(TaskBuffers& buffers) {
    if (buffers.writtenIn != recording_) {
        const VkDeviceSize offset = room_->offsets_.buffers + nextBuffers_++ * kBuffersBytes;
        std::memcpy(room_->mapped(offset), buffers.at.data(), kBuffersBytes);
        buffers.where = room_->address_ + offset;
        buffers.writtenIn = recording_;
    }
    return buffers.where;
}

TaskDispatches::Chain& TaskDispatches::chainOf(const Kernel& kernel, bool isCounted) {
    const auto end = chains_.begin() + static_cast<ptrdiff_t>(chainCount_);
    const auto known = std::find_if(chains_.begin(), end, [&](const Chain& chain) {
        return chain.kernel->pipeline == kernel.pipeline && chain.isCounted == isCounted;
    });
    if (known != end) {
        return *known;
    }
    if (chainCount_ == kChains) {
        flush();
    }
    chains_[chainCount_] = {&kernel, isCounted, nullptr, nullptr};
    return chains_[chainCount_++];
}

void TaskDispatches::add(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push, uint64_t groups,
                         VkDeviceAddress arguments) {
    Chain& chain = chainOf(kernel, arguments != 0);
    const VkDeviceSize offset = room_->offsets_.pushes + nextTask_ * kPushBytes;
    std::memcpy(room_->mapped(offset), push.data(), push.size());
    RecordedTask& task = room_->recorded_[nextTask_++];
    task = {};
    task.task = {addressOfBuffers(*bound.buffers), room_->address_ + offset, arguments, 0, 0};
    task.groups = groups;
    if (keeps()) {
        task.pipeline = kernel.pipeline;
        task.buffers = bound.buffers;
        room_->kept_.addTask(owner_, task);
    }
    (chain.last != nullptr ? chain.last->next : chain.first) = &task;
    chain.last = &task;
}

void TaskDispatches::recordNothing(const Kernel& kernel) {
    bindByAddress(device(), commandBuffer(), kernel, TasksPush{0, 1});
    dispatchLinear(device(), commandBuffer(), 0);
}

void TaskDispatches::dispatch(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                              uint64_t groups) {
    if (room_ == nullptr) {
        recordNothing(kernel);
    } else {
        add(kernel, bound, push, groups, 0);
    }
}

void TaskDispatches::dispatchIndirect(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                                      VkBuffer arguments, VkDeviceSize offset) {
    if (room_ == nullptr) {
        recordNothing(kernel);
    } else {
        add(kernel, bound, push, 0, addressOf(device(), arguments) + offset);
    }
}

void TaskDispatches::list(uint32_t entry, Task task, uint32_t firstGroup) const {
    task.firstGroup = firstGroup;
    std::memcpy(room_->mapped(entry * kTaskBytes), &task, kTaskBytes);
}

uint64_t TaskDispatches::list(const KeptTasks::Dispatch& dispatch) const {
    uint64_t groups = 0;
    const RecordedTask* task = dispatch.first;
    for (uint32_t i = 0; i < dispatch.count; ++i, task = task->next) {
        list(dispatch.firstEntry + i, task->task, static_cast<uint32_t>(groups));
        groups += task->groups;
    }
    list(dispatch.firstEntry + dispatch.count, {}, static_cast<uint32_t>(groups));
    return groups;
}

void TaskDispatches::recordListed(KeptTasks::Dispatch dispatch) {
    dispatch.firstEntry = nextListed_;
    nextListed_ += dispatch.count + 1;
    dispatch.groups = list(dispatch);
    if (dispatch.isCounted) {
        dispatch.arguments = room_->offsets_.arguments + nextList_ * kArgumentBytes;
        lists()[nextList_++] = {dispatch.firstEntry, dispatch.count};
        ++lists()[firstPhase_ + phase_].count;
    }
    record(dispatch);
    if (keeps()) {
        room_->kept_.addDispatch(dispatch);
    }
}

void TaskDispatches::record(const KeptTasks::Dispatch& dispatch) {
    if (!dispatch.isCounted && dispatch.groups == 0) {
        return;
    }
    bindByAddress(device(), commandBuffer(), dispatch.kernel,
                  TasksPush{room_->address_ + dispatch.firstEntry * kTaskBytes, dispatch.count});
    if (dispatch.isCounted) {
        device().vk.CmdDispatchIndirect(commandBuffer(), room_->local_.buffer(0), dispatch.arguments);
    } else {
        dispatchLinear(device(), commandBuffer(), dispatch.groups);
    }
}

void TaskDispatches::recordChain(const Chain& chain) {
    KeptTasks::Dispatch dispatch{*chain.kernel, chain.isCounted};
    uint64_t groups = 0;
    const auto recordUpTo = [&](RecordedTask* end) {
        recordListed(dispatch);
        dispatch.first = end;
        dispatch.count = 0;
        groups = 0;
    };
    dispatch.first = chain.first;
    for (RecordedTask* task = chain.first; task != nullptr; task = task->next) {
        if (dispatch.count == kMaxTasks || (dispatch.count > 0 && groups + task->groups > kMaxGroups)) {
            recordUpTo(task);
        }
        groups += task->groups;
        ++dispatch.count;
    }
    recordUpTo(nullptr);
}

void TaskDispatches::flush() {
    for (size_t i = 0; i < chainCount_; ++i) {
        recordChain(chains_[i]);
    }
    chainCount_ = 0;
}

void TaskDispatches::count() {
    flush();
    if (room_ == nullptr) {
        return;
    }
    ++phase_;
    if (!resumed_) {
        lists()[firstPhase_ + phase_].first = nextList_;
    }
    shared::CountTasksPush push{};
    push.tasks = room_->address_;
    push.lists = room_->address_ + room_->offsets_.lists;
    push.arguments = room_->address_ + room_->offsets_.arguments;
    push.phase = firstPhase_ + phase_;
    push.maxGroups = maxGroupsInX(device());
    bindByAddress(device(), commandBuffer(), *counts_, push);
    device().vk.CmdDispatch(commandBuffer(), kCountingGroups, 1, 1);
    constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    memoryBarrier(device(), commandBuffer(), {kCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                  {kCompute | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT});
}

OwnDispatches::OwnDispatches(const Device& device, VkCommandBuffer commandBuffer) {
    if (device.mapping.sharesDispatches) {
        chosen_ = &tasks_.emplace(device, commandBuffer);
    } else {
        chosen_ = &single_.emplace(device, commandBuffer);
    }
}

OwnDispatches::OwnDispatches(const Device& device, VkCommandBuffer commandBuffer, const TaskRooms& rooms,
                             uint64_t frame, const TaskNeeds& needs) {
    TaskRoom* const room = rooms.roomOf(frame);
    if (room != nullptr && needs.tasks > 0) {
        chosen_ = &tasks_.emplace(device, commandBuffer, *room, rooms.counts(), needs);
    } else {
        chosen_ = &single_.emplace(device, commandBuffer);
    }
}

} // namespace supple::gpu
