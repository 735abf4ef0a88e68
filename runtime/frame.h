// What the files of a frame share: what its passes work with, and the rows of its table.
#pragma once

#include "runtime/context.h"

#include <cstdint>
#include <span>

namespace supple::runtime {

/// What the passes of one suppleRecord work with.
struct Frame {
    const gpu::Device& device;
    VkCommandBuffer commands;
    gpu::Dispatches& dispatches; ///< into it, of surfaces
    gpu::TaskDispatches* tasks;  ///< these, if groups share them; else null
    uint64_t number = 0;
    uint32_t framesInFlight = 2;
    double time = 0.0;       ///< the host's, in seconds
    Group* groups = nullptr; ///< linked (Group::Link)
    Context& context;

    template <class F>
    void forEach(F&& visit) const {
        for (Group* group = groups; group != nullptr; group = group->link.next) {
            visit(*group);
        }
    }
    template <class F>
    [[nodiscard]] bool any(F&& predicate) const {
        for (Group* group = groups; group != nullptr; group = group->link.next) {
            if (predicate(*group)) {
                return true;
            }
        }
        return false;
    }
    void computeBarrier() const { dispatches.computeBarrier(); }
    void numberGroups() const {
        uint32_t next = 0;
        forEach([&](Group& group) { group.link.number = next++; });
    }
    /// Tells each view what its groups need (View::roomInFrame).
    void findRoom() const {
        forEach([](Group& group) {
            if (group.view() != nullptr) {
                group.link.inView = group.view()->addNeeds(group.leastVerticesOfAll(), group.poolUnitsOfAll());
            }
        });
        forEach([](Group& leader) {
            if (leader.link.leadsView) {
                leader.view()->findRoom();
            }
        });
    }
};

/// What stands behind a pass: who may read what it wrote.
enum class Behind { nothing, compute, uploads, bounds, sizes, arguments, places, readback, directions, vertices };

/// What a pass records: for every group, or for every surface of it. Nothing: it stands for the table of cage stages
/// (runtime/stages/cage_stages.h).
struct PassWork {
    constexpr PassWork() = default;
    constexpr PassWork(PassCost (*record)(const Frame&, Group&)) : ofGroup(record) {} // NOLINT
    constexpr PassWork(PassCost (*record)(const Frame&, Tessellation&, surface::Round&))
        : ofSurface(record) {} // NOLINT

    PassCost (*ofGroup)(const Frame&, Group&) = nullptr;
    PassCost (*ofSurface)(const Frame&, Tessellation&, surface::Round&) = nullptr;
    [[nodiscard]] constexpr bool isCageStages() const { return ofGroup == nullptr && ofSurface == nullptr; }
};

struct PassRow {
    SupplePass pass;
    bool (*wants)(Group&);
    PassWork work;
    Behind behind = Behind::compute;
    bool timed = true;       ///< false: part of the pass before, without label and timing
    bool byCommands = false; ///< it records commands of its own, and nothing that groups share
};

/// The table. One row stands for all cage stages.
[[nodiscard]] std::span<const PassRow> passRows();
/// Calls ofRow(place, row) for each row of passRows(), and ofStage(place, stage, row) for each of the cage stages among
/// them. A place is the number in this order (gpu/kept_tasks.h).
template <class OfRow, class OfStage>
void forEachRow(std::span<const CageStageRow> stages, OfRow&& ofRow, OfStage&& ofStage) {
    uint32_t place = 0;
    for (const PassRow& row : passRows()) {
        if (!row.work.isCageStages()) {
            ofRow(place++, row);
            continue;
        }
        for (size_t stage = 0; stage < stages.size(); ++stage) {
            ofStage(place++, stage, stages[stage]);
        }
    }
}
[[nodiscard]] bool isWanted(const Frame& frame, const PassRow& row);
/// The places of poses: they follow each other, before the cage stages.
struct PosePlaces {
    uint32_t first = 0, last = 0;
};
[[nodiscard]] PosePlaces posePlaces();

/// What a row records between its label and its barrier.
void recordRow(const Frame& frame, const PassRow& row, Timings::Recording& timing);
/// The same of a row of the table of cage stages.
void recordStageRow(const Frame& frame, size_t stage, const CageStageRow& row, Timings::Recording& timing);
/// The same with its label and its barrier.
void recordPass(const Frame& frame, const PassRow& row, Timings::Recording& timing);
void recordBarrier(const Frame& frame, Behind behind);

// Frames whose tasks are kept from an earlier one (runtime/kept_frame.cpp, gpu/kept_tasks.h).
/// True: the frame goes on from the tasks of an earlier one, which are up to date.
[[nodiscard]] bool resumeTasks(const Frame& frame);
/// Records the tasks of all groups anew. `keeps`: for later frames.
void beginTasks(const Frame& frame, bool keeps);
void recordKeptPasses(const Frame& frame, gpu::KeptTasks& kept);

} // namespace supple::runtime
