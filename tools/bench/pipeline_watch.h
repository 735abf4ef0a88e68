// Watches a context create its pipelines: which, how large, how long it took.
#pragma once

#include <cstdint>
#include <string>
#include <vector>
#include <vulkan/vulkan.h>

namespace supple::bench {

struct WatchedPipeline {
    std::string name; ///< as the library named it for captures; empty where the device has no debug utils
    uint64_t spirvBytes = 0;
    double seconds = 0.0;       ///< vkCreateComputePipelines
    double moduleSeconds = 0.0; ///< vkCreateShaderModule
    double cpuSeconds = 0.0;    ///< of the process, in both
};

/// While one lives, contexts made with getInstanceProcAddr() are watched. One at a time, one thread: Vulkan's functions
/// take no user data, so the table behind it is the process's.
class PipelineWatch {
public:
    PipelineWatch();
    ~PipelineWatch();
    PipelineWatch(const PipelineWatch&) = delete;
    PipelineWatch& operator=(const PipelineWatch&) = delete;

    [[nodiscard]] static PFN_vkGetInstanceProcAddr getInstanceProcAddr();
    /// All so far, in the order of their creation.
    [[nodiscard]] const std::vector<WatchedPipeline>& pipelines() const { return pipelines_; }

private:
    friend struct WatchedFunctions;
    std::vector<WatchedPipeline> pipelines_;
    std::vector<VkPipeline> handles_;
    uint64_t moduleBytes_ = 0; ///< of the last shader module, which the next pipeline is made of
    double moduleSeconds_ = 0.0, moduleCpuSeconds_ = 0.0;
};

} // namespace supple::bench
