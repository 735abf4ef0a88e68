// Poses on the CPU: clip sampling, node hierarchy, joint palettes. This is the interface of the pose pass: a pose goes
// in, a joint palette comes out, per instance.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// A node's local transform: translation * rotation * scale. The rotation need not be of unit length; a zero one (a
/// spline may pass through it) counts as none.
struct Transform {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

[[nodiscard]] Transform restTransform(const cage::Node& node);

/// All that a clip can set. Filling a pose that was filled for the same character before allocates nothing.
struct Pose {
    std::vector<Transform> locals;    ///< one a node; nodes with a fixed matrix keep that, whatever stands here
    std::vector<double> morphWeights; ///< one a morph target
};

/// A 3x4 affine matrix by rows: the GPU's joint palette element. row r dotted with (p, 1) gives component r.
struct Affine {
    glm::vec4 rows[3];
};
[[nodiscard]] Affine toAffine(const glm::mat4& matrix);

/// The nodes' rest transforms and the file's morph weights.
void restPose(const cage::Character& character, Pose& pose);

/// The pose at `time` seconds of `clip`. Sampling follows glTF 2.0: STEP, LINEAR (slerp for rotations, shortest path),
/// CUBICSPLINE (rotations of unit length once they are a matrix), clamped outside the keys; what the clip does not
/// animate is as in the rest pose.
void sampleClip(const cage::Character& character, const cage::Clip& clip, double time, Pose& pose);

/// What a clip gives to a crease set at a time: the first or the last key's value outside of the keys.
[[nodiscard]] double sampleSharpness(const cage::SharpnessCurve& curve, double time);
/// The local transform of one node alone.
[[nodiscard]] Transform sampleNode(const cage::Skeleton& skeleton, const cage::Clip& clip, double time, uint32_t node);

[[nodiscard]] glm::dmat4 localMatrix(const cage::Node& node, const Transform& transform);
void localMatrices(const cage::Skeleton& skeleton, const Pose& pose, std::span<glm::mat4> locals);

/// The same without a pose to keep, for one skeleton pose at a time: these allocate. One matrix a node.
void sampleClip(const cage::Skeleton& skeleton, const cage::Clip& clip, double time, std::span<glm::mat4> locals);
void restPose(const cage::Skeleton& skeleton, std::span<glm::mat4> locals);

/// Local to global (model space), parents before children. In place is allowed (locals.data() == globals.data()).
void globalTransforms(const cage::Skeleton& skeleton, std::span<const glm::mat4> locals, std::span<glm::mat4> globals);

/// palette[j] = transform * global(joints[j]) * inverseBinds[j].
void jointPalette(const cage::Skin& skin, std::span<const glm::mat4> globals, const glm::mat4& transform,
                  std::span<Affine> palette);

/// The palette of a pose in model space; `nodes` is memory for its node transforms.
void posePalette(const cage::Character& character, const Pose& pose, std::span<glm::mat4> nodes,
                 std::span<Affine> palette);

/// The rotation of every joint's matrix (skinning/rotation.h) as x, y, z, w: what dual quaternion skinning blends.
void jointRotations(std::span<const Affine> palette, std::span<glm::vec4> rotations);

/// Morph targets and linear blend skinning on the CPU in double precision: the reference the GPU's deform pass is
/// tested against. morphed[v] = position_v + sum_t weights[t] * displacement_t[v]; deformed[v] = sum_i weight_i *
/// palette[joint_i] * (position_v, 1).
[[nodiscard]] std::vector<glm::dvec3> morphOnCpu(const cage::Cage& cage, const cage::Morphs& morphs,
                                                 std::span<const float> weights);
[[nodiscard]] std::vector<glm::dvec3> deformOnCpu(std::span<const glm::dvec3> positions,
                                                  const cage::SkinWeights& weights, std::span<const Affine> palette);
[[nodiscard]] std::vector<glm::dvec3> deformOnCpu(const cage::Cage& cage, const cage::SkinWeights& weights,
                                                  std::span<const Affine> palette);
/// Both, of a pose.
[[nodiscard]] std::vector<glm::dvec3> deformOnCpu(const cage::Character& character, const Pose& pose);

} // namespace supple::skinning
