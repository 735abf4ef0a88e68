// The deform pass: morph targets, then skinning of the control cage in compute, with any number of targets and of
// influences a vertex, by any way of skinning.
#pragma once

#include "cage/character.h"
#include "gpu/dispatches.h"
#include "gpu/pipelines.h"
#include "shaders/shared/deform.h"
#include "skinning/deform_table.h"
#include "skinning/pose.h"
#include "skinning/skinning_mode.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::skinning {

/// Where things lie in an instance's pose, in vec4 elements (shaders/shared/deform.h).
struct PoseLayout {
    SkinningMode mode = SkinningMode::linear;
    uint32_t jointCount = 0;
    uint32_t morphCount = 0; ///< weights that the device needs
    uint32_t morphWeights = 0;
    uint32_t stride = 0; ///< from one instance to the next
    [[nodiscard]] bool hasRotations() const { return skinningRow(mode).rotations; }
    [[nodiscard]] uint32_t elements() const { return morphWeights + (morphCount + 3) / 4; } ///< of a pose
    [[nodiscard]] static PoseLayout of(SkinningMode mode, uint32_t jointCount, uint32_t morphCount);
};

/// One instance's pose before it is placed.
struct InstancePose {
    std::span<const Affine> palette;
    std::span<const glm::vec4> rotations; ///< jointRotations(palette), where the layout has some
    std::span<const float> morphWeights;
    glm::mat4 transform{1.0f};
};
/// Writes layout.stride elements. Linear blending takes the transform into the matrices; where rotations are blended
/// the pass applies it to the blended vertex, for a blend followed by uneven scale is no blend of scaled joints.
void writePose(const PoseLayout& layout, const InstancePose& pose, std::byte* target);

/// The pipelines of the pass, each made when it is first needed. Output: float4 (x, y, z, 1) a cage vertex,
/// `cageStride` vertices an instance.
class DeformKernels {
public:
    /// Both must outlive the pass.
    [[nodiscard]] static Result<DeformKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines);

    // Pipelines are made if they are not there: on any thread, also beside recording.
    /// That of a mode, with or without morph targets.
    [[nodiscard]] Result<gpu::Kernel> make(SkinningMode mode, bool morphs) const;
    /// That of recordGather().
    [[nodiscard]] Result<gpu::Kernel> makeGather() const;

    // The same for what is to be recorded.
    [[nodiscard]] Status prepare(SkinningMode mode, bool morphs);
    [[nodiscard]] Status prepareGather();

    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    /// Records one dispatch over a window of instances; `set` binds the window's buffers. `push.firstInfluences` as the
    /// table has it, and `push.firstCenter`. What it needs must have been prepared.
    void record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SkinningMode mode,
                const shared::DeformPush& push) const;
    /// Copies the vertices of a piece out of the whole deformed cage (shaders/deform/gather.comp).
    void recordGather(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::DeformPush& push) const;

private:
    void record(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set,
                const shared::DeformPush& push) const;

    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::Kernel kernels_[kSkinningModes][2]; ///< by mode, and whether there are morph targets
    gpu::Kernel gather_;
};

} // namespace supple::skinning
