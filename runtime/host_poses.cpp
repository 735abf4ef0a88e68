#include "runtime/host_poses.h"

#include "runtime/pose_desc.h"
#include "skinning/rotation.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

namespace supple::runtime {

skinning::PoseLayout poseLayoutOf(const Asset& asset, skinning::SkinningMode mode, uint32_t strideMultiple) {
    const cage::Character& character = asset.character;
    // Weights of targets that move nothing stay on the CPU.
    const size_t morphs = asset.hasMorphs() ? character.morphs.targets.size() : 0;
    skinning::PoseLayout layout = skinning::PoseLayout::of(mode, static_cast<uint32_t>(character.skin.joints.size()),
                                                           static_cast<uint32_t>(morphs));
    layout.stride = (layout.elements() + strideMultiple - 1) / strideMultiple * strideMultiple;
    return layout;
}

HostPoses::HostPoses(const Asset& asset, uint32_t instanceCount, const skinning::PoseLayout& layout,
                     const StateRoom& room)
    : asset_(&asset), layout_(layout), skinned_(asset.skinning(layout.mode)) {
    const cage::Character& character = asset.character;
    targetCount_ = character.morphs.targets.size();
    palettes_.resize(size_t{instanceCount} * layout.jointCount);
    joints_.resize(palettes_.size());
    if (layout.hasRotations()) {
        rotations_.resize(palettes_.size());
    }
    poseWeights_.resize(instanceCount * targetCount_);
    hostWeights_.resize(instanceCount * targetCount_);
    hostWeighted_.resize(instanceCount, false);
    versions_.assign(instanceCount, 0);
    transforms_.assign(instanceCount, glm::mat4(1.0f));
    positions_.assign(instanceCount, glm::dvec3(0.0));
    memory_ = skinning::PoseMemory(character);
    if (asset.drivers != nullptr) {
        drivers_ = HostDrivers(character, asset.drivers, instanceCount);
    }
    if (room.modifiers || room.springs) {
        const skinning::ClipTable& table = *asset.clipTable;
        modifiers_ = InstanceModifiers(room.modifiers ? instanceCount : 0, 0);
        stateElements_ =
            shared::modifiersBegin(0) + (room.modifiers ? shared::kMaxModifiers * shared::kModifierElements : 0);
        states_.resize(size_t{instanceCount} * 4 * stateElements_);
        locals_.resize(instanceCount * table.nodes.size());
        held_.resize(room.modifiers ? size_t{instanceCount} * table.footCount : 0);
        hasLocals_.resize(instanceCount, 0);
        twin_ = skinning::PoseTwin(table, skinning::PoseLayout::of(layout.mode, layout.jointCount, 0), 0);
    }
    if (room.hasSteps()) {
        steps_ = HostSteps(instanceCount, room.cloths);
    }
    if (room.soft) {
        soft_ = HostSoft(layout, instanceCount, room);
    }
    if (room.springs) {
        springs_ = HostSprings(asset, instanceCount);
        swungPalette_.resize(layout.jointCount);
        swungRotations_.resize(layout.hasRotations() ? layout.jointCount : 0);
    }
    for (uint32_t instance = 0; instance < instanceCount; ++instance) {
        setBindPose(instance);
    }
}

void HostPoses::reset(uint32_t instance) {
    setBindPose(instance);
    setMorphWeights(instance, nullptr);
    if (takesModifiers()) {
        state(instance).setModifierCount(0);
    }
    setTransform(instance, glm::mat4(1.0f));
    steps_.settle(instance);
}

std::span<skinning::Affine> HostPoses::palette(uint32_t instance) {
    return std::span(palettes_).subspan(size_t{instance} * layout_.jointCount, layout_.jointCount);
}

void HostPoses::releaseHeld(uint32_t instance) {
    const std::span<glm::vec4> feet = held(instance);
    std::fill(feet.begin(), feet.end(), glm::vec4(0.0f));
}

std::span<glm::vec4> HostPoses::held(uint32_t instance) {
    const size_t feet = takesModifiers() ? asset_->clipTable->footCount : 0;
    return std::span(held_).subspan(instance * feet, feet);
}

std::span<glm::mat4> HostPoses::joints(uint32_t instance) {
    return std::span(joints_).subspan(size_t{instance} * layout_.jointCount, layout_.jointCount);
}

glm::mat4 HostPoses::jointTransform(uint32_t instance, uint32_t joint) const {
    return skinning::placedJoint(glm::dmat4(placement(instance)),
                                 joints_[size_t{instance} * layout_.jointCount + joint]);
}

void HostPoses::finishPalette(uint32_t instance) {
    ++versions_[instance];
    drive(instance);
    if (!rotations_.empty()) {
        skinning::jointRotations(
            palette(instance),
            std::span(rotations_).subspan(size_t{instance} * layout_.jointCount, layout_.jointCount));
    }
}

void HostPoses::setPose(uint32_t instance) {
    const skinning::Pose& pose = memory_.pose;
    setWeights(instance, nullptr);
    steps_.setPosed(instance);
    if (keepsLocals()) {
        keepLocals(instance);
        modify(instance);
        return;
    }
    drivers_.setLocals(instance, pose);
    skinning::posePalette(asset_->character, pose, memory_.nodes, palette(instance));
    skinning::jointTransforms(asset_->character.skin, memory_.nodes, joints(instance));
    finishPalette(instance);
}

void HostPoses::setWeights(uint32_t instance, const float* weights) {
    for (size_t t = 0; t < targetCount_; ++t) {
        poseWeights_[instance * targetCount_ + t] =
            weights != nullptr ? weights[t] : static_cast<float>(memory_.pose.morphWeights[t]);
    }
}

void HostPoses::keepLocals(uint32_t instance) {
    const std::vector<uint32_t>& nodes = asset_->clipTable->nodes;
    for (size_t place = 0; place < nodes.size(); ++place) {
        const skinning::Transform& from = memory_.pose.locals[nodes[place]];
        locals_[instance * nodes.size() + place] = {glm::vec3(from.translation), skinning::floatsOf(from.rotation),
                                                    glm::vec3(from.scale)};
    }
    hasLocals_[instance] = 1;
}

void HostPoses::modify(uint32_t instance) {
    if (!keepsLocals() || hasLocals_[instance] == 0) {
        return;
    }
    const size_t nodes = asset_->clipTable->nodes.size();
    skinning::PlaybackState own = state(instance);
    own.setTransform(placement(instance));
    if (takesModifiers()) {
        modifiers_.place(instance, own, origin_);
    }
    twin_.poseLocals(stateWords(instance), std::span(locals_).subspan(instance * nodes, nodes), held(instance));
    drivers_.setLocals(instance, *asset_->clipTable, twin_.locals());
    springs_.setPose(instance, twin_.locals());
    const std::span<skinning::Affine> target = palette(instance);
    const std::span<glm::mat4> placed = joints(instance);
    for (uint32_t j = 0; j < target.size(); ++j) {
        const shared::Affine skinned = twin_.skinned(j);
        target[j] = {{skinned.x, skinned.y, skinned.z}};
        placed[j] = twin_.joint(j);
    }
    finishPalette(instance);
}

void HostPoses::setModifiers(uint32_t instance, std::span<const PlacedModifier> modifiers) {
    modifiers_.set(instance, state(instance), *asset_->clipTable, modifiers, origin_);
    modify(instance);
}

void HostPoses::setModifierGoal(uint32_t instance, uint32_t index, const ModifierGoal& goal) {
    modifiers_.setGoal(instance, state(instance), index, goal, origin_);
    modify(instance);
}

void HostPoses::setOrigin(const glm::dvec3& origin) {
    if (origin_ == origin) {
        return;
    }
    originVersion_ += uint64_t{1} << 40; // all versions are others than any before
    origin_ = origin;
    for (uint32_t instance = 0; instance < hasLocals_.size(); ++instance) {
        modifyInWorld(instance);
    }
}

void HostPoses::setBindPose(uint32_t instance) {
    const std::span<skinning::Affine> own = palette(instance);
    std::fill(own.begin(), own.end(), skinning::toAffine(glm::mat4(1.0f)));
    std::copy(asset_->jointFrames.bind.begin(), asset_->jointFrames.bind.end(), joints(instance).begin());
    std::fill_n(poseWeights_.begin() + static_cast<ptrdiff_t>(instance * targetCount_), targetCount_, 0.0f);
    drivers_.setBindPose(instance);
    forgetLocals(instance);
    steps_.setBindPose(instance);
    finishPalette(instance);
}

void HostPoses::setRestPose(uint32_t instance) {
    skinning::restPose(asset_->character, memory_.pose);
    releaseHeld(instance);
    setPose(instance);
}

void HostPoses::setClipPose(uint32_t instance, uint32_t clip, double time) {
    skinning::sampleClip(asset_->character, asset_->character.clips[clip], time, memory_.pose);
    releaseHeld(instance);
    skinning::Layer layer;
    layer.clip = &asset_->character.clips[clip];
    layer.time = time;
    twin_.hold(asset_->character, asset_->rig, layer, {}, held(instance));
    setPose(instance);
}

void HostPoses::setLayers(uint32_t instance, const SupplePoseDesc& desc) {
    const skinning::RootSelection root = rootSelection(*asset_, desc);
    skinning::restPose(asset_->character, memory_.pose);
    releaseHeld(instance);
    for (uint32_t i = 0; i < desc.layerCount; ++i) {
        const skinning::Layer layer = layerOf(*asset_, desc.layers[i]);
        skinning::applyLayer(asset_->character, asset_->rig, layer, root, memory_.scratch, memory_.pose);
        twin_.hold(asset_->character, asset_->rig, layer, root, held(instance));
    }
    setPose(instance);
}

void HostPoses::setMatrixPose(uint32_t instance, const float* jointMatrices) {
    SuppleJointMatricesDesc desc{};
    desc.jointMatrices = jointMatrices;
    desc.jointCount = layout_.jointCount;
    setJointMatrices(instance, desc);
}

void HostPoses::setJointMatrices(uint32_t instance, const SuppleJointMatricesDesc& desc) {
    const std::span<skinning::Affine> target = palette(instance);
    const std::span<glm::mat4> own = joints(instance);
    for (uint32_t k = 0; k < desc.jointCount; ++k) {
        const uint32_t j = desc.joints != nullptr ? desc.joints[k] : k;
        own[j] = glm::make_mat4(desc.jointMatrices + 16 * size_t{k});
        target[j] = skinning::toAffine(own[j] * asset_->character.skin.inverseBinds[j]);
    }
    if (desc.morphWeights != nullptr || desc.joints == nullptr) {
        setWeights(instance,
                   desc.morphWeights != nullptr ? desc.morphWeights : asset_->character.morphs.weights.data());
    }
    drivers_.setJoints(instance, own);
    forgetLocals(instance);
    springs_.setJoints(instance, own);
    steps_.setPosed(instance);
    finishPalette(instance);
}

void HostPoses::setMorphWeights(uint32_t instance, const float* weights) {
    ++versions_[instance];
    hostWeighted_[instance] = weights != nullptr;
    if (weights != nullptr) {
        std::copy_n(weights, targetCount_, hostWeights_.begin() + static_cast<ptrdiff_t>(instance * targetCount_));
    }
    drive(instance);
}

void HostPoses::takeOverJoints(const HostPoses& other, uint32_t instance, const AssetMatch& match) {
    const skinning::Affine identity = skinning::toAffine(glm::mat4(1.0f));
    const std::span before =
        std::span(other.palettes_).subspan(size_t{instance} * other.layout_.jointCount, other.layout_.jointCount);
    const auto isIdentity = [&](const skinning::Affine& joint) {
        return std::equal(std::begin(joint.rows), std::end(joint.rows), std::begin(identity.rows));
    };
    if (std::all_of(before.begin(), before.end(), isIdentity)) {
        return; // in the bind pose, as here
    }
    const std::span<glm::mat4> own = joints(instance);
    const std::span<skinning::Affine> target = palette(instance);
    for (size_t j = 0; j < own.size(); ++j) {
        const uint32_t from = match.joints[j];
        own[j] = from != cage::kNone ? other.joints_[size_t{instance} * other.layout_.jointCount + from]
                                     : asset_->jointFrames.rest[j];
        target[j] = skinning::toAffine(own[j] * asset_->character.skin.inverseBinds[j]);
    }
    drivers_.setJoints(instance, own);
    springs_.setJoints(instance, own);
    steps_.setPosed(instance);
    finishPalette(instance);
}

/// Locals by node; nodes that the other version lacks are as in the rest pose. Modifiers whose nodes are there.
void HostPoses::takeOverModified(HostPoses& other, uint32_t instance, const AssetMatch& match) {
    if (!keepsLocals() || !other.keepsLocals()) {
        return;
    }
    const skinning::ClipTable &table = *asset_->clipTable, &before = *other.asset_->clipTable;
    const auto placeHere = [&](uint32_t place) {
        const uint32_t node = match.nodes[before.nodes[place]];
        return node != cage::kNone ? table.places[node] : cage::kNone;
    };
    const bool modified = takesModifiers() && other.takesModifiers();
    if (modified) {
        modifiers_.takeOver(instance, state(instance), table, other.modifiers_, other.state(instance), placeHere);
    }
    if (other.hasLocals_[instance] == 0) {
        return;
    }
    skinning::restPose(asset_->character, memory_.pose);
    keepLocals(instance);
    for (size_t place = 0; place < before.nodes.size(); ++place) {
        const uint32_t node = match.nodes[before.nodes[place]];
        if (node != cage::kNone && table.places[node] != cage::kNone) {
            locals_[instance * table.nodes.size() + table.places[node]] =
                other.locals_[instance * before.nodes.size() + place];
        }
    }
    for (uint32_t foot = 0; modified && foot < before.footCount; ++foot) {
        const uint32_t here = placeHere(before.footPlace(foot));
        if (here != cage::kNone && table.isFoot(table.nodes[here])) {
            held(instance)[table.footNumber(here)] = other.held(instance)[foot];
        }
    }
    modify(instance);
}

void HostPoses::takeOver(HostPoses& other, uint32_t count, const AssetMatch& match) {
    origin_ = other.origin_;
    steps_.takeWind(other.steps_);
    for (uint32_t i = 0; i < count; ++i) {
        ++versions_[i];
        transforms_[i] = other.transforms_[i];
        positions_[i] = other.positions_[i];
        hostWeighted_[i] = other.hostWeighted_[i];
        for (size_t t = 0; t < targetCount_; ++t) {
            const auto from = match.same ? static_cast<uint32_t>(t) : match.targets[t];
            const bool known = from != cage::kNone;
            const float rest = asset_->character.morphs.weights[t];
            poseWeights_[i * targetCount_ + t] = known ? other.poseWeights_[i * other.targetCount_ + from] : rest;
            hostWeights_[i * targetCount_ + t] = known ? other.hostWeights_[i * other.targetCount_ + from] : rest;
        }
        if (!match.same) {
            takeOverJoints(other, i, match);
            takeOverModified(other, i, match);
        }
    }
    if (match.same) {
        const size_t joints = size_t{count} * layout_.jointCount;
        std::copy_n(other.palettes_.begin(), joints, palettes_.begin());
        std::copy_n(other.joints_.begin(), joints, joints_.begin());
        std::copy_n(other.rotations_.begin(), std::min(joints, other.rotations_.size()), rotations_.begin());
        drivers_.takeOver(other.drivers_, count);
        if (keepsLocals()) {
            if (takesModifiers()) {
                modifiers_.takeOver(other.modifiers_, count);
            }
            std::copy_n(other.states_.begin(), size_t{count} * 4 * stateElements_, states_.begin());
            std::copy_n(other.locals_.begin(), count * asset_->clipTable->nodes.size(), locals_.begin());
            std::copy_n(other.held_.begin(), std::min(count * size_t{asset_->clipTable->footCount}, held_.size()),
                        held_.begin());
            std::copy_n(other.hasLocals_.begin(), count, hasLocals_.begin());
            springs_.takeOver(other.springs_, count);
        }
        steps_.takeOver(other.steps_, count);
        soft_.takeOver(other.soft_, count);
    }
    for (uint32_t i = 0; i < count; ++i) {
        drive(i);
    }
}

std::optional<skinning::Box> HostPoses::boundsOf(uint32_t instance, const skinning::Reach& reach) const {
    if (hasSprings()) {
        return std::nullopt;
    }
    const std::span own = std::span(palettes_).subspan(size_t{instance} * layout_.jointCount, layout_.jointCount);
    return skinning::movedBy(glm::dmat4(placement(instance)), skinned_.posed(reach, own, weightsOf(instance)));
}

void HostPoses::step(uint32_t instance, skinning::InstancePose& pose) {
    const StepPlace place{glm::dmat3(glm::mat3(transforms_[instance])), positions_[instance]};
    const HostSteps::Due due = steps_.take(instance, place);
    springs_.begin(instance);
    soft_.begin(instance, due, pose.transform);
    for (uint32_t k = 0; k < due.steps.count; ++k) {
        springs_.step(instance, due, k, pose.transform);
        soft_.step(instance, due.ways[k], pose, springs_);
    }
    soft_.end(instance, pose);
    if (!hasSprings()) {
        return;
    }
    std::copy(pose.palette.begin(), pose.palette.end(), swungPalette_.begin());
    std::copy(pose.rotations.begin(), pose.rotations.end(), swungRotations_.begin());
    springs_.show(instance, due.steps.part, swungPalette_, swungRotations_);
    pose.palette = swungPalette_;
    pose.rotations = swungRotations_;
}

void HostPoses::write(const Frame& frame, const InstanceSlots& slots, std::byte* target) {
    const size_t joints = layout_.jointCount;
    const uint32_t count = slots.end();
    steps_.setTime(frame.number, frame.time);
    soft_.beginFrame(frame.number);
    for (uint32_t instance = 0; instance < count; ++instance) {
        skinning::InstancePose pose;
        pose.palette = std::span(palettes_).subspan(instance * joints, joints);
        if (!rotations_.empty()) {
            pose.rotations = std::span(rotations_).subspan(instance * joints, joints);
        }
        pose.morphWeights = weightsOf(instance);
        pose.transform = placement(instance);
        if (!frame.leavesOut && slots.shows(instance) && steps_.runs(instance)) {
            step(instance, pose);
        }
        skinning::writePose(layout_, pose, target);
        target += instanceBytes();
    }
    soft_.endFrame();
    steps_.endFrame();
}

void HostPoses::cancelFrame(uint64_t frame) {
    for (const uint32_t instance : steps_.cancelFrame(frame)) {
        springs_.restore(instance);
        soft_.restore(instance);
    }
}

} // namespace supple::runtime
