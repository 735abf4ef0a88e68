#include "runtime/instance_set.h"

#include "shaders/shared/pose.h"

#include <algorithm>

namespace supple::runtime {

namespace {

// Descriptor offsets need at most 256-byte alignment (VkPhysicalDeviceLimits). If there is more than one window, poses
// start on such multiples.
constexpr uint32_t kPosePadding = 16;

constexpr CreaseAlphas::Value ownAlphas() {
    CreaseAlphas::Value value{};
    for (float& alpha : value) {
        alpha = -1.0f;
    }
    return value;
}

} // namespace

Result<std::shared_ptr<InstanceSet>> InstanceSet::create(const Desc& desc) {
    auto set = std::make_shared<InstanceSet>();
    set->desc_ = desc;
    set->cageStride_ = cageStrideOf(desc.asset->character.cage.vertexCount());
    Status status = success();
    if (posesNodes(desc.source, desc.room.modifiers, desc.room.springs)) {
        status = desc.asset->makeClips(*desc.device);
    }
    if (status && desc.source != SUPPLE_POSES_CAGE_BUFFER) {
        status = desc.asset->makeSkinning(*desc.device, desc.mode);
    }
    status = status && desc.room.springs ? set->takeSprings() : status;
    status = status && desc.room.soft ? set->takeSoft() : status;
    status = status && desc.source == SUPPLE_POSES_PLAYBACK ? set->makePipelines() : status;
    if (!status) {
        return status.error();
    }
    if (desc.source == SUPPLE_POSES_SET) {
        desc.asset->makeDrivers();
    }
    if (desc.room.updateRates) {
        desc.asset->measureUpdates();
    }
    set->slots_ = InstanceSlots(desc.capacity, desc.firstGeneration, static_cast<uint32_t>(desc.asset->parts.size()));
    set->userData_ = UserData(desc.capacity);
    const bool hasSets = !desc.asset->character.cage.creaseSets.empty();
    set->creaseAlphas_ = CreaseAlphas(hasSets ? desc.capacity : 0, ownAlphas());
    return set;
}

Status InstanceSet::makePipelines() {
    const Asset& asset = *desc_.asset;
    const skinning::PoseNeeds needs = poseNeeds(desc_.room, asset.character, asset.hasMorphs());
    const Result<skinning::PosePipelines> made = desc_.pose->make(desc_.mode, needs);
    if (made) {
        pipelines_ = *made;
    }
    return made ? success() : made.error();
}

Status InstanceSet::takeSprings() {
    const skinning::ClipTable& table = *desc_.asset->clipTable;
    desc_.room.springs = table.springs != 0;
    if (table.springWork > shared::kMostStepWork) {
        return Error{ErrorCode::limit, "its springs have " + std::to_string(table.springWork) +
                                           " joints, colliders and tests of one against the other, of at most " +
                                           std::to_string(shared::kMostStepWork)};
    }
    return success();
}

Status InstanceSet::takeSoft() {
    Status made = desc_.asset->makeSoft(*desc_.device);
    desc_.room.soft = desc_.asset->isSoft();
    desc_.room.cloths = desc_.asset->cloths.count > 0;
    return made;
}

uint32_t InstanceSet::cageStrideOf(uint32_t cageVertices) {
    return surface::cageStrideFor(cageVertices);
}

BoundBytes InstanceSet::boundBytes(bool windowed) const {
    const skinning::PoseLayout layout = poseLayoutOf(*desc_.asset, desc_.mode, windowed ? kPosePadding : 1);
    return {std::max(VkDeviceSize{cageStride_} * gpu::kVec4Bytes,
                     poseWindowBytes(desc_.source, *desc_.asset, layout, desc_.room)),
            0};
}

Status InstanceSet::makeBuffers(bool windowed) {
    constexpr VkBufferUsageFlags kInput = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                          VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                          VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    layout_ = poseLayoutOf(*desc_.asset, desc_.mode, windowed ? kPosePadding : 1);
    poses_ = makePoseSource(desc_.source, {desc_.device, pipelines_, desc_.asset.get(), layout_, desc_.capacity,
                                           desc_.framesInFlight, desc_.room});
    addMember(*poses_);
    addMember(userData_);
    addMember(creaseAlphas_);
    const VkDeviceSize n = desc_.capacity;
    const bool deforms = desc_.source != SUPPLE_POSES_CAGE_BUFFER;
    gpu::BufferPlan device(buffers_), staging(staging_);
    palettes_ = device.add(
        {"supple poses", deforms ? n * layout_.stride * gpu::kVec4Bytes : 0, kInput, gpu::MemoryPurpose::poses});
    cages_ = device.add({"supple deformed cage", n * cageStride_ * gpu::kVec4Bytes,
                         kInput | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, gpu::MemoryPurpose::cages});
    userData_.plan(device, "supple user data", staging, "supple user data staging", desc_.framesInFlight);
    creaseAlphas_.plan(device, "supple crease alphas", staging, "supple crease alphas staging", desc_.framesInFlight);
    poses_->plan(staging);
    const Status status = device.create(*desc_.device, gpu::MemoryKind::deviceLocal);
    return status ? staging.create(*desc_.device, gpu::MemoryKind::upload) : status;
}

Status InstanceSet::createSets(const InstanceListing& listing) {
    const VkBuffer list = listing.buffer().buffer();
    return poses_->create({palettes_.buffer(), list, listing.passBytes(), listing.windows().size});
}

void InstanceSet::takeOver(InstanceSet& other, const AssetMatch& match) {
    slots_.takeOver(other.slots_, match.parts);
    poses_->takeOver(*other.poses_, other.slots_.end(), match);
    userData_.takeFrom(other.userData_, other.slots_.end());
    takeCreaseAlphas(other, match);
}

void InstanceSet::takeCreaseAlphas(const InstanceSet& other, const AssetMatch& match) {
    if (creaseAlphas_.values().empty() || other.creaseAlphas_.values().empty()) {
        return;
    }
    if (match.same) {
        creaseAlphas_.takeFrom(other.creaseAlphas_, other.slots_.end());
        return;
    }
    for (uint32_t slot = 0; slot < other.slots_.end(); ++slot) {
        CreaseAlphas::Value value = creaseAlphas_.unset();
        for (size_t set = 0; set < match.creaseSets.size(); ++set) {
            if (const uint32_t before = match.creaseSets[set]; before != cage::kNone) {
                value[set] = other.creaseAlphas_.values()[slot][before];
            }
        }
        creaseAlphas_.set(slot, value);
    }
}

void InstanceSet::setCreaseAlpha(uint32_t slot, uint32_t set, float alpha) {
    CreaseAlphas::Value value = creaseAlphas_.values()[slot];
    value[set] = alpha;
    creaseAlphas_.set(slot, value);
}

void InstanceSet::reset(uint32_t slot) {
    poses_->reset(slot);
    userData_.reset(slot);
    if (!creaseAlphas_.values().empty()) {
        creaseAlphas_.reset(slot);
    }
}

void InstanceSet::fill(SuppleGroupInfo& output) const {
    const auto whole = [](const gpu::PlannedBuffer& buffer, uint32_t stride) {
        return SuppleBufferRange{buffer.buffer(), 0, buffer.size(), stride};
    };
    output.capacity = desc_.capacity;
    output.skinning = static_cast<SuppleSkinning>(desc_.mode);
    output.cageVertexCount = desc_.asset->character.cage.vertexCount();
    output.cageVerticesPerInstance = cageStride_;
    output.deformedCage = whole(cages_, 16);
    output.poses = whole(palettes_, layout_.stride * 16);
    output.userData = whole(userData_.buffer(), sizeof(UserData::Value));
}

void InstanceSet::addTransfers(Transfers& transfers) const {
    if (desc_.source != SUPPLE_POSES_CAGE_BUFFER) {
        transfers.add(cages_.buffer());
    }
    // What the host writes on the device is its own to hand over.
    if (desc_.source == SUPPLE_POSES_SET || desc_.source == SUPPLE_POSES_PLAYBACK) {
        transfers.add(palettes_.buffer());
    }
    transfers.add(userData_.buffer().buffer());
}

PassCost InstanceSet::recordPoses(VkCommandBuffer commandBuffer, const HostPoses::Frame& frame,
                                  const glm::dvec3& origin) {
    poses_->setOrigin(origin, slots_.end());
    PassCost cost = poses_->recordUpload(commandBuffer, frame, slots_);
    cost.bytes += userData_.recordUpload(*desc_.device, commandBuffer, frame.number, desc_.handsOver, slots_.end());
    cost.bytes += creaseAlphas_.recordUpload(*desc_.device, commandBuffer, frame.number, false, slots_.end());
    return cost;
}

} // namespace supple::runtime
