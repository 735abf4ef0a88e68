// One cache of compute pipelines. Whoever needs a pipeline asks for it by what it is made of; what exists is found.
#pragma once

#include "gpu/pipeline.h"

#include <span>
#include <vector>

namespace supple::gpu {

/// The pipelines of one context. Two are the same if their SPIR-V (its address), layout and constants are the same.
/// Not thread-safe; recording does not need it.
class Pipelines {
public:
    explicit Pipelines(const Device& device) : device_(&device) {}

    /// The pipeline, created if it is not there yet. The SPIR-V's words and the layout must outlive the cache; `name`
    /// is for debuggers, and that of the first call stays.
    [[nodiscard]] Result<Kernel> get(const ComputeLayout& layout, const Spirv& spirv,
                                     std::span<const Constant> constants, const char* name);

private:
    struct Entry {
        const uint32_t* words = nullptr;
        VkPipelineLayout layout = VK_NULL_HANDLE;
        std::vector<Constant> constants;
        PipelineHandle pipeline;
    };
    const Device* device_;
    std::vector<Entry> entries_; ///< a few dozen: a search costs nothing beside a pipeline
};

} // namespace supple::gpu
