#include "runtime/playback.h"

#include "gpu/tasks.h"
#include "runtime/pose_spans.h"
#include "skinning/joints.h"
#include "skinning/played_pose.h"
#include "skinning/split_time.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace supple::runtime {

namespace {

using namespace supple::shared;

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

/// The longest side of the box that holds the cage at rest.
float extentOf(const cage::Cage& cage) {
    skinning::Box box = skinning::emptyBox();
    for (const glm::vec3& p : cage.positions) {
        skinning::extend(box, p);
    }
    const glm::vec3 size(box.high - box.low);
    return std::max({size.x, size.y, size.z});
}

/// A node's place in the table of another version of the asset, or kNone.
uint32_t placeInOther(uint32_t node, const AssetMatch& match, const skinning::ClipTable& table) {
    const uint32_t moved = match.nodes[node];
    return moved != cage::kNone ? table.places[moved] : cage::kNone;
}

} // namespace

Status Playback::create(const Desc& desc) {
    const skinning::ClipTable& table = *desc.asset->clipTable;
    device_ = desc.device;
    pipelines_ = desc.pipelines;
    asset_ = desc.asset;
    capacity_ = desc.capacity;
    windowSize_ = desc.windowSize;
    posesInFrame_ = posesInFrame(desc.room);
    unshownPoses_ = unshownPoses(desc.room);
    push_ = posePushOf(*desc.asset, desc.layout, desc.room);

    modifiers_ = InstanceModifiers(desc.room.modifiers ? desc.capacity : 0, push_.morphCount);
    states_ = PlayedStates(
        {push_, desc.room, transitionElements(table, desc.layout, desc.room), desc.capacity, desc.framesInFlight});
    masks_ = PlayedMasks(*desc.asset, desc.room.hasSteps());
    twin_ = skinning::PoseTwin(table, desc.layout, push_.transition);
    transforms_.resize(desc.capacity, glm::mat4(1.0f));
    positions_.resize(desc.capacity, glm::dvec3(0.0));
    bounds_ = PlayedBounds(desc.asset->character, skinning::SkinnedBounds(desc.asset->skinning(desc.layout.mode)),
                           desc.room.modifiers, desc.capacity);
    list_ = PoseList(desc.capacity, windowCount(), desc.room, kStepsInRound);
    if (desc.room.updateRates) {
        laterTwin_ = twin_;
        rates_ = UpdateRates(desc.capacity);
    }
    if (desc.room.hasSteps()) {
        clock_ = StepClock(desc.capacity, desc.room.cloths);
    }
    if (desc.room.springs) {
        bounds_.setSwinging(table.swinging);
    }
    if (desc.room.transitions) {
        for (auto* const poses : {&startsFrom_.shown, &startsFrom_.played}) {
            for (skinning::SampledPose& pose : *poses) {
                pose.assign(twin_.locals(), twin_.weights());
            }
        }
    }
    Status status = createBuffers(desc);
    return status ? createSets(desc) : status;
}

Status Playback::createBuffers(const Desc& desc) {
    constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    gpu::BufferPlan device(buffers_), staging(staging_);
    states_.plan(device, staging);
    masks_.plan(device, staging, desc.framesInFlight);
    list_.plan(device, staging, desc.framesInFlight);
    scratch_ = device.add({"supple node matrices", capacity_ * scratchBytes(), kUsage, gpu::MemoryPurpose::scratch});
    ends_ = device.add({"supple ends", capacity_ * endBytes(), kUsage, gpu::MemoryPurpose::poses});
    Status status = device.create(*device_, gpu::MemoryKind::deviceLocal);
    if (status) {
        status = staging.create(*device_, gpu::MemoryKind::upload);
    }
    if (status && hasSprings()) {
        status = springState_.create(*device_, capacity_, springBytes(), "supple springs");
    }
    return status;
}

