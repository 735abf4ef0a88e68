#include "host/graph.h"

#include "host/must.h"

namespace supple::host {

namespace {

constexpr uint32_t kMaxPasses = 16;

bool covers(const Scope& scope, const Scope& part) {
    return (scope.stages & part.stages) == part.stages && (scope.access & part.access) == part.access;
}

} // namespace

Use reads(Resource resource, Scope scope, VkImageLayout layout) {
    return {resource, scope, {}, layout, false};
}

Use writes(Resource resource, Scope scope, VkImageLayout layout, bool discard) {
    return {resource, scope, scope, layout, discard};
}

Use writesWithin(Resource resource, Scope first, Scope last) {
    return {resource, first, last, VK_IMAGE_LAYOUT_UNDEFINED, false};
}

Graph::Graph(Device& device) : device_(device) {
    for (VkQueryPool& pool : queries_) {
        const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                         .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                         .queryCount = kMaxPasses + 1};
        must(vkCreateQueryPool(device.handle(), &info, nullptr, &pool), "vkCreateQueryPool");
        device.atEnd([handle = device.handle(), pool] { vkDestroyQueryPool(handle, pool, nullptr); });
    }
}

Resource Graph::addBuffers() {
    states_.push_back({});
    return {static_cast<uint32_t>(states_.size() - 1)};
}

Resource Graph::addImage(VkImageAspectFlags aspect) {
    states_.push_back({.isImage = true, .aspect = aspect});
    return {static_cast<uint32_t>(states_.size() - 1)};
}

void Graph::setImage(Resource resource, VkImage image, Scope before) {
    State& state = states_[resource.index];
    state = {.isImage = true, .image = image, .aspect = state.aspect, .write = before};
}

void Graph::add(const char* name, std::vector<Use> uses, std::function<void(VkCommandBuffer)> record) {
    if (passes_.size() == kMaxPasses)
        fail("too many passes");
    passes_.push_back({name, std::move(uses), std::move(record)});
}

/// All that a pass must wait for, in one vkCmdPipelineBarrier2: a barrier for each image, one for all buffers.
void Graph::barriers(VkCommandBuffer commands, const Pass& pass) {
    std::vector<VkImageMemoryBarrier2> images;
    VkMemoryBarrier2 memory{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    for (const Use& use : pass.uses) {
        State& state = states_[use.resource.index];
        const bool write = use.last.stages != 0;
        const bool transition = state.isImage && state.layout != use.layout;
        // Writes wait for the write and the reads before them, reads for the write alone, and once.
        const bool waits = write || transition ? (state.write.stages | state.readers) != 0
                                               : state.write.stages != 0 && !covers(state.visible, use.first);
        if (waits || transition) {
            const VkPipelineStageFlags2 from = state.write.stages | (write || transition ? state.readers : 0);
            if (state.isImage) {
                images.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                  .srcStageMask = from,
                                  .srcAccessMask = state.write.access,
                                  .dstStageMask = use.first.stages,
                                  .dstAccessMask = use.first.access,
                                  .oldLayout = use.discard ? VK_IMAGE_LAYOUT_UNDEFINED : state.layout,
                                  .newLayout = use.layout,
                                  .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                  .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                  .image = state.image,
                                  .subresourceRange = {state.aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1}});
            } else {
                memory.srcStageMask |= from;
                memory.srcAccessMask |= state.write.access;
                memory.dstStageMask |= use.first.stages;
                memory.dstAccessMask |= use.first.access;
            }
        }
        if (write) {
            state.write = use.last;
            state.visible = {};
            state.readers = 0;
        } else if (transition) {
            // The transition wrote the image, and this pass has waited for it.
            state.write = {use.first.stages, 0};
            state.visible = use.first;
            state.readers = use.first.stages;
        } else {
            state.visible.stages |= use.first.stages;
            state.visible.access |= use.first.access;
            state.readers |= use.first.stages;
        }
        state.layout = use.layout;
    }
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .memoryBarrierCount = memory.srcStageMask != 0 ? 1u : 0u,
                                      .pMemoryBarriers = &memory,
                                      .imageMemoryBarrierCount = static_cast<uint32_t>(images.size()),
                                      .pImageMemoryBarriers = images.data()};
    if (dependency.memoryBarrierCount != 0 || !images.empty())
        vkCmdPipelineBarrier2(commands, &dependency);
}

void Graph::execute(VkCommandBuffer commands, uint32_t slot) {
    const VkQueryPool queries = queries_[slot];
    vkCmdResetQueryPool(commands, queries, 0, kMaxPasses + 1);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries, 0);
    timed_[slot].clear();
    for (const Pass& pass : passes_) {
        barriers(commands, pass);
        pass.record(commands);
        timed_[slot].push_back(pass.name);
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries,
                             static_cast<uint32_t>(timed_[slot].size()));
    }
    passes_.clear();
}

const std::vector<PassTime>& Graph::readTimes(uint32_t slot) {
    uint64_t ticks[kMaxPasses + 1];
    const auto count = static_cast<uint32_t>(timed_[slot].size() + 1);
    times_.clear();
    if (count == 1 || vkGetQueryPoolResults(device_.handle(), queries_[slot], 0, count, sizeof ticks, ticks,
                                            sizeof ticks[0], VK_QUERY_RESULT_64_BIT) != VK_SUCCESS)
        return times_;
    for (uint32_t i = 0; i + 1 < count; ++i) {
        const double nanoseconds = static_cast<double>(ticks[i + 1] - ticks[i]) *
                                   static_cast<double>(device_.properties().limits.timestampPeriod);
        times_.push_back({timed_[slot][i], nanoseconds * 1e-6});
    }
    return times_;
}

void addPresent(Graph& graph, const Swapchain& swapchain, Resource use, const Image& picture, Resource pictureUse) {
    const VkImage image = swapchain.image(swapchain.index());
    const VkExtent2D from = picture.desc().extent;
    const VkExtent2D to = swapchain.extent();
    graph.setImage(use, image, {Swapchain::kFirstUse, 0});
    graph.add("present",
              {reads(pictureUse, {VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_READ_BIT},
                     VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
               writes(use, {VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true)},
              [=, source = picture.handle()](VkCommandBuffer commands) {
                  const VkImageBlit region{
                      .srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                      .srcOffsets = {{}, {static_cast<int32_t>(from.width), static_cast<int32_t>(from.height), 1}},
                      .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                      .dstOffsets = {{}, {static_cast<int32_t>(to.width), static_cast<int32_t>(to.height), 1}}};
                  vkCmdBlitImage(commands, source, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image,
                                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST);
              });
    // No commands: only the barrier into the layout of what is shown. The semaphore of the submission does the rest.
    graph.add("show", {reads(use, {}, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR)}, [](VkCommandBuffer) {});
}

} // namespace supple::host
