// ACC's patches evaluated on the device.
#pragma once

#include "host/device.h"
#include "tools/bench/acc.h"

#include <memory>
#include <span>

namespace supple::bench {

class AccKernel {
public:
    [[nodiscard]] static Result<std::unique_ptr<AccKernel>> create(host::Device& device,
                                                                   std::span<const AccPatch> patches, uint32_t rate);

    /// Evaluates all samples.
    void record(VkCommandBuffer commands) const;
    /// How far the samples of the last run are from these at most, as a fraction of their extent.
    [[nodiscard]] Result<double> apartFrom(std::span<const glm::dvec3> points);

private:
    AccKernel(host::Device& device, uint32_t patches, uint32_t rate)
        : device_(device), patches_(patches), rate_(rate) {}
    [[nodiscard]] Status createPipeline();

    host::Device& device_;
    uint32_t patches_, rate_;
    host::Buffer coefficients_, vertices_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

} // namespace supple::bench
