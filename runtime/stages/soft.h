// The stages between deform and the surfaces that move what is soft: vertices that jiggle (docs/soft.md), and cloths
// (docs/cloth.md).
#pragma once

#include "runtime/stages/cage_stage.h"

namespace supple::runtime {

[[nodiscard]] Result<std::unique_ptr<CageKernels>> makeJiggleKernels(const gpu::Device& device,
                                                                     gpu::Pipelines& pipelines);
[[nodiscard]] bool wantsJiggle(const CageStageDesc& desc);
[[nodiscard]] Result<std::unique_ptr<CageStage>> makeJiggle(const CageStageDesc& desc, CageKernels& kernels);
[[nodiscard]] Status makeJigglePipelines(const PlannedStages& planned, const CageKernels& kernels);

[[nodiscard]] Result<std::unique_ptr<CageKernels>> makeClothKernels(const gpu::Device& device,
                                                                    gpu::Pipelines& pipelines);
[[nodiscard]] bool wantsCloth(const CageStageDesc& desc);
[[nodiscard]] Result<std::unique_ptr<CageStage>> makeCloth(const CageStageDesc& desc, CageKernels& kernels);
[[nodiscard]] Status makeClothPipelines(const PlannedStages& planned, const CageKernels& kernels);

inline constexpr CageStageRow kJiggleRow{.pass = SUPPLE_PASS_DEFORM,
                                         .wants = wantsJiggle,
                                         .makeKernels = makeJiggleKernels,
                                         .make = makeJiggle,
                                         .makePipelines = makeJigglePipelines,
                                         .tasks = CageStageRow::Tasks::written};
inline constexpr CageStageRow kClothRow{.pass = SUPPLE_PASS_DEFORM,
                                        .wants = wantsCloth,
                                        .makeKernels = makeClothKernels,
                                        .make = makeCloth,
                                        .makePipelines = makeClothPipelines,
                                        .tasks = CageStageRow::Tasks::written};

} // namespace supple::runtime
