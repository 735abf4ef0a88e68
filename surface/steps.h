// How the steps of a program are made. Private to surface/.
#pragma once

#include "gpu/pipelines.h"
#include "surface/evaluation.h"
#include "surface/program.h"
#include "surface/program_options.h"
#include "surface/scheme.h"
#include "surface/shaders.h"

#include <initializer_list>
#include <string>

namespace supple::surface {

/// Builds one program: what it is made for, its steps, and the pipelines for them.
class ProgramBuilder {
public:
    using Layouts = std::array<gpu::ComputeLayout, kSetKinds>;
    ProgramBuilder(const gpu::Device& own, const Layouts& layouts, gpu::Pipelines& pipelines, const Shaders& shaders,
                   const Tables& ofTables, const ProgramOptions& ofOptions, const Evaluation& ofEvaluation)
        : device(own), tables(ofTables), options(ofOptions), evaluation(ofEvaluation), layouts_(layouts),
          pipelines_(pipelines), shaders_(shaders) {}

    const gpu::Device& device;
    const Tables& tables;
    const ProgramOptions& options;
    const Evaluation& evaluation;
    Program program;

    [[nodiscard]] gpu::Kernel kernel(SetKind sets, Kernel which, std::initializer_list<gpu::Constant> constants,
                                     const std::string& name);
    /// Makes the pipelines of all kernels. Without that the program is void.
    [[nodiscard]] Status makePipelines() { return pipelines_.make(); }

    /// Adds a step unless it has no elements.
    template <class Push>
    void add(Steps& steps, SetKind sets, const gpu::Kernel& kernel, DispatchSize size, const Push& push,
             uint32_t argument = 0, Order order = Order::free) {
        if (size.elements > 0) {
            steps.push_back({kernel, sets, order, size, argument, {}, 0});
            steps.back().setPush(push);
        }
    }
    /// One lane per element.
    [[nodiscard]] DispatchSize lanes(uint32_t elements) const { return {elements, device.mapping.localSize}; }

    /// The passes that write surface vertices: evaluate, and motion, if they are needed.
    struct VertexPass {
        uint32_t format = shared::kVertex16;
        Steps* steps = nullptr;
    };
    [[nodiscard]] std::vector<VertexPass> vertexPasses();

private:
    const Layouts& layouts_;
    gpu::Pipelines::Batch pipelines_;
    const Shaders& shaders_;
};

/// The push constants of a step on the records of a section, with what all that work on a range say.
template <class Push>
[[nodiscard]] Push pushFor(const Section& section) {
    Push push{};
    push.table = section.table;
    push.count = section.count;
    return push;
}
/// Attributes that are asked for and that the tables have, beside the first UV set and the color.
[[nodiscard]] uint32_t outputsOf(const ProgramBuilder& builder);
/// Whether kernels that write vertices of a format write tangents too (shared::kTangentsConstant).
[[nodiscard]] uint32_t tangentsConstant(const ProgramBuilder& builder, uint32_t format);

// Each adds what the tables and needs call for.
void addConstructions(ProgramBuilder& builder);
void addRanges(ProgramBuilder& builder); ///< patch, evaluate and attributes, at a rate
void addRangesAtLevels(ProgramBuilder& builder);

} // namespace supple::surface
