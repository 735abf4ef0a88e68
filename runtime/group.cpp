#include "runtime/group.h"

#include "cage/limits.h"
#include "runtime/skinning_choice.h"
#include "surface/grid.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace supple::runtime {

namespace {

using namespace supple::shared;
using surface::SchemeId;

// supple.h repeats for C what the shaders and the schemes share.
static_assert(SUPPLE_MAX_RATE == surface::kMaxRate);
static_assert(SUPPLE_MAX_SIDES == surface::kMaxSides);
static_assert(SUPPLE_PATCH_STRIDE == kPatchStride);
static_assert(SUPPLE_DOMAIN_QUAD == kQuadDomain && SUPPLE_DOMAIN_POLAR == kPolarDomain &&
              SUPPLE_DOMAIN_TRIANGLE == kTriangleDomain && SUPPLE_DOMAIN_PENTAGON == kPentagonDomain);
static_assert(SUPPLE_PATCH_REGULAR == kRegularPatch && SUPPLE_PATCH_PERTURBED == kPerturbedPatch &&
              SUPPLE_PATCH_POLAR == kPolarPatch && SUPPLE_PATCH_P3 == kP3Patch && SUPPLE_PATCH_P4 == kP4Patch &&
              SUPPLE_PATCH_P5 == kP5Patch && SUPPLE_PATCH_FRAGMENT == kFragmentPatch &&
              SUPPLE_PATCH_LOOP == kLoopPatch && SUPPLE_PATCH_BLEND == kBlendPatch &&
              SUPPLE_PATCH_BLEND_SHARP == kBlendSharpPatch && SUPPLE_PATCH_BLEND_REGULAR == kBlendRegularPatch &&
              SUPPLE_PATCH_TRIANGLE == kTrianglePatch && SUPPLE_PATCH_IRREGULAR == kIrregularPatch &&
              SUPPLE_PATCH_IRREGULAR_SHARP == kIrregularSharpPatch && SUPPLE_PATCH_CREASED == kCreasedPatch &&
              SUPPLE_PATCH_LOOP_REGULAR == kLoopRegularPatch && SUPPLE_PATCH_LOOP_IRREGULAR == kLoopIrregularPatch &&
              SUPPLE_PATCH_LOOP_IRREGULAR_SHARP == kLoopIrregularSharpPatch);
static_assert(SUPPLE_SCHEME_PREP == static_cast<int>(SchemeId::prep) &&
              SUPPLE_SCHEME_PM == static_cast<int>(SchemeId::pm) &&
              SUPPLE_SCHEME_FRAGMENTS == static_cast<int>(SchemeId::fragments) &&
              SUPPLE_SCHEME_LOOP == static_cast<int>(SchemeId::loop) &&
              SUPPLE_SCHEME_BLEND == static_cast<int>(SchemeId::blend) &&
              SUPPLE_SCHEME_POLYGONS == static_cast<int>(SchemeId::polygons) &&
              SUPPLE_SCHEME_CATMULL_CLARK == static_cast<int>(SchemeId::catmullClark));
static_assert(SUPPLE_MAX_CREASE_SETS == kMaxCreaseSets && SUPPLE_MAX_CREASE_SETS == cage::kMaxCreaseSets);
static_assert(SUPPLE_DOMAIN_MESH == surface::kDomainCount);
static_assert(SUPPLE_VERTEX_16 == kVertex16 && SUPPLE_VERTEX_24 == kVertex24 && SUPPLE_VERTEX_12 == kVertexPosition);

} // namespace

