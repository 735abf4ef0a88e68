// What dispatches bind, made for a layout: descriptor sets, or addresses where groups share dispatches (gpu/tasks.h).
#pragma once

#include "gpu/dispatches.h"

#include <memory>
#include <span>
#include <vector>

namespace supple::gpu {

class BoundSets {
public:
    /// `count` sets, of which nothing is bound yet.
    [[nodiscard]] Status create(const Device& device, const ComputeLayout& layout, uint32_t count, const char* name);
    /// Resources that the layout lacks are skipped.
    void write(const Device& device, const ComputeLayout& layout, size_t index,
               std::span<const BoundResource> resources);

    [[nodiscard]] bool empty() const { return sets_.empty(); }
    [[nodiscard]] const BoundSet& operator[](size_t index) const { return sets_[index]; }

private:
    DescriptorPoolHandle pool_;
    std::unique_ptr<TaskBuffers[]> buffers_;
    std::vector<BoundSet> sets_;
};

} // namespace supple::gpu
