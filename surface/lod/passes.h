// The passes that choose the levels of a view's patches: levels of edges and patches, the budget, places.
#pragma once

#include "gpu/pipeline.h"
#include "shaders/shared/lod.h"
#include "surface/evaluation.h"

#include <array>
#include <cstdint>
#include <span>

namespace supple::surface::lod {

/// Recorded in this order with a barrier (compute to compute) between each two; solve once a view, the others once a
/// window of instances. The solver writes indirect arguments too.
class Passes {
public:
    struct Shaders {
        gpu::Spirv edge, patch, facingPatch, chartPatch, solve, place;
    };
    Passes() = default;
    Passes(const gpu::Device& device, const Shaders& shaders);

    /// `backFaces`: patches that show their backs are left out; recorded as prepared.
    [[nodiscard]] Status prepare(const gpu::ComputeLayout& layout, const LodTables& tables, bool backFaces);

    /// `window`: its instances go into the push; where their number is known to the device alone, `arguments` tells
    /// the groups of edges and, three words on, of patches (Window::arguments behind those of the constructions).
    void recordEdges(VkCommandBuffer commandBuffer, const LodTables& tables, const Window& window,
                     VkDeviceSize arguments, shared::LodPush push) const;
    void recordPatches(VkCommandBuffer commandBuffer, const LodTables& tables, const Window& window,
                       VkDeviceSize arguments, const shared::LodPush& push, bool backFaces) const;
    void recordSolve(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::LodSolvePush& push) const;
    void recordPlaces(VkCommandBuffer commandBuffer, const Window& window, VkDeviceSize arguments,
                      const shared::LodPush& push) const;

private:
    enum Kernel : size_t { kEdge, kPatch, kFacingPatch, kChartEdge, kChartPatch, kSolve, kPlace, kKernels };
    [[nodiscard]] static Kernel patchKernel(const LodTables& tables, bool backFaces);
    void bind(VkCommandBuffer commandBuffer, Kernel kernel, VkDescriptorSet set, const void* push,
              uint32_t bytes) const;
    void dispatch(VkCommandBuffer commandBuffer, Kernel kernel, const Window& window, VkDeviceSize arguments,
                  shared::LodPush push) const;

    const gpu::Device* device_ = nullptr;
    Shaders shaders_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    std::array<gpu::PipelineHandle, kKernels> pipelines_;
};

} // namespace supple::surface::lod