Result<std::shared_ptr<Group>> Group::create(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                             const SuppleGroupDesc& desc) {
    auto group = std::make_shared<Group>();
    group->asset_ = std::move(asset);
    group->view_ = shared.view;
    group->device_ = shared.device;
    group->handsOver_ = shared.handsOver;
    group->number_ = shared.number;
    group->recipe_ = GroupRecipe(desc);
    group->leader_ = desc.instancesOf.id;
    group->streamsClips_ = group->asset_->stream != nullptr;
    group->desc_ = desc;
    group->surfaceBuffers_.setKeepFrames(desc.keepUnseenFrames);
    TessellationDesc tessellation;
    tessellation.device = shared.device;
    tessellation.programs = shared.surface;
    tessellation.bounds = shared.bounds;
    tessellation.pairs = shared.pairs;
    tessellation.view = shared.view;
    tessellation.asset = group->asset_.get();
    tessellation.group = desc;
    tessellation.framesInFlight = shared.framesInFlight;
    tessellation.handsOver = shared.handsOver;
    if (shared.leader != nullptr && shared.leader->culling() != nullptr && shared.view != nullptr) {
        group->place_ = SharerPlace(shared.leader->culling()->sharers());
    }
    Result<Surfaces> surfaces =
        Surfaces::create(tessellation, shared.before != nullptr ? &shared.before->surfaces_ : nullptr,
                         group->place_.number() ? &shared.leader->surfaces_ : nullptr);
    if (!surfaces) {
        return surfaces.error();
    }
    group->surfaces_ = std::move(*surfaces);
    group->drawnParts_ = DrawnParts(group->surfaces_.partPatches());
    group->desc_.prep = nullptr; // the caller's
    group->desc_.blend = nullptr;
    group->desc_.fragments = nullptr;
    group->desc_.partSchemes = nullptr;
    Status status = group->createInstances(shared);
    const bool deforms = shared.instances == nullptr && desc.poseSource != SUPPLE_POSES_CAGE_BUFFER;
    status = status ? group->stages_.create(*shared.stages, *shared.pipelines,
                                            {shared.device, group->asset_.get(), &group->desc_, group->instances_.get(),
                                             &group->surfaces_, shared.framesInFlight, deforms})
                    : status;
    status = status ? group->createListing(shared) : status;
    status = status ? group->createRest(shared) : status;
    if (!status) {
        return Error{status.error().code, group->asset_->character.name + ": " + status.error().message};
    }
    return group;
}

Result<std::shared_ptr<Group>> Group::remade(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                             const GroupRecipe& recipe, const AssetMatch& match) {
    Result<std::shared_ptr<Group>> made = create(shared, std::move(asset), recipe.desc());
    if (!made) {
        return made;
    }
    Group& group = **made;
    if (const Status rate = rate_ != 0 ? group.setRate(rate_) : success(); !rate) {
        return rate.error();
    }
    group.origin_ = origin_;
    group.surfaceBuffers_.takePlaceOf(surfaceBuffers_);
    if (!follows()) {
        group.instances_->takeOver(*instances_, match);
        group.stages_.takeOver(stages_, slots().end(), match);
    }
    return made;
}

Status Group::setRate(uint32_t rate) {
    Status status = surfaces_.setRate(rate);
    if (status) {
        rate_ = rate;
        passNeeds_ = countTasks();
        ++tasksVersion_;
    }
    return status;
}

Status Group::createInstances(const GroupShared& shared) {
    if (shared.instances != nullptr) {
        instances_ = shared.instances;
        return success();
    }
    Result<std::shared_ptr<InstanceSet>> instances = InstanceSet::create(
        {shared.device, shared.pose, asset_, desc_.poseSource, skinningOf(asset_->character, desc_.skinning),
         desc_.capacity, shared.firstGeneration, shared.framesInFlight,
         StateRoom{(desc_.flags & SUPPLE_GROUP_MODIFIERS) != 0, (desc_.flags & SUPPLE_GROUP_TRANSITIONS) != 0,
                   (desc_.flags & SUPPLE_GROUP_UPDATE_RATES) != 0, (desc_.flags & SUPPLE_GROUP_SPRINGS) != 0,
                   (desc_.flags & SUPPLE_GROUP_SOFT) != 0},
         shared.handsOver});
    if (!instances) {
        return instances.error();
    }
    instances_ = std::move(*instances);
    return success();
}

