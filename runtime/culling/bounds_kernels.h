// The passes that find what a view sees of a group: bounds of every window's deformed cages, sizes, the list, and what
// instances of several rates need (shaders/shared/bounds.h).
//
// The caller puts a barrier (compute to compute) between bounds and list, and behind the list one to what reads it
// (compute, vertex shaders, indirect commands). If instances may have to be left out, the sizes of all groups of the
// view come before the first list, with a barrier on either side; their buffer, two times kSizeRanks words cleared in
// every frame, is the view's.
#pragma once

#include "gpu/dispatches.h"
#include "gpu/pipeline.h"
#include "gpu/pipelines.h"
#include "shaders/shared/bounds.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace supple::runtime {

/// What a slot takes of the buffers that kBoundsBinding and kBoundsStateBinding bind.
inline constexpr VkDeviceSize kBoundsBytes = 32, kStateBytes = 8;

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
    uint32_t rate = 0;    ///< | the number of its part's list << shared::kDrawListShift
};
/// A part that some instance hides.
struct ListPart {
    uint32_t part = 0;
    uint32_t unused[3] = {};
};
/// The bytes that kListTableBinding takes, and writes them.
[[nodiscard]] size_t listTableBytes(size_t windows, size_t arguments, size_t draws, size_t parts);
void writeListTable(std::span<const ListWindow> windows, std::span<const ListArgument> arguments,
                    std::span<const ListDraw> draws, std::span<const ListPart> parts, std::byte* target);

/// Planes of a matrix that takes points to clip space with depths 0..w (rows as in Vulkan); reversed and infinite depth
/// too.
[[nodiscard]] std::array<float, 24> frustumPlanes(const std::array<float, 16>& columns);

class BoundsKernels {
public:
    /// `pipelines` must outlive the pass.
    [[nodiscard]] static Result<BoundsKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines);
    /// Makes the pipelines if they are not there, with those of instances of several rates or without: on any thread,
    /// also beside recording.
    [[nodiscard]] Status make(bool rates) const;
    // The same for what is to be recorded. The first group of several rates calls for theirs.
    [[nodiscard]] Status prepare();
    [[nodiscard]] Status prepareRates();

    /// The set of a window binds its cages; the set of a group is for all other passes.
    [[nodiscard]] const gpu::ComputeLayout& boundsLayout() const { return boundsLayout_; }
    [[nodiscard]] const gpu::ComputeLayout& listLayout() const { return listLayout_; }

    /// Nothing if push.instanceCount is 0. `set` is the window's.
    void recordBounds(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::BoundsPush& push) const;
    // `set` is the group's.
    /// Nothing if push.instanceCount is 0.
    void recordSizes(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::SizePush& push) const;
    /// For empty groups too: the arguments are then those of no instances. push.maxGroups is filled in.
    void recordList(gpu::Dispatches& dispatches, const gpu::BoundSet& set, shared::ListPush push) const;
    /// Behind the list: what instances of several rates need. Nothing if push.instanceCount is 0.
    void recordDemand(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::DemandPush& push) const;
    /// As recordList, behind it and the view's solution.
    void recordRates(gpu::Dispatches& dispatches, const gpu::BoundSet& set, shared::RatesPush push) const;
    /// Context::recordWarmUp.
    void recordWarmUp(VkCommandBuffer commandBuffer, const gpu::BoundSet& ofWindow, const gpu::BoundSet& ofGroup) const;

private:
    struct Kernels {
        gpu::Kernel bounds, sizes, list;
    };
    struct RateKernels {
        gpu::Kernel demand, rates;
    };
    [[nodiscard]] Kernels kernels(gpu::Pipelines::Batch& batch) const;
    [[nodiscard]] RateKernels rateKernels(gpu::Pipelines::Batch& batch) const;
    template <class Push>
    void record(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set, const Push& push,
                uint64_t groups) const;
    [[nodiscard]] uint64_t groupsFor(uint32_t lanes) const;

    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout boundsLayout_, listLayout_;
    Kernels kernels_;
    RateKernels rateKernels_;
};

} // namespace supple::runtime
