// Shared dispatches (docs/shared_dispatches.md): what steps of several groups do with one kernel becomes one dispatch.
// Each of its workgroups finds its task in a list, and there its push constants and the addresses of its buffers.
#pragma once

#include "base/result.h"
#include "gpu/dispatches.h"
#include "gpu/memory.h"
#include "gpu/pipelines.h"
#include "shaders/shared/tasks.h"

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

namespace supple::gpu {

/// At most, in a frame, with TaskDispatches::kPhases more tasks a recording.
struct TaskNeeds {
    uint32_t tasks = 0;
    uint32_t buffers = 0; ///< TaskBuffers

    TaskNeeds& operator+=(const TaskNeeds& other) {
        tasks += other.tasks;
        buffers += other.buffers;
        return *this;
    }
};

/// The memory of one frame's tasks: the host writes them while it records, and a copy at the beginning of what was
/// recorded takes them to the device.
class TaskRoom {
public:
    /// `number`: of the room, so that recordings in different ones are told apart.
    [[nodiscard]] static Result<std::unique_ptr<TaskRoom>> create(const Device& device, const TaskNeeds& needs,
                                                                  uint32_t number);
    /// Beside what the frame's recordings have taken.
    [[nodiscard]] bool holds(const TaskNeeds& needs) const {
        return needs.tasks <= capacity_.tasks - tasksTaken_ && needs.buffers <= capacity_.buffers - buffersTaken_;
    }
    /// For another frame.
    void clear() {
        tasksTaken_ = 0;
        buffersTaken_ = 0;
    }

private:
    friend class TaskDispatches;
    /// A task that waits for its dispatch.
    struct Waiting {
        shared::Task task{};
        uint64_t groups = 0;
        Waiting* next = nullptr; ///< of the same kernel
    };
    /// What lies where in both buffers, in bytes.
    struct Offsets {
        VkDeviceSize pushes = 0, buffers = 0, lists = 0; ///< tasks come first, and each list of them has one more
        VkDeviceSize arguments = 0;                      ///< of dispatches, on the device alone
    };

    TaskNeeds capacity_;
    Offsets offsets_;
    BufferSet staging_, local_;
    VkDeviceAddress address_ = 0; ///< of `local_`
    std::vector<Waiting> waiting_;
    std::atomic<uint32_t> tasksTaken_ = 0, buffersTaken_ = 0;
    std::atomic<uint64_t> recordings_ = 0;
};

/// The rooms of the frames in flight. They grow with the groups, and never while recording.
class TaskRooms {
public:
    /// `counts`: shared/count_tasks.comp. Makes its pipeline if the device's mapping shares dispatches.
    [[nodiscard]] Status create(const Device& device, Pipelines& pipelines, const Spirv& counts,
                                uint32_t framesInFlight);
    /// The frame that had the place before is complete.
    void beginFrame(uint64_t frame);
    /// Whether the frame has room for a recording; always, if the device's mapping shares no dispatches.
    [[nodiscard]] bool holds(const Device& device, uint64_t frame, const TaskNeeds& needs) const;
    /// Sees to it that the frame has room for all that is recorded in it from now on.
    [[nodiscard]] Status reserve(const Device& device, uint64_t frame, const TaskNeeds& needs);

    /// Null before reserve().
    [[nodiscard]] TaskRoom* roomOf(uint64_t frame) const { return frames_[frame % frames_.size()].room.get(); }
    [[nodiscard]] const Kernel& counts() const { return counts_; }

private:
    struct Frame {
        std::unique_ptr<TaskRoom> room;
        std::vector<std::unique_ptr<TaskRoom>> outgrown; ///< what the frame has recorded may read them
    };
    ComputeLayout layout_;
    Kernel counts_;
    std::vector<Frame> frames_;
    uint32_t made_ = 0; ///< rooms so far
};

/// Puts together the dispatches of one kernel between two barriers.
class TaskDispatches final : public Dispatches {
public:
    /// How often count() may be called, less one; the lists have room for the phases that it begins.
    static constexpr uint32_t kPhases = 8;

    /// Without a room dispatches of no workgroups alone are recorded, which drivers compile pipelines at.
    TaskDispatches(const Device& device, VkCommandBuffer commandBuffer) : Dispatches(device, commandBuffer) {}
    /// Takes a part of the room, which has it, and records the copy of what will be in it.
    TaskDispatches(const Device& device, VkCommandBuffer commandBuffer, TaskRoom& room, const Kernel& counts,
                   const TaskNeeds& needs);

    void dispatch(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                  uint64_t groups) override;
    void dispatchIndirect(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                          VkBuffer arguments, VkDeviceSize offset) override;
    void flush() override;
    void count() override;

private:
    using Waiting = TaskRoom::Waiting;
    struct Chain {
        const Kernel* kernel = nullptr;
        bool isCounted = false; ///< the device knows how large its tasks are
        Waiting* first = nullptr;
        Waiting* last = nullptr;
    };
    static constexpr size_t kChains = 48; ///< kernels between two barriers; more begin anew

    void add(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push, uint64_t groups,
             VkDeviceAddress arguments);
    void recordNothing(const Kernel& kernel);
    [[nodiscard]] VkDeviceAddress addressOfBuffers(TaskBuffers& buffers);
    [[nodiscard]] Chain& chainOf(const Kernel& kernel, bool isCounted);
    void recordChain(const Chain& chain);
    void recordCountedChain(const Chain& chain);
    /// Writes the next entry of the list.
    void list(shared::Task task, uint32_t firstGroup);
    /// Ends a list of `count` tasks of so many workgroups, and binds the dispatch of them.
    void bindListed(const Kernel& kernel, uint32_t count, uint32_t groups);
    [[nodiscard]] shared::TaskRun* lists() const; ///< mapped

    TaskRoom* room_ = nullptr;
    const Kernel* counts_ = nullptr;
    uint64_t recording_ = 0; ///< TaskBuffers::writtenIn
    uint32_t nextListed_ = 0, nextWaiting_ = 0, nextBuffers_ = 0;
    uint32_t nextList_ = 0, firstPhase_ = 0, phase_ = 0; ///< among the lists; phase_: calls of count()
    std::array<Chain, kChains> chains_{};
    size_t chainCount_ = 0;
};

/// The kind of dispatches that the device's mapping asks for.
class OwnDispatches {
public:
    /// For a warm-up: all dispatches have no workgroups.
    OwnDispatches(const Device& device, VkCommandBuffer commandBuffer);
    /// The frame's room has the needs.
    OwnDispatches(const Device& device, VkCommandBuffer commandBuffer, const TaskRooms& rooms, uint64_t frame,
                  const TaskNeeds& needs);
    [[nodiscard]] Dispatches& operator*() { return *chosen_; }
    [[nodiscard]] Dispatches* operator->() { return chosen_; }

private:
    std::optional<SingleDispatches> single_;
    std::optional<TaskDispatches> tasks_;
    Dispatches* chosen_ = nullptr;
};

/// The address of a buffer that was made with shared dispatches.
[[nodiscard]] VkDeviceAddress addressOf(const Device& device, VkBuffer buffer);

} // namespace supple::gpu