Status Group::createListing(const GroupShared& shared) {
    const gpu::Device& device = *shared.device;
    const uint32_t capacity = desc_.capacity;
    const uint32_t lists = view_ != nullptr ? Culling::lists(drawnParts_.count(), surfaces_.ladder().count) : 2;
    // Texels of an instance, in the lists of instances and in that of poses.
    const StateRoom room = follows() ? StateRoom{} : instances_->room();
    const bool listsPoses = !follows() && (instances_->source() == SUPPLE_POSES_PLAYBACK || room.soft);
    const uint32_t texels = std::max(lists, listsPoses ? PoseList::wordsOfInstance(room) : 0);
    if (!device.mapping.wide && uint64_t{texels} * capacity > device.limits.maxTexelBufferElements) {
        return Error{ErrorCode::limit, std::to_string(capacity) +
                                           " instances exceed the device's texel-buffer elements: the largest "
                                           "capacity is " +
                                           std::to_string(device.limits.maxTexelBufferElements / texels)};
    }
    const BoundBytes bound = surfaces_.boundBytes().with(stages_.boundBytes());
    Result<InstanceWindows> windows =
        InstanceWindows::layOut(device, capacity, bound.with(instances_->boundBytes(false)));
    if (windows && windows->count() > 1) {
        windows = InstanceWindows::layOut(device, capacity, bound.with(instances_->boundBytes(true)));
    }
    if (!windows) {
        return windows.error();
    }
    Status drawn = surfaces_.cutDraws(*windows, (desc_.flags & SUPPLE_GROUP_WINDOWS) != 0);
    if (!drawn) {
        return drawn;
    }
    const bool windowed = windows->count() > 1;
    listing_ = InstanceListing(std::move(*windows), view_ == nullptr && surfaces_.haveGrids() ? &drawnParts_ : nullptr);
    constexpr uint32_t kPosesAll = SUPPLE_GROUP_POSE_UNSEEN | SUPPLE_GROUP_BOUNDS;
    if (view_ != nullptr && view_->culls() && !follows() && (desc_.flags & kPosesAll) == 0 && stages_.keepReach()) {
        outOfSight_ = OutOfSight(capacity);
        listing_.leaveOut(&outOfSight_);
    }
    // Who is moved beyond reach is posed in every frame: nobody knows its size.
    const bool chooses = view_ != nullptr && (desc_.flags & SUPPLE_GROUP_UPDATE_RATES) != 0 && stages_.keepReach();
    if (outOfSight_.isAskedFor() || chooses || fadesSteps()) {
        boxes_ = InstanceBoxes(asset_->reach(), boundsMargin(), capacity);
    }
    return follows() ? success() : instances_->makeBuffers(windowed);
}

Status Group::createRest(const GroupShared& shared) {
    Status status = success();
    for (const auto& surface : surfaces_) {
        status = status ? surface->join(windows()) : status;
    }
    if (!status) {
        return status;
    }

    gpu::BufferPlan device(buffers_), staging(staging_);
    listing_.plan(device, staging, shared.framesInFlight);
    stages_.plan(device, staging);
    for (const auto& surface : surfaces_) {
        surface->plan(surfaceBuffers_.mayGo() ? surfaceBuffers_.plan() : device, staging);
    }
    if (view_ != nullptr) {
        planCulling(shared, device, staging);
        status = checkPool();
        if (!status) {
            return status;
        }
    }
    planBounds(shared, device);
    status = device.create(*shared.device, gpu::MemoryKind::deviceLocal);
    status = status ? staging.create(*shared.device, gpu::MemoryKind::upload) : status;
    status = status ? surfaceBuffers_.create(*shared.device) : status;
    status = status && boundsReadback_ != nullptr ? boundsReadback_->create() : status;
    status = status && !follows() ? instances_->createSets(listing_) : status;
    if (status && fadesSteps()) {
        poses().playback()->takeStepSizes();
    }
    status = status ? stages_.createSets(instances_->cages(), listing_) : status;
    status = status ? createVisibility() : status;
    for (uint32_t surface = 0; surface < surfaces_.size(); ++surface) {
        status = status ? surfaces_[surface].createSets({stages_.cagesOf(surface), instances_->creaseAlphas().buffer()},
                                                        listing_, *visibility_)
                        : status;
    }
    status = status && shared.hashes != nullptr ? createHashes(shared.hashes) : status;
    if (status) {
        addMembers(shared);
        passNeeds_ = countTasks();
        earlyNeeds_ = countEarlyTasks();
        for (const auto& surface : surfaces_) {
            patchesAtLevels_ += surface->patchesAtLevels();
        }
    }
    return status;
}

