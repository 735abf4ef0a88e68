// What a recording has left of its shared dispatches in a room (gpu/tasks.h), so that the next one there writes only
// the tasks that have changed.
#pragma once

#include "gpu/dispatches.h"

#include <array>
#include <cstdint>
#include <span>
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
    bool operator==(const TaskNeeds&) const = default;
};

/// Who records tasks, a group, and what they follow from, in numbers that the caller compares.
struct TaskOwner {
    uint64_t id = 0;          ///< no other owner ever has it
    uint64_t version = 0;     ///< of what the tasks of all passes follow from
    uint32_t pools = 0;       ///< a bit for each of the buffers that take turns
    uint32_t room = 0;        ///< that its view tells it of
    bool countsRates = false; ///< its view does
    bool recordsOnce = false; ///< it also records what stands from then on
    uint64_t poses = 0;       ///< what the tasks of poses follow from beside their time; 0: there are none

    /// Whether all but the tasks of poses stand.
    [[nodiscard]] bool isLike(const TaskOwner& other) const {
        return version == other.version && pools == other.pools && room == other.room &&
               countsRates == other.countsRates && recordsOnce == other.recordsOnce;
    }
};

/// A task of a dispatch. It stays where it is as long as it is kept.
struct RecordedTask {
    shared::Task task{};
    uint64_t groups = 0;          ///< workgroups; unless the device knows them
    RecordedTask* next = nullptr; ///< of the same dispatch
    RecordedTask* nextOfOwner = nullptr;
    // What tells it from the owner's other tasks of the place, in their order.
    const void* pipeline = nullptr;
    const TaskBuffers* buffers = nullptr;
    uint32_t place = 0;
    uint32_t barriers = 0; ///< in the place, before it
    uint32_t dispatch = 0; ///< among the kept ones
};

/// Places are parts of a frame, in their order: an owner's tasks of one place come together, or not at all.
class KeptTasks {
public:
    static constexpr uint32_t kPlaces = 64;
    static constexpr uint32_t kBarrier = 0xFFFFFFFFu; ///< among the commands of a place

    struct Dispatch {
        Kernel kernel;
        bool isCounted = false;             ///< the device knows how large its tasks are
        bool changed = false;               ///< its list is to be written anew
        uint32_t firstEntry = 0, count = 0; ///< of its list
        uint64_t groups = 0;
        VkDeviceSize arguments = 0; ///< if isCounted: where its size stands
        RecordedTask* first = nullptr;
    };
    struct Place {
        uint32_t firstCommand = 0, endCommand = 0;
        uint32_t firstTask = 0, endTask = 0;
        uint32_t barriers = 0; ///< so far
        bool changed = false;  ///< push constants of its tasks
    };
    struct Owner {
        TaskOwner who;
        RecordedTask* first = nullptr;
        RecordedTask* last = nullptr;
    };

    /// Takes memory for a recording of so many tasks.
    void reserve(uint32_t tasks);
    /// Nothing is kept until complete().
    void forget() { complete_ = false; }
    /// Begins anew.
    void begin(const TaskNeeds& needs);
    /// False: the recording had more than there is room for, and nothing is kept.
    [[nodiscard]] bool isKeeping() const { return keeping_; }
    void complete() { complete_ = keeping_; }
    /// Whether a recording of these needs may go on from here.
    [[nodiscard]] bool stands(const TaskNeeds& needs) const { return complete_ && needs == needs_; }

    void addOwner(const TaskOwner& owner);
    [[nodiscard]] std::span<Owner> owners() { return owners_; }
    void enter(uint32_t place, uint32_t nextTask);
    void leave(uint32_t nextTask);
    void addTask(uint32_t owner, RecordedTask& task);
    /// Tells its tasks which dispatch theirs is.
    void addDispatch(const Dispatch& dispatch);
    void addBarrier();

    [[nodiscard]] std::span<Place> places() { return places_; }
    [[nodiscard]] bool uses(uint32_t place) const { return place < kPlaces && (used_ >> place & 1u) != 0; }
    /// Numbers of dispatches, and kBarrier, in the order in which they were recorded there.
    [[nodiscard]] std::span<const uint32_t> commandsOf(uint32_t place) const;
    [[nodiscard]] std::span<Dispatch> dispatches() { return dispatches_; }

private:
    template <class T>
    void add(std::vector<T>& list, const T& element) {
        keeping_ = keeping_ && list.size() < list.capacity();
        if (keeping_) {
            list.push_back(element);
        }
    }
    void addCommand(uint32_t command);

    bool complete_ = false, keeping_ = false;
    TaskNeeds needs_;
    std::vector<Owner> owners_;
    std::vector<Dispatch> dispatches_;
    std::vector<uint32_t> commands_;
    std::array<Place, kPlaces> places_{};
    uint64_t used_ = 0; ///< bits of places
    uint32_t place_ = 0;
};

} // namespace supple::gpu