Status Playback::createSets(const Desc& desc) {
    const gpu::Device& device = *desc.device;
    Status status = sets_.create(device, pipelines_.layout(), windowCount(), "supple pose");
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size, const char* name) {
        return views_.make(device, buffer, format, offset, size, name, status);
    };
    const VkBuffer table = asset_->clips.buffer(0), masks = masks_.buffer();
    const VkDeviceSize tableBytes = asset_->clips.size(0), maskBytes = masks_.bytes();
    const VkBufferView tableView = view(table, gpu::kUint4, 0, tableBytes, "supple clips");
    const VkBufferView maskView = view(masks, gpu::kFloat4, 0, maskBytes, "supple masks");
    const VkBuffer list = listsPoses() ? list_.buffer() : desc.instances;
    const VkDeviceSize listed = listsPoses() ? list_.bytes() : desc.instanceBytes;
    const VkBufferView listView = view(list, VK_FORMAT_R32_UINT, 0, listed, "supple instances");
    const VkDeviceSize poseBytes = push_.poseStride * gpu::kVec4Bytes;
    // Without such poses nobody touches what is bound as ends.
    const VkBuffer ends = unshownPoses_ > 0 ? ends_.buffer() : desc.poses;
    const VkDeviceSize bytesOfEnds = unshownPoses_ > 0 ? endBytes() : poseBytes;
    for (uint32_t w = 0; w < windowCount() && status; ++w) {
        const VkDeviceSize first = VkDeviceSize{w} * windowSize_;
        const VkDeviceSize count = std::min<VkDeviceSize>(windowSize_, capacity_ - first);
        const auto range = [&](VkBuffer buffer, VkDeviceSize bytes) {
            return VkDescriptorBufferInfo{buffer, first * bytes, count * bytes};
        };
        const VkBuffer states = states_.buffer(), scratch = scratch_.buffer();
        const gpu::BoundResource resources[] = {
            {kClipTableBinding, {table, 0, tableBytes}, VK_NULL_HANDLE},
            {kClipTableTexelBinding, {}, tableView},
            {kStateBinding, range(states, states_.bytes()), VK_NULL_HANDLE},
            {kStateTexelBinding,
             {},
             view(states, gpu::kUint4, first * states_.bytes(), count * states_.bytes(), "supple playback")},
            {kMaskBinding, {masks, 0, maskBytes}, VK_NULL_HANDLE},
            {kMaskTexelBinding, {}, maskView},
            {kScratchPoseBinding, range(scratch, scratchBytes()), VK_NULL_HANDLE},
            {kScratchPoseTexelBinding,
             {},
             view(scratch, gpu::kFloat4, first * scratchBytes(), count * scratchBytes(), "supple node matrices")},
            {kPosedBinding, range(desc.poses, poseBytes), VK_NULL_HANDLE},
            {kEndsBinding, range(ends, bytesOfEnds), VK_NULL_HANDLE},
            {kEndsTexelBinding, {}, view(ends, gpu::kFloat4, first * bytesOfEnds, count * bytesOfEnds, "supple ends")},
            {kSpringBinding,
             hasSprings() ? range(springState_.buffer(), springBytes()) : range(scratch, scratchBytes()),
             VK_NULL_HANDLE},
            {kInstanceBinding, {list, 0, listed}, VK_NULL_HANDLE},
            {kInstanceTexelBinding, {}, listView},
        };
        if (status) {
            sets_.write(device, pipelines_.layout(), w, resources);
        }
    }
    return status;
}

void Playback::forget(uint32_t slot) {
    if (evaluated_ == slot) {
        evaluated_ = kNoSlot;
    }
}

template <class Holds>
void Playback::forgetEndsOf(Holds&& holds) {
    skinning::PlaybackState::Layers memory;
    for (uint32_t slot = 0; takesUpdateRates() && slot < capacity_; ++slot) {
        const skinning::PlaybackState own = states_.state(slot);
        const skinning::PlaybackDesc desc =
            own.inBindPose() ? skinning::PlaybackDesc{} : own.read(*asset_->clipTable, memory);
        if (std::any_of(desc.layers.begin(), desc.layers.end(), holds)) {
            rates_.forget(slot);
        }
    }
}

void Playback::takeSegments() {
    const ClipStream* const stream = asset_->stream.get();
    if (stream == nullptr || segmentVersion_ == stream->version()) {
        return;
    }
    forgetEndsOf([&](const auto& layer) { return stream->versionOf(layer.clip) > segmentVersion_; });
    segmentVersion_ = stream->version();
    evaluated_ = kNoSlot;
}

void Playback::takeStep() {
    takeSegments();
    steps_.take(time_);
}