HashedPart Group::partOf(const Hashed& hashed, uint32_t part) const {
    constexpr uint32_t kWords = 4; // of what is read as vec4
    HashedPart result;
    switch (hashed.stage) {
    case HashedStage::palettes: {
        const skinning::PoseLayout& layout = instances_->poseLayout();
        result.words = instances_->palettes().buffer();
        result.slotStride = kWords * layout.stride;
        result.elementCount = kWords * layout.morphWeights + layout.morphCount;
        return result;
    }
    case HashedStage::cages:
        result.words = instances_->cages().buffer();
        result.elementWords = result.keptWords = kWords;
        result.slotStride = kWords * instances_->cageStride();
        result.elementCount = asset_->character.cage.vertexCount();
        return result;
    case HashedStage::vertices:
        break;
    }
    return surfaces_[hashed.surface].hashedPart(part);
}

Status Group::createHashes(const std::shared_ptr<const StageHashes>& hashes) {
    if (hashes_ != nullptr || !surfaceBuffers_.areThere()) {
        return success();
    }
    std::vector<Hashed> all;
    if (!follows()) {
        all = {{HashedStage::palettes}, {HashedStage::cages}};
    }
    for (uint32_t surface = 0; surface < surfaces_.size(); ++surface) {
        all.push_back({HashedStage::vertices, surface, surfaces_[surface].hashedParts()});
    }
    std::vector<HashedPart> parts;
    for (const Hashed& hashed : all) {
        for (uint32_t part = 0; part < hashed.parts; ++part) {
            parts.push_back(partOf(hashed, part));
        }
    }
    auto made = std::make_unique<HashedParts>(*device_, hashes, windows(), culling_);
    Status status = made->create(parts, listing_.buffer().buffer());
    if (status) {
        hashed_ = std::move(all);
        hashes_ = std::move(made);
    }
    return status;
}

void Group::recordHashes(StageHashes::Recording& recording, bool withSurfaces) const {
    size_t number = 0;
    for (const Hashed& hashed : hashed_) {
        const bool wanted = hashed.stage != HashedStage::vertices || withSurfaces;
        const bool there = wanted && hashed.parts > 0 && partOf(hashed, 0).words != VK_NULL_HANDLE &&
                           recording.next({link.handle, hashed.stage, hashed.surface, {}});
        for (uint32_t part = 0; part < hashed.parts; ++part, ++number) {
            const HashedPart now = partOf(hashed, part);
            if (there && now.elementCount > 0) {
                hashes_->record(recording, number, now);
            }
        }
    }
}

void Group::addMembers(const GroupShared& shared) {
    addMember(*shared.pairs);
    asset_->forSkins([&](gpu::StaticBuffers& buffers) { addMember(buffers); });
    addMember(asset_->clips);
    addMember(asset_->jiggles.table);
    addMember(asset_->cloths.table);
    if (!follows()) {
        addMember(*instances_);
    }
    addMember(stages_);
    addMember(points_);
    if (view_ != nullptr) {
        addMember(*culling_);
        addMember(*view_);
    }
    if (listedBounds_ != nullptr) {
        addMember(*listedBounds_);
    }
    if (boundsReadback_ != nullptr) {
        addMember(*boundsReadback_);
    }
    for (const auto& surface : surfaces_) {
        addMember(*surface);
    }
}

