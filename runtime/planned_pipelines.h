// The pipelines of groups that are to come, made before there are any.
#pragma once

#include "runtime/prepare.h"
#include "runtime/shared_kernels.h"
#include "runtime/stages/cage_stages.h"
#include "surface/programs.h"

namespace supple::runtime {

/// What makes pipelines in a context. Any threads may use these at the same time.
struct PipelineMakers {
    const gpu::Device* device = nullptr;
    gpu::Pipelines* pipelines = nullptr;
    SharedKernels* kernels = nullptr;
    surface::Programs* surface = nullptr;
    CageStageTable* stages = nullptr;
};

/// Makes every pipeline that creating the group, and its view, would make. Tables that were not prepared are built and
/// thrown away. Refuses what creating the group would refuse of the character. Any thread may call it, also beside
/// recording.
[[nodiscard]] Status makePipelines(const PipelineMakers& makers, const Prepared& prepared, const PlannedGroup& group);

} // namespace supple::runtime
