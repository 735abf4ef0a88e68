#include "tools/bench/acc_kernel.h"

#include "host/pipelines.h"

#include <algorithm>
#include <cstring>
#include <shaders/acc_comp.h>

namespace supple::bench {
namespace {

constexpr uint32_t kLocalSize = 64;

struct AccPush {
    uint32_t patchCount, rate, samplesPerLane;
};

} // namespace

Result<std::unique_ptr<AccKernel>> AccKernel::create(host::Device& device, std::span<const AccPatch> patches,
                                                     uint32_t rate) {
    std::unique_ptr<AccKernel> kernel(new AccKernel(device, static_cast<uint32_t>(patches.size()), rate));
    std::vector<glm::vec4> words;
    for (const AccPatch& patch : patches) {
        const auto add = [&](const auto& coefficients) {
            for (const glm::dvec3& c : coefficients)
                words.emplace_back(glm::vec3(c), 0.0f);
        };
        add(patch.b), add(patch.u), add(patch.v);
    }
    Result<host::Buffer> coefficients =
        device.uploadBuffer(words.data(), words.size() * sizeof words[0], VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    if (!coefficients)
        return coefficients.error();
    kernel->coefficients_ = std::move(*coefficients);
    const VkDeviceSize samples = VkDeviceSize{rate + 1} * (rate + 1) * patches.size();
    Result<host::Buffer> vertices = device.createBuffer(
        16 * samples, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, host::MemoryKind::device);
    if (!vertices)
        return vertices.error();
    kernel->vertices_ = std::move(*vertices);
    const Status status = kernel->createPipeline();
    return status ? Result<std::unique_ptr<AccKernel>>(std::move(kernel)) : status.error();
}

Status AccKernel::createPipeline() {
    const Result<VkDescriptorSetLayout> set =
        host::createSetLayout(device_, {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT},
                                        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT}});
    if (!set)
        return set.error();
    const Result<VkPipelineLayout> layout =
        host::createPipelineLayout(device_, {*set}, sizeof(AccPush), VK_SHADER_STAGE_COMPUTE_BIT);
    if (!layout)
        return layout.error();
    layout_ = *layout;
    const Result<VkPipeline> pipeline = host::createComputePipeline(device_, layout_, acc_comp);
    if (!pipeline)
        return pipeline.error();
    pipeline_ = *pipeline;
    Result<host::DescriptorPool> pool = host::DescriptorPool::create(device_, 1);
    if (!pool)
        return pool.error();
    const Result<VkDescriptorSet> allocated = pool->allocate(*set);
    if (!allocated)
        return allocated.error();
    set_ = *allocated;
    pool->write(set_, {host::storageBuffer(0, coefficients_.handle(), 0, VK_WHOLE_SIZE),
                       host::storageBuffer(1, vertices_.handle(), 0, VK_WHOLE_SIZE)});
    return success();
}

void AccKernel::record(VkCommandBuffer commands) const {
    const uint32_t samples = (rate_ + 1) * (rate_ + 1);
    const AccPush push{patches_, rate_, device_.isCpu() ? samples : 1};
    const uint32_t lanes = patches_ * (samples / push.samplesPerLane);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, &push);
    vkCmdDispatch(commands, (lanes + kLocalSize - 1) / kLocalSize, 1, 1);
}

Result<double> AccKernel::apartFrom(std::span<const glm::dvec3> points) {
    const Result<std::vector<std::byte>> bytes =
        device_.readBuffer(vertices_.handle(), 0, VkDeviceSize{16} * points.size());
    if (!bytes)
        return bytes.error();
    double largest = 0.0;
    glm::dvec3 low = points[0], high = low;
    for (size_t i = 0; i < points.size(); ++i) {
        glm::vec3 position;
        std::memcpy(&position, bytes->data() + 16 * i, sizeof position);
        largest = std::max(largest, glm::length(glm::dvec3(position) - points[i]));
        low = glm::min(low, points[i]), high = glm::max(high, points[i]);
    }
    return largest / glm::length(high - low);
}

} // namespace supple::bench