void Group::planCulling(const GroupShared& shared, gpu::BufferPlan& device, gpu::BufferPlan& staging) {
    const bool oneLevel = (desc_.flags & SUPPLE_GROUP_ONE_LEVEL) != 0;
    const uint32_t vertices = asset_->character.cage.vertexCount();
    Culling::Desc desc;
    desc.device = shared.device;
    desc.kernels = shared.bounds;
    desc.occlusion = (view_->desc().flags & SUPPLE_VIEW_OCCLUSION) != 0 ? shared.occlusion : nullptr;
    desc.framesInFlight = shared.framesInFlight;
    desc.windows = &windows();
    desc.cageVertices = vertices;
    desc.cageStride = instances_->cageStride();
    desc.parts = &drawnParts_;
    desc.firstRate = surfaces_.ladder().first;
    desc.poolUnits = view_->poolUnits();
    SharerPlace place = std::move(place_); // given back if there is nothing to share
    if (sharesCoefficients()) {
        desc.leader = shared.leader->culling();
        desc.place = std::move(place);
    }
    std::vector<Culling::Surface> culled;
    for (const auto& surface : surfaces_) {
        culled.push_back(surface->culledSurface());
        if (surfaces_.ladder().count > 0 && culled.back().rates.empty() && !oneLevel) {
            culled.back().measure = {}; // only rates ask for the level of an instance
        }
    }
    std::unique_ptr<Culling> culling = Culling::create(std::move(desc), culled);
    culling->plan(device, staging);
    culling_ = culling.get();
    visibility_ = std::move(culling);
}

Status Group::checkPool() const {
    if (uint64_t{culling_->instanceUnits()} * desc_.capacity > UINT32_MAX) { // the device adds them up
        return Error{ErrorCode::limit, std::to_string(desc_.capacity) + " instances have more than " +
                                           std::to_string(kPoolUnitBytes << 32) + " bytes of coefficients"};
    }
    if (culling_->instanceUnits() <= view_->poolUnits()) {
        return success();
    }
    return Error{ErrorCode::limit, "an instance has " + std::to_string(culling_->instanceUnits() * kPoolUnitBytes) +
                                       " bytes of coefficients, the view has room for " +
                                       std::to_string(view_->poolUnits() * kPoolUnitBytes)};
}

void Group::planBounds(const GroupShared& shared, gpu::BufferPlan& device) {
    if ((desc_.flags & SUPPLE_GROUP_BOUNDS) == 0) {
        return;
    }
    boundsReadback_ = std::make_unique<BoundsReadback>(*shared.device, windows().capacity, shared.framesInFlight);
    if (culling_ == nullptr) {
        listedBounds_ = std::make_unique<ListedBounds>(ListedBounds::Desc{shared.device, shared.bounds, &windows(),
                                                                          asset_->character.cage.vertexCount(),
                                                                          instances_->cageStride(), boundsMargin()});
        listedBounds_->plan(device);
    }
}

Status Group::createVisibility() {
    if (culling_ != nullptr) {
        return culling_->createSets(
            {instances_->cages().buffer(), listing_.buffer().buffer(), view_->cull(), view_->sizes(), view_->words()});
    }
    visibility_ = std::make_unique<ListedByHost>(listing_);
    return listedBounds_ != nullptr
               ? listedBounds_->createSets(instances_->cages().buffer(), listing_.buffer().buffer())
               : success();
}

PointSource Group::pointSource() const {
    return {device_, &listing_, instances_->cages().buffer(), instances_->cageStride(), &surfaces_};
}