void Playback::evaluate(uint32_t slot) {
    takeSegments();
    if (evaluated_ == slot) {
        return;
    }
    evaluated_ = slot;
    evaluatedSpan_ = spanOf(slot);
    if (evaluatedSpan_.isExact()) {
        twin_.pose(states_.words(slot), masks_.values(), time_);
    } else {
        twin_.pose(states_.words(slot), masks_.values(), evaluatedSpan_.begin, skinning::PoseTwin::Stands::unplaced);
        laterTwin_.pose(states_.words(slot), masks_.values(), evaluatedSpan_.end, skinning::PoseTwin::Stands::unplaced);
    }
}

glm::mat4 Playback::jointTransform(uint32_t slot, uint32_t joint) {
    const skinning::PlaybackState own = states_.state(slot);
    if (own.inBindPose()) {
        return skinning::placedJoint(glm::dmat4(own.transform()), asset_->jointFrames.bind[joint]);
    }
    evaluate(slot);
    return evaluatedSpan_.isExact()
               ? twin_.placedJoint(joint)
               : twin_.placedJointBetween(laterTwin_, evaluatedSpan_.partAt(time_), states_.words(slot), joint);
}

void Playback::writePose(uint32_t slot, std::span<glm::vec4> pose) {
    evaluate(slot);
    if (evaluatedSpan_.isExact()) {
        twin_.write(pose);
    } else {
        twin_.writeBetween(laterTwin_, evaluatedSpan_.partAt(time_), states_.words(slot), pose);
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
    skinning::PlaybackState own = states_.state(slot);
    own.setMorphWeights(nullptr, 0);
    own.setModifierCount(0);
    own.setBindPose();
    bounds_.setBindPose(slot);
    rates_.reset(slot);
    clock_.settle(slot);
    detail_.forget(slot);
    if (takesModifiers()) {
        bounds_.setTurned(slot, {}, false, 0.0);
    }
    setTransform(slot, glm::mat4(1.0f));
}

void Playback::sample(uint32_t slot, double time, bool modified, skinning::SampledPose& pose) {
    if (modified) {
        twin_.pose(states_.words(slot), masks_.values(), time);
    } else {
        twin_.sample(states_.words(slot), masks_.values(), time);
    }
    pose.assign(twin_.locals(), twin_.weights());
    evaluated_ = kNoSlot;
}

void Playback::sampleShown(uint32_t slot, const TransitionRequest& request) {
    constexpr auto kStep = static_cast<double>(kTransitionStep);
    // Before a transition began, something else was shown.
    const bool justBegun =
        states_.state(slot).isInTransition() && skinning::transitionStart(states_.transition(slot)) > time_ - kStep;
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
    skinning::writeTransition({request.kind, time_, request.seconds}, startsFrom_, states_.transition(slot));
    states_.state(slot).setInTransition(true);
    states_.markTransition(slot);
    const double end = time_ + static_cast<double>(request.seconds);
    bounds_.setTransition(slot, {time_, end});
    transitions_.start = std::min(transitions_.start, time_);
    transitions_.end = std::max(transitions_.end, end);
}

void Playback::set(uint32_t slot, const skinning::PlaybackDesc& desc, const TransitionRequest& request,
                   uint32_t updateInterval) {
    forget(slot);
    skinning::PlaybackState own = states_.state(slot);
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
    if (rates_.areTaken()) { // else the asset does not know the errors of its clips
        rates_.set(slot, updateCourseOf(*asset_, desc, updateInterval));
    }
    roots_ = roots_ || desc.root.axes != 0;
    for (const skinning::PlaybackLayer& layer : desc.layers) {
        adds_ = adds_ || layer.mode == skinning::LayerMode::additive;
    }
    states_.markChanged(slot);
}

bool Playback::keepBefore(uint32_t slot) {
    const bool keeps = clock_.change(slot, time_);
    if (keeps) {
        states_.keepBefore(slot);
    }
    return keeps;
}

bool Playback::travels(uint32_t slot) {
    const auto asks = [](std::span<const uint32_t> words) { return (words[1] & kStateTravels) != 0; };
    return asks(states_.words(slot)) || (clock_.hasBefore(slot) && asks(states_.before(slot)));
}

glm::mat4 Playback::placement(uint32_t slot) const {
    glm::mat4 placed = transforms_[slot];
    placed[3] = glm::vec4(glm::vec3(positions_[slot] - origin_), 1.0f);
    return placed;
}

void Playback::place(uint32_t slot) {
    forget(slot);
    states_.state(slot).setTransform(placement(slot));
    modifiers_.place(slot, states_.state(slot), origin_);
    states_.markChanged(slot);
}

void Playback::setModifiers(uint32_t slot, std::span<const PlacedModifier> modifiers) {
    forget(slot);
    keepBefore(slot);
    modifiers_.set(slot, states_.state(slot), *asset_->clipTable, modifiers, origin_);
    modifies_ = modifies_ || !modifiers.empty();
    takeModifiers(slot);
    rates_.forget(slot);
    states_.markChanged(slot);
}

void Playback::setModifierGoal(uint32_t slot, uint32_t index, const ModifierGoal& goal) {
    forget(slot);
    keepBefore(slot);
    modifiers_.setGoal(slot, states_.state(slot), index, goal, origin_);
    states_.markChanged(slot);
}

void Playback::takeModifiers(uint32_t slot) {
    skinning::PlaybackState own = states_.state(slot);
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
    const float* const weights = states_.state(slot).morphWeights();
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
    keepBefore(slot);
    clock_.place(slot, time_);
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
    skinning::PlaybackState own = states_.state(slot);
    const float* const before = own.morphWeights();
    const bool areSame = weights == nullptr || before == nullptr
                             ? weights == before
                             : std::memcmp(weights, before, push_.morphCount * sizeof(float)) == 0;
    if (areSame) {
        return;
    }
    forget(slot);
    // Ends that were posed meanwhile have the host's. With drivers, they have what these add to the weights of then.
    if (hasDrivers() || weights == nullptr) {
        rates_.forget(slot);
    }
    if (hasSoft()) { // joints do not know of weights
        keepBefore(slot);
    }
    own.setMorphWeights(weights, push_.morphCount);
    states_.markChanged(slot);
}

void Playback::setMask(uint32_t mask, std::span<const float> joints, std::span<const float> morphs) {
    for (uint32_t slot = 0; hasSteps() && slot < capacity_; ++slot) {
        if (keepBefore(slot)) {
            states_.markChanged(slot);
        }
    }
    masks_.set(mask, joints, morphs);
    evaluated_ = kNoSlot;
    forgetEndsOf([mask](const auto& layer) { return layer.mask == mask; });
}

void Playback::takeOverState(Playback& other, uint32_t slot, const AssetMatch& match) {
    const skinning::PlaybackState before = other.states_.state(slot);
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
        modifiers_.takeOver(slot, states_.state(slot), *asset_->clipTable, other.modifiers_, before,
                            [&](uint32_t place) {
                                return placeInOther(other.asset_->clipTable->nodes[place], match, *asset_->clipTable);
                            });
        modifies_ = modifies_ || states_.state(slot).modifierCount() > 0;
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
    set(slot, desc, {}, other.rates_.asked(slot));
}

void Playback::takeOver(Playback& other, uint32_t count, const AssetMatch& match) {
    time_ = other.time_;
    origin_ = other.origin_;
    clock_.takeWind(other.clock_);
    masks_.takeOver(other.masks_, match);
    if (match.same) {
        adds_ = other.adds_;
        roots_ = other.roots_;
        modifies_ = other.modifies_;
        plants_ = other.plants_;
        transitions_ = other.transitions_;
        modifiers_.takeOver(other.modifiers_, count);
        states_.takeOver(other.states_, count);
        bounds_.takeOver(other.bounds_, count);
        rates_.takeOver(other.rates_, count);
        steps_ = other.steps_;
        clock_.takeOver(other.clock_, count);
        detail_.takeOver(other.detail_, count);
        springState_.takeOver(other.springState_, count);
    }
    for (uint32_t slot = 0; slot < count; ++slot) {
        if (!match.same) {
            reset(slot);
            takeOverState(other, slot, match);
        }
        transforms_[slot] = other.transforms_[slot];
        positions_[slot] = other.positions_[slot];
        place(slot);
    }
}

VkDeviceSize Playback::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame) {
    VkDeviceSize bytes = springState_.recordUpload(commandBuffer, frame, {});
    bytes += states_.recordUpload(*device_, commandBuffer, frame);
    bytes += masks_.recordUpload(*device_, commandBuffer, frame);
    return bytes;
}

