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
    Result<std::unique_ptr<Tessellation>> tessellation =
        Tessellation::create({shared.device, shared.surface, shared.bounds, shared.pairs, shared.view,
                              group->asset_.get(), desc, shared.framesInFlight, shared.handsOver});
    if (!tessellation) {
        return tessellation.error();
    }
    group->tessellation_ = std::move(*tessellation);
    const Status status = group->createParts(shared, desc);
    if (!status) {
        return Error{status.error().code, group->asset_->character.name + ": " + status.error().message};
    }
    return group;
}

Status Group::createParts(const GroupShared& shared, const SuppleGroupDesc& desc) {
    const bool listsParts = view_ == nullptr && tessellation_->kind() != SUPPLE_TESSELLATION_NONE;
    Result<std::unique_ptr<InstanceSet>> instances = InstanceSet::create(
        {shared.device, shared.deform, shared.pose, asset_.get(), desc.poseSource, skinningOf(desc), desc.capacity,
         shared.firstGeneration, shared.framesInFlight, shared.handsOver, tessellation_->lists(),
         tessellation_->partPatches(), listsParts, tessellation_->boundBytes()});
    if (!instances) {
        return instances.error();
    }
    instances_ = std::move(*instances);
    Status status = tessellation_->join(instances_->windows());
    if (!status) {
        return status;
    }

    gpu::BufferPlan device(buffers_), staging(staging_);
    instances_->plan(device, staging);
    tessellation_->plan(device, staging);
    if (view_ != nullptr) {
        const uint32_t vertices = asset_->character.cage.vertexCount();
        const bool hides = (view_->desc().flags & SUPPLE_VIEW_OCCLUSION) != 0;
        std::unique_ptr<Culling> culling =
            Culling::create({shared.device, shared.bounds, hides ? shared.occlusion : nullptr, shared.framesInFlight,
                             &instances_->windows(), vertices, InstanceSet::cageStrideOf(vertices)},
                            tessellation_->cullingNeeds());
        culling->plan(device, staging);
        culling_ = culling.get();
        visibility_ = std::move(culling);
    }
    status = device.create(*shared.device, gpu::MemoryKind::deviceLocal);
    status = status ? staging.create(*shared.device, gpu::MemoryKind::upload) : status;
    status = status ? instances_->createSets() : status;
    const gpu::PlannedBuffer& list = instances_->list();
    if (status && culling_ != nullptr) {
        status = culling_->createSets(
            {instances_->cages().buffer(), list.buffer(), view_->cull(), view_->sizes(), view_->words()});
    } else if (status) {
        const auto entries = static_cast<uint32_t>(list.size() / sizeof(uint32_t));
        const InstanceList drawn{list.buffer(), instances_->passListBytes(), listsParts ? entries : desc.capacity};
        visibility_ = std::make_unique<ListedByHost>(instances_->windows(), drawn);
    }
    clear_.renew(culling_ != nullptr);
    return status ? tessellation_->createSets(*instances_, *visibility_) : status;
}

void Group::fill(SuppleGroupInfo& info) const {
    instances_->fill(info);
    info.tessellation = tessellation_->kind();
    info.patchCount = static_cast<uint32_t>(tables().patches.size());
    info.instances = visibility_->list().slots();
    const gpu::PlannedBuffer& patches = tessellation_->patchCoefficients();
    info.patchCoefficients = {patches.buffer(), 0, patches.size(), 16};
    info.deviceBytes = buffers_.allocatedBytes() + instances_->deviceBytes() + tessellation_->deviceBytes();
}

uint64_t Group::leastVertices() const {
    return culling_ != nullptr && tessellation_->isBudgeted() ? culling_->leastVerticesOfAll() : 0;
}

bool Group::staticsPending() const {
    return asset_->buffers.uploadPending() || asset_->clips.uploadPending() || tessellation_->staticsPending() ||
           clear_.due() || (view_ != nullptr && view_->staticsPending());
}

VkDeviceSize Group::recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) {
    lastRecordedFrame_ = frame;
    if (clear_.due()) {
        clear_.record(frame);
        culling_->recordClear(commandBuffer);
    }
    return asset_->buffers.recordUpload(commandBuffer, frame) + asset_->clips.recordUpload(commandBuffer, frame) +
           tessellation_->recordStatics(commandBuffer, frame);
}

PassCost Group::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame) {
    passesFrame_ = lastRecordedFrame_ = frame;
    const bool changed = instances_->changed();
    PassCost cost = instances_->recordUpload(commandBuffer, frame, *visibility_);
    cost.bytes += tessellation_->recordUpload(commandBuffer, frame, changed);
    return cost;
}

void Group::addTransfers(Transfers& transfers) const {
    instances_->addTransfers(transfers);
    visibility_->addTransfers(transfers);
    tessellation_->addTransfers(transfers, passesFrame_);
}

void Group::cancelFrame(uint64_t frame) {
    asset_->buffers.cancelUpload(frame);
    asset_->clips.cancelUpload(frame);
    instances_->cancelFrame(frame);
    tessellation_->cancelFrame(frame);
    clear_.cancel(frame);
    if (passesFrame_ == frame) {
        slots().forgetAll();
    }
}

void Group::releaseStaging(uint64_t completedFrame) {
    asset_->buffers.releaseStaging(completedFrame);
    asset_->clips.releaseStaging(completedFrame);
    tessellation_->releaseStaging(completedFrame);
}

} // namespace supple::runtime
