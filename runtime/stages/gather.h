// The last stage: the deformed vertices of the parts that a surface is made of, if a group has several surfaces.
#pragma once

#include "runtime/stages/deform.h"

namespace supple::runtime {

[[nodiscard]] bool wantsGather(const CageStageDesc& desc);
[[nodiscard]] Result<std::unique_ptr<CageStage>> makeGather(const CageStageDesc& desc, CageKernels& kernels);
[[nodiscard]] Status makeGatherPipelines(const PlannedStages& planned, const CageKernels& kernels);

inline constexpr CageStageRow kGatherRow{
    SUPPLE_PASS_DEFORM,        true, wantsGather, makeDeformKernels, makeGather, makeGatherPipelines, true,
    CageStageRow::Tasks::stand};

} // namespace supple::runtime