SuppleBufferRange Group::bounds() const {
    return culling_ != nullptr ? culling_->bounds() : listedBounds_->bounds();
}

float Group::boundsMargin() const {
    float margin = 0.0f;
    for (const auto& surface : surfaces_) {
        margin = std::max(margin, surface->boundsMargin());
    }
    return margin;
}

void Group::fill(SuppleGroupInfo& info) const {
    instances_->fill(info);
    info.surfaceCount = static_cast<uint32_t>(surfaces_.size());
    info.instances = visibility_->list().slots();
    info.windowSize = windows().size;
    info.windowCount = windows().count();
    info.surfacesGivenBack = surfaceBuffers_.areThere() ? 0 : 1;
    info.surfaceVersion = surfaceBuffers_.version();
}

gpu::TaskNeeds Group::countTasks() const {
    const uint32_t windows = listing_.windows().count();
    const uint32_t stages = stages_.count(static_cast<uint32_t>(surfaces_.size()));
    gpu::TaskNeeds needs{windows * (Playback::kTasks + stages), windows * (1 + stages)};
    needs += {windows + Culling::kGroupPasses + gpu::TaskDispatches::kPhases, windows + 1}; // bounds and lists
    needs += points_.taskNeeds();
    for (const auto& surface : surfaces_) {
        needs += surface->taskNeeds();
    }
    return needs;
}

gpu::TaskNeeds Group::countEarlyTasks() const {
    if (follows() || desc_.poseSource != SUPPLE_POSES_PLAYBACK || !instances_->room().hasSteps()) {
        return {};
    }
    const uint32_t windows = listing_.windows().count(), stages = stages_.count(0);
    const uint32_t rounds = (shared::kMostDueSteps - 1) / kStepsInRound;
    return {rounds * windows * (Playback::kTasks + stages) + gpu::TaskDispatches::kPhases, windows * (1 + stages)};
}

gpu::MemoryUse Group::memoryUse() const {
    gpu::MemoryUse use = buffers_.use();
    use += staging_.use();
    use += surfaceBuffers_.use();
    use += stages_.memoryUse();
    use += points_.memoryUse();
    if (boundsReadback_ != nullptr) {
        use += boundsReadback_->memoryUse();
    }
    if (!follows()) {
        use += instances_->memoryUse();
    }
    for (const auto& surface : surfaces_) {
        use += surface->memoryUse();
    }
    return use;
}

void Group::fill(SuppleSurfaceInfo& info, uint32_t index) const {
    const Tessellation& surface = surfaces_[index];
    info.scheme = surface.schemeId();
    info.tessellation = surface.kind();
    info.parts = surface.parts().data();
    info.partCount = static_cast<uint32_t>(surface.parts().size());
    info.patchCount = static_cast<uint32_t>(surface.tables().patches.size());
    info.patchesPerEdge = 1u << surface.tables().isolationSteps;
    const gpu::PlannedBuffer& patches = surface.patchCoefficients();
    info.patchCoefficients = {patches.buffer(), 0, patches.size(), 16};
}

VkDeviceSize Group::recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) {
    lastRecordedFrame_ = frame;
    return FrameMembers::recordStatics(commandBuffer, frame);
}

void Group::recordWaiting(VkCommandBuffer commandBuffer, uint64_t frame) {
    waitingFrame_ = lastRecordedFrame_ = frame;
    leftOutAll_ = listing_.leavesOutAll();
    points_.noteAsked(frame);
    if (!noDraws_.due()) {
        return;
    }
    noDraws_.record(frame);
    for (const auto& surface : surfaces_) {
        surface->recordNoDraws(commandBuffer);
    }
    if (culling_ != nullptr) {
        culling_->recordNoDraws(commandBuffer);
    }
}

