#include "gpu/kept_tasks.h"

namespace supple::gpu {

void KeptTasks::reserve(uint32_t tasks) {
    owners_.reserve(tasks);
    dispatches_.reserve(tasks);
    commands_.reserve(size_t{2} * tasks + kPlaces); // a barrier behind each dispatch and each place
}

void KeptTasks::begin(const TaskNeeds& needs) {
    complete_ = false;
    keeping_ = true;
    needs_ = needs;
    owners_.clear();
    dispatches_.clear();
    commands_.clear();
    places_.fill({});
    used_ = 0;
}

void KeptTasks::addOwner(const TaskOwner& owner) {
    add(owners_, Owner{owner, nullptr, nullptr});
}

void KeptTasks::enter(uint32_t place, uint32_t nextTask) {
    keeping_ = keeping_ && place < kPlaces;
    if (keeping_) {
        place_ = place;
        used_ |= uint64_t{1} << place;
        const auto command = static_cast<uint32_t>(commands_.size());
        places_[place] = {command, command, nextTask, nextTask, 0, false};
    }
}

void KeptTasks::leave(uint32_t nextTask) {
    places_[place_].endTask = nextTask;
}

void KeptTasks::addTask(uint32_t owner, RecordedTask& task) {
    keeping_ = keeping_ && owner < owners_.size();
    if (!keeping_) {
        return;
    }
    task.place = place_;
    task.barriers = places_[place_].barriers;
    task.nextOfOwner = nullptr;
    Owner& own = owners_[owner];
    (own.last != nullptr ? own.last->nextOfOwner : own.first) = &task;
    own.last = &task;
}

void KeptTasks::addDispatch(const Dispatch& dispatch) {
    const auto number = static_cast<uint32_t>(dispatches_.size());
    add(dispatches_, dispatch);
    RecordedTask* task = dispatch.first;
    for (uint32_t i = 0; i < dispatch.count; ++i, task = task->next) {
        task->dispatch = number;
    }
    addCommand(number);
}

void KeptTasks::addBarrier() {
    addCommand(kBarrier);
    ++places_[place_].barriers;
}

void KeptTasks::addCommand(uint32_t command) {
    add(commands_, command);
    places_[place_].endCommand = static_cast<uint32_t>(commands_.size());
}

std::span<const uint32_t> KeptTasks::commandsOf(uint32_t place) const {
    const Place& own = places_[place];
    return std::span(commands_).subspan(own.firstCommand, own.endCommand - own.firstCommand);
}

} // namespace supple::gpu
