// The stage between deform and the surfaces in which vertices jiggle (docs/soft.md), in groups that play.
#pragma once

#include "runtime/stages/cage_stage.h"

namespace supple::runtime {

[[nodiscard]] Result<std::unique_ptr<CageKernels>> makeJiggleKernels(const gpu::Device& device,
                                                                     gpu::Pipelines& pipelines);

[[nodiscard]] bool wantsJiggle(const CageStageDesc& desc);
[[nodiscard]] Result<std::unique_ptr<CageStage>> makeJiggle(const CageStageDesc& desc, CageKernels& kernels);
[[nodiscard]] Status makeJigglePipelines(const PlannedStages& planned, const CageKernels& kernels);

inline constexpr CageStageRow kJiggleRow{SUPPLE_PASS_DEFORM, false,      wantsJiggle,
                                         makeJiggleKernels,  makeJiggle, makeJigglePipelines};

} // namespace supple::runtime
