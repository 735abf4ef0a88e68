// The first stage: joint palettes and morph weights deform the rest cage (skinning/deform_kernels.h).
#pragma once

#include "runtime/stages/cage_stage.h"
#include "skinning/deform_kernels.h"

namespace supple::runtime {

/// What the stages have of the kernels.
struct DeformStageKernels final : CageKernels {
    skinning::DeformKernels kernels;
};
[[nodiscard]] Result<std::unique_ptr<CageKernels>> makeDeformKernels(const gpu::Device& device,
                                                                     gpu::Pipelines& pipelines);

[[nodiscard]] bool wantsDeform(const CageStageDesc& desc);
[[nodiscard]] Result<std::unique_ptr<CageStage>> makeDeform(const CageStageDesc& desc, CageKernels& kernels);
[[nodiscard]] Status makeDeformPipelines(const PlannedStages& planned, const CageKernels& kernels);

inline constexpr CageStageRow kDeformRow{
    SUPPLE_PASS_DEFORM,        false, wantsDeform, makeDeformKernels, makeDeform, makeDeformPipelines, true,
    CageStageRow::Tasks::stand};

} // namespace supple::runtime
