// Which instances of a group its view sees: bounds of their deformed cages, the list of those that are left, and the
// arguments of what is dispatched for them (surface/bounds_pass.h).
#pragma once

#include "base/result.h"
#include "gpu/memory.h"
#include "runtime/instance_slots.h"
#include "supple/supple.h"
#include "surface/bounds_pass.h"
#include "surface/evaluation.h"
#include "surface/lod/instance.h"
#include "surface/occlusion_pass.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

/// Recording allocates nothing.
class Culling {
public:
    /// What is dispatched and drawn for the instances of one rate.
    struct Rate {
        uint32_t vertices = 0;                         ///< of an instance
        std::vector<surface::DispatchSize> dispatches; ///< of a window
        std::vector<SuppleDrawRange> draws;            ///< of all windows
    };
    struct Desc {
        const gpu::Device* device = nullptr;
        const surface::BoundsPass* pass = nullptr;
        const surface::OcclusionPass* occlusion = nullptr; ///< or null: nothing hides
        uint32_t framesInFlight = 2;
        uint32_t capacity = 0;
        uint32_t windowSize = 0, windows = 0;
        uint32_t cageVertices = 0, cageStride = 0;
        float margin = 0.0f; ///< surface::boundsMargin
        surface::lod::InstanceMeasure measure;
        uint32_t leastVertices = 0;         ///< of an instance at its coarsest
        VkBuffer cages = VK_NULL_HANDLE;    ///< read
        VkBuffer hostList = VK_NULL_HANDLE; ///< capacity entries, as shaders/shared/bounds.h has them
        VkBuffer view = VK_NULL_HANDLE;     ///< shared::CullView
        VkBuffer sizes = VK_NULL_HANDLE;    ///< of all groups of the view
        VkBuffer words = VK_NULL_HANDLE;    ///< of the view (shaders/shared/lod.h)
        std::span<const uint32_t> elements; ///< lanes an instance, of the dispatches that follow
        uint32_t firstRate = 0;             ///< segments along an edge of the cage; the others twice as many each
        std::span<const Rate> rates;        ///< none where levels are real numbers
    };
    Culling() = default;
    [[nodiscard]] static Result<Culling> create(const Desc& desc);
    [[nodiscard]] bool active() const { return pass_ != nullptr; }

    /// The table of the list pass, to be uploaded whenever the host's list changes.
    [[nodiscard]] VkDeviceSize tableBytes() const;
    void writeTable(std::span<const InstanceSlots::Listed> windows, std::byte* target);
    [[nodiscard]] VkBuffer table() const { return buffers_.buffer(kTable); }

    /// Once, before anything else.
    void recordClear(VkCommandBuffer commandBuffer) const;
    void recordBounds(VkCommandBuffer commandBuffer, std::span<const InstanceSlots::Listed> windows) const;
    /// Behind the bounds, before sizes and list. `place`: of the frame among those in flight, whose descriptor set no
    /// frame uses any more; `generation` tells whether it has this pyramid.
    void recordOcclusion(VkCommandBuffer commandBuffer, uint64_t place, const SuppleDepthPyramidDesc& pyramid,
                         uint64_t generation, uint32_t instanceCount);
    /// What `listed` instances of the host's list need at least; only where that may be more than there is.
    void recordSizes(VkCommandBuffer commandBuffer, uint32_t listed) const;
    /// `room`: vertices, or shared::kRoomForAll.
    void recordList(VkCommandBuffer commandBuffer, uint32_t room) const;
    /// Where there are rates, behind the list: what `listed` instances of the host's list need in the budget.
    void recordDemand(VkCommandBuffer commandBuffer, uint32_t listed) const;
    /// Behind that and the view's solution: the lists of all rates. `counted`: the budget scales levels.
    void recordRates(VkCommandBuffer commandBuffer, bool counted) const;
    [[nodiscard]] uint32_t leastVertices() const { return leastVertices_; }
    /// From an entry of the list to the level of its instance.
    [[nodiscard]] uint32_t levelOffset() const { return capacity_; }

