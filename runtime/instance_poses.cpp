#include "runtime/instance_poses.h"

#include "runtime/pose_desc.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

namespace supple::runtime {

InstancePoses::InstancePoses(const Asset& asset, uint32_t instanceCount, skinning::SkinningMode mode,
                             uint32_t strideMultiple)
    : asset_(&asset) {
    const cage::Character& character = asset.character;
    const size_t jointCount = character.skin.joints.size();
    targetCount_ = character.morphs.targets.size();
    // Weights of targets that move nothing stay here.
    const bool morphs = asset.firstInfluences != 0;
    layout_ = skinning::PoseLayout::of(mode, static_cast<uint32_t>(jointCount),
                                       morphs ? static_cast<uint32_t>(targetCount_) : 0);
    layout_.stride = (layout_.stride + strideMultiple - 1) / strideMultiple * strideMultiple;
    palettes_.resize(instanceCount * jointCount);
    if (mode == skinning::SkinningMode::dualQuaternion) {
        rotations_.resize(palettes_.size());
    }
    poseWeights_.resize(instanceCount * targetCount_);
    hostWeights_.resize(instanceCount * targetCount_);
    hostWeighted_.resize(instanceCount, false);
    transforms_.assign(instanceCount, glm::mat4(1.0f));
    nodes_.resize(character.skeleton.nodes.size());
    for (skinning::Pose* pose : {&pose_, &scratch_.sample, &scratch_.reference}) {
        skinning::restPose(character, *pose);
    }
    for (uint32_t instance = 0; instance < instanceCount; ++instance) {
        setBindPose(instance);
    }
}

void InstancePoses::reset(uint32_t instance) {
    setBindPose(instance);
    setMorphWeights(instance, nullptr);
    setTransform(instance, glm::mat4(1.0f));
}

std::span<skinning::Affine> InstancePoses::palette(uint32_t instance) {
    return std::span(palettes_).subspan(size_t{instance} * layout_.jointCount, layout_.jointCount);
}

void InstancePoses::finishPalette(uint32_t instance) {
    if (!rotations_.empty()) {
        skinning::jointRotations(
            palette(instance),
            std::span(rotations_).subspan(size_t{instance} * layout_.jointCount, layout_.jointCount));
    }
}

void InstancePoses::setPose(uint32_t instance) {
    skinning::posePalette(asset_->character, pose_, nodes_, palette(instance));
    std::transform(pose_.morphWeights.begin(), pose_.morphWeights.end(),
                   poseWeights_.begin() + static_cast<ptrdiff_t>(instance * targetCount_),
                   [](double weight) { return static_cast<float>(weight); });
    finishPalette(instance);
}

void InstancePoses::setBindPose(uint32_t instance) {
    std::ranges::fill(palette(instance), skinning::toAffine(glm::mat4(1.0f)));
    std::fill_n(poseWeights_.begin() + static_cast<ptrdiff_t>(instance * targetCount_), targetCount_, 0.0f);
    finishPalette(instance);
}

void InstancePoses::setRestPose(uint32_t instance) {
    skinning::restPose(asset_->character, pose_);
    setPose(instance);
}

void InstancePoses::setClipPose(uint32_t instance, uint32_t clip, double time) {
    skinning::sampleClip(asset_->character, asset_->character.clips[clip], time, pose_);
    setPose(instance);
}

void InstancePoses::setLayers(uint32_t instance, const SupplePoseDesc& desc) {
    const skinning::RootSelection root = rootSelection(*asset_, desc);
    skinning::restPose(asset_->character, pose_);
    for (uint32_t i = 0; i < desc.layerCount; ++i) {
        skinning::applyLayer(asset_->character, asset_->rig, layerOf(*asset_, desc.layers[i]), root, scratch_, pose_);
    }
    setPose(instance);
}

void InstancePoses::setMatrixPose(uint32_t instance, const float* jointMatrices) {
    const cage::Character& character = asset_->character;
    const std::span<skinning::Affine> target = palette(instance);
    for (size_t j = 0; j < target.size(); ++j) {
        target[j] = skinning::toAffine(glm::make_mat4(jointMatrices + 16 * j) * character.skin.inverseBinds[j]);
    }
    std::copy(character.morphs.weights.begin(), character.morphs.weights.end(),
              poseWeights_.begin() + static_cast<ptrdiff_t>(instance * targetCount_));
    finishPalette(instance);
}

void InstancePoses::setMorphWeights(uint32_t instance, const float* weights) {
    hostWeighted_[instance] = weights != nullptr;
    if (weights != nullptr) {
        std::copy_n(weights, targetCount_, hostWeights_.begin() + static_cast<ptrdiff_t>(instance * targetCount_));
    }
}

void InstancePoses::write(uint32_t count, std::byte* target) const {
    const size_t joints = layout_.jointCount;
    for (uint32_t instance = 0; instance < count; ++instance) {
        const std::vector<float>& weights = hostWeighted_[instance] ? hostWeights_ : poseWeights_;
        skinning::InstancePose pose;
        pose.palette = std::span(palettes_).subspan(instance * joints, joints);
        if (!rotations_.empty()) {
            pose.rotations = std::span(rotations_).subspan(instance * joints, joints);
        }
        pose.morphWeights = std::span(weights).subspan(instance * targetCount_, targetCount_);
        pose.transform = transforms_[instance];
        skinning::writePose(layout_, pose, target);
        target += instanceBytes();
    }
}

} // namespace supple::runtime
