// The GPU passes of all surface schemes: construction (vertex, edge), patch, evaluate, and the attributes that no pose
// changes. Which kernels a group runs is data: its tables list them.
#pragma once

#include "gpu/pipeline.h"
#include "shaders/shared/surface.h"
#include "surface/evaluation.h"
#include "surface/kernel/passes.h"
#include "surface/lod/passes.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace supple::surface {

/// SPIR-V of the passes. The default is what was embedded at build time; tests put mutations in.
struct Shaders {
    gpu::Spirv prepVertex, prepEdge;
    gpu::Spirv pmVertex, pmFacet, pmPatch, pmEvaluate;
    gpu::Spirv isolate;
    gpu::Spirv blendChart, blendEvaluate;
    kernel::Passes::Shaders kernel;
    gpu::Spirv patch, bicubic, edge, attributes;
    lod::Passes::Shaders lod;
    struct AtLevels {
        gpu::Spirv pmEvaluate, blendEvaluate, regular, bicubic, attributes, ringAttributes;
    } levels;
    [[nodiscard]] static Shaders embedded();
};

/// What a group wants of its tables' passes.
struct Needs {
    uint32_t vertexFormat = shared::kVertex16;
    bool motion = false; ///< positions alone as well
    bool patches = false;
    bool attributes = false;
    uint32_t attributeOutputs = 0; ///< of attributes: as Evaluation::attributeOutputs
    bool backFaces = false;        ///< of a view: patches that show their backs are left out
    bool view = false;             ///< the passes that groups of a view share
    bool lod = false;              ///< records of a view instead of all patches at a rate
    uint32_t rate = 0;             ///< that it begins with
};

/// The pipelines, each created when tables first need it. Recording needs no memory and creates nothing. Between the
/// stages the caller puts a memory barrier (compute writes to compute reads): vertex | edge | patch, evaluate.
class Passes {
public:
    /// `shaders` must outlive the passes.
    [[nodiscard]] static Result<Passes> create(const gpu::Device& device, const Shaders& shaders = Shaders::embedded());

    /// Creates what is missing to record these tables.
    [[nodiscard]] Status prepare(const Tables& tables, const Needs& needs);

    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }

    /// Points an instance in the scratch buffer that the tables' evaluation needs; 0 for none.
    [[nodiscard]] uint32_t scratchStride(const Tables& tables) const { return kernel_.scratchStride(tables.fragments); }

    void recordStage(VkCommandBuffer commandBuffer, Stage stage, const Tables& tables, const Window& window,
                     const Evaluation& evaluation) const;
    void recordPatch(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                     const Evaluation& evaluation) const;
    /// `vertexFormat`: as prepared; shared::kVertexPosition writes where samples are and nothing else.
    void recordEvaluate(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                        const Evaluation& evaluation, uint32_t vertexFormat) const;
    void recordAttributes(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                          const Evaluation& evaluation) const;

    [[nodiscard]] const kernel::Passes& kernel() const { return kernel_; }
    /// Level of detail: what chooses and places the patches of a view.
    [[nodiscard]] const lod::Passes& lod() const { return lod_; }
    /// As recordEvaluate and recordAttributes, of the patches that a view has placed for this window.
    void recordLodEvaluate(VkCommandBuffer commandBuffer, const Tables& tables, const LodWindow& window,
                           const Evaluation& evaluation, uint32_t vertexFormat) const;
    void recordLodAttributes(VkCommandBuffer commandBuffer, const Tables& tables, const LodWindow& window,
                             const Evaluation& evaluation) const;

private:
    [[nodiscard]] Status make(gpu::PipelineHandle& target, const gpu::Spirv& spirv,
                              std::span<const gpu::Constant> constants, const std::string& name);
    [[nodiscard]] Status make(gpu::PipelineHandle& target, const gpu::Spirv& spirv,
                              std::initializer_list<gpu::Constant> constants, const std::string& name) {
        return make(target, spirv, std::span(constants.begin(), constants.size()), name);
    }
    [[nodiscard]] Status makeConstruction(Kernel kernel);
    [[nodiscard]] Status makeShared(const Tables& tables, const Needs& needs, std::span<const uint32_t> formats);
    void record(VkCommandBuffer commandBuffer, VkPipeline pipeline, VkDescriptorSet set,
                const shared::SurfacePush& push, uint64_t groups) const;
    [[nodiscard]] uint64_t groupsFor(uint64_t lanes) const;

    void recordIndirect(VkCommandBuffer commandBuffer, VkPipeline pipeline, VkDescriptorSet set,
                        const shared::SurfacePush& push, VkBuffer arguments, VkDeviceSize offset) const;
    void recordLod(VkCommandBuffer commandBuffer, VkPipeline pipeline, const LodWindow& window,
                   const shared::SurfacePush& push) const;

    static constexpr size_t kClasses = kPatchClassCount;
    /// Kernels of one kind, each for a rate that is a constant of it, and with 0 the one for any rate.
    struct AtRate {
        uint32_t rate = 0;
        gpu::PipelineHandle pipeline;
    };
    using ByRate = std::vector<AtRate>;
    using ByFormat = std::array<std::array<ByRate, 2>, shared::kVertexFormats>; ///< and corner normals
    /// Whether this rate is worth a kernel of its own. In the narrow mapping it unrolls all loops over a patch's
    /// samples, and what is compiled grows with it; in the wide one it makes divisions cheap, and loops of many rounds
    /// stay.
    [[nodiscard]] bool isWorthOwn(uint32_t rate) const { return device_->mapping.wide || rate <= kUnrolledRates; }
    [[nodiscard]] bool isWorthOwn(uint32_t rate, uint32_t patchClass) const {
        return isWorthOwn(rate) &&
               patchClass <= (device_->mapping.wide ? shared::kPolarPatch : shared::kPerturbedPatch);
    }
    [[nodiscard]] Status makeAtRate(ByRate& kernels, uint32_t rate, const gpu::Spirv& spirv,
                                    std::vector<gpu::Constant> constants, const std::string& name);
    static constexpr uint32_t kUnrolledRates = 8;
    const gpu::Device* device_ = nullptr;
    Shaders shaders_;
    gpu::ComputeLayout layout_;
    std::array<gpu::PipelineHandle, static_cast<size_t>(Kernel::count)> construction_;
    /// By which outputs there are beside the first (shared::kOutputUvs1, kOutputFaceUvs).
    using ByOutputs = std::array<gpu::PipelineHandle, shared::kAttributeOutputs>;
    std::array<ByOutputs, kDomainCount> attributes_; ///< by domain
    // By class and by corner normals, which only p-rep's classes have; evaluate_ also by vertex format.
    std::array<std::array<gpu::PipelineHandle, 2>, kClasses> patch_;
    std::array<ByFormat, kClasses> evaluate_;
    std::array<std::array<gpu::PipelineHandle, 2>, kClasses> lodEvaluate_[shared::kVertexFormats];
    std::array<ByOutputs, kClasses> lodAttributes_;
    // Shared samples: inside patches, as evaluate_ and attributes_, then those of edges.
    std::array<ByFormat, kClasses> inside_;
    std::array<ByFormat, shared::kEdgeKinds> edges_;
    std::array<ByOutputs, kDomainCount + 1> insideAttributes_; ///< the last one: along edges
    kernel::Passes kernel_;
    lod::Passes lod_;
};

} // namespace supple::surface
