// One frame: the table of passes (kPasses), and what walks it.
#include "runtime/frame.h"
#include "gpu/barriers.h"
#include "runtime/early_steps.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace supple::runtime {

namespace {

using surface::Stage;

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr VkPipelineStageFlags2 kIndirect = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;
constexpr VkAccessFlags2 kIndirectRead = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT;
constexpr gpu::SyncScope kFirstPasses{kCompute | kTransfer, kRead | kWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT};
/// What passes do with uploads: headers of tables are uniforms.
constexpr gpu::SyncScope kUploaded{kFirstPasses.stages, kFirstPasses.access | VK_ACCESS_2_UNIFORM_READ_BIT};
constexpr gpu::SyncScope kLastPasses{kCompute | kTransfer, kWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT};

/// By flags that fit the 32 bits of Vulkan 1.0.
SuppleSyncScope hostScope(gpu::SyncScope scope) {
    const gpu::BasicScope basic = gpu::basic(scope);
    return {basic.stages, basic.access};
}

/// Linked groups in two lists.
struct Separated {
    Group* first = nullptr;
    Group* second = nullptr;
};
/// The first list has those that `isFirst` holds for. Each keeps its order.
template <class Predicate>
Separated separate(Group* groups, Predicate&& isFirst) {
    Separated result;
    Group** firstEnd = &result.first;
    Group** secondEnd = &result.second;
    while (groups != nullptr) {
        Group* const group = groups;
        groups = std::exchange(group->link.next, nullptr);
        Group**& end = isFirst(*group) ? firstEnd : secondEnd;
        *end = group;
        end = &group->link.next;
    }
    return result;
}
Group* join(const Separated& lists) {
    Group* first = lists.first;
    Group** end = &first;
    while (*end != nullptr) {
        end = &(*end)->link.next;
    }
    *end = lists.second;
    return first;
}
/// Finds the first group of each view. Those of the second list come behind all of the first.
void markLeaders(const Separated& lists, uint64_t call) {
    for (Group* const list : {lists.first, lists.second}) {
        for (Group* group = list; group != nullptr; group = group->link.next) {
            group->link.leadsView = group->view() != nullptr && group->view()->enter(call);
        }
    }
}

// What passes record for one group. A cost of nothing: the group has no such pass.

PassCost recordUpload(const Frame& frame, Group& group) {
    const Context::Statics statics = frame.context.recordPendingStatics(frame.commands, group);
    // Those that follow a group come behind it.
    const std::shared_ptr<Group> leader = group.follows() ? frame.context.groups.find(group.leader()) : nullptr;
    // A leader that was recorded before this group was created may not have posed all that it draws.
    const bool lacksPoses = leader != nullptr && (leader->waitsIn(frame.number) || leader->unposed() > 0);
    if (!statics.there || lacksPoses) {
        group.recordWaiting(frame.commands, frame.number);
        return {0, statics.bytes};
    }
    PassCost cost{0, statics.bytes};
    if (group.view() != nullptr && group.view()->lastRecordedFrame() != frame.number) {
        cost.bytes += group.view()->recordUpload(frame.commands, frame.number);
    }
    cost += group.recordUpload(frame.commands, {frame.number, frame.time, frame.context.origin(), leader.get()});
    return cost;
}

PassCost recordAttributes(const Frame& frame, Tessellation& surface, surface::Round&) {
    return surface.recordAttributes(frame.dispatches, frame.number);
}

template <PassCost (Tessellation::*record)(gpu::Dispatches&) const>
PassCost recordSurface(const Frame& frame, Tessellation& surface, surface::Round&) {
    return (surface.*record)(frame.dispatches);
}
template <PassCost (Tessellation::*record)(surface::Round&) const>
PassCost recordInRounds(const Frame&, Tessellation& surface, surface::Round& round) {
    return (surface.*record)(round);
}
/// All surfaces of a group together.
template <PassCost (Tessellation::*record)(gpu::Dispatches&) const>
PassCost recordSurfaces(const Frame& frame, Group& group) {
    return group.surfaces().record([&](const Tessellation& surface) { return (surface.*record)(frame.dispatches); });
}

template <Playback::Part part>
bool poses(Group& group) {
    return !group.follows() && group.poses().has(part);
}

template <Playback::Part part>
PassCost recordPose(const Frame& frame, Group& group) {
    return poses<part>(group) ? group.poses().recordPart(frame.dispatches, part, group.windows()) : PassCost{};
}

PassCost recordPoints(const Frame& frame, Group& group) {
    return group.recordPoints(frame.dispatches);
}

PassCost recordVertexPoints(const Frame& frame, Group& group) {
    return group.recordVertexPoints(frame.dispatches);
}

PassCost recordBounds(const Frame& frame, Group& group) {
    return group.hasBounds() ? group.recordBounds(frame.dispatches) : PassCost{};
}

/// What the host reads frames later.
PassCost recordBoundsReadback(const Frame& frame, Group& group) {
    if (group.boundsReadback() != nullptr) {
        group.recordBoundsReadback(frame.commands, frame.number);
    }
    return {};
}

PassCost recordOcclusion(const Frame& frame, Group& group) {
    if (group.culling() == nullptr || !group.view()->depthPyramid()) {
        return {};
    }
    return group.culling()->recordOcclusion(frame.commands, frame.number % frame.framesInFlight,
                                            *group.view()->depthPyramid(), group.view()->pyramidGeneration());
}

bool isShortOfRoom(const Group& group) {
    return group.view() != nullptr && group.view()->roomInFrame() != shared::kRoomForAll && group.leastVertices() > 0;
}
/// If even the coarsest surfaces of all instances might not have room, those that are left out are found first.
PassCost recordSizes(const Frame& frame, Group& group) {
    if (isShortOfRoom(group)) {
        group.culling()->recordSizes(frame.dispatches, group.leastVertices());
    }
    return {};
}

PassCost recordList(const Frame& frame, Group& group) {
    if (!group.listsSeen()) {
        return {};
    }
    if (group.culling()->instanceUnits() > 0) {
        frame.dispatches.disjointBarrier();
    }
    const bool budgeted = group.surfaces().any([](const Tessellation& surface) { return surface.isBudgeted(); });
    return group.culling()->recordList(frame.dispatches, budgeted ? group.view()->roomInFrame() : shared::kRoomForAll,
                                       group.link.inView);
}

template <Stage stage>
PassCost recordStage(const Frame&, Tessellation& surface, surface::Round& round) {
    return surface.recordStage(round, stage);
}

bool choosesRates(Group& group) {
    return group.culling() != nullptr && group.culling()->hasRates();
}
bool countsRates(Group& group) {
    return choosesRates(group) && group.view()->countsRates();
}

PassCost recordPatchLevels(const Frame& frame, Group& group) {
    PassCost cost = recordSurfaces<&Tessellation::recordPatchLevels>(frame, group);
    if (countsRates(group)) {
        frame.dispatches.disjointBarrier();
        cost += group.culling()->recordDemand(frame.dispatches);
    }
    return cost;
}

/// Once a view, with the first of its groups.
PassCost recordSolve(const Frame& frame, Group& group) {
    if (!group.link.leadsView) {
        return {};
    }
    uint32_t priorities = 0;
    frame.forEach([&](Group& other) { priorities |= other.view() == group.view() ? other.listing().priorities() : 0; });
    group.view()->recordSolve(frame.commands, priorities);
    return {0, 0, true, group.view()};
}

PassCost recordRates(const Frame& frame, Group& group) {
    if (!choosesRates(group) || !group.listsSeen()) {
        return {};
    }
    frame.dispatches.disjointBarrier();
    return group.culling()->recordRates(frame.dispatches, countsRates(group));
}

/// What the host reads frames later: what each view has solved, then how many instances of each group are seen.
PassCost recordReadback(const Frame& frame, Group& group) {
    if (!group.link.leadsView) {
        return {};
    }
    View& view = *group.view();
    view.recordReadback(frame.commands);
    frame.forEach([&](Group& other) {
        if (other.view() == &view) {
            view.recordReadback(frame.commands, *other.culling(),
                                {other.patchesAtLevels(), other.leastVertices(), other.unposed()});
        }
    });
    view.recordCounts(frame.commands);
    return {};
}

// Who wants a pass. It is left out, with its barrier, if no group does.

bool always(Group&) {
    return true;
}
bool isInView(Group& group) {
    return group.view() != nullptr;
}
bool hasPoints(Group& group) {
    return !group.points().empty();
}
bool hasVertexPoints(Group& group) {
    return group.points().copyVertices();
}
bool hasBounds(Group& group) {
    return group.hasBounds();
}
bool readsBounds(Group& group) {
    return group.boundsReadback() != nullptr;
}
template <bool (Tessellation::*predicate)() const>
bool anySurface(Group& group) {
    return group.surfaces().any([](const Tessellation& surface) { return (surface.*predicate)(); });
}
template <Stage stage>
bool constructs(Group& group) {
    return group.surfaces().any([](const Tessellation& surface) { return surface.has(stage); });
}

/// The first of a frame: it finds out which groups the others are for.
constexpr PassRow kUploads = {SUPPLE_PASS_UPLOAD, always, recordUpload, Behind::nothing};

constexpr PassRow kPasses[] = {
    {SUPPLE_PASS_ATTRIBUTES, anySurface<&Tessellation::attributesDue>, recordAttributes, Behind::nothing},
    {SUPPLE_PASS_POSE, hasEarlySteps, recordEarlySteps, Behind::nothing, true, true},
    {SUPPLE_PASS_POSE, poses<Playback::Part::locals>, recordPose<Playback::Part::locals>},
    {SUPPLE_PASS_POSE, poses<Playback::Part::roots>, recordPose<Playback::Part::roots>},
    {SUPPLE_PASS_POSE, poses<Playback::Part::modifiers>, recordPose<Playback::Part::modifiers>},
    {SUPPLE_PASS_POSE, poses<Playback::Part::drivers>, recordPose<Playback::Part::drivers>},
    {SUPPLE_PASS_POSE, poses<Playback::Part::springs>, recordPose<Playback::Part::springs>},
    {SUPPLE_PASS_POSE, poses<Playback::Part::palette>, recordPose<Playback::Part::palette>},
    {SUPPLE_PASS_POSE, poses<Playback::Part::mix>, recordPose<Playback::Part::mix>},
    {SUPPLE_PASS_DEFORM, always, {}},
    {SUPPLE_PASS_POINTS, hasPoints, recordPoints, Behind::nothing},
    {SUPPLE_PASS_BOUNDS, hasBounds, recordBounds, Behind::bounds},
    {SUPPLE_PASS_BOUNDS, readsBounds, recordBoundsReadback, Behind::readback, false, true},
    {SUPPLE_PASS_BOUNDS,
     [](Group& g) { return g.view() != nullptr && g.view()->depthPyramid().has_value() && g.windows().visible > 0; },
     recordOcclusion, Behind::compute, true, true},
    {SUPPLE_PASS_BOUNDS, isInView, recordSizes, Behind::sizes, false},
    {SUPPLE_PASS_LIST, isInView, recordList, Behind::arguments},
    {SUPPLE_PASS_VERTEX, constructs<Stage::vertex>, recordStage<Stage::vertex>},
    {SUPPLE_PASS_ASSEMBLE, constructs<Stage::assemble>, recordStage<Stage::assemble>},
    {SUPPLE_PASS_PATCH, anySurface<&Tessellation::writesPatches>, recordSurface<&Tessellation::recordPatch>,
     Behind::nothing},
    {SUPPLE_PASS_LEVEL, isInView, recordInRounds<&Tessellation::recordEdgeLevels>},
    {SUPPLE_PASS_LEVEL, isInView, recordPatchLevels},
    {SUPPLE_PASS_SOLVE, isInView, recordSolve, Behind::compute, true, true},
    {SUPPLE_PASS_PLACE, anySurface<&Tessellation::findsDepths>, recordSurface<&Tessellation::recordDepths>},
    {SUPPLE_PASS_PLACE, isInView, recordSurfaces<&Tessellation::recordPlaces>, Behind::places},
    {SUPPLE_PASS_PLACE, choosesRates, recordRates, Behind::places},
    {SUPPLE_PASS_PLACE, isInView, recordReadback, Behind::readback, false, true},
    {SUPPLE_PASS_ASSEMBLE, anySurface<&Tessellation::deepens>, recordInRounds<&Tessellation::recordDeepen>},
    {SUPPLE_PASS_ATTRIBUTES, anySurface<&Tessellation::writesLevelAttributes>,
     recordSurface<&Tessellation::recordLevelAttributes>, Behind::directions},
    {SUPPLE_PASS_EVALUATE, always, recordInRounds<&Tessellation::recordEvaluate>, Behind::vertices},
    {SUPPLE_PASS_POINTS, hasVertexPoints, recordVertexPoints, Behind::nothing},
    {SUPPLE_PASS_MOTION, anySurface<&Tessellation::writesMotion>, recordInRounds<&Tessellation::recordMotion>,
     Behind::nothing},
};

/// In messages: "group 1 (pip)". A handle that is no group has no name.
std::string nameOf(size_t index, const Group* group) {
    const std::string number = "group " + std::to_string(index);
    return group != nullptr ? number + " (" + group->asset().character.name + ")" : number;
}

} // namespace

