#include "runtime/group.h"

#include "surface/grid.h"

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
              SUPPLE_PATCH_P5 == kP5Patch && SUPPLE_PATCH_CATMULL_CLARK == kCatmullClarkPatch &&
              SUPPLE_PATCH_LOOP == kLoopPatch && SUPPLE_PATCH_BLEND == kBlendPatch &&
              SUPPLE_PATCH_BLEND_SHARP == kBlendSharpPatch && SUPPLE_PATCH_TRIANGLE == kTrianglePatch);
static_assert(SUPPLE_SCHEME_PREP == static_cast<int>(SchemeId::prep) &&
              SUPPLE_SCHEME_PM == static_cast<int>(SchemeId::pm) &&
              SUPPLE_SCHEME_CATMULL_CLARK == static_cast<int>(SchemeId::catmullClark) &&
              SUPPLE_SCHEME_LOOP == static_cast<int>(SchemeId::loop) &&
              SUPPLE_SCHEME_BLEND == static_cast<int>(SchemeId::blend) &&
              SUPPLE_SCHEME_POLYGONS == static_cast<int>(SchemeId::polygons));
static_assert(SUPPLE_DOMAIN_MESH == surface::kDomainCount);
static_assert(SUPPLE_VERTEX_16 == kVertex16 && SUPPLE_VERTEX_24 == kVertex24);

skinning::SkinningMode skinningOf(const SuppleGroupDesc& desc) {
    return desc.skinning == SUPPLE_SKINNING_DUAL_QUATERNION ? skinning::SkinningMode::dualQuaternion
                                                            : skinning::SkinningMode::linear;
}

} // namespace

Result<std::shared_ptr<Group>> Group::create(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                             const SuppleGroupDesc& desc) {
    auto group = std::make_shared<Group>();
    group->asset_ = std::move(asset);
    group->view_ = shared.view;
    TessellationDesc tessellation;
    tessellation.device = shared.device;
    tessellation.passes = shared.surface;
    tessellation.deform = shared.deform;
    tessellation.bounds = shared.bounds;
    tessellation.pairs = shared.pairs;
    tessellation.view = shared.view;
    tessellation.asset = group->asset_.get();
    tessellation.group = desc;
    tessellation.framesInFlight = shared.framesInFlight;
    tessellation.handsOver = shared.handsOver;
    Result<Surfaces> surfaces = Surfaces::create(tessellation);
    if (!surfaces) {
        return surfaces.error();
    }
    group->surfaces_ = std::move(*surfaces);
    const Status status = group->createRest(shared, desc);
    if (!status) {
        return Error{status.error().code, group->asset_->character.name + ": " + status.error().message};
    }
    return group;
}

Status Group::createRest(const GroupShared& shared, const SuppleGroupDesc& desc) {
    InstanceSet::Desc set{shared.device,         shared.deform,    shared.pose,   asset_.get(),
                          desc.poseSource,       skinningOf(desc), desc.capacity, shared.firstGeneration,
                          shared.framesInFlight, shared.handsOver};
    set.lists = view_ != nullptr ? Culling::lists(static_cast<uint32_t>(asset_->parts.size()), surfaces_.ladder().count)
                                 : set.lists;
    set.partPatches = surfaces_.partPatches();
    set.listsParts = view_ == nullptr && surfaces_.haveGrids();
    set.surface = surfaces_.boundBytes();
    Result<std::unique_ptr<InstanceSet>> instances = InstanceSet::create(set);
    if (!instances) {
        return instances.error();
    }
    instances_ = std::move(*instances);
    const bool gathers = surfaces_.any([](const Tessellation& surface) { return surface.gathers(); });
    Status status = gathers ? shared.deform->prepareGather() : success();
    for (const auto& surface : surfaces_) {
        status = status ? surface->join(instances_->windows()) : status;
    }
    if (!status) {
        return status;
    }

    gpu::BufferPlan device(buffers_), staging(staging_);
    instances_->plan(device, staging);
    for (const auto& surface : surfaces_) {
        surface->plan(device, staging);
    }
    if (view_ != nullptr) {
        planCulling(shared, (desc.flags & SUPPLE_GROUP_ONE_LEVEL) != 0, device, staging);
    }
    status = device.create(*shared.device, gpu::MemoryKind::deviceLocal);
    status = status ? staging.create(*shared.device, gpu::MemoryKind::upload) : status;
    status = status ? instances_->createSets() : status;
    status = status ? createVisibility(set.listsParts) : status;
    clear_.renew(culling_ != nullptr);
    for (const auto& surface : surfaces_) {
        status = status ? surface->createSets(*instances_, *visibility_) : status;
    }
    return status;
}

