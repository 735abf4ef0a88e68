// Frames that go on from the tasks of an earlier one (gpu/kept_tasks.h).
#include "gpu/task_rewriter.h"
#include "runtime/frame.h"

#include <cstddef>
#include <utility>

namespace supple::runtime {

namespace {

/// The group's tasks of the places from `first` to `last`, over those that are kept. False: there are others.
bool rewriteTasks(const Frame& frame, Group& group, gpu::TaskRewriter rewriter, uint32_t first, uint32_t last) {
    Group* const next = std::exchange(group.link.next, nullptr);
    const Frame own{.device = frame.device,
                    .commands = frame.commands,
                    .dispatches = rewriter,
                    .tasks = nullptr,
                    .number = frame.number,
                    .framesInFlight = frame.framesInFlight,
                    .time = frame.time,
                    .groups = &group,
                    .context = frame.context};
    Timings::Recording untimed;
    forEachRow(
        frame.context.stageRows(),
        [&](uint32_t place, const PassRow& row) {
            if (place >= first && place <= last && !row.byCommands && isWanted(own, row)) {
                rewriter.enter(place);
                recordRow(own, row, untimed);
            }
        },
        [&](uint32_t place, size_t stage, const CageStageRow& row) {
            if (place >= first && place <= last && group.stages().has(stage)) {
                rewriter.enter(place);
                recordStageRow(own, stage, row, untimed);
            }
        });
    group.link.next = next;
    return rewriter.end(last);
}

/// Brings what is kept of a group up to date. False: it cannot be.
bool refreshTasks(const Frame& frame, Group& group, gpu::KeptTasks::Owner& kept) {
    const gpu::TaskOwner now = group.taskOwner();
    const gpu::TaskOwner before = std::exchange(kept.who, now);
    if (now.recordsOnce) {
        return false; // if it were recorded twice, the second time would find that it is done
    }
    if (!now.isLike(before)) {
        constexpr uint32_t kLast = gpu::KeptTasks::kPlaces - 1;
        return rewriteTasks(frame, group, {*frame.tasks, kept, 0}, 0, kLast);
    }
    const Playback* const playback = now.poses != 0 ? group.poses().playback() : nullptr;
    const auto [first, last] = posePlaces();
    if (group.stages().tasks() == CageStageRow::Tasks::written) {
        const auto stages = static_cast<uint32_t>(frame.context.stageRows().size()); // which follow poses
        return rewriteTasks(frame, group, {*frame.tasks, kept, first}, first, last + stages);
    }
    if (playback == nullptr) {
        return true;
    }
    if (now.poses != before.poses || playback->listsPoses()) {
        return rewriteTasks(frame, group, {*frame.tasks, kept, first}, first, last);
    }
    const skinning::SplitTime time = playback->splitTime();
    static_assert(offsetof(shared::PosePush, timeHigh) == 0 && offsetof(shared::PosePush, timeLow) == sizeof(float) &&
                  sizeof(time) == 2 * sizeof(float));
    frame.tasks->rewrite(kept, first, last, 0, std::as_bytes(std::span(&time, 1)));
    return true;
}

/// Whether the barrier is among what is kept.
constexpr bool isKept(Behind behind) {
    return behind != Behind::uploads && behind != Behind::bounds && behind != Behind::arguments &&
           behind != Behind::places && behind != Behind::readback;
}

} // namespace

bool resumeTasks(const Frame& frame) {
    gpu::KeptTasks* const kept = frame.tasks->kept();
    if (kept == nullptr) {
        return false;
    }
    const std::span<gpu::KeptTasks::Owner> owners = kept->owners();
    size_t count = 0;
    bool same = true;
    frame.forEach([&](const Group& group) {
        same = same && count < owners.size() && owners[count].who.id == group.number();
        ++count;
    });
    same = same && count == owners.size();
    frame.forEach([&](Group& group) { same = same && refreshTasks(frame, group, owners[group.link.number]); });
    return same && frame.tasks->resume();
}

void beginTasks(const Frame& frame, bool keeps) {
    frame.tasks->begin(keeps && !frame.any([](const Group& group) { return !group.keepsTasks(); }));
    frame.forEach([&](const Group& group) { frame.tasks->addOwner(group.taskOwner()); });
}

void recordKeptPasses(const Frame& frame, gpu::KeptTasks& kept) {
    Timings::Recording untimed;
    const auto recordLabelled = [&](bool labelled, SupplePass pass, uint32_t place) {
        if (labelled) {
            frame.device.beginLabel(frame.commands, passName(pass));
        }
        frame.tasks->recordKept(place);
        if (labelled) {
            frame.device.endLabel(frame.commands);
        }
    };
    forEachRow(
        frame.context.stageRows(),
        [&](uint32_t place, const PassRow& row) {
            if (row.byCommands) {
                if (isWanted(frame, row)) {
                    recordPass(frame, row, untimed);
                }
                return;
            }
            if (!kept.uses(place)) {
                return;
            }
            recordLabelled(row.timed, row.pass, place);
            if (!isKept(row.behind)) {
                recordBarrier(frame, row.behind);
            }
        },
        [&](uint32_t place, size_t, const CageStageRow& row) {
            if (kept.uses(place)) {
                recordLabelled(true, row.pass, place);
            }
        });
}

} // namespace supple::runtime
