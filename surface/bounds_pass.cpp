#include "surface/bounds_pass.h"

#include "cage/topology.h"
#include "shaders/bounds_bounds_comp.h"
#include "shaders/bounds_demand_comp.h"
#include "shaders/bounds_list_comp.h"
#include "shaders/bounds_rates_comp.h"
#include "shaders/bounds_size_comp.h"

#include <algorithm>
#include <cmath>

namespace supple::surface {

using namespace shared;

static_assert(sizeof(ListWindow) == 16 && sizeof(ListArgument) == 16 && sizeof(ListDraw) == 16);

namespace {

constexpr uint32_t kPushBytes = std::max({sizeof(BoundsPush), sizeof(ListPush), sizeof(DemandPush), sizeof(RatesPush)});
static_assert(kPushBytes <= gpu::kPushConstantBytes);

/// Whether a chart of the blending surface may be open. One that is not has smaller weights.
bool openOrSharp(const cage::Cage& cage) {
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    return !cage.creases.empty() || !cage.sharpVertices.empty() || !topology.ok() ||
           std::any_of(topology->boundary.begin(), topology->boundary.end(), [](uint8_t b) { return b != 0; });
}

} // namespace

float boundsMargin(SchemeId scheme, const cage::Cage& cage) {
    // A little above what was found (tests/surface/bounds_test.cpp), for rounding and for rarer valences.
    switch (scheme) {
    case SchemeId::prep:
        return 0.04f; // 0.0276, at valence 59
    case SchemeId::pm:
        return 0.21f; // 0.1896
    case SchemeId::blend:
        return openOrSharp(cage) ? 1.05f : 0.3f; // 1.0126; 0.2812
    default:
        return 0.001f; // points of the limit are means of the cage's
    }
}

size_t listTableBytes(size_t windows, size_t arguments, size_t draws) {
    return windows * sizeof(ListWindow) + arguments * sizeof(ListArgument) + draws * sizeof(ListDraw);
}

void writeListTable(std::span<const ListWindow> windows, std::span<const ListArgument> arguments,
                    std::span<const ListDraw> draws, std::byte* target) {
    const auto put = [&](std::span<const std::byte> bytes) { target = std::copy(bytes.begin(), bytes.end(), target); };
    put(std::as_bytes(windows));
    put(std::as_bytes(arguments));
    put(std::as_bytes(draws));
}

std::array<float, 24> frustumPlanes(const std::array<float, 16>& columns) {
    const auto row = [&](size_t r) {
        return std::array<float, 4>{columns[r], columns[4 + r], columns[8 + r], columns[12 + r]};
    };
    const std::array<float, 4> x = row(0), y = row(1), z = row(2), w = row(3);
    std::array<float, 24> planes{};
    for (size_t c = 0; c < 4; ++c) { // -w <= x <= w, -w <= y <= w, 0 <= z <= w
        const float sides[6] = {w[c] + x[c], w[c] - x[c], w[c] + y[c], w[c] - y[c], z[c], w[c] - z[c]};
        for (size_t k = 0; k < 6; ++k) {
            planes[4 * k + c] = sides[k];
        }
    }
    return planes;
}

Result<BoundsPass> BoundsPass::create(const gpu::Device& device) {
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    constexpr VkDescriptorType kTexels = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    const gpu::Binding bindings[] = {
        {kBoundsCageBinding, kStorage},  {kBoundsCageTexelBinding, kTexels}, {kBoundsBinding, kStorage},
        {kBoundsStateBinding, kStorage}, {kHostListBinding, kStorage},       {kBoundsStateTexelBinding, kTexels},
        {kListBinding, kStorage},        {kHostListTexelBinding, kTexels},   {kListArgumentBinding, kStorage},
        {kListTableBinding, kStorage},   {kCullViewBinding, kStorage},       {kSizeBinding, kStorage},
        {kViewWordsBinding, kStorage},
    };
    BoundsPass pass;
    pass.device_ = &device;
    Result<gpu::ComputeLayout> layout = gpu::ComputeLayout::create(device, bindings, kPushBytes, "supple bounds");
    if (!layout) {
        return layout.error();
    }
    pass.layout_ = std::move(*layout);
    const Source sources[] = {{&pass.bounds_, bounds_bounds_comp, "supple bounds"},
                              {&pass.sizes_, bounds_size_comp, "supple sizes of instances"},
                              {&pass.list_, bounds_list_comp, "supple list of instances"}};
    const Status made = pass.make(sources);
    if (!made) {
        return made.error();
    }
    return pass;
}

Status BoundsPass::prepareRates() {
    const Source sources[] = {{&demand_, bounds_demand_comp, "supple demand of rates"},
                              {&rates_, bounds_rates_comp, "supple lists of rates"}};
    return make(sources);
}

Status BoundsPass::make(std::span<const Source> sources) {
    for (const auto& [target, spirv, name] : sources) {
        if (target->get() == VK_NULL_HANDLE) {
            Result<gpu::PipelineHandle> made = gpu::createComputePipeline(*device_, layout_, spirv, {}, name);
            if (!made) {
                return made.error();
            }
            *target = std::move(*made);
        }
    }
    return success();
}

void BoundsPass::bind(VkCommandBuffer commandBuffer, const gpu::PipelineHandle& pipeline, VkDescriptorSet set,
                      const void* push, uint32_t bytes) const {
    const VkPipelineLayout layout = layout_.pipelineLayout.get();
    device_->vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
    device_->vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    device_->vk.CmdPushConstants(commandBuffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, bytes, push);
}

uint32_t BoundsPass::groupsFor(uint32_t lanes) const {
    return (lanes + device_->mapping.localSize - 1) / device_->mapping.localSize;
}

void BoundsPass::recordBounds(VkCommandBuffer commandBuffer, VkDescriptorSet set, const BoundsPush& push) const {
    if (push.instanceCount == 0) {
        return;
    }
    bind(commandBuffer, bounds_, set, &push, sizeof(push));
    gpu::dispatchLinear(*device_, commandBuffer,
                        device_->mapping.wide ? push.instanceCount : groupsFor(push.instanceCount));
}

void BoundsPass::recordSizes(VkCommandBuffer commandBuffer, VkDescriptorSet set, const SizePush& push) const {
    if (push.instanceCount == 0) {
        return;
    }
    bind(commandBuffer, sizes_, set, &push, sizeof(push));
    gpu::dispatchLinear(*device_, commandBuffer, groupsFor(push.instanceCount));
}

void BoundsPass::recordDemand(VkCommandBuffer commandBuffer, VkDescriptorSet set, const DemandPush& push) const {
    if (push.instanceCount == 0) {
        return;
    }
    bind(commandBuffer, demand_, set, &push, sizeof(push));
    gpu::dispatchLinear(*device_, commandBuffer, groupsFor(push.instanceCount));
}

void BoundsPass::recordList(VkCommandBuffer commandBuffer, VkDescriptorSet set, ListPush push) const {
    push.maxGroups = gpu::maxGroupsInX(*device_);
    bind(commandBuffer, list_, set, &push, sizeof(push));
    device_->vk.CmdDispatch(commandBuffer, 1, 1, 1);
}

void BoundsPass::recordRates(VkCommandBuffer commandBuffer, VkDescriptorSet set, RatesPush push) const {
    push.maxGroups = gpu::maxGroupsInX(*device_);
    bind(commandBuffer, rates_, set, &push, sizeof(push));
    device_->vk.CmdDispatch(commandBuffer, 1, 1, 1);
}

} // namespace supple::surface
