// Poses on the CPU: clip sampling, node hierarchy, joint palettes. This is the interface of the pose pass: a pose goes
// in, a joint palette comes out, per instance.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// A 3x4 affine matrix by rows: the GPU's joint palette element. row r dotted with (p, 1) gives component r.
struct Affine {
    glm::vec4 rows[3];
};
[[nodiscard]] Affine toAffine(const glm::mat4& matrix);

/// Local transform of every node at `time` seconds of `clip`. Sampling follows glTF 2.0: STEP, LINEAR (slerp for
/// rotations, shortest path), CUBICSPLINE (normalised rotations), clamped outside the keys; nodes without a channel
/// keep their rest transform. `locals` has one entry per node.
void sampleClip(const cage::Skeleton& skeleton, const cage::Clip& clip, double time, std::span<glm::mat4> locals);

/// Rest transforms of every node.
void restPose(const cage::Skeleton& skeleton, std::span<glm::mat4> locals);

/// Local to global (model space), parents before children. In place is allowed (locals.data() == globals.data()).
void globalTransforms(const cage::Skeleton& skeleton, std::span<const glm::mat4> locals, std::span<glm::mat4> globals);

/// palette[j] = transform * global(joints[j]) * inverseBinds[j].
void jointPalette(const cage::Skin& skin, std::span<const glm::mat4> globals, const glm::mat4& transform,
                  std::span<Affine> palette);

/// Linear blend skinning on the CPU in double precision: the reference the GPU's deform pass is tested against.
/// deformed[v] = sum_i weight_i * palette[joint_i] * (position_v, 1).
[[nodiscard]] std::vector<glm::dvec3> deformOnCpu(const cage::Cage& cage, const cage::SkinWeights& weights,
                                                  std::span<const Affine> palette);

} // namespace supple::skinning
