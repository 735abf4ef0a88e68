#include "runtime/playback.h"

#include "gpu/tasks.h"
#include "skinning/joints.h"
#include "skinning/played_pose.h"
#include "skinning/split_time.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace supple::runtime {

namespace {

using namespace supple::shared;

/// Elements: descriptor offsets need at most 256-byte alignment (VkPhysicalDeviceLimits).
constexpr uint32_t kPadding = 16;

uint32_t padded(uint32_t elements) {
    return (elements + kPadding - 1) / kPadding * kPadding;
}

uint32_t transitionElements(const skinning::ClipTable& table, const skinning::PoseLayout& layout,
                            const StateRoom& room) {
    return room.transitions ? skinning::transitionElements(static_cast<uint32_t>(table.nodes.size()), layout.morphCount)
                            : 0;
}

/// Where the transition begins in a state.
uint32_t transitionBegin(const skinning::PoseLayout& layout, const StateRoom& room) {
    return skinning::PlaybackState::elements(layout.morphCount, room.modifiers ? kMaxModifiers : 0);
}

/// From what an instance plays to what it has played before the last call, which is there with springs.
uint32_t playedStride(const skinning::ClipTable& table, const skinning::PoseLayout& layout, const StateRoom& room) {
    return padded(transitionBegin(layout, room) + transitionElements(table, layout, room));
}
uint32_t stateStride(const skinning::ClipTable& table, const skinning::PoseLayout& layout, const StateRoom& room) {
    return (room.springs ? 2 : 1) * playedStride(table, layout, room);
}

/// Behind the nodes and the place.
uint32_t springScratch(const skinning::ClipTable& table, const StateRoom& room) {
    return kAffineElements * (static_cast<uint32_t>(table.nodes.size()) + 1) + (room.modifiers ? table.footCount : 0);
}
uint32_t scratchStride(const skinning::ClipTable& table, const StateRoom& room) {
    return padded(springScratch(table, room) +
                  (room.springs ? kAffineElements + kPosedColliderElements * table.springColliderCount : 0));
}
uint32_t springStride(const skinning::ClipTable& table, const StateRoom& room) {
    return room.springs ? padded(kSpringJoints + kSpringJointElements * table.springJointCount) : 0;
}

/// From one end of an instance to the next. Both together are a multiple of kPadding.
uint32_t endStride(const skinning::PoseLayout& layout, const StateRoom& room) {
    constexpr uint32_t kMultiple = kPadding / kPoseEnds;
    return room.updateRates ? (layout.elements() + kMultiple - 1) / kMultiple * kMultiple : 0;
}

/// Poses of an instance that may be made in one frame.
uint32_t posesInFrame(const StateRoom& room) {
    return room.updateRates ? 2 : room.springs ? 1 + kMostSpringSteps : 1;
}

/// What the pose pass's dispatches of any window have in common.
PosePush constantsOf(const Playback::Desc& desc) {
    const skinning::ClipTable& table = *desc.asset->clipTable;
    PosePush push{};
    push.nodeCount = static_cast<uint32_t>(table.nodes.size());
    push.jointCount = table.jointCount;
    push.morphCount = desc.layout.morphCount;
    push.joints = table.joints;
    push.levels = table.levels;
    push.levelCount = table.levelCount;
    push.restWeights = table.restWeights;
    push.clips = table.clips;
    push.stateStride = stateStride(table, desc.layout, desc.room);
    push.transition = transitionBegin(desc.layout, desc.room);
    push.maskStride = skinning::maskElements(table);
    push.scratchStride = scratchStride(table, desc.room);
    push.contacts = table.contacts;
    push.poseStride = desc.layout.stride;
    push.endStride = endStride(desc.layout, desc.room);
    push.morphWeights = desc.layout.morphWeights;
    push.shown = UINT32_MAX;
    push.stepNodes = desc.room.modifiers ? 0 : kNodeOfSprings;
    push.stateBefore = playedStride(table, desc.layout, desc.room);
    push.springs = table.springs;
    push.springScratch = springScratch(table, desc.room);
    push.springStride = springStride(table, desc.room);
    return push;
}

/// How much longer a matrix makes a vector, at most; exactly, if its columns are orthogonal: by the sums of the rows of
/// its columns' products.
float largestScale(const glm::mat3& linear) {
    const glm::mat3 products = glm::transpose(linear) * linear;
    float most = 0.0f;
    for (int column = 0; column < 3; ++column) {
        const glm::vec3 row = glm::abs(products[column]);
        most = std::max(most, row.x + row.y + row.z);
    }
    return std::sqrt(most);
}

/// A node's place in the table of another version of the asset, or kNone.
uint32_t placeInOther(uint32_t node, const AssetMatch& match, const skinning::ClipTable& table) {
    const uint32_t moved = match.nodes[node];
    return moved != cage::kNone ? table.places[moved] : cage::kNone;
}

} // namespace

VkDeviceSize Playback::windowBytes(const Asset& asset, const skinning::PoseLayout& layout, const StateRoom& room) {
    const skinning::ClipTable& table = *asset.clipTable;
    return std::max({stateStride(table, layout, room), posesInFrame(room) * scratchStride(table, room),
                     kPoseEnds * endStride(layout, room), springStride(table, room)}) *
           gpu::kVec4Bytes;
}