void Playback::cancelFrame(uint64_t frame) {
    springState_.cancelFrame(frame);
    clock_.cancelFrame(frame);
    states_.cancelFrame(frame);
    masks_.cancelFrame(frame);
    if (list_.recordedIn(frame)) {
        rates_.forgetAll();
    }
}

void Playback::setSize(uint32_t slot, float pixelsPerUnit) {
    const uint32_t before = rates_.interval(slot);
    const float scale = largestScale(glm::mat3(transforms_[slot]));
    rates_.choose(slot, pixelsPerUnit * scale * static_cast<float>(asset_->updates.extent), steps_.leastInterval());
    if (rates_.interval(slot) != before) {
        forget(slot);
    }
}

void Playback::takeStepSizes() {
    extent_ = extentOf(asset_->character.cage);
    detail_ = StepDetail(capacity_);
}

void Playback::setStepSize(uint32_t slot, float pixelsPerUnit) {
    const float scale = largestScale(glm::mat3(transforms_[slot]));
    detail_.setSize(slot, pixelsPerUnit * scale * extent_, time_);
}

PoseSpan Playback::spanOf(uint32_t slot) {
    const uint32_t interval = rates_.interval(slot);
    if (interval <= 1 || states_.state(slot).modifierCount() > 0) {
        return exactSpan(time_);
    }
    const PoseSpan span = gridSpan(time_, slot, interval);
    if (rates_.holds(slot, span)) { // then it was found to be one
        return span;
    }
    const bool broken =
        bounds_.transition(slot).meets(span.begin, span.end) || hasCorner(*asset_, states_.state(slot), span);
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
    if (states_.state(slot).inBindPose()) {
        clock_.settle(slot);
        return;
    }
    PoseList::StepRecord record{detail_.shown(slot), {}};
    if (record.shown.springs == 0.0f) {
        return;
    }
    const StepPlace place{glm::dmat3(glm::mat3(transforms_[slot])), positions_[slot]};
    const bool runsSoft = record.shown.soft > 0.0f;
    const StepClock::Due due = clock_.take(slot, frame, time_, place, travels(slot), runsSoft);
    for (uint32_t k = 0; k < due.count; ++k) {
        const std::span<const uint32_t> played = due.before[k] ? states_.before(slot) : states_.words(slot);
        const bool travels = (played[1] & kStateTravels) != 0;
        record.posed[k] = (due.before[k] ? kPosedBefore : 0) | (travels ? kPosedTravels : 0);
        firstStep_ = std::min(firstStep_, timeOfStep(due.first + k));
    }
    list_.addSteps(slotInWindow, due, record);
}

