// Bounds of deformed cages, culling against a view, and the list of the instances that are left, with the arguments of
// what is dispatched and drawn for them (shaders/shared/bounds.h).
//
// A group needs: bounds (two vec4 a slot) and states (two words a slot), written by the passes alone, the states
// cleared to zero once; the host's list, the table and the view, uploaded; the list and the arguments, written by the
// list pass. Record the bounds of every window, a barrier (compute to compute), the list, and a barrier to what reads
// its list and arguments (compute, vertex shaders, indirect commands). Where instances may have to be left out, the
// sizes of all groups of the view come before the first list, with a barrier on either side; their buffer, kSizeRanks
// words cleared in every frame, is the view's.
#pragma once

#include "cage/character.h"
#include "gpu/pipeline.h"
#include "shaders/shared/bounds.h"
#include "surface/schemes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace supple::surface {

/// How far the surface may lie outside the box of its cage, as a part of the box's size: what a sample's negative
/// weights sum to at most, whatever the positions.
[[nodiscard]] float boundsMargin(SchemeId scheme, const cage::Cage& cage);

struct ListWindow {
    uint32_t firstEntry = 0; ///< in the host's list
    uint32_t entries = 0;
    uint32_t firstSlot = 0;
    uint32_t target = 0; ///< first entry in the list
};
/// Of a dispatch.
struct ListArgument {
    uint32_t elements = 0; ///< an instance: lanes, patches
    uint32_t perGroup = 0; ///< elements a workgroup takes
    uint32_t count = 0;    ///< shared::kCountWindow, or kCountRate and the rate
    uint32_t target = 0;   ///< word in the argument buffer; of window w argumentStride * w words further
};
/// Of the instances of all windows at a rate.
struct ListDraw {
    uint32_t indexCount = 0, firstIndex = 0;
    uint32_t patches = 0; ///< an instance
    uint32_t rate = 0;
};
/// The bytes that kListTableBinding takes, and writes them.
[[nodiscard]] size_t listTableBytes(size_t windows, size_t arguments, size_t draws);
void writeListTable(std::span<const ListWindow> windows, std::span<const ListArgument> arguments,
                    std::span<const ListDraw> draws, std::byte* target);

/// Planes of a matrix that takes points to clip space with depths 0..w (rows as in Vulkan); reversed and infinite depth
/// too.
[[nodiscard]] std::array<float, 24> frustumPlanes(const std::array<float, 16>& columns);

class BoundsPass {
public:
    [[nodiscard]] static Result<BoundsPass> create(const gpu::Device& device);
    /// Makes the passes of instances of several rates, which the first group that has some calls for.
    [[nodiscard]] Status prepareRates();

    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    /// `set` binds the window's cages. Nothing where push.instanceCount is 0.
    void recordBounds(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::BoundsPush& push) const;
    /// Any window's set. Nothing where push.instanceCount is 0.
    void recordSizes(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::SizePush& push) const;
    /// For empty groups too: the arguments are then those of no instances. Any window's set; push.maxGroups is filled
    /// in.
    void recordList(VkCommandBuffer commandBuffer, VkDescriptorSet set, shared::ListPush push) const;
    /// Behind the list: what instances of several rates need. Any window's set. Nothing where push.instanceCount is 0.
    void recordDemand(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::DemandPush& push) const;
    /// As recordList, behind it and the view's solution.
    void recordRates(VkCommandBuffer commandBuffer, VkDescriptorSet set, shared::RatesPush push) const;

private:
    struct Source {
        gpu::PipelineHandle* target;
        gpu::Spirv spirv;
        const char* name;
    };
    [[nodiscard]] Status make(std::span<const Source> sources);
    [[nodiscard]] uint32_t groupsFor(uint32_t lanes) const;
    void bind(VkCommandBuffer commandBuffer, const gpu::PipelineHandle& pipeline, VkDescriptorSet set, const void* push,
              uint32_t bytes) const;

    const gpu::Device* device_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::PipelineHandle bounds_, sizes_, list_, demand_, rates_;
};

} // namespace supple::surface