Result<Playback> Playback::create(const Desc& desc) {
    const skinning::ClipTable& table = *desc.asset->clipTable;
    Playback playback;
    playback.device_ = desc.device;
    playback.kernels_ = desc.kernels;
    playback.asset_ = desc.asset;
    playback.capacity_ = desc.capacity;
    playback.windowSize_ = desc.windowSize;
    playback.framesInFlight_ = desc.framesInFlight;
    playback.push_ = constantsOf(desc);
    const PosePush& push = playback.push_;
    playback.transitionElements_ = transitionElements(table, desc.layout, desc.room);
    playback.mode_ = desc.layout.mode;

    playback.modifiers_ = InstanceModifiers(desc.room.modifiers ? desc.capacity : 0, push.morphCount);
    playback.states_.resize(size_t{desc.capacity} * push.stateStride * 4);
    playback.masks_.assign(size_t{kMaxMasks} * push.maskStride * 4, 1.0f);
    playback.jointMasks_.assign(size_t{kMaxMasks} * push.jointCount, 1.0f);
    playback.twin_ = skinning::PoseTwin(table, desc.layout, push.transition);
    playback.makeLists(desc);
    playback.transforms_.resize(desc.capacity, glm::mat4(1.0f));
    playback.positions_.resize(desc.capacity, glm::dvec3(0.0));
    playback.bounds_ = PlayedBounds(desc.asset->character, desc.asset->skinnedBounds(desc.layout.mode),
                                    desc.room.modifiers, desc.capacity);
    if (desc.room.springs) {
        playback.bounds_.setSwinging(table.swinging);
    }
    playback.versions_.resize(desc.capacity, 1);
    playback.changed_.resize(desc.capacity, false);
    playback.changedSlots_.reserve(desc.capacity);
    playback.uploadedSlots_.reserve(desc.capacity);
    // Runs of slots with others between; of states of which only parts are used, each part by itself.
    const size_t parts = size_t{desc.room.springs ? 3u : desc.room.modifiers || desc.room.transitions ? 2u : 0u};
    playback.regions_.reserve(parts > 0 ? parts * desc.capacity : size_t{desc.capacity} / 2 + 1);
    if (desc.room.transitions) {
        playback.transitionDue_.resize(desc.capacity, false);
        for (auto* const poses : {&playback.startsFrom_.shown, &playback.startsFrom_.played}) {
            for (skinning::SampledPose& pose : *poses) {
                pose.assign(playback.twin_.locals(), playback.twin_.weights());
            }
        }
    }
    Status status = playback.createBuffers(desc);
    if (status) {
        status = playback.createSets(desc);
    }
    if (!status) {
        return status.error();
    }
    return playback;
}

void Playback::makeLists(const Desc& desc) {
    if (desc.room.updateRates) {
        laterTwin_ = twin_;
        rates_ = UpdateRates(desc.capacity);
    }
    if (desc.room.springs) {
        springs_ = SpringClock(desc.capacity);
        beforeDue_.resize(desc.capacity, false);
    }
    if (listsPoses()) {
        list_ = PoseList(desc.capacity, (desc.capacity + desc.windowSize - 1) / desc.windowSize, desc.room.springs);
    }
}

