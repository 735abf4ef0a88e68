// Shared dispatches (docs/shared_dispatches.md): what steps of several groups do with one kernel becomes one dispatch.
// Each of its workgroups finds its task in a list, and there its push constants and the addresses of its buffers.
#pragma once

#include "base/result.h"
#include "gpu/dispatches.h"
#include "gpu/kept_tasks.h"
#include "gpu/memory.h"
#include "gpu/pipelines.h"
#include "shaders/shared/tasks.h"

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

namespace supple::gpu {

/// The memory of one frame's tasks: the host writes them while it records, and a copy at the beginning of what was
/// recorded takes them to the device. What the first recording of a frame has left there is kept: the next one of the
/// same owners writes only what has changed.
class TaskRoom {
public:
    /// `number`: of the room, so that recordings in different ones are told apart.
    [[nodiscard]] static Result<std::unique_ptr<TaskRoom>> create(const Device& device, const TaskNeeds& needs,
                                                                  uint32_t number);
    /// Beside what the frame's recordings have taken.
    [[nodiscard]] bool holds(const TaskNeeds& needs) const {
        const TaskNeeds taken = unpacked(taken_);
        return needs.tasks <= capacity_.tasks - taken.tasks && needs.buffers <= capacity_.buffers - taken.buffers;
    }
    /// For another frame.
    void clear() { taken_ = 0; }
    /// What the frame has copied may never have reached the device.
    void forget() { kept_.forget(); }

private:
    friend class TaskDispatches;
    friend class TaskRewriter;
    /// What lies where in both buffers, in bytes.
    struct Offsets {
        VkDeviceSize pushes = 0, buffers = 0, lists = 0; ///< tasks come first, and each list of them has one more
        VkDeviceSize nothing = 0;                        ///< a size of no workgroups
        VkDeviceSize arguments = 0;                      ///< of dispatches, on the device alone
    };
    /// Both counts of what is taken are one number, so that recordings on several threads take them in one order.
    [[nodiscard]] static uint64_t packed(const TaskNeeds& needs) {
        return uint64_t{needs.buffers} << 32u | needs.tasks;
    }
    [[nodiscard]] static TaskNeeds unpacked(uint64_t taken) {
        return {static_cast<uint32_t>(taken), static_cast<uint32_t>(taken >> 32u)};
    }
    /// What was taken before.
    [[nodiscard]] TaskNeeds take(const TaskNeeds& needs) { return unpacked(taken_.fetch_add(packed(needs))); }
    [[nodiscard]] std::byte* mapped(VkDeviceSize offset) const { return staging_.mapped(0) + offset; }
    [[nodiscard]] std::byte* pushOf(const RecordedTask& task) const;

    TaskNeeds capacity_;
    Offsets offsets_;
    BufferSet staging_, local_;
    VkDeviceAddress address_ = 0; ///< of `local_`
    std::vector<RecordedTask> recorded_;
    KeptTasks kept_;
    std::atomic<uint64_t> taken_ = 0; ///< packed()
    std::atomic<uint64_t> recordings_ = 0;
};

/// The rooms of the frames in flight: an even number, so that frames in which two pools take turns find what they
/// have left. They grow with the groups, and never while recording.
class TaskRooms {
public:
    /// `counts`: shared/count_tasks.comp. Makes its pipeline if the device's mapping shares dispatches.
    [[nodiscard]] Status create(const Device& device, Pipelines& pipelines, const Spirv& counts,
                                uint32_t framesInFlight);
    /// The frame that had the place before is complete.
    void beginFrame(uint64_t frame);
    void cancelFrame(uint64_t frame);
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
    /// Takes a part of the room, which has it. Then comes begin(), or what is kept goes on.
    TaskDispatches(const Device& device, VkCommandBuffer commandBuffer, TaskRoom& room, const Kernel& counts,
                   const TaskNeeds& needs);

    /// Records the copy of all tasks that are to come. `keeps`: for the next recording in the room.
    void begin(bool keeps);
    /// Who will record tasks, in the order of setOwner(). Behind begin().
    void addOwner(const TaskOwner& owner);
    void setOwner(uint32_t owner) override { owner_ = owner; }
    /// What is recorded from here on can be recorded again with recordKept().
    void enter(uint32_t place);
    void leave();
    /// All is recorded.
    void end();

    // In the place of begin():
    /// What the last recording has left; null if nothing can go on from it.
    [[nodiscard]] KeptTasks* kept() const;
    /// Writes push constants anew, for all tasks of the owner in places from `first` to `last`.
    void rewrite(const KeptTasks::Owner& owner, uint32_t first, uint32_t last, size_t offset,
                 std::span<const std::byte> bytes);
    /// Records the copy of what was written anew, and goes on from it. False: there are too many workgroups.
    [[nodiscard]] bool resume();
    /// What was recorded in that place.
    void recordKept(uint32_t place);

    void computeBarrier() override;
    [[nodiscard]] bool takesEmpty() const override { return true; }
    void dispatch(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                  uint64_t groups) override;
    void dispatchIndirect(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                          VkBuffer arguments, VkDeviceSize offset) override;
    void flush() override;
    void count() override;

private:
    friend class TaskRewriter;
    struct Chain {
        const Kernel* kernel = nullptr;
        bool isCounted = false; ///< the device knows how large its tasks are
        RecordedTask* first = nullptr;
        RecordedTask* last = nullptr;
    };
    static constexpr size_t kChains = 48; ///< kernels between two barriers; more begin anew

    [[nodiscard]] bool keeps() const { return keeps_ && room_->kept_.isKeeping(); }
    void add(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push, uint64_t groups,
             VkDeviceAddress arguments);
    void recordNothing(const Kernel& kernel);
    [[nodiscard]] VkDeviceAddress addressOfBuffers(TaskBuffers& buffers);
    [[nodiscard]] Chain& chainOf(const Kernel& kernel, bool isCounted);
    void recordChain(const Chain& chain);
    /// What was written anew of what is kept.
    void copyChanged();
    /// Writes an entry of a list.
    void list(uint32_t entry, shared::Task task, uint32_t firstGroup) const;
    /// Writes the whole list of a dispatch; the workgroups. More than kMaxGroups if they do not fit.
    [[nodiscard]] uint64_t list(const KeptTasks::Dispatch& dispatch) const;
    /// A dispatch of the next `count` tasks.
    void recordListed(KeptTasks::Dispatch dispatch);
    void record(const KeptTasks::Dispatch& dispatch);
    [[nodiscard]] shared::TaskRun* lists() const; ///< mapped

    TaskRoom* room_ = nullptr;
    const Kernel* counts_ = nullptr;
    TaskNeeds needs_;
    bool isFirst_ = false; ///< of the frame
    bool keeps_ = false, resumed_ = false;
    uint32_t owner_ = 0;
    uint64_t recording_ = 0; ///< TaskBuffers::writtenIn
    uint32_t nextListed_ = 0, nextTask_ = 0, nextBuffers_ = 0;
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
    /// Null if groups do not share dispatches.
    [[nodiscard]] TaskDispatches* tasks() { return tasks_ ? &*tasks_ : nullptr; }

private:
    std::optional<SingleDispatches> single_;
    std::optional<TaskDispatches> tasks_;
    Dispatches* chosen_ = nullptr;
};

/// The address of a buffer that was made with shared dispatches.
[[nodiscard]] VkDeviceAddress addressOf(const Device& device, VkBuffer buffer);

} // namespace supple::gpu
