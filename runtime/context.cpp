#include "runtime/context.h"

#include "runtime/run_jobs.h"
#include "shaders/shared_count_tasks_comp.h"
#include "surface/grid.h"

#include <algorithm>

namespace supple::runtime {

namespace {

Timings::Shortfall shortfallOf(const View& view, uint64_t frame) {
    const std::optional<SuppleViewStatistics> statistics = view.statisticsOf(frame);
    if (!statistics || statistics->shortfall == 0) {
        return {};
    }
    const uint32_t lacking =
        statistics->wantedVertexCount - std::min(statistics->wantedVertexCount, statistics->vertexCount);
    return {true, statistics->droppedInstanceCount, uint64_t{lacking} * vertexBytes(view.desc().vertexFormat)};
}

gpu::MemorySource memorySourceOf(const SuppleMemoryCallbacks& callbacks) {
    gpu::MemorySource source;
    source.allocate = [callbacks](const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                                  VkMemoryPropertyFlags preferred, const char* name, gpu::HostMemory& out) {
        SuppleMemory memory{};
        const VkResult result = callbacks.allocate(&requirements, required, preferred, name, &memory, callbacks.user);
        out = {memory.memory, memory.offset, memory.mapped, memory.allocation};
        return result;
    };
    source.free = [callbacks](const gpu::HostMemory& piece) {
        const SuppleMemory memory{piece.memory, piece.offset, piece.mapped, piece.allocation};
        callbacks.free(&memory, callbacks.user);
    };
    return source;
}

gpu::DeviceDesc deviceDescOf(const SuppleContextDesc& desc) {
    gpu::DeviceDesc device;
    device.instance = desc.instance;
    device.physicalDevice = desc.physicalDevice;
    device.device = desc.device;
    device.queueFamily = desc.queueFamily;
    const bool handsOver = (desc.flags & SUPPLE_CONTEXT_ASYNC_COMPUTE) != 0;
    device.drawQueueFamily = handsOver ? desc.drawQueueFamily : desc.queueFamily;
    device.getInstanceProcAddr = desc.getInstanceProcAddr;
    device.pipelineCache = desc.pipelineCache;
    device.allocator = desc.allocator;
    device.enabledFeatures = desc.enabledFeatures;
    if (desc.memory != nullptr) {
        device.memorySource = memorySourceOf(*desc.memory);
    }
    device.memoryBlockSize = desc.memoryBlockSize;
    device.shareDispatches = (desc.flags & SUPPLE_CONTEXT_SHARED_DISPATCHES) != 0;
    device.fanRecords = (desc.flags & SUPPLE_CONTEXT_FAN_RECORDS) != 0;
    device.rayTracing = (desc.flags & SUPPLE_CONTEXT_RAY_TRACING) != 0;
    device.debugUtils = (desc.flags & SUPPLE_CONTEXT_DEBUG_UTILS) != 0;
    device.mapping = desc.mapping == SUPPLE_MAPPING_NARROW ? gpu::MappingChoice::narrow
                     : desc.mapping == SUPPLE_MAPPING_WIDE ? gpu::MappingChoice::wide
                                                           : gpu::MappingChoice::automatic;
    return device;
}

} // namespace

Result<std::unique_ptr<Context>> Context::create(const SuppleContextDesc& desc, const surface::Shaders& shaders,
                                                 std::span<const CageStageRow> stages) {
    auto context = std::make_unique<Context>();
    context->stages_ = CageStageTable(stages);
    context->log_ = desc.log;
    context->logUser_ = desc.logUser;
    context->framesInFlight_ = desc.framesInFlight == 0 ? 2 : desc.framesInFlight;
    context->flags_ = desc.flags;
    if ((desc.flags & SUPPLE_CONTEXT_RECORDABLE) != 0) {
        context->keeper_ = std::make_unique<CallKeeper>();
        context->keeps_ = true;
    }

    context->asyncCompute_ = (desc.flags & SUPPLE_CONTEXT_ASYNC_COMPUTE) != 0;
    const gpu::DeviceDesc deviceDesc = deviceDescOf(desc);
    context->families_ = {desc.queueFamily, deviceDesc.drawQueueFamily};
    Result<gpu::Device> device = gpu::Device::create(deviceDesc);
    if (!device) {
        return device.error();
    }
    context->device_ = std::make_unique<gpu::Device>(std::move(*device));
    const gpu::Device& d = *context->device_;
    context->device_->uploads = &context->uploads_;
    if (d.mapping.lacksTexels) {
        context->log(SUPPLE_SEVERITY_INFO, SUPPLE_MESSAGE_LIMIT,
                     "suppleCreateContext: the device reads at most " +
                         std::to_string(d.limits.maxTexelBufferElements) +
                         " texels of a buffer, so the mapping is SUPPLE_MAPPING_WIDE");
    }
    context->pipelines_ = std::make_unique<gpu::Pipelines>(d, runJobsOf(desc.runJobs, desc.jobsUser));
    context->kernels_ = std::make_unique<SharedKernels>(d, *context->pipelines_);
    if (const Status rooms =
            context->taskRooms_.create(d, *context->pipelines_, shared_count_tasks_comp, context->framesInFlight_);
        !rooms) {
        return rooms.error();
    }

    Result<surface::Programs> passes = surface::Programs::create(d, *context->pipelines_, shaders);
    if (!passes) {
        return passes.error();
    }
    context->surface_ = std::move(*passes);

    const std::vector<float> pairs = surface::parameterPairs();
    const gpu::StaticRequest request{"supple parameter pairs", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                     std::as_bytes(std::span(pairs))};
    Result<gpu::StaticBuffers> pairBuffers = gpu::StaticBuffers::create(d, {&request, 1});
    if (!pairBuffers) {
        return pairBuffers.error();
    }
    context->pairs_ = std::move(*pairBuffers);

    const Status timings = context->timings.create(d, context->framesInFlight_);
    if (!timings) {
        return timings.error();
    }
    return context;
}

void Context::log(SuppleSeverity severity, SuppleMessage message, const std::string& text) const {
    if (log_ != nullptr) {
        log_(severity, message, text.c_str(), logUser_);
    }
}

Status Context::checkFrame(uint64_t frame, uint64_t completedFrame) const {
    const auto refuse = [&](ErrorCode code, const std::string& reason) {
        return Error{code, "suppleBeginFrame: frame " + std::to_string(frame) + reason};
    };
    const auto refuseCompleted = [&](const std::string& reason) {
        return refuse(ErrorCode::range, " with completed frame " + std::to_string(completedFrame) + ": " + reason);
    };
    if (frame <= frame_) {
        return refuse(ErrorCode::order, " does not rise above frame " + std::to_string(frame_));
    }
    if (completedFrame >= frame) {
        return refuseCompleted("a frame cannot be complete before it has been recorded");
    }
    if (completedFrame < completedFrame_) {
        return refuseCompleted("frame " + std::to_string(completedFrame_) + " was complete before");
    }
    const uint64_t needed = frame - completedFrame;
    if (needed > framesInFlight_) {
        const std::string more = needed <= SUPPLE_MAX_FRAMES_IN_FLIGHT
                                     ? ", or create the context with framesInFlight = " + std::to_string(needed)
                                     : "";
        return refuseCompleted("the context keeps " + std::to_string(framesInFlight_) +
                               " frames in flight, so wait for frame " + std::to_string(frame - framesInFlight_) +
                               more);
    }
    return success();
}

Status Context::checkOpen(const char* function) const {
    const auto refuse = [function](const std::string& reason) {
        return Error{ErrorCode::order, std::string(function) + ": " + reason};
    };
    if (refusedFrame_) {
        return refuse("suppleBeginFrame refused frame " + std::to_string(*refusedFrame_) +
                      ", so nothing can be recorded until it takes one");
    }
    if (frame_ == 0) {
        return refuse("no frame has begun: call suppleBeginFrame");
    }
    return frameOpen_ ? success() : refuse("frame " + std::to_string(frame_) + " is cancelled: call suppleBeginFrame");
}

bool Context::hasRecorded() const {
    bool recorded = false;
    groups.forEach([&](const Group& group) { recorded = recorded || group.passesFrame() == frame_; });
    return frameOpen_ && recorded;
}

void Context::warnOfUnrecorded() {
    if (!hasRecorded()) {
        return;
    }
    groups.forEach([&](Group& group) {
        if (group.noteUnrecordedFrame()) {
            log(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_NEVER_RECORDED,
                group.asset().character.name +
                    ": outputs of this group were asked for and it has visible instances, but suppleRecord was never "
                    "called for it: if it is drawn, its buffers hold nothing");
        }
    });
}

Status Context::beginFrame(uint64_t frame, uint64_t completedFrame) {
    Status status = checkFrame(frame, completedFrame);
    status = status ? takeFrame(frame, completedFrame) : status;
    refusedFrame_ = status ? std::nullopt : std::optional(frame);
    return status;
}

Status Context::takeFrame(uint64_t frame, uint64_t completedFrame) {
    taskRooms_.beginFrame(frame);
    if (Status room = reserveTasks(frame, {}); !room) {
        return room;
    }
    warnOfUnrecorded();
    // Before anything is freed: what was timed may be of views that go now.
    Status timed = timings.beginFrame(
        frame, completedFrame,
        [this](const View* timedView, uint64_t timedFrame) {
            Timings::Shortfall shortfall;
            forViews([&](View& view) {
                if (&view == timedView) {
                    shortfall = shortfallOf(view, timedFrame);
                }
            });
            return shortfall;
        },
        [this](const char* text) {
            if (log_ != nullptr) {
                log_(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_BUDGET, text, logUser_);
            }
        });
    if (!timed) {
        return timed;
    }
    frame_ = frame;
    completedFrame_ = completedFrame;
    frameOpen_ = true;
    origin_ = nextOrigin_;
    noteHashes(completedFrame);
    uploads_.beginFrame(frame, completedFrame);
    retire(completedFrame);
    fitMemory();
    planStreams();
    return success();
}

Status Context::reserveTasks(uint64_t frame, const gpu::TaskNeeds& more) {
    if (!device_->mapping.sharesDispatches) {
        return success();
    }
    gpu::TaskNeeds needs = more;
    groups.forEach([&](const Group& group) { needs += group.taskNeeds(); });
    return taskRooms_.reserve(*device_, frame, needs);
}

void Context::setMemoryBudget(VkDeviceSize bytes, std::function<bool(const gpu::MemoryRequest&)> allowsMore) {
    device_->ledger->budget = bytes;
    device_->ledger->allowsMore = std::move(allowsMore);
}

Status Context::cancelFrame() {
    if (Status open = checkOpen("suppleCancelFrame"); !open) {
        return open;
    }
    frameOpen_ = false;
    forMembers([this](gpu::FrameMember& member) { member.cancelFrame(frame_); });
    forStreams([this](Asset& asset) { asset.stream->cancelFrame(frame_); });
    uploads_.cancelFrame();
    taskRooms_.cancelFrame(frame_);
    timings.cancelFrame();
    if (hashes_ != nullptr) {
        hashes_->cancelFrame(frame_);
    }
    return success();
}

void Context::retire(uint64_t completedFrame) {
    std::erase_if(retired_, [&](const Retired<Group>& group) { return group.lastFrame <= completedFrame; });
    std::erase_if(retiredPools_, [&](const Retired<QueryPool>& pool) { return pool.lastFrame <= completedFrame; });
    // Those that groups still use stay, as groups may be recorded again.
    std::erase_if(retiredViews_, [&](const Retired<View>& view) {
        return view.object.use_count() == 1 && view.lastFrame <= completedFrame;
    });
    forMembers([&](gpu::FrameMember& member) { member.beginFrame(completedFrame); });
}

void Context::tellWarnings(const cage::Character& character) const {
    for (const std::string& warning : character.warnings) {
        log(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_ASSET_WARNING, character.name + ": " + warning);
    }
}

Result<uint64_t> Context::createAsset(cage::Character character, uint64_t clipPoolBytes) {
    tellWarnings(character);
    return keep(Asset::create(*device_, std::move(character)), clipPoolBytes);
}

Result<uint64_t> Context::createAsset(std::shared_ptr<const Prepared> prepared, uint64_t clipPoolBytes) {
    return keep(Asset::create(*device_, std::move(prepared)), clipPoolBytes);
}

Result<uint64_t> Context::keep(Result<std::shared_ptr<Asset>> asset, uint64_t clipPoolBytes) {
    if (asset) {
        streamClips(**asset, clipPoolBytes);
    }
    return asset ? Result<uint64_t>(assets.insert(std::move(*asset))) : asset.error();
}

Status Context::follow(const Asset& asset, GroupShared& shared, SuppleGroupDesc& desc) {
    const std::shared_ptr<Group> leader = groups.find(desc.instancesOf.id);
    if (leader == nullptr) {
        return Error{ErrorCode::staleHandle, "suppleCreateGroup: instancesOf: stale or foreign group handle"};
    }
    if (leader->follows() || leader->sharedAsset().get() != &asset) {
        return Error{ErrorCode::argument, "suppleCreateGroup: instancesOf: the group follows another one itself, or "
                                          "it has another asset"};
    }
    shared.instances = leader->sharedInstances();
    shared.leader = leader.get();
    desc.capacity = shared.instances->capacity();
    desc.poseSource = shared.instances->source();
    const Status fits = fitMemory(*leader); // it is followed now
    return fits ? fits : Error{fits.error().code, "suppleCreateGroup: instancesOf: " + fits.error().message};
}

Result<uint64_t> Context::createGroup(const SuppleGroupDesc& desc) {
    const std::shared_ptr<Asset> asset = assets.find(desc.asset.id);
    if (asset == nullptr) {
        return Error{ErrorCode::staleHandle, "suppleCreateGroup: stale or foreign asset handle"};
    }
    if ((desc.flags & SUPPLE_GROUP_RAY_TRACING) != 0 && !device_->rayTracing) {
        return Error{ErrorCode::argument,
                     "suppleCreateGroup: SUPPLE_GROUP_RAY_TRACING: the context was created without "
                     "SUPPLE_CONTEXT_RAY_TRACING"};
    }
    if (desc.poseSource == SUPPLE_POSES_PLAYBACK) {
        if (const Result<skinning::PoseKernels*> pose = kernels_->pose(); !pose) {
            return pose.error();
        }
    }
    if ((desc.flags & SUPPLE_GROUP_BOUNDS) != 0) {
        if (const Status prepared = prepareBounds(); !prepared) {
            return prepared.error();
        }
    }
    std::shared_ptr<View> view;
    if (desc.view.id != 0 && (view = views.find(desc.view.id)) == nullptr) {
        return Error{ErrorCode::staleHandle, "suppleCreateGroup: stale or foreign view handle"};
    }
    GroupShared shared = sharedFor(std::move(view));
    SuppleGroupDesc whole = desc;
    if (desc.instancesOf.id != 0) {
        if (const Status followed = follow(*asset, shared, whole); !followed) {
            return followed.error();
        }
    }
    Result<std::shared_ptr<Group>> group = Group::create(shared, asset, whole);
    if (!group) {
        return group.error();
    }
    if (!hidesInDraws() && (*group)->drawsByRanges() && (*group)->slots().hiddenParts().any()) {
        return Error{ErrorCode::disabled, "suppleCreateGroup: instancesOf: " + asset->character.name +
                                              ": an instance hides a part, and the device was created without the "
                                              "feature drawIndirectFirstInstance"};
    }
    if (const Status room = reserveTasks(frame_, (*group)->taskNeeds()); !room) {
        return room.error();
    }
    tellNotes(**group);
    tellBuiltLate(*asset);
    makeRoom(retired_, groups.slotCount() + 1);
    asset->startStream();
    return groups.insert(std::move(*group));
}

bool Context::drawsByRanges(const InstanceSet& instances) const {
    bool ranges = false;
    groups.forEach(
        [&](const Group& group) { ranges = ranges || (&group.instances() == &instances && group.drawsByRanges()); });
    return ranges;
}

bool Context::draws(const InstanceSet& instances, SuppleScheme scheme) const {
    bool found = false;
    groups.forEach([&](const Group& group) {
        found = found || (&group.instances() == &instances && group.surfaces().any([&](const Tessellation& surface) {
                    return surface.schemeId() == scheme;
                }));
    });
    return found;
}

GroupShared Context::sharedFor(std::shared_ptr<View> view) {
    // Instances of one group must not fit another that takes its place: groups' ids differ, and so do generations.
    nextGeneration_ = nextGeneration_ * 1664525u + 1013904223u;
    GroupShared shared;
    shared.device = device_.get();
    shared.pipelines = pipelines_.get();
    shared.stages = &stages_;
    shared.pose = kernels_->knownPose();
    shared.surface = &surface_;
    shared.pairs = &pairs_;
    shared.bounds = kernels_->knownBounds();
    shared.occlusion = kernels_->knownOcclusion();
    shared.view = std::move(view);
    shared.framesInFlight = framesInFlight_;
    shared.firstGeneration = nextGeneration_ | 1u;
    shared.number = ++groupsMade_;
    shared.handsOver = asyncCompute_;
    shared.hashes = hashes_;
    return shared;
}

void Context::tellNotes(const Group& group) const {
    const auto tell = [&](SuppleMessage id, const std::string& note) {
        log(SUPPLE_SEVERITY_INFO, id, group.asset().character.name + ": " + note);
    };
    for (const auto& surface : group.surfaces()) {
        for (const std::string& note : surface->tables().notes) {
            tell(SUPPLE_MESSAGE_SCHEME_NOTE, note);
        }
        if (!surface->rateNote().empty()) {
            tell(SUPPLE_MESSAGE_RATE_CHANGED, surface->rateNote());
        }
        if (!surface->uvNote().empty()) {
            log(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_SCHEME_NOTE,
                group.asset().character.name + ": " + surface->uvNote());
        }
    }
}

void Context::tellBuiltLate(Asset& asset) const {
    for (const std::string& what : asset.builtLate) {
        log(SUPPLE_SEVERITY_INFO, SUPPLE_MESSAGE_NOT_PREPARED,
            asset.character.name + ": " + what + " were not prepared, and are built now");
    }
    asset.builtLate.clear();
}

Status Context::remake(const Remaking& remaking, uint64_t id, Group& group, std::vector<Remade>& remade) {
    GroupShared shared = sharedFor(group.sharedView());
    if (group.follows()) {
        const auto leader =
            std::find_if(remade.begin(), remade.end(), [&](const Remade& other) { return other.id == group.leader(); });
        shared.instances = leader->group->sharedInstances();
        shared.leader = leader->group.get();
    }
    if (!asyncCompute_ || group.askedFrame() != frame_) { // else the draws may not have taken the indices over yet
        shared.before = &group;
    }
    GroupRecipe recipe = group.recipe();
    remaking.change(recipe);
    Result<std::shared_ptr<Group>> made =
        group.remade(shared, remaking.asset != nullptr ? remaking.asset : group.sharedAsset(), recipe, remaking.match);
    if (!made) {
        return made.error();
    }
    remade.push_back({id, std::move(*made), {}, {}});
    const Status points = remakePoints(group, remade.back());
    return points ? remakeQueries(group, remade.back()) : points;
}

Result<std::vector<Context::Remade>> Context::remake(const Remaking& remaking) {
    std::vector<Remade> remade;
    Status status = success();
    groups.forEachId([&](uint64_t id, Group& group) {
        if (status && !group.follows() && remaking.wants(id, group)) {
            status = remake(remaking, id, group, remade);
        }
    });
    const size_t leaders = remade.size();
    const auto isRemade = [&](uint64_t id) {
        return std::any_of(remade.begin(), remade.begin() + static_cast<ptrdiff_t>(leaders),
                           [&](const Remade& other) { return other.id == id; });
    };
    groups.forEachId([&](uint64_t id, Group& group) {
        if (status && group.follows() && isRemade(group.leader())) { // without its leader it can only be destroyed
            status = remake(remaking, id, group, remade);
        }
    });
    gpu::TaskNeeds more;
    for (const Remade& own : remade) {
        more += own.group->taskNeeds();
    }
    status = status ? reserveTasks(frame_, more) : status;
    if (!status) {
        return status.error();
    }
    return remade;
}

void Context::replace(std::vector<Remade>& remade) {
    makeRoom(retired_, groups.slotCount() + remade.size());
    for (Remade& own : remade) {
        replacePoints(own);
        replaceQueries(own);
        retired_.push_back(retired(groups.replace(own.id, std::move(own.group))));
    }
}

Status Context::setCapacity(uint64_t id, uint32_t capacity) {
    const std::shared_ptr<Group> group = groups.find(id);
    const std::string& name = group->asset().character.name;
    if (group->follows()) {
        return Error{ErrorCode::argument, "suppleSetCapacity: " + name +
                                              ": the group draws the instances of another one, which has the capacity"};
    }
    if (capacity < group->slots().end()) {
        return Error{ErrorCode::limit, "suppleSetCapacity: " + name + ": capacity " + std::to_string(capacity) +
                                           ": the instance in slot " + std::to_string(group->slots().end() - 1) +
                                           " would have no room"};
    }
    if (capacity == group->slots().capacity()) {
        return success();
    }
    const AssetMatch same;
    Result<std::vector<Remade>> remade =
        remake({[&](uint64_t other, const Group&) { return other == id; },
                [&](GroupRecipe& recipe) { recipe.setCapacity(capacity); }, nullptr, same});
    if (!remade) {
        return remade.error();
    }
    replace(*remade);
    return success();
}

Status Context::reloadAsset(uint64_t id, cage::Character character, uint64_t clipPoolBytes) {
    return reload(id, Asset::create(*device_, std::move(character)), clipPoolBytes);
}

Status Context::reloadAsset(uint64_t id, std::shared_ptr<const Prepared> prepared, uint64_t clipPoolBytes) {
    return reload(id, Asset::create(*device_, std::move(prepared)), clipPoolBytes);
}

Status Context::reload(uint64_t id, Result<std::shared_ptr<Asset>> made, uint64_t clipPoolBytes) {
    if (!made) {
        return made.error();
    }
    const std::shared_ptr<Asset> before = assets.find(id), asset = std::move(*made);
    const AssetMatch match = AssetMatch::of(before->character, asset->character);
    streamClips(*asset, clipPoolBytes);
    takeOverRequests(*before, *asset, match.clips);
    Result<std::vector<Remade>> remade =
        remake({[&](uint64_t, const Group& group) { return group.sharedAsset() == before; },
                [&](GroupRecipe& recipe) { recipe.renumberParts(match.parts); }, asset, match});
    if (!remade) {
        return remade.error();
    }
    if (asset->ownsPrepared) { // else supplePrepare has told them
        tellWarnings(asset->character);
    }
    for (const Remade& own : *remade) {
        tellNotes(*own.group);
        tellDropped(own);
    }
    tellBuiltLate(*asset);
    asset->startStream();
    replace(*remade);
    assets.replace(id, asset);
    return success();
}

void Context::setOrigin(const glm::dvec3& origin) {
    nextOrigin_ = origin;
    if (!hasRecorded()) {
        origin_ = origin;
    }
}

Status Context::prepareBounds() {
    const Result<BoundsKernels*> bounds = kernels_->bounds();
    return bounds ? (*bounds)->prepare() : bounds.error();
}

Result<uint64_t> Context::createView(const SuppleViewDesc& desc) {
    if (const Status prepared = prepareBounds(); !prepared) {
        return prepared.error();
    }
    if ((desc.flags & SUPPLE_VIEW_OCCLUSION) != 0) {
        const Result<OcclusionKernels*> occlusion = kernels_->occlusion();
        if (const Status prepared = occlusion ? (*occlusion)->prepare() : occlusion.error(); !prepared) {
            return prepared.error();
        }
    }
    Result<std::shared_ptr<View>> view = View::create(*device_, surface_, framesInFlight_, desc);
    if (!view) {
        return view.error();
    }
    makeRoom(retiredViews_, views.slotCount() + 1);
    return views.insert(std::move(*view));
}

Status Context::makePipelines(const Prepared& prepared, const PlannedGroup& group) {
    return runtime::makePipelines({device_.get(), pipelines_.get(), kernels_.get(), &surface_, &stages_}, prepared,
                                  group);
}

bool Context::destroyView(uint64_t id) {
    std::shared_ptr<View> view = views.remove(id);
    if (view == nullptr) {
        return false;
    }
    view->setDepthPyramid(std::nullopt); // nobody can take the host's image away any more
    retiredViews_.push_back(retired(std::move(view)));
    return true;
}

bool Context::destroyGroup(uint64_t id) {
    std::shared_ptr<Group> group = groups.remove(id);
    if (group == nullptr) {
        return false;
    }
    dropPoints(id);
    dropQueries(id);
    retired_.push_back(retired(std::move(group))); // freed by the next beginFrame that may
    return true;
}

} // namespace supple::runtime