void Group::followCoefficients(const Group& leader) {
    if (passesFrame_ != leader.passesBefore_) {
        listing_.forgetAll(); // others have been written since
    }
    // If the leader's passes are recorded already, they know nothing of what this group sees.
    const bool constructs = leader.link.call != link.call;
    bool changed = false;
    for (const auto& surface : surfaces_) {
        changed = (surface->sharesCoefficients() && surface->setConstructs(constructs)) || changed;
    }
    tasksVersion_ += changed ? 1 : 0;
}

PassCost Group::recordUpload(VkCommandBuffer commandBuffer, const FrameInfo& frame) {
    noDraws_.renew();
    if (frame.leader != nullptr && sharesCoefficients()) {
        followCoefficients(*frame.leader);
    }
    if (view_ != nullptr && view_->poolUnits() > 0 && culling_->instanceUnits() > 0) {
        if (passesFrame_ != view_->recordedBefore()) {
            listing_.forgetAll(); // others have written where its coefficients were
        }
        culling_->takePool(view_->pool());
    }
    passesBefore_ = std::exchange(passesFrame_, frame.number);
    lastRecordedFrame_ = frame.number;
    leftOutAll_ = listing_.leavesOutAll();
    points_.noteAsked(frame.number);
    bool changed = listing_.changed(slots());
    const HostPoses::Frame own{frame.number, frame.time, leftOutAll_};
    PassCost cost = follows() ? PassCost{} : instances_->recordPoses(commandBuffer, own, frame.origin);
    const glm::vec3 step(frame.origin - origin_);
    origin_ = frame.origin;
    if (boxes_.areAskedFor() && !drawnElsewhere()) { // else nobody looks at them
        boxes_.find(slots(), poses());
    }
    changed = findUnseen() || changed;
    if (changed) {
        visibility_->list(slots(), listing_);
    }
    if (changed || handsOver_) {
        cost.bytes += listing_.recordCopies(*device_, commandBuffer) + visibility_->recordUpload(commandBuffer);
    }
    cost += recordPoseList(commandBuffer, frame.number);
    surfaceBuffers_.noteRecorded(windows().visible > 0);
    for (const auto& surface : surfaces_) {
        surface->setPastStep(step);
        cost.bytes += surface->hasBuffers() ? surface->recordUpload(commandBuffer, frame.number, changed) : 0;
    }
    cost.bytes += stages_.recordUpload(commandBuffer, frame.number, frame.time, slots());
    changed = findList(frame.number) || changed;
    const uint32_t sharers = culling_ != nullptr && drawnElsewhere() ? culling_->sharers()->end() : 0;
    changed = std::exchange(sharers_, sharers) != sharers || changed;
    const bool pastMoves =
        step != pastStep_ &&
        (points_.havePasts() || surfaces_.any([](const Tessellation& surface) { return surface.writesMotion(); }));
    tasksVersion_ += changed || pastMoves ? 1 : 0;
    pastStep_ = step;
    return cost;
}

gpu::TaskOwner Group::taskOwner() const {
    gpu::TaskOwner owner;
    owner.id = number_;
    owner.version = tasksVersion_;
    owner.recordsOnce = points_.beginsAny();
    for (const auto& surface : surfaces_) {
        owner.pools |= surface->pool(); // they take turns together
        owner.recordsOnce = owner.recordsOnce || surface->attributesDue();
    }
    if (view_ != nullptr) {
        owner.pools |= view_->pool() << 1u;
        owner.room = view_->roomInFrame();
        owner.countsRates = view_->countsRates();
    }
    if (!follows() && instances_->poses().playback() != nullptr) {
        owner.poses = instances_->poses().playback()->tasksMade();
    }
    return owner;
}

bool Group::findUnseen() {
    if (!outOfSight_.isAskedFor()) {
        return false;
    }
    // Groups that draw the same instances read their deformed cages, wherever their views look.
    return drawnElsewhere() ? outOfSight_.clear() : outOfSight_.find(view_->cullView(), slots(), boxes_);
}