std::span<const PassRow> passRows() {
    return kPasses;
}

bool isWanted(const Frame& frame, const PassRow& row) {
    return row.wants == always || frame.any(row.wants);
}

PosePlaces posePlaces() {
    constexpr auto isPose = [](const PassRow& row) { return row.pass == SUPPLE_PASS_POSE; };
    constexpr auto first =
        static_cast<uint32_t>(std::find_if(std::begin(kPasses), std::end(kPasses), isPose) - kPasses);
    constexpr auto count = static_cast<uint32_t>(std::count_if(std::begin(kPasses), std::end(kPasses), isPose));
    static_assert(std::all_of(kPasses + first, kPasses + first + count, isPose));
    static_assert(std::none_of(kPasses, kPasses + first, [](const PassRow& row) { return row.work.isCageStages(); }));
    return {first, first + count - 1};
}

void recordBarrier(const Frame& frame, Behind behind) {
    const auto barrier = [&](gpu::SyncScope before, gpu::SyncScope after) {
        gpu::memoryBarrier(frame.device, frame.commands, before, after);
    };
    switch (behind) {
    case Behind::nothing:
        break;
    case Behind::compute:
        frame.computeBarrier();
        break;
    case Behind::uploads:
        barrier({kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT}, kUploaded);
        break;
    case Behind::bounds:
        barrier({kCompute, kWrite},
                {kCompute | VK_PIPELINE_STAGE_2_COPY_BIT, kRead | kWrite | VK_ACCESS_2_TRANSFER_READ_BIT});
        break;
    case Behind::sizes:
        if (frame.any([](const Group& group) { return isShortOfRoom(group); })) {
            frame.computeBarrier();
        }
        break;
    case Behind::arguments:
        barrier({kCompute, kWrite}, {kCompute | kIndirect, kRead | kWrite | kIndirectRead});
        frame.dispatches.count();
        break;
    case Behind::places:
        barrier({kCompute, kWrite}, {kCompute | kIndirect | VK_PIPELINE_STAGE_2_COPY_BIT,
                                     kRead | kWrite | kIndirectRead | VK_ACCESS_2_TRANSFER_READ_BIT});
        frame.dispatches.count();
        break;
    case Behind::readback:
        barrier({VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        break;
    case Behind::directions: // of tangents
        if (frame.any(anySurface<&Tessellation::writesTangents>)) {
            frame.computeBarrier();
        }
        break;
    case Behind::vertices: // points copy them; evaluate and motion may use the same memory
        if (frame.any([](Group& group) {
                return hasVertexPoints(group) || group.surfaces().any([](const Tessellation& surface) {
                    return surface.writesMotion() && surface.usesScratch();
                });
            })) {
            frame.computeBarrier();
        }
        break;
    }
}

namespace {

/// Times what a pass records of a group: then groups share no dispatch.
struct Timed {
    SupplePass pass;
    Timings::Recording& timing;
    gpu::Dispatches& dispatches;

    template <class Record>
    void operator()(const Group& group, uint32_t surface, Record&& record) const {
        dispatches.setOwner(group.link.number);
        timing.beginPass();
        const PassCost cost = record();
        if (timing.isOpen()) {
            dispatches.flush();
        }
        if (cost.bytes > 0 || cost.onDevice) {
            timing.endPass(pass, group.link.handle, surface, cost);
        }
    }
};

/// Surfaces share the barriers between rounds. If they are timed, they come one after the other, so that each is told
/// what it takes itself.
void recordEachSurface(const Frame& frame, const PassRow& row, const Timed& timed) {
    const auto forEachSurface = [&](auto&& visit) {
        frame.forEach([&](Group& group) {
            for (uint32_t surface = 0; surface < group.surfaces().size(); ++surface) {
                visit(group, surface);
            }
        });
    };
    if (!timed.timing.isOpen()) {
        surface::inRounds(frame.dispatches, [&](surface::Round& round) {
            forEachSurface([&](Group& group, uint32_t surface) {
                frame.dispatches.setOwner(group.link.number);
                (void)row.work.ofSurface(frame, group.surfaces()[surface], round);
            });
        });
        return;
    }
    forEachSurface([&](Group& group, uint32_t surface) {
        timed(group, surface, [&] {
            Tessellation& own = group.surfaces()[surface];
            PassCost cost;
            own.inRounds(frame.dispatches, [&](surface::Round& round) {
                const PassCost ofRound = row.work.ofSurface(frame, own, round);
                cost = round.number == 0 ? ofRound : cost;
            });
            return cost;
        });
    });
}

} // namespace

void recordRow(const Frame& frame, const PassRow& row, Timings::Recording& timing) {
    const Timed timed{row.pass, timing, frame.dispatches};
    if (row.work.ofSurface != nullptr) {
        recordEachSurface(frame, row, timed);
    } else {
        frame.forEach(
            [&](Group& group) { timed(group, SUPPLE_NO_SURFACE, [&] { return row.work.ofGroup(frame, group); }); });
    }
    frame.dispatches.flush();
}

void recordPass(const Frame& frame, const PassRow& row, Timings::Recording& timing) {
    if (row.timed) {
        frame.device.beginLabel(frame.commands, passName(row.pass));
    }
    recordRow(frame, row, timing);
    if (row.timed) {
        frame.device.endLabel(frame.commands);
    }
    recordBarrier(frame, row.behind);
}

void recordStageRow(const Frame& frame, size_t stage, const CageStageRow& row, Timings::Recording& timing) {
    const Timed timed{row.pass, timing, frame.dispatches};
    frame.forEach([&](Group& group) {
        const auto record = [&](uint32_t surface) {
            timed(group, surface, [&] { return group.stages().record(frame.dispatches, stage, surface); });
        };
        const auto surfaces = static_cast<uint32_t>(group.surfaces().size());
        for (uint32_t surface = 0; row.perSurface && surface < surfaces; ++surface) {
            record(surface);
        }
        if (!row.perSurface) {
            record(SUPPLE_NO_SURFACE);
        }
    });
    frame.dispatches.flush();
}

namespace {

void recordCageStage(const Frame& frame, size_t stage, const CageStageRow& row, Timings::Recording& timing) {
    frame.device.beginLabel(frame.commands, passName(row.pass));
    recordStageRow(frame, stage, row, timing);
    frame.device.endLabel(frame.commands);
    frame.computeBarrier();
}

/// Views of which no group is there: `waiting` are the groups that the frame leaves out.
void recordEmptyViews(const Frame& frame, const Group* waiting) {
    for (const Group* group = waiting; group != nullptr; group = group->link.next) {
        if (group->link.leadsView) {
            group->view()->recordNoDraws(frame.commands, frame.number);
        }
    }
}

/// Behind all passes: what they have written.
void recordHashes(const Frame& frame, StageHashes& hashes, bool withSurfaces) {
    uint32_t count = 0;
    frame.forEach([&](const Group& group) { count += group.hashCount(); });
    StageHashes::Recording recording(hashes, frame.commands, frame.number, count);
    frame.forEach([&](const Group& group) { group.recordHashes(recording, withSurfaces); });
    recording.end();
}

void recordPasses(const Frame& frame, std::span<const CageStageRow> stages, Timings::Recording& timing) {
    const auto within = [&](uint32_t place, auto&& record) {
        if (frame.tasks != nullptr) {
            frame.tasks->enter(place);
        }
        record();
        if (frame.tasks != nullptr) {
            frame.tasks->leave();
        }
    };
    forEachRow(
        stages,
        [&](uint32_t place, const PassRow& row) {
            if (isWanted(frame, row)) {
                within(place, [&] { recordPass(frame, row, timing); });
            }
        },
        [&](uint32_t place, size_t stage, const CageStageRow& row) {
            if (frame.any([&](Group& group) { return group.stages().has(stage); })) {
                within(place, [&] { recordCageStage(frame, stage, row, timing); });
            }
        });
}

/// All passes but uploads, with the barrier before them.
void recordBehindUploads(const Frame& frame, Timings::Recording& timing) {
    const bool resumes = frame.tasks != nullptr && !timing.isOpen() && resumeTasks(frame);
    if (frame.tasks != nullptr && !resumes) {
        beginTasks(frame, !timing.isOpen());
    }
    recordBarrier(frame, Behind::uploads);
    if (resumes) {
        recordKeptPasses(frame, *frame.tasks->kept());
        return;
    }
    recordPasses(frame, frame.context.stageRows(), timing);
    if (frame.tasks != nullptr) {
        frame.tasks->end();
    }
}

} // namespace

SuppleSyncScope Context::firstScope() {
    return hostScope(kFirstPasses);
}

SuppleSyncScope Context::lastScope() {
    return hostScope(kLastPasses);
}

const char* Context::faultOfLeader(const Group& group, uint64_t call) const {
    if (!group.follows()) {
        return nullptr;
    }
    const Group* const leader = groups.at(group.leader());
    if (leader == nullptr) {
        return "the group whose instances it draws is destroyed";
    }
    return leader->link.call == call || leader->askedFrame() == frame_
               ? nullptr
               : "the group whose instances it draws is not recorded in this frame";
}

Result<Group*> Context::linkGroups(const SuppleRecordDesc& desc, uint64_t call) const {
    Group* first = nullptr;
    Group** last = &first;
    // The words are put together only where they are needed: recording allocates nothing.
    const auto refuseOf = [](uint32_t g, const Group* group, ErrorCode code, const std::string& reason) {
        return Error{code, "suppleRecord: " + nameOf(g, group) + ": " + reason};
    };
    for (uint32_t g = 0; g < desc.groupCount; ++g) {
        Group* const group = groups.at(desc.groups[g].id);
        const auto refuse = [&](ErrorCode code, const std::string& reason) { return refuseOf(g, group, code, reason); };
        if (group == nullptr) {
            return refuse(ErrorCode::staleHandle, "stale or foreign handle");
        }
        if (group->askedFrame() == frame_) {
            return refuse(ErrorCode::order, "recorded twice in frame " + std::to_string(frame_));
        }
        View* const view = group->view();
        if (view != nullptr && !view->hasCamera()) {
            return refuse(ErrorCode::order, "its view has no camera yet");
        }
        if (view != nullptr && view->lastRecordedFrame() == frame_) {
            return refuse(ErrorCode::order, "other groups of its view are recorded already: one call takes them all");
        }
        if (group->link.call == call) {
            return refuse(ErrorCode::argument, "listed twice");
        }
        group->link = {nullptr, desc.groups[g], call};
        *last = group;
        last = &group->link.next;
    }
    for (uint32_t g = 0; g < desc.groupCount; ++g) {
        const Group* const group = groups.at(desc.groups[g].id);
        if (const char* const fault = faultOfLeader(*group, call)) {
            return refuseOf(g, group, ErrorCode::order, fault);
        }
    }
    // Whether a group is left out, those that follow it must know.
    const Separated own = separate(first, [](const Group& group) { return !group.follows(); });
    return join(own);
}

Context::Statics Context::recordPendingStatics(VkCommandBuffer commandBuffer, Group& group) {
    if (group.staticsThere() && !group.staticsPending() && !group.streamsClips()) {
        return {0, true};
    }
    const std::scoped_lock lock(uploading_);
    VkDeviceSize bytes = group.staticsPending() ? group.recordStatics(commandBuffer, frame_) : 0;
    bytes += recordStream(commandBuffer, group, bytes);
    if (group.lacksStatics()) {
        return {bytes, false};
    }
    group.noteStaticsThere();
    return {bytes, true};
}

Status Context::recordUploads(VkCommandBuffer commandBuffer) {
    if (Status open = checkOpen("suppleRecordUploads"); !open) {
        return open;
    }
    const std::scoped_lock lock(uploading_);
    bool recorded = false;
    groups.forEach([&](Group& group) {
        if (group.staticsPending()) {
            group.recordStatics(commandBuffer, frame_);
            recorded = true;
        }
    });
    queryPools.forEach([&](QueryPool& pool) { recorded = pool.recordStatics(commandBuffer, frame_) > 0 || recorded; });
    recorded = recordStreams(commandBuffer) || recorded;
    if (recorded) {
        gpu::memoryBarrier(*device_, commandBuffer, {kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT}, kUploaded);
    }
    return success();
}

Status Context::recordWarmUp(VkCommandBuffer commandBuffer, std::span<const SuppleGroup> wanted) {
    if (const Status open = checkOpen("suppleRecordWarmUp"); !open) {
        return open.error();
    }
    for (size_t g = 0; g < wanted.size(); ++g) {
        if (groups.find(wanted[g].id) == nullptr) {
            return Error{ErrorCode::staleHandle,
                         "suppleRecordWarmUp: group " + std::to_string(g) + ": stale or foreign handle"};
        }
    }
    Status uploaded = recordUploads(commandBuffer);
    if (!uploaded) {
        return uploaded;
    }
    // Nothing is read or written, but barriers keep validation from taking these dispatches for ones that race.
    constexpr gpu::SyncScope kAll{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                  VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
    gpu::memoryBarrier(*device_, commandBuffer, kAll, kUploaded);
    for (const SuppleGroup& handle : wanted) {
        Group& group = *groups.find(handle.id);
        if (!isOrphan(group)) {
            group.noteRecorded(frame_);
            group.recordWarmUp(commandBuffer);
        }
    }
    gpu::memoryBarrier(*device_, commandBuffer, kFirstPasses, kAll);
    return success();
}

gpu::TaskNeeds Context::taskNeeds(const Group* groups, const gpu::TaskNeeds& (Group::*ofGroup)() const) const {
    gpu::TaskNeeds needs;
    if (!device_->mapping.sharesDispatches) {
        return needs;
    }
    for (const Group* group = groups; group != nullptr; group = group->link.next) {
        needs += (group->*ofGroup)();
    }
    return needs;
}

gpu::OwnDispatches Context::earlyDispatches(const Frame& frame) const {
    return {*device_, frame.commands, taskRooms_, frame.number, taskNeeds(frame.groups, &Group::earlyNeeds)};
}

Status Context::record(VkCommandBuffer commandBuffer, const SuppleRecordDesc& desc) {
    if (Status open = checkOpen("suppleRecord"); !open) {
        return open;
    }
    const uint64_t call = ++recordings_;
    const Result<Group*> linked = linkGroups(desc, call);
    if (!linked) {
        return linked.error();
    }
    const gpu::Device& device = *device_;
    const gpu::TaskNeeds needs = taskNeeds(*linked, &Group::passNeeds);
    gpu::TaskNeeds all = needs;
    all += taskNeeds(*linked, &Group::earlyNeeds);
    if (!taskRooms_.holds(device, frame_, all)) { // the frame began without it
        return Error{ErrorCode::deviceMemory, "suppleRecord: there is no memory for shared dispatches"};
    }
    device.beginLabel(commandBuffer, "supple");
    if ((desc.flags & SUPPLE_RECORD_NO_ENTRY_BARRIER) == 0) {
        // Earlier frames' passes and the host's uses end before this frame overwrites anything.
        gpu::memoryBarrier(device, commandBuffer,
                           {desc.before.stages | kLastPasses.stages, desc.before.access | kLastPasses.access},
                           kFirstPasses);
    }
    gpu::OwnDispatches dispatches(device, commandBuffer, taskRooms_, frame_, needs);
    Frame frame{device,    commandBuffer, *dispatches, dispatches.tasks(), frame_, framesInFlight_,
                desc.time, *linked,       *this};
    Timings::Recording timing;
    if ((desc.flags & SUPPLE_RECORD_TIMINGS) != 0) {
        uint32_t surfaces = 0;
        frame.forEach([&](Group& group) { surfaces += static_cast<uint32_t>(group.surfaces().size()); });
        timing =
            timings.open(commandBuffer, Timings::mostEntries(surfaces, static_cast<uint32_t>(stages_.rows().size())));
    }
    recordPass(frame, kUploads, timing);
    const Separated groups = separate(*linked, [this](const Group& group) { return !group.waitsIn(frame_); });
    markLeaders(groups, call);
    recordEmptyViews(frame, groups.second);
    frame.groups = groups.first;
    frame.numberGroups();
    frame.findRoom();
    recordBehindUploads(frame, timing);
    timing.end();
    if (recordsHashes()) {
        recordHashes(frame, *hashes_, recorder_->hashesSurfacesIn(frame_));
    }
    frame.groups = join(groups);
    if (asyncCompute_) {
        Releases releases(device, commandBuffer, families_, {lastScope().stages, lastScope().access});
        frame.forEach([&](Group& group) { group.addTransfers(releases, group.link.leadsView); });
    }
    if (desc.after.stages != 0) {
        gpu::memoryBarrier(device, commandBuffer, kLastPasses, {desc.after.stages, desc.after.access});
    }
    device.endLabel(commandBuffer);
    return success();
}

Result<uint32_t> Context::acquireBarriers(std::span<const SuppleGroup> wanted, SuppleSyncScope use,
                                          std::span<VkBufferMemoryBarrier2> out) const {
    if (!asyncCompute_) {
        return Error{ErrorCode::argument, "suppleGetAcquireBarriers: the context has no SUPPLE_CONTEXT_ASYNC_COMPUTE"};
    }
    // All checks before the first barrier is written: a call that fails has done nothing.
    for (size_t g = 0; g < wanted.size(); ++g) {
        const std::shared_ptr<Group> group = groups.find(wanted[g].id);
        const auto refuse = [&](ErrorCode code, const char* reason) {
            return Error{code, "suppleGetAcquireBarriers: " + nameOf(g, group.get()) + ": " + reason};
        };
        if (group == nullptr) {
            return refuse(ErrorCode::staleHandle, "stale or foreign handle");
        }
        if (group->askedFrame() != frame_ || !frameOpen_) {
            return refuse(ErrorCode::order, "not recorded in this frame");
        }
    }
    Acquires acquires(families_, {use.stages, use.access}, out);
    for (size_t g = 0; g < wanted.size(); ++g) {
        const std::shared_ptr<Group> group = groups.find(wanted[g].id);
        const bool leadsView =
            group->view() != nullptr &&
            std::none_of(wanted.begin(), wanted.begin() + static_cast<ptrdiff_t>(g),
                         [&](const SuppleGroup& h) { return groups.find(h.id)->view() == group->view(); });
        group->addTransfers(acquires, leadsView);
    }
    return acquires.count();
}

} // namespace supple::runtime
