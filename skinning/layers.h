// Clip layers: crossfades, additive layers, joint masks. A pose is put together from the rest pose by layers in order.
#pragma once

#include "cage/character.h"
#include "skinning/pose.h"
#include "skinning/root_motion.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::skinning {

/// What layers look up in a character, found once.
struct Rig {
    std::vector<uint32_t> maskJoints;   ///< one a node: the joint whose mask value counts for it, or kNone: always 1
    std::vector<uint32_t> jointParents; ///< one a joint: the nearest joint above it, or kNone
    /// One a joint: the first joint of its bone. A bone may be cut into several joints, one below the other, whose
    /// names differ in digits alone: "lowerleg01.L" and "lowerleg02.L".
    std::vector<uint32_t> boneStarts;
    uint32_t root = cage::kNone; ///< findRoot
};
[[nodiscard]] Rig makeRig(const cage::Character& character);

enum class LayerMode {
    blend,   ///< the pose moves towards the clip's by the weight
    additive ///< what the clip differs by from its own pose at referenceTime is added to the pose
};

struct Layer {
    const cage::Clip* clip = nullptr;
    double time = 0.0;
    double previousTime = 0.0;  ///< root motion is the movement from here to `time`
    double referenceTime = 0.0; ///< additive
    double weight = 1.0;        ///< blend: 0..1
    LayerMode mode = LayerMode::blend;
    bool loop = false;                ///< else times are clamped to the clip
    std::span<const float> jointMask; ///< one a joint, 0..1: multiplies the weight; empty: all 1
    std::span<const float> morphMask; ///< one a target; empty: all 1, but all 0 where there is a joint mask
};

/// Memory of applyLayer, kept by the caller so that posing allocates nothing.
struct LayerScratch {
    Pose sample, reference;
};

/// Memory for putting a pose of one character together.
struct PoseMemory {
    Pose pose;
    LayerScratch scratch;
    std::vector<glm::mat4> nodes; ///< one a node

    PoseMemory() = default;
    explicit PoseMemory(const cage::Character& character);
};

/// The weight with which a layer changes a node.
[[nodiscard]] double layerWeight(const Rig& rig, const Layer& layer, uint32_t node);

/// Applies one layer to `pose`, with the root motion of `root` taken out of the layer's clip. Weight 0 leaves bits as
/// they are, and weight 1 of a blend gives the clip's. Blended: translations, scales and morph weights linearly,
/// rotations along the shorter arc. Added: acc.translation + w (sample - reference); acc.rotation * (reference^-1 *
/// sample)^w, that is, the difference turns the joint in its own frame; acc.scale * (1 + w (sample / reference - 1));
/// morph weights as translations.
void applyLayer(const cage::Character& character, const Rig& rig, const Layer& layer, const RootSelection& root,
                LayerScratch& scratch, Pose& pose);

/// Blends the layer's movement of `root` into `before`, that of the layers before it, as applyLayer blends poses.
[[nodiscard]] RootMotion layerRootMotion(const cage::Character& character, const Rig& rig, const Layer& layer,
                                         const RootSelection& root, const RootMotion& before);

/// Sets the mask of a joint and of all joints below it.
void fillJointMask(const Rig& rig, uint32_t joint, float value, std::span<float> mask);

} // namespace supple::skinning