bool Playback::has(Part part) const {
    // Parts of which a frame has nothing keep their place, as others have something.
    const bool always = device_->mapping.sharesDispatches;
    const bool posed = !listsPoses() || list_.poseCount() > 0 || always;
    switch (part) {
    case Part::roots:
        return posed && (roots_ || plants_);
    case Part::modifiers:
        return posed && modifies_;
    case Part::drivers:
        return posed && hasDrivers();
    case Part::springs:
        return hasSprings() && (list_.steppingCount() > 0 || always);
    case Part::mix:
        return takesUpdateRates() && (list_.mixCount() > 0 || always);
    default:
        return posed;
    }
}

bool Playback::hasEarly(Part part) const {
    switch (part) {
    case Part::springs:
        return hasSprings();
    case Part::palette:
        return hasSoft();
    case Part::drivers:
        return hasSoft() && hasDrivers();
    case Part::mix:
        return false;
    default:
        return has(part);
    }
}

skinning::PosePipelines::Locals Playback::locals() const {
    using Locals = skinning::PosePipelines::Locals;
    const double first = std::min(firstStep_, time_);
    const bool inTransition = transitions_.meets(first, time_) && bounds_.anyInTransition(first, time_);
    return inTransition ? Locals::transition : adds_ ? Locals::add : Locals::blend;
}

uint64_t Playback::tasksMade() const {
    const uint32_t bits = 1u | (has(Part::roots) ? 2u : 0) | (has(Part::modifiers) ? 4u : 0) | (plants_ ? 8u : 0);
    return bits | static_cast<uint32_t>(locals()) << 4;
}