bool Group::fadesSteps() const {
    const bool plays = !follows() && desc_.poseSource == SUPPLE_POSES_PLAYBACK;
    return view_ != nullptr && plays && instances_->room().hasSteps() && (desc_.flags & SUPPLE_GROUP_POSE_UNSEEN) == 0;
}

bool Group::findList(uint64_t frame) {
    const bool before = listsSeen_, empty = windows().visible == 0;
    if (!empty || handsOver_) {
        emptyList_.renew();
    }
    listsSeen_ = view_ != nullptr && emptyList_.due();
    if (empty && listsSeen_) {
        emptyList_.record(frame);
    }
    return listsSeen_ != before;
}

PassCost Group::recordPoseList(VkCommandBuffer commandBuffer, uint64_t frame) {
    Playback* const playback = follows() ? nullptr : poses().playback();
    if (playback == nullptr || !playback->listsPoses()) {
        return {};
    }
    playback->takeStep();
    const shared::LodCamera camera = boxes_.areAskedFor() ? view_->cullView().camera : shared::LodCamera{};
    const bool unknown = drawnElsewhere(); // in views that may look from nearer by
    const bool rates = playback->takesUpdateRates(), steps = playback->takesStepSizes();
    const bool sizes = boxes_.areAskedFor() && (rates || steps);
    for (uint32_t slot = 0; sizes && slot < slots().end(); ++slot) {
        if (!listing_.worksOn(slots(), slot) || !(steps || playback->asksForSize(slot))) {
            continue;
        }
        const float size =
            unknown ? std::numeric_limits<float>::infinity() : pixelsPerUnit(camera, boxes_.boxes(), slot);
        steps ? playback->setStepSize(slot, size) : playback->setSize(slot, size);
    }
    playback->listPoses(frame, windows(), slots().end(),
                        [&](uint32_t slot) { return listing_.worksOn(slots(), slot); });
    return {0, playback->recordList(commandBuffer, frame)};
}

PassCost Group::recordBounds(gpu::Dispatches& dispatches) const {
    return culling_ != nullptr ? culling_->recordBounds(dispatches) : listedBounds_->record(dispatches);
}

void Group::recordBoundsReadback(VkCommandBuffer commandBuffer, uint64_t frame) {
    if (!listing_.leavesOutAll()) { // else it has found no box
        boundsReadback_->record(commandBuffer, frame, bounds().buffer, slots());
    }
}

bool Group::noteUnrecordedFrame() {
    constexpr uint32_t kFrames = 8;
    if (askedFrame() != 0 || !outputsAsked_ || unrecordedFrames_ >= kFrames) {
        return false;
    }
    bool anyVisible = false;
    for (uint32_t slot = 0; slot < slots().end() && !anyVisible; ++slot) {
        anyVisible = slots().shows(slot);
    }
    return anyVisible && ++unrecordedFrames_ == kFrames;
}

void Group::addTransfers(Transfers& transfers, bool withView) const {
    if (!follows()) {
        instances_->addTransfers(transfers);
    }
    transfers.add(listing_.buffer().buffer());
    visibility_->addTransfers(transfers);
    if (listedBounds_ != nullptr) {
        transfers.add(listedBounds_->bounds().buffer);
    }
    points_.addTransfers(transfers, askedFrame());
    for (const auto& surface : surfaces_) {
        surface->addTransfers(transfers, askedFrame());
    }
    if (withView) {
        view()->addTransfers(transfers, askedFrame());
    }
}

void Group::cancelFrame(uint64_t frame) {
    FrameMembers::cancelFrame(frame);
    staticsThere_ = false;
    noDraws_.cancelFrame(frame);
    emptyList_.cancelFrame(frame);
    if (passesFrame_ == frame) {
        listing_.forgetAll();
        ++tasksVersion_;
    }
}

} // namespace supple::runtime