Status Playback::createBuffers(const Desc& desc) {
    constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    constexpr VkBufferUsageFlags kTexels = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    constexpr VkBufferUsageFlags kCopied = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const VkDeviceSize maskBytes = masks_.size() * sizeof(float);
    std::vector<gpu::BufferRequest> requests(kBufferCount);
    requests[kStates] = {"supple playback", capacity_ * stateBytes(), kStorage | kTexels | kCopied,
                         gpu::MemoryPurpose::poses};
    requests[kMasks] = {"supple masks", maskBytes, kStorage | kTexels | kCopied, gpu::MemoryPurpose::poses};
    requests[kScratch] = {"supple node matrices",
                          capacity_ * posesInFrame(desc.room) * push_.scratchStride * gpu::kVec4Bytes,
                          kStorage | kTexels, gpu::MemoryPurpose::scratch};
    requests[kEnds] = {"supple ends", capacity_ * endBytes(), kStorage | kTexels, gpu::MemoryPurpose::poses};
    const VkDeviceSize ofList = listBytes();
    requests[kList] = {"supple list of poses", ofList, kStorage | kTexels | kCopied, gpu::MemoryPurpose::poses};
    Result<gpu::BufferSet> buffers = gpu::BufferSet::create(*desc.device, requests, gpu::MemoryKind::deviceLocal);
    if (!buffers) {
        return buffers.error();
    }
    buffers_ = std::move(*buffers);
    std::vector<gpu::BufferRequest> staging(kStagingCount);
    staging[kStateStaging] = {"supple playback staging", capacity_ * stateBytes() * framesInFlight_,
                              VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    staging[kMaskStaging] = {"supple mask staging", maskBytes * framesInFlight_, VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    staging[kListStaging] = {"supple list of poses staging", ofList * framesInFlight_,
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    Result<gpu::BufferSet> stagingSet = gpu::BufferSet::create(*desc.device, staging, gpu::MemoryKind::upload);
    if (!stagingSet) {
        return stagingSet.error();
    }
    staging_ = std::move(*stagingSet);
    return hasSprings() ? springState_.create(*desc.device, capacity_, springBytes(), "supple springs") : success();
}

Status Playback::createSets(const Desc& desc) {
    const gpu::Device& device = *desc.device;
    const uint32_t windows = (capacity_ + windowSize_ - 1) / windowSize_;
    Status status = sets_.create(device, kernels_->layout(), windows, "supple pose");
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size, const char* name) {
        return views_.make(device, buffer, format, offset, size, name, status);
    };
    const VkBuffer table = asset_->clips.buffer(0), masks = buffers_.buffer(kMasks);
    const VkDeviceSize tableBytes = asset_->clips.size(0), maskBytes = buffers_.size(kMasks);
    const VkBufferView tableView = view(table, gpu::kUint4, 0, tableBytes, "supple clips");
    const VkBufferView maskView = view(masks, gpu::kFloat4, 0, maskBytes, "supple masks");
    const VkBuffer list = listsPoses() ? buffers_.buffer(kList) : desc.instances;
    const VkDeviceSize listed = listsPoses() ? listBytes() : desc.instanceBytes;
    const VkBufferView listView = view(list, VK_FORMAT_R32_UINT, 0, listed, "supple instances");
    const VkDeviceSize poseBytes = push_.poseStride * gpu::kVec4Bytes,
                       scratchBytes = posesInFrame(desc.room) * push_.scratchStride * gpu::kVec4Bytes;
    // Without update rates nobody touches what is bound as ends.
    const VkBuffer ends = takesUpdateRates() ? buffers_.buffer(kEnds) : desc.poses;
    const VkDeviceSize bytesOfEnds = takesUpdateRates() ? endBytes() : poseBytes;
    for (uint32_t w = 0; w < windows && status; ++w) {
        const VkDeviceSize first = VkDeviceSize{w} * windowSize_;
        const VkDeviceSize count = std::min<VkDeviceSize>(windowSize_, capacity_ - first);
        const auto range = [&](VkBuffer buffer, VkDeviceSize bytes) {
            return VkDescriptorBufferInfo{buffer, first * bytes, count * bytes};
        };
        const VkBuffer states = buffers_.buffer(kStates), scratch = buffers_.buffer(kScratch);
        const gpu::BoundResource resources[] = {
            {kClipTableBinding, {table, 0, tableBytes}, VK_NULL_HANDLE},
            {kClipTableTexelBinding, {}, tableView},
            {kStateBinding, range(states, stateBytes()), VK_NULL_HANDLE},
            {kStateTexelBinding,
             {},
             view(states, gpu::kUint4, first * stateBytes(), count * stateBytes(), "supple playback")},
            {kMaskBinding, {masks, 0, maskBytes}, VK_NULL_HANDLE},
            {kMaskTexelBinding, {}, maskView},
            {kScratchPoseBinding, range(scratch, scratchBytes), VK_NULL_HANDLE},
            {kScratchPoseTexelBinding,
             {},
             view(scratch, gpu::kFloat4, first * scratchBytes, count * scratchBytes, "supple node matrices")},
            {kPosedBinding, range(desc.poses, poseBytes), VK_NULL_HANDLE},
            {kEndsBinding, range(ends, bytesOfEnds), VK_NULL_HANDLE},
            {kEndsTexelBinding, {}, view(ends, gpu::kFloat4, first * bytesOfEnds, count * bytesOfEnds, "supple ends")},
            {kSpringBinding, hasSprings() ? range(springState_.buffer(), springBytes()) : range(scratch, scratchBytes),
             VK_NULL_HANDLE},
            {kInstanceBinding, {list, 0, listed}, VK_NULL_HANDLE},
            {kInstanceTexelBinding, {}, listView},
        };
        if (status) {
            sets_.write(device, kernels_->layout(), w, resources);
        }
    }
    return status;
}

skinning::PlaybackState Playback::state(uint32_t slot) {
    return skinning::PlaybackState(stateWords(slot));
}

void Playback::markChanged(uint32_t slot) {
    versions_[slot] += versions_[slot] == UINT32_MAX ? 2 : 1;
    if (!changed_[slot]) {
        changed_[slot] = true;
        changedSlots_.push_back(slot);
    }
}

void Playback::forget(uint32_t slot) {
    if (evaluated_ == slot) {
        evaluated_ = kNoSlot;
    }
}

void Playback::forgetEnds(uint32_t slot) {
    if (takesUpdateRates()) {
        rates_.forget(slot);
    }
}

void Playback::forgetEndsWith(uint32_t mask) {
    skinning::PlaybackState::Layers memory;
    for (uint32_t slot = 0; takesUpdateRates() && slot < capacity_; ++slot) {
        const skinning::PlaybackState own = state(slot);
        const skinning::PlaybackDesc desc =
            own.inBindPose() ? skinning::PlaybackDesc{} : own.read(*asset_->clipTable, memory);
        if (std::ranges::any_of(desc.layers, [&](const auto& layer) { return layer.mask == mask; })) {
            rates_.forget(slot);
        }
    }
}

void Playback::evaluate(uint32_t slot) {
    if (evaluated_ == slot) {
        return;
    }
    evaluated_ = slot;
    evaluatedSpan_ = spanOf(slot);
    if (evaluatedSpan_.isExact()) {
        twin_.pose(stateWords(slot), masks_, time_);
    } else {
        twin_.pose(stateWords(slot), masks_, evaluatedSpan_.begin, skinning::PoseTwin::Stands::unplaced);
        laterTwin_.pose(stateWords(slot), masks_, evaluatedSpan_.end, skinning::PoseTwin::Stands::unplaced);
    }
}

glm::mat4 Playback::jointTransform(uint32_t slot, uint32_t joint) {
    const skinning::PlaybackState own = state(slot);
    if (own.inBindPose()) {
        return skinning::placedJoint(glm::dmat4(own.transform()), asset_->jointFrames.bind[joint]);
    }
    evaluate(slot);
    return evaluatedSpan_.isExact()
               ? twin_.placedJoint(joint)
               : twin_.placedJointBetween(laterTwin_, evaluatedSpan_.partAt(time_), stateWords(slot), joint);
}

void Playback::writePose(uint32_t slot, std::span<glm::vec4> pose) {
    evaluate(slot);
    if (evaluatedSpan_.isExact()) {
        twin_.write(pose);
    } else {
        twin_.writeBetween(laterTwin_, evaluatedSpan_.partAt(time_), stateWords(slot), pose);
    }
}

void Playback::setTime(double seconds) {
    if (time_ != seconds) {
        time_ = seconds;
        evaluated_ = kNoSlot;
    }
}

void Playback::reset(uint32_t slot) {
    forget(slot);
    skinning::PlaybackState own = state(slot);
    own.setMorphWeights(nullptr, 0);
    own.setModifierCount(0);
    own.setBindPose();
    bounds_.setBindPose(slot);
    if (takesUpdateRates()) {
        rates_.reset(slot);
    }
    if (hasSprings()) {
        springs_.settle(slot);
    }
    if (takesModifiers()) {
        bounds_.setTurned(slot, {}, false, 0.0);
    }
    setTransform(slot, glm::mat4(1.0f));
}

void Playback::sample(uint32_t slot, double time, bool modified, skinning::SampledPose& pose) {
    if (modified) {
        twin_.pose(stateWords(slot), masks_, time);
    } else {
        twin_.sample(stateWords(slot), masks_, time);
    }
    pose.assign(twin_.locals(), twin_.weights());
    evaluated_ = kNoSlot;
}

std::span<uint32_t> Playback::transitionWords(uint32_t slot) {
    return stateWords(slot).subspan(4 * size_t{push_.transition}, 4 * size_t{transitionElements_});
}

void Playback::sampleShown(uint32_t slot, const TransitionRequest& request) {
    constexpr auto kStep = static_cast<double>(kTransitionStep);
    // Before a transition began, something else was shown.
    const bool justBegun =
        state(slot).isInTransition() && skinning::transitionStart(transitionWords(slot)) > time_ - kStep;
    startsFrom_.now = justBegun ? 0 : 1;
    double time = time_ - startsFrom_.now * kStep;
    for (skinning::SampledPose& pose : startsFrom_.shown) {
        sample(slot, time, request.fromModified, pose);
        time += kStep;
    }
}

void Playback::startTransition(uint32_t slot, const TransitionRequest& request) {
    if (request.kind == skinning::TransitionKind::quintic) {
        double time = time_;
        for (skinning::SampledPose& pose : startsFrom_.played) {
            sample(slot, time, false, pose);
            time += static_cast<double>(kTransitionStep);
        }
    }
    skinning::writeTransition({request.kind, time_, request.seconds}, startsFrom_, transitionWords(slot));
    state(slot).setInTransition(true);
    transitionDue_[slot] = true;
    const double end = time_ + static_cast<double>(request.seconds);
    bounds_.setTransition(slot, {time_, end});
    transitions_.start = std::min(transitions_.start, time_);
    transitions_.end = std::max(transitions_.end, end);
}

void Playback::set(uint32_t slot, const skinning::PlaybackDesc& desc, const TransitionRequest& request,
                   uint32_t updateInterval) {
    forget(slot);
    skinning::PlaybackState own = state(slot);
    const bool starts = request.seconds > 0.0f && !own.inBindPose(), keeps = request.keeps && own.isInTransition();
    const PlayedBounds::Interval before = bounds_.transition(slot);
    if (starts) {
        sampleShown(slot, request);
    }
    keepBefore(slot);
    own.set(asset_->character, *asset_->clipTable, desc);
    bounds_.set(slot, desc);
    if (starts) {
        startTransition(slot, request);
    } else if (keeps) {
        own.setInTransition(true);
        bounds_.setTransition(slot, before);
    }
    if (takesUpdateRates()) {
        rates_.set(slot, courseOf(desc, updateInterval));
    }
    roots_ = roots_ || desc.root.axes != 0;
    for (const skinning::PlaybackLayer& layer : desc.layers) {
        adds_ = adds_ || layer.mode == skinning::LayerMode::additive;
    }
    markChanged(slot);
}

void Playback::keepBefore(uint32_t slot) {
    if (hasSprings() && springs_.change(slot, time_)) {
        const std::span<uint32_t> words = stateWords(slot);
        const size_t played = size_t{push_.stateBefore} * 4;
        std::copy_n(words.begin(), played, words.begin() + static_cast<ptrdiff_t>(played));
        beforeDue_[slot] = true;
    }
}

bool Playback::travels(uint32_t slot) {
    const auto asks = [](std::span<const uint32_t> words) { return (words[1] & kStateTravels) != 0; };
    const std::span<uint32_t> words = stateWords(slot);
    return asks(words) || (springs_.hasBefore(slot) && asks(words.subspan(size_t{push_.stateBefore} * 4)));
}

void Playback::teleport(uint32_t slot) {
    if (hasSprings()) {
        springs_.jump(slot, time_);
    }
}

glm::mat4 Playback::placement(uint32_t slot) const {
    glm::mat4 placed = transforms_[slot];
    placed[3] = glm::vec4(glm::vec3(positions_[slot] - origin_), 1.0f);
    return placed;
}

void Playback::place(uint32_t slot) {
    forget(slot);
    state(slot).setTransform(placement(slot));
    modifiers_.place(slot, state(slot), origin_);
    markChanged(slot);
}

void Playback::setModifiers(uint32_t slot, std::span<const PlacedModifier> modifiers) {
    forget(slot);
    keepBefore(slot);
    modifiers_.set(slot, state(slot), *asset_->clipTable, modifiers, origin_);
    modifies_ = modifies_ || !modifiers.empty();
    takeModifiers(slot);
    forgetEnds(slot);
    markChanged(slot);
}

void Playback::setModifierGoal(uint32_t slot, uint32_t index, const ModifierGoal& goal) {
    forget(slot);
    keepBefore(slot);
    modifiers_.setGoal(slot, state(slot), index, goal, origin_);
    markChanged(slot);
}

void Playback::takeModifiers(uint32_t slot) {
    skinning::PlaybackState own = state(slot);
    std::vector<uint32_t>& turned = turnedNodes_;
    turned.clear();
    bool moves = false;
    double lowered = 0.0;
    for (uint32_t i = 0; i < own.modifierCount(); ++i) {
        const std::span<const uint32_t> words = own.modifier(push_.morphCount, i);
        moves = moves || skinning::modifierKind(words) == kModifierHandOver;
        plants_ = plants_ || skinning::modifierKind(words) == kModifierPlant;
        lowered += static_cast<double>(skinning::loweredBy(words));
        skinning::ChainPlaces room;
        for (const uint32_t place : skinning::modifierPlaces(words, room)) {
            turned.push_back(asset_->clipTable->nodes[place]);
        }
    }
    bounds_.setTurned(slot, turned, moves, lowered);
}

std::optional<skinning::Box> Playback::boundsOf(uint32_t slot, const skinning::Reach& reach) {
    // Targets that move nothing have no weights on the device.
    const float* const weights = state(slot).morphWeights();
    const std::span<const float> own(weights, weights != nullptr ? push_.morphCount : 0);
    const std::optional<skinning::Box> box = bounds_.of(slot, time_, reach, own);
    return box ? std::optional(skinning::movedBy(glm::dmat4(placement(slot)), *box)) : std::nullopt;
}

void Playback::setTransform(uint32_t slot, const glm::mat4& transform) {
    transforms_[slot] = transform;
    setPosition(slot, glm::dvec3(transform[3]));
}

void Playback::setPosition(uint32_t slot, const glm::dvec3& position) {
    positions_[slot] = position;
    if (hasSprings()) {
        keepBefore(slot);
        springs_.place(slot, time_);
    }
    place(slot);
}

void Playback::setOrigin(const glm::dvec3& origin, uint32_t end) {
    if (origin_ != origin) {
        origin_ = origin;
        for (uint32_t slot = 0; slot < end; ++slot) {
            place(slot);
        }
    }
}

void Playback::setMorphWeights(uint32_t slot, const float* weights) {
    forget(slot);
    skinning::PlaybackState own = state(slot);
    if (weights == nullptr && own.morphWeights() != nullptr) { // ends that were posed meanwhile have the host's
        forgetEnds(slot);
    }
    own.setMorphWeights(weights, push_.morphCount);
    markChanged(slot);
}

void Playback::setMask(uint32_t mask, std::span<const float> joints, std::span<const float> morphs) {
    skinning::writeMask(*asset_->clipTable, asset_->rig, joints, morphs,
                        std::span(masks_).subspan((mask - 1) * maskFloats(), maskFloats()));
    const std::span<float> own = std::span(jointMasks_).subspan(size_t{mask - 1} * push_.jointCount, push_.jointCount);
    if (joints.empty()) {
        std::fill(own.begin(), own.end(), 1.0f);
    } else {
        std::copy(joints.begin(), joints.end(), own.begin());
    }
    evaluated_ = kNoSlot;
    forgetEndsWith(mask);
    masksSet_[mask - 1] = joints.empty() ? MaskKind::morphs : MaskKind::joints;
    masksChanged_ = true;
}

void Playback::takeOverState(Playback& other, uint32_t slot, const AssetMatch& match) {
    const skinning::PlaybackState before = other.state(slot);
    if (const float* const weights = before.morphWeights()) {
        std::vector<float> moved(push_.morphCount);
        for (uint32_t t = 0; t < push_.morphCount; ++t) {
            const uint32_t from = match.targets[t];
            // Targets that moved nothing there had no weights.
            moved[t] = from < other.push_.morphCount ? weights[from] : asset_->character.morphs.weights[t];
        }
        setMorphWeights(slot, moved.data());
    }
    if (takesModifiers()) {
        modifiers_.takeOver(slot, state(slot), *asset_->clipTable, other.modifiers_, before, [&](uint32_t place) {
            return placeInOther(other.asset_->clipTable->nodes[place], match, *asset_->clipTable);
        });
        modifies_ = modifies_ || state(slot).modifierCount() > 0;
        takeModifiers(slot);
    }
    if (before.inBindPose()) {
        return;
    }
    skinning::PlaybackState::Layers memory, kept;
    skinning::PlaybackDesc desc = before.read(*other.asset_->clipTable, memory);
    if (!desc.layers.empty() && match.clips[desc.layers.front().clip] == cage::kNone) {
        desc.travels = false; // it was the first layer's movement
    }
    size_t count = 0;
    for (skinning::PlaybackLayer layer : desc.layers) {
        layer.clip = match.clips[layer.clip];
        if (layer.clip != cage::kNone) {
            kept[count++] = layer;
        }
    }
    desc.layers = std::span(kept).first(count);
    if (desc.root.node != cage::kNone) {
        desc.root.node = match.nodes[desc.root.node];
    }
    set(slot, desc, {}, other.takesUpdateRates() ? other.rates_.course(slot).asked : 0);
}

void Playback::takeOverMasks(const Playback& other, const AssetMatch& match) {
    std::vector<float> joints(push_.jointCount), morphs(asset_->clipTable->targetCount);
    for (uint32_t mask = 1; mask <= kMaxMasks; ++mask) {
        const MaskKind kind = other.masksSet_[mask - 1];
        if (kind == MaskKind::none) {
            continue;
        }
        for (uint32_t j = 0; j < joints.size(); ++j) {
            const size_t from = size_t{mask - 1} * other.push_.jointCount + match.joints[j];
            joints[j] = match.joints[j] != cage::kNone ? other.jointMasks_[from] : 1.0f;
        }
        const std::span<const float> values =
            std::span(other.masks_).subspan((mask - 1) * other.maskFloats(), other.maskFloats());
        const std::span<const float> before = skinning::morphMaskOf(*other.asset_->clipTable, values);
        for (uint32_t t = 0; t < morphs.size(); ++t) {
            const float unnamed = kind == MaskKind::joints ? 0.0f : 1.0f;
            morphs[t] = match.targets[t] != cage::kNone ? before[match.targets[t]] : unnamed;
        }
        setMask(mask, kind == MaskKind::joints ? std::span<const float>(joints) : std::span<const float>(), morphs);
    }
}

void Playback::takeOver(Playback& other, uint32_t count, const AssetMatch& match) {
    time_ = other.time_;
    origin_ = other.origin_;
    if (match.same) {
        masks_ = other.masks_;
        jointMasks_ = other.jointMasks_;
        masksSet_ = other.masksSet_;
        adds_ = other.adds_;
        roots_ = other.roots_;
        modifies_ = other.modifies_;
        plants_ = other.plants_;
        transitions_ = other.transitions_;
        modifiers_.takeOver(other.modifiers_, count);
        const size_t words = size_t{push_.stateStride} * 4 * count;
        std::copy_n(other.states_.begin(), words, states_.begin());
        bounds_.takeOver(other.bounds_, count);
        rates_.takeOver(other.rates_, count);
        steps_ = other.steps_;
        if (hasSprings()) {
            springs_.takeOver(other.springs_, count);
            springState_.takeOver(other.springState_, count);
        }
    } else {
        takeOverMasks(other, match);
    }
    for (uint32_t slot = 0; slot < count; ++slot) {
        if (!match.same) {
            reset(slot);
            takeOverState(other, slot, match);
        }
        if (takesTransitions()) {
            transitionDue_[slot] = state(slot).isInTransition();
        }
        if (hasSprings()) {
            beforeDue_[slot] = springs_.hasBefore(slot);
        }
        transforms_[slot] = other.transforms_[slot];
        positions_[slot] = other.positions_[slot];
        place(slot);
    }
}

void Playback::stage(VkDeviceSize& from, VkDeviceSize to, VkDeviceSize bytes) {
    std::memcpy(staging_.mapped(kStateStaging) + from, states_.data() + to / sizeof(uint32_t), bytes);
    if (!regions_.empty() && regions_.back().dstOffset + regions_.back().size == to) {
        regions_.back().size += bytes;
    } else {
        regions_.push_back({from, to, bytes});
    }
    from += bytes;
}

VkDeviceSize Playback::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame) {
    VkDeviceSize bytes = hasSprings() ? springState_.recordUpload(commandBuffer, frame, {}) : 0;
    const VkDeviceSize run = frame % framesInFlight_;
    if (!changedSlots_.empty()) {
        // Packed in the order of slots: a region of the copy for every run of neighbors.
        std::sort(changedSlots_.begin(), changedSlots_.end());
        regions_.clear();
        const VkDeviceSize first = run * capacity_ * stateBytes();
        VkDeviceSize from = first;
        for (const uint32_t slot : changedSlots_) {
            const VkDeviceSize to = slot * stateBytes();
            stage(from, to, usedBytes(slot));
            if (takesTransitions() && transitionDue_[slot] && state(slot).isInTransition()) {
                stage(from, to + push_.transition * gpu::kVec4Bytes, transitionElements_ * gpu::kVec4Bytes);
                transitionDue_[slot] = false;
            }
            if (hasSprings() && beforeDue_[slot]) {
                const VkDeviceSize played = push_.stateBefore * gpu::kVec4Bytes;
                stage(from, to + played, played);
                beforeDue_[slot] = false;
            }
            changed_[slot] = false;
        }
        device_->vk.CmdCopyBuffer(commandBuffer, staging_.buffer(kStateStaging), buffers_.buffer(kStates),
                                  static_cast<uint32_t>(regions_.size()), regions_.data());
        bytes += from - first;
        std::swap(uploadedSlots_, changedSlots_);
        changedSlots_.clear();
        uploadFrame_ = frame;
    }
    if (masksChanged_) {
        const VkDeviceSize size = buffers_.size(kMasks);
        std::memcpy(staging_.mapped(kMaskStaging) + run * size, masks_.data(), size);
        const VkBufferCopy region{run * size, 0, size};
        device_->vk.CmdCopyBuffer(commandBuffer, staging_.buffer(kMaskStaging), buffers_.buffer(kMasks), 1, &region);
        bytes += size;
        masksChanged_ = false;
        masksFrame_ = frame;
    }
    return bytes;
}

VkDeviceSize Playback::usedBytes(uint32_t slot) {
    return takesModifiers() || takesTransitions() || hasSprings()
               ? VkDeviceSize{skinning::PlaybackState::elements(push_.morphCount, state(slot).modifierCount())} * 16
               : stateBytes();
}

void Playback::beginFrame(uint64_t completedFrame) {
    if (hasSprings()) {
        springState_.beginFrame(completedFrame);
    }
}

void Playback::cancelFrame(uint64_t frame) {
    if (hasSprings()) {
        springState_.cancelFrame(frame);
        springs_.cancelFrame(frame);
    }
    if (uploadFrame_ == frame) {
        for (const uint32_t slot : uploadedSlots_) {
            markChanged(slot);
            if (takesTransitions()) {
                transitionDue_[slot] = state(slot).isInTransition();
            }
            if (hasSprings()) {
                beforeDue_[slot] = springs_.hasBefore(slot);
            }
        }
    }
    masksChanged_ = masksChanged_ || masksFrame_ == frame;
    if (listFrame_ == frame) {
        rates_.forgetAll();
    }
}

UpdateCourse Playback::courseOf(const skinning::PlaybackDesc& desc, uint32_t updateInterval) const {
    UpdateCourse course;
    course.asked = updateInterval;
    for (const skinning::PlaybackLayer& layer : desc.layers) { // those that add have no box, and so no size
        if (layer.weight == 0.0f && !(layer.fadeDuration > 0.0f)) {
            continue;
        }
        const skinning::UpdateErrors& errors = asset_->updates.ofClips[layer.clip];
        const double speed = std::abs(static_cast<double>(layer.speed));
        for (size_t n = 0; n < UpdateCourse::kIntervals.size(); ++n) {
            const auto own = static_cast<float>(errors.at(speed * UpdateCourse::kIntervals[n]));
            course.errors[n] = std::max(course.errors[n], own);
        }
    }
    return course;
}

void Playback::setSize(uint32_t slot, float pixelsPerUnit) {
    const uint32_t before = rates_.interval(slot);
    const float scale = largestScale(glm::mat3(transforms_[slot]));
    rates_.choose(slot, pixelsPerUnit * scale * static_cast<float>(asset_->updates.extent), steps_.leastInterval());
    if (rates_.interval(slot) != before) {
        forget(slot);
    }
}

bool Playback::hasCorner(uint32_t slot, const PoseSpan& span) {
    constexpr double kSlack = 1e-5; // as finely as the device tells times apart
    const double first = span.begin - kSlack, last = span.end + kSlack;
    const skinning::PlaybackState own = state(slot);
    if (own.inBindPose()) {
        return false;
    }
    skinning::PlaybackState::Layers memory;
    const skinning::PlaybackDesc desc = own.read(*asset_->clipTable, memory);
    for (const skinning::PlaybackLayer& layer : desc.layers) {
        const double fadeEnd = layer.fadeStart + static_cast<double>(layer.fadeDuration);
        const bool fades = layer.fadeDuration > 0.0f && last > layer.fadeStart && first < fadeEnd;
        if (fades || skinning::clampsBetween(asset_->character, layer, first, last)) {
            return true;
        }
        const bool travels = desc.travels && &layer == desc.layers.data();
        if ((travels || !asset_->updates.closes(layer.clip, desc.root)) &&
            skinning::loopsAt(asset_->character, layer, first) != skinning::loopsAt(asset_->character, layer, last)) {
            return true;
        }
    }
    return false;
}

PoseSpan Playback::spanOf(uint32_t slot) {
    const uint32_t interval = takesUpdateRates() ? rates_.interval(slot) : 1;
    if (interval <= 1 || state(slot).modifierCount() > 0) {
        return exactSpan(time_);
    }
    const PoseSpan span = gridSpan(time_, slot, interval);
    if (rates_.holds(slot, span)) { // then it was found to be one
        return span;
    }
    const bool broken = bounds_.transition(slot).meets(span.begin, span.end) || hasCorner(slot, span);
    return broken ? exactSpan(time_) : span;
}

void Playback::listPose(uint32_t slot, uint32_t slotInWindow) {
    const PoseSpan span = spanOf(slot);
    if (span.isExact()) {
        list_.addPose(slotInWindow, 0, time_);
        return;
    }
    const UpdateRates::Ends ends = rates_.take(slot, span);
    for (uint32_t i = 0; i < ends.dueCount; ++i) {
        list_.addPose(slotInWindow, ends.due[i].end, ends.due[i].time);
    }
    list_.addMix(slotInWindow, ends.earlier, span.partAt(time_));
}

void Playback::listSteps(uint64_t frame, uint32_t slot, uint32_t slotInWindow) {
    list_.addPose(slotInWindow, 0, time_);
    if (state(slot).inBindPose()) {
        springs_.settle(slot);
        return;
    }
    const SpringPlace place{glm::dmat3(glm::mat3(transforms_[slot])), positions_[slot]};
    const SpringClock::Due due = springs_.take(slot, frame, time_, place, travels(slot));
    const uint32_t jump = due.jump != SpringClock::kNone ? (due.jump + 1) << kSpringJumpShift : 0;
    list_.addSwinging(slotInWindow, due.count | jump | (due.settles ? kSpringSettles : 0), due.part, due.moves);
    for (uint32_t k = 0; k < due.count; ++k) {
        const double time = springTime(due.first + k);
        list_.addStep(slotInWindow, due.before[k], time);
        firstStep_ = std::min(firstStep_, time);
        if (due.moves) {
            list_.addMove(due.rows[k]);
        }
    }
}

VkDeviceSize Playback::recordList(VkCommandBuffer commandBuffer, uint64_t frame) {
    const std::span<const uint32_t> words = list_.words();
    if (words.empty()) {
        return 0;
    }
    const VkDeviceSize from = frame % framesInFlight_ * listBytes();
    std::memcpy(staging_.mapped(kListStaging) + from, words.data(), words.size_bytes());
    const VkBufferCopy region{from, 0, words.size_bytes()};
    device_->vk.CmdCopyBuffer(commandBuffer, staging_.buffer(kListStaging), buffers_.buffer(kList), 1, &region);
    listFrame_ = frame;
    return words.size_bytes();
}

bool Playback::has(Part part) const {
    const bool posed = !listsPoses() || list_.poseCount() > 0;
    switch (part) {
    case Part::roots:
        return posed && (roots_ || plants_);
    case Part::modifiers:
        return posed && modifies_;
    case Part::springs:
        return hasSprings() && list_.swingingCount() > 0;
    case Part::mix:
        return takesUpdateRates() && list_.mixCount() > 0;
    default:
        return posed;
    }
}

skinning::PoseKernels::Locals Playback::locals() const {
    using Locals = skinning::PoseKernels::Locals;
    const double first = hasSprings() ? firstStep_ : time_;
    const bool inTransition = transitions_.meets(first, time_) && bounds_.anyInTransition(first, time_);
    return inTransition ? Locals::transition : adds_ ? Locals::add : Locals::blend;
}

uint64_t Playback::tasksMade() const {
    const uint32_t bits = 1u | (has(Part::roots) ? 2u : 0) | (has(Part::modifiers) ? 4u : 0) | (plants_ ? 8u : 0);
    return bits | static_cast<uint32_t>(locals()) << 4;
}

PosePush Playback::pushOf(Part part, uint32_t window, const InstanceWindows& windows) const {
    PosePush push = push_;
    const skinning::SplitTime time = skinning::splitTime(time_);
    push.timeHigh = time.high;
    push.timeLow = time.low;
    push.firstInstance = windows.firstEntry(window);
    push.instanceCount = windows.listed[window].count;
    push.footCount = plants_ ? asset_->clipTable->footCount : 0;
    if (listsPoses()) {
        const PoseList::Window& own = list_.window(window);
        const PoseList::Run& run = part == Part::mix ? own.mixes : own.poses;
        push.firstInstance = run.first;
        push.instanceCount = part == Part::palette ? own.shown : part == Part::springs ? own.swinging.count : run.count;
        push.times = run.values;
        push.shown = own.shown;
        push.springWords = own.swinging.first;
    }
    return push;
}

void Playback::record(gpu::Dispatches& dispatches, Part part, uint32_t window, const InstanceWindows& windows) const {
    const PosePush push = pushOf(part, window, windows);
    if (push.instanceCount == 0) {
        return;
    }
    switch (part) {
    case Part::locals:
        kernels_->recordLocals(dispatches, sets_[window], locals(), push);
        break;
    case Part::roots:
        kernels_->recordRoots(dispatches, sets_[window], push);
        break;
    case Part::modifiers:
        kernels_->recordModifiers(dispatches, sets_[window], push);
        break;
    case Part::springs:
        kernels_->recordSprings(dispatches, sets_[window], push);
        break;
    case Part::palette:
        kernels_->recordPalette(dispatches, sets_[window], mode_, push);
        break;
    case Part::mix:
        kernels_->recordMix(dispatches, sets_[window], mode_, push);
        break;
    }
}

void Playback::recordWarmUp(VkCommandBuffer commandBuffer) const {
    gpu::OwnDispatches own(*device_, commandBuffer);
    gpu::Dispatches& dispatches = *own;
    const gpu::BoundSet& set = sets_[0];
    const PosePush none{}; // of no instances
    for (size_t what = 0; what < skinning::PoseKernels::kLocals; ++what) {
        dispatches.computeBarrier();
        kernels_->recordLocals(dispatches, set, static_cast<skinning::PoseKernels::Locals>(what), none);
    }
    dispatches.computeBarrier();
    kernels_->recordRoots(dispatches, set, none);
    if (takesModifiers()) {
        dispatches.computeBarrier();
        kernels_->recordModifiers(dispatches, set, none);
    }
    if (hasSprings()) {
        dispatches.computeBarrier();
        kernels_->recordSprings(dispatches, set, none);
    }
    dispatches.computeBarrier();
    kernels_->recordPalette(dispatches, set, mode_, none);
    if (takesUpdateRates()) {
        dispatches.computeBarrier();
        kernels_->recordMix(dispatches, set, mode_, none);
    }
}

gpu::MemoryUse Playback::memoryUse() const {
    gpu::MemoryUse use = buffers_.use();
    use += staging_.use();
    if (hasSprings()) {
        use += springState_.memoryUse();
    }
    return use;
}

} // namespace supple::runtime