PosePush Playback::pushOf(Part part, uint32_t window, const InstanceWindows& windows, uint32_t round) const {
    PosePush push = push_;
    const skinning::SplitTime time = skinning::splitTime(time_);
    push.timeHigh = time.high;
    push.timeLow = time.low;
    push.firstInstance = windows.firstEntry(window);
    push.instanceCount = windows.listed[window].count;
    push.footCount = plants_ ? asset_->clipTable->footCount : 0;
    if (listsPoses()) {
        const PoseList::Round& own = list_.window(window).rounds[round];
        const PoseList::Run& run = part == Part::mix ? list_.window(window).mixes : own.poses;
        push.firstInstance = run.first;
        const bool shownAlone = (part == Part::palette || part == Part::drivers) && !hasSoft();
        push.instanceCount = shownAlone ? own.shown : part == Part::springs ? own.stepping.count : run.count;
        push.times = run.values;
        push.shown = own.shown;
        push.stepWords = own.stepping.first;
    }
    return push;
}

void Playback::record(gpu::Dispatches& dispatches, Part part, uint32_t window, const InstanceWindows& windows,
                      uint32_t round) const {
    const PosePush push = pushOf(part, window, windows, round);
    if (push.instanceCount == 0 && !dispatches.takesEmpty()) {
        return;
    }
    switch (part) {
    case Part::locals:
        recordLocals(dispatches, sets_[window], push);
        break;
    case Part::roots:
        pipelines_.recordRoots(dispatches, sets_[window], push);
        break;
    case Part::modifiers:
        pipelines_.recordModifiers(dispatches, sets_[window], push);
        break;
    case Part::drivers:
        pipelines_.recordDrivers(dispatches, sets_[window], asset_->clipTable->drivenQuads, push);
        break;
    case Part::springs:
        pipelines_.recordSprings(dispatches, sets_[window], push);
        break;
    case Part::palette:
        pipelines_.recordPalette(dispatches, sets_[window], push);
        break;
    case Part::mix:
        pipelines_.recordMix(dispatches, sets_[window], push);
        break;
    }
}

void Playback::recordLocals(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push) const {
    using Locals = skinning::PosePipelines::Locals;
    const Locals now = locals();
    if (!dispatches.takesEmpty() || !takesTransitions()) {
        pipelines_.recordLocals(dispatches, set, now, push);
        return;
    }
    // Transitions begin and end: the kernel that waits keeps its place.
    PosePush none = push;
    none.instanceCount = 0;
    const bool inTransition = now == Locals::transition;
    pipelines_.recordLocals(dispatches, set, adds_ ? Locals::add : Locals::blend, inTransition ? none : push);
    pipelines_.recordLocals(dispatches, set, Locals::transition, inTransition ? push : none);
}

void Playback::recordWarmUp(VkCommandBuffer commandBuffer) const {
    gpu::OwnDispatches own(*device_, commandBuffer);
    gpu::Dispatches& dispatches = *own;
    const gpu::BoundSet& set = sets_[0];
    const PosePush none{}; // of no instances
    for (size_t what = 0; what < skinning::PosePipelines::kLocals; ++what) {
        dispatches.computeBarrier();
        pipelines_.recordLocals(dispatches, set, static_cast<skinning::PosePipelines::Locals>(what), none);
    }
    dispatches.computeBarrier();
    pipelines_.recordRoots(dispatches, set, none);
    if (takesModifiers()) {
        dispatches.computeBarrier();
        pipelines_.recordModifiers(dispatches, set, none);
    }
    if (hasDrivers()) {
        dispatches.computeBarrier();
        pipelines_.recordDrivers(dispatches, set, asset_->clipTable->drivenQuads, none);
    }
    if (hasSprings()) {
        dispatches.computeBarrier();
        pipelines_.recordSprings(dispatches, set, none);
    }
    dispatches.computeBarrier();
    pipelines_.recordPalette(dispatches, set, none);
    if (takesUpdateRates()) {
        dispatches.computeBarrier();
        pipelines_.recordMix(dispatches, set, none);
    }
}

StepPoses Playback::stepPoses() const {
    return {ends_.buffer(),     scratch_.buffer(),   list_.buffer(),
            endBytes(),         scratchBytes(),      list_.bytes(),
            push_.endStride,    push_.scratchStride, kAffineElements * push_.nodeCount,
            push_.springScratch};
}

gpu::MemoryUse Playback::memoryUse() const {
    gpu::MemoryUse use = buffers_.use();
    use += staging_.use();
    use += springState_.memoryUse();
    return use;
}

} // namespace supple::runtime
