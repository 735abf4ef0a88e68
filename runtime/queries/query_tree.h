// The trees over a group's pieces in the frame's poses, of as many instances at a time as there is memory for.
#pragma once

#include "gpu/bound_sets.h"
#include "gpu/memory.h"
#include "runtime/queries/tree_kernels.h"

#include <cstdint>
#include <span>

namespace supple::runtime {

class QueryTree {
public:
    /// How trees are made in turn, of the instances of a window.
    struct Plan {
        uint32_t count = 0; ///< instances that have trees at a time
        uint32_t turns = 0; ///< after which all have had one
    };
    /// An error if the device does not bind one tree.
    [[nodiscard]] static Result<Plan> planFor(const gpu::Device& device, uint32_t pieceCount, uint32_t windowSize);

    /// Kernels must outlive it.
    [[nodiscard]] Status create(const gpu::Device& device, const TreeKernels& kernels, uint32_t pieceCount, Plan plan,
                                uint32_t windowCount);
    /// What the kernels bind besides the trees.
    void write(const gpu::Device& device, uint32_t window, std::span<const gpu::BoundResource> resources);

    [[nodiscard]] const Plan& plan() const { return plan_; }
    [[nodiscard]] VkBuffer nodes() const { return nodes_.buffer(0); }
    /// `sizes`: has what the kernel `list` has written, for the window that `push` is of.
    void record(gpu::Dispatches& dispatches, TreeKernels::Pass pass, uint32_t window, const shared::QueryPush& push,
                VkBuffer sizes) const;

private:
    Plan plan_;
    const TreeKernels* kernels_ = nullptr;
    gpu::BufferSet nodes_;
    gpu::TexelViews views_;
    VkBufferView texels_ = VK_NULL_HANDLE;
    gpu::BoundSets sets_; ///< by window
};

} // namespace supple::runtime
