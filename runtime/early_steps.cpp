#include "runtime/early_steps.h"

#include <algorithm>

namespace supple::runtime {

namespace {

using Part = Playback::Part;

/// In the order of the pose pass.
constexpr Part kParts[] = {Part::locals, Part::roots, Part::modifiers, Part::drivers, Part::springs, Part::palette};

template <class Record>
void recordPart(const Frame& frame, gpu::Dispatches& dispatches, uint32_t round, Record&& record) {
    frame.forEach([&](Group& group) {
        if (group.earlyRounds() >= round) {
            record(group);
        }
    });
    dispatches.computeBarrier();
}

void recordRound(const Frame& frame, gpu::Dispatches& dispatches, uint32_t round) {
    for (const Part part : kParts) {
        const bool any = frame.any(
            [&](Group& group) { return group.earlyRounds() >= round && group.poses().playback()->hasEarly(part); });
        if (!any) {
            continue;
        }
        recordPart(frame, dispatches, round, [&](Group& group) {
            const Playback& playback = *group.poses().playback();
            if (playback.hasEarly(part)) {
                group.windows().forEach(
                    [&](uint32_t w) { playback.record(dispatches, part, w, group.windows(), round); });
            }
        });
    }
    recordPart(frame, dispatches, round, [&](Group& group) { group.stages().recordEarly(dispatches, round); });
}

} // namespace

bool hasEarlySteps(Group& group) {
    return group.earlyRounds() > 0;
}

PassCost recordEarlySteps(const Frame& frame, Group& group) {
    if (&group != frame.groups) {
        return {};
    }
    uint32_t rounds = 0;
    frame.forEach([&](const Group& other) { rounds = std::max(rounds, other.earlyRounds()); });
    // They follow from the frame rate. So they are no tasks that later frames go on from.
    gpu::OwnDispatches dispatches = frame.context.earlyDispatches(frame);
    if (dispatches.tasks() != nullptr) {
        dispatches.tasks()->begin(false);
        recordBarrier(frame, Behind::uploads);
    }
    for (uint32_t round = rounds; round > 0; --round) {
        recordRound(frame, *dispatches, round);
    }
    return {0, 0, true};
}

} // namespace supple::runtime