void Group::planCulling(const GroupShared& shared, bool oneLevel, gpu::BufferPlan& device, gpu::BufferPlan& staging) {
    const uint32_t vertices = asset_->character.cage.vertexCount();
    Culling::Desc desc;
    desc.device = shared.device;
    desc.pass = shared.bounds;
    desc.occlusion = (view_->desc().flags & SUPPLE_VIEW_OCCLUSION) != 0 ? shared.occlusion : nullptr;
    desc.framesInFlight = shared.framesInFlight;
    desc.windows = &instances_->windows();
    desc.cageVertices = vertices;
    desc.cageStride = instances_->cageStride();
    desc.parts = static_cast<uint32_t>(asset_->parts.size());
    desc.firstRate = surfaces_.ladder().first;
    std::vector<Culling::Needs> needs;
    for (const auto& surface : surfaces_) {
        needs.push_back(surface->cullingNeeds());
        if (surfaces_.ladder().count > 0 && needs.back().rates.empty() && !oneLevel) {
            needs.back().measure = {}; // only rates ask for the level of an instance
        }
    }
    std::unique_ptr<Culling> culling = Culling::create(desc, needs);
    culling->plan(device, staging);
    culling_ = culling.get();
    visibility_ = std::move(culling);
}

Status Group::createVisibility(bool listsParts) {
    const gpu::PlannedBuffer& list = instances_->list();
    if (culling_ != nullptr) {
        return culling_->createSets(
            {instances_->cages().buffer(), list.buffer(), view_->cull(), view_->sizes(), view_->words()});
    }
    const auto entries = static_cast<uint32_t>(list.size() / sizeof(uint32_t));
    const InstanceWindows& windows = instances_->windows();
    const InstanceList drawn{list.buffer(), instances_->passListBytes(), listsParts ? entries : windows.capacity};
    visibility_ = std::make_unique<ListedByHost>(windows, drawn);
    return success();
}

void Group::fill(SuppleGroupInfo& info) const {
    instances_->fill(info);
    info.surfaceCount = static_cast<uint32_t>(surfaces_.size());
    info.instances = visibility_->list().slots();
}

gpu::MemoryUse Group::memoryUse() const {
    gpu::MemoryUse use = buffers_.use();
    use += staging_.use();
    use += instances_->memoryUse();
    for (const auto& surface : surfaces_) {
        use += surface->memoryUse();
    }
    return use;
}

void Group::recordWarmUp(VkCommandBuffer commandBuffer, uint64_t frame) {
    lastRecordedFrame_ = frame;
    instances_->recordWarmUp(commandBuffer);
    if (culling_ != nullptr) {
        culling_->recordWarmUp(commandBuffer);
        view_->recordWarmUp(commandBuffer);
    }
    for (const auto& surface : surfaces_) {
        surface->recordWarmUp(commandBuffer);
    }
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

bool Group::staticsPending() const {
    return asset_->buffers.uploadPending() || asset_->clips.uploadPending() || clear_.due() ||
           surfaces_.any([](const Tessellation& surface) { return surface.staticsPending(); }) ||
           (view_ != nullptr && view_->staticsPending());
}

VkDeviceSize Group::recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) {
    lastRecordedFrame_ = frame;
    if (clear_.due()) {
        clear_.record(frame);
        culling_->recordClear(commandBuffer);
    }
    VkDeviceSize bytes =
        asset_->buffers.recordUpload(commandBuffer, frame) + asset_->clips.recordUpload(commandBuffer, frame);
    for (const auto& surface : surfaces_) {
        bytes += surface->recordStatics(commandBuffer, frame);
    }
    return bytes;
}

PassCost Group::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame) {
    passesFrame_ = lastRecordedFrame_ = frame;
    const bool changed = instances_->changed();
    PassCost cost = instances_->recordUpload(commandBuffer, frame, *visibility_);
    for (const auto& surface : surfaces_) {
        cost.bytes += surface->recordUpload(commandBuffer, frame, changed);
    }
    return cost;
}

void Group::addTransfers(Transfers& transfers) const {
    instances_->addTransfers(transfers);
    visibility_->addTransfers(transfers);
    for (const auto& surface : surfaces_) {
        surface->addTransfers(transfers, passesFrame_);
    }
}

void Group::cancelFrame(uint64_t frame) {
    asset_->buffers.cancelUpload(frame);
    asset_->clips.cancelUpload(frame);
    instances_->cancelFrame(frame);
    for (const auto& surface : surfaces_) {
        surface->cancelFrame(frame);
    }
    clear_.cancel(frame);
    if (passesFrame_ == frame) {
        slots().forgetAll();
    }
}

void Group::releaseStaging(uint64_t completedFrame) {
    asset_->buffers.releaseStaging(completedFrame);
    asset_->clips.releaseStaging(completedFrame);
    for (const auto& surface : surfaces_) {
        surface->releaseStaging(completedFrame);
    }
}

} // namespace supple::runtime
