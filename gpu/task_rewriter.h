// Writes what an owner of kept tasks (gpu/kept_tasks.h) records now over what it has recorded before.
#pragma once

#include "gpu/tasks.h"

namespace supple::gpu {

/// Takes the owner's dispatches of some places, in their order, and records nothing. Tasks that do not come again have
/// no workgroups from then on.
class TaskRewriter final : public Dispatches {
public:
    TaskRewriter(const TaskDispatches& tasks, const KeptTasks::Owner& owner, uint32_t firstPlace);

    void enter(uint32_t place) {
        place_ = place;
        barriers_ = written_ = 0;
    }
    [[nodiscard]] bool takesEmpty() const override { return true; }
    void dispatch(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                  uint64_t groups) override;
    void dispatchIndirect(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                          VkBuffer arguments, VkDeviceSize offset) override;
    void flush() override {}
    void computeBarrier() override { barriers_ = written_ + 1; }
    /// Nothing more comes of the places up to `last`. False: there was a task that is not kept.
    [[nodiscard]] bool end(uint32_t last);

private:
    void write(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push, uint64_t groups,
               VkDeviceAddress arguments);
    /// Goes on behind the task.
    void leaveOut(RecordedTask& task);
    void resize(RecordedTask& task, uint64_t groups, VkDeviceAddress arguments);

    TaskRoom* room_;
    RecordedTask* next_;
    uint32_t place_ = 0;
    // How many of the place's barriers must come before the next task, as it waits for those that were written; and
    // how many come before the last one of these. Other owners may have asked for more of them than this one.
    uint32_t barriers_ = 0, written_ = 0;
    bool failed_ = false;
};

} // namespace supple::gpu
