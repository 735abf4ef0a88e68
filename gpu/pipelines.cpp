#include "gpu/pipelines.h"

#include <algorithm>

namespace supple::gpu {

Result<Kernel> Pipelines::get(const ComputeLayout& layout, const Spirv& spirv, std::span<const Constant> constants,
                              const char* name) {
    const uint32_t* words = wordsOf(*device_, spirv).data();
    const VkPipelineLayout pipelineLayout = layout.pipelineLayout.get();
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return entry.words == words && entry.layout == pipelineLayout &&
               std::equal(entry.constants.begin(), entry.constants.end(), constants.begin(), constants.end());
    });
    if (known != entries_.end()) {
        return Kernel{known->pipeline.get(), pipelineLayout};
    }
    Result<PipelineHandle> pipeline = createComputePipeline(*device_, layout, spirv, constants, name);
    if (!pipeline) {
        return pipeline.error();
    }
    const Kernel kernel{pipeline->get(), pipelineLayout};
    entries_.push_back({words, pipelineLayout, {constants.begin(), constants.end()}, std::move(*pipeline)});
    return kernel;
}

} // namespace supple::gpu
