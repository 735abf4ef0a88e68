// The GPU passes of all surface schemes: construction (vertex, assemble), patch, attributes, levels, evaluate, motion.
// prepare() makes the program of a group from its tables.
#pragma once

#include "gpu/pipelines.h"
#include "surface/evaluation.h"
#include "surface/program.h"
#include "surface/program_options.h"
#include "surface/scheme.h"
#include "surface/shaders.h"

#include <array>
#include <cstdint>

namespace supple::surface {

/// The layouts of the passes, and all that programs are made of.
class Programs {
public:
    /// `device`, `pipelines` and the SPIR-V must outlive the passes.
    [[nodiscard]] static Result<Programs> create(const gpu::Device& device, gpu::Pipelines& pipelines,
                                                 const Shaders& shaders = Shaders::embedded());

    /// Makes the program of these tables, and every pipeline that it options. Without lod, `evaluation` must be laid
    /// out for the tables. If a group calls again with another evaluation.rate, no pipeline is created.
    [[nodiscard]] Result<Program> prepare(const Tables& tables, const ProgramOptions& options,
                                          const Evaluation& evaluation);

    /// The kernels that solve a view's budget, one after the other, with shared::LodSolvePush and a set of
    /// solverLayout(). The second is dispatched as one workgroup a run, the others as one.
    struct Solver {
        gpu::Kernel solve, count, place;
    };
    [[nodiscard]] Result<Solver> prepareSolver();

    [[nodiscard]] const gpu::ComputeLayout& layout(SetKind sets) const { return layouts_[static_cast<size_t>(sets)]; }
    [[nodiscard]] const gpu::ComputeLayout& solverLayout() const { return solverLayout_; }

private:
    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    Shaders shaders_;
    std::array<gpu::ComputeLayout, kSetKinds> layouts_;
    gpu::ComputeLayout solverLayout_;
};

} // namespace supple::surface
