#include "gpu/task_rewriter.h"

#include <cstring>

namespace supple::gpu {

TaskRewriter::TaskRewriter(const TaskDispatches& tasks, const KeptTasks::Owner& owner, uint32_t firstPlace)
    : Dispatches(tasks.device(), tasks.commandBuffer()), room_(tasks.room_), next_(owner.first) {
    while (next_ != nullptr && next_->place < firstPlace) {
        next_ = next_->nextOfOwner;
    }
}

void TaskRewriter::resize(RecordedTask& task, uint64_t groups, VkDeviceAddress arguments) {
    KeptTasks::Dispatch& dispatch = room_->kept_.dispatches()[task.dispatch];
    dispatch.changed = dispatch.changed || task.groups != groups || task.task.arguments != arguments;
    task.groups = groups;
    task.task.arguments = arguments;
}

void TaskRewriter::leaveOut(RecordedTask& task) {
    const bool isCounted = room_->kept_.dispatches()[task.dispatch].isCounted;
    resize(task, 0, isCounted ? room_->address_ + room_->offsets_.nothing : 0);
    next_ = task.nextOfOwner;
}

void TaskRewriter::write(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push, uint64_t groups,
                         VkDeviceAddress arguments) {
    const auto isSame = [&](const RecordedTask& task) {
        return task.place == place_ && task.barriers >= barriers_ && task.pipeline == kernel.pipeline &&
               task.buffers == bound.buffers && room_->kept_.dispatches()[task.dispatch].isCounted == (arguments != 0);
    };
    while (next_ != nullptr && next_->place <= place_ && !isSame(*next_)) {
        leaveOut(*next_);
    }
    if (next_ == nullptr || next_->place > place_) {
        failed_ = true;
        return;
    }
    std::memcpy(room_->pushOf(*next_), push.data(), push.size());
    room_->kept_.places()[place_].changed = true;
    resize(*next_, groups, arguments);
    written_ = next_->barriers;
    next_ = next_->nextOfOwner;
}

void TaskRewriter::dispatch(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                            uint64_t groups) {
    write(kernel, bound, push, groups, 0);
}

void TaskRewriter::dispatchIndirect(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                                    VkBuffer arguments, VkDeviceSize offset) {
    write(kernel, bound, push, 0, addressOf(device(), arguments) + offset);
}

bool TaskRewriter::end(uint32_t last) {
    while (next_ != nullptr && next_->place <= last) {
        leaveOut(*next_);
    }
    return !failed_;
}

} // namespace supple::gpu