    /// What passes after the list work on, in the place of a window of the host's list: `set` stays the caller's.
    [[nodiscard]] surface::Window window(uint32_t window, VkDescriptorSet set) const;
    /// The same for the instances of a rate, and what Rate::dispatches take for them.
    [[nodiscard]] surface::Window window(uint32_t window, VkDescriptorSet set, uint32_t rate) const;
    /// In list(): the first of all slots at a rate, and the draws of all rates.
    [[nodiscard]] VkDeviceSize rateListOffset(uint32_t rate) const;
    [[nodiscard]] VkDeviceSize drawOffset() const;
    [[nodiscard]] VkBuffer list() const { return buffers_.buffer(kList); }
    /// What the list pass has found out, of all windows: kListHeaderWords words (shaders/shared/bounds.h).
    [[nodiscard]] VkDeviceSize countOffset() const { return VkDeviceSize{firstArgument()} * sizeof(uint32_t); }
    [[nodiscard]] VkDeviceSize listBytes() const { return buffers_.size(kList); }
    [[nodiscard]] VkBuffer bounds() const { return buffers_.buffer(kBounds); }
    [[nodiscard]] VkDeviceSize boundsBytes() const { return buffers_.size(kBounds); }
    [[nodiscard]] VkDeviceSize deviceBytes() const { return buffers_.allocatedBytes(); }

private:
    /// kList: all that are seen, those of every window, their levels; the same without levels for every rate; then the
    /// arguments, the counts of rates and their draws.
    enum BufferIndex : size_t { kBounds, kStates, kList, kTable, kBufferCount };
    [[nodiscard]] Status createSets(const Desc& desc);
    [[nodiscard]] Status createOcclusionSets(const Desc& desc, VkBufferView hostList);
    [[nodiscard]] uint32_t argumentStride() const { return 3 * static_cast<uint32_t>(arguments_.size()); }
    [[nodiscard]] uint32_t rateCount() const { return static_cast<uint32_t>(firstDispatches_.size()); }
    /// Words of kList.
    [[nodiscard]] uint32_t firstArgument() const { return firstRateList() + rateCount() * rateStride(); }
    [[nodiscard]] uint32_t firstRateList() const;
    [[nodiscard]] uint32_t rateStride() const;
    // Words from firstArgument() on.
    [[nodiscard]] uint32_t firstRateCount() const { return headerWords() + argumentStride() * windows_; }
    [[nodiscard]] uint32_t firstDraw() const { return firstRateCount() + rateCount() * windows_; }
    [[nodiscard]] uint32_t headerWords() const { return shared::kListHeaderWords * (1 + windows_); }

    const gpu::Device* device_ = nullptr;
    const surface::BoundsPass* pass_ = nullptr;
    uint32_t capacity_ = 0, windowSize_ = 0, windows_ = 0;
    uint32_t leastVertices_ = 0;
    shared::BoundsPush push_{};
    std::vector<surface::ListWindow> listed_; ///< of the table written last
    std::vector<surface::ListArgument> arguments_;
    uint32_t firstRate_ = 0;
    std::array<uint32_t, shared::kMaxRates> rateVertices_{};
    std::vector<uint32_t> firstDispatches_; ///< by rate, in arguments_
    std::vector<surface::ListDraw> draws_;
    gpu::BufferSet buffers_;
    gpu::DescriptorPoolHandle pool_;
    gpu::TexelViews views_;
    std::vector<VkDescriptorSet> sets_; ///< by window
    const surface::OcclusionPass* occlusion_ = nullptr;
    gpu::DescriptorPoolHandle occlusionPool_;
    struct OcclusionSet {
        VkDescriptorSet set = VK_NULL_HANDLE;
        uint64_t generation = 0; ///< of the pyramid that it was written with
    };
    std::vector<OcclusionSet> occlusionSets_; ///< by frame in flight
};

} // namespace supple::runtime
