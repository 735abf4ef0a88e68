#include "runtime/tessellation/one_rate.h"

#include <cstring>

namespace supple::runtime {

void HostDraws::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, size_t count, uint32_t framesInFlight) {
    const VkDeviceSize bytes = count * sizeof(VkDrawIndexedIndirectCommand);
    buffer_ = device.add({"supple indirect arguments", bytes,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                              VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                              VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT});
    staging_.plan(staging, "supple indirect staging", bytes, framesInFlight);
}

VkDeviceSize HostDraws::recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, bool listed, bool always,
                                     std::span<const SuppleDrawRange> draws, const InstanceWindows& windows) {
    if (listed || changed_) {
        std::byte* target = staging_.next();
        const size_t parts = windows.parts.size() / windows.drawCount();
        for (uint32_t w = 0; w < windows.drawCount(); ++w) {
            for (const SuppleDrawRange& range : draws) {
                const PartList list = windows.parts[w * parts + range.part];
                const uint32_t first = list.first - windows.firstDrawnSlot(w);
                const VkDrawIndexedIndirectCommand command{range.indexCount, range.patchCount * list.count,
                                                           range.firstIndex, 0, range.patchCount * first};
                std::memcpy(target, &command, sizeof(command));
                target += sizeof(command);
            }
        }
    } else if (!always) {
        return 0;
    }
    changed_ = false;
    return staging_.recordCopy(device, commandBuffer, 0, buffer_.buffer(), 0, buffer_.size());
}

void HostDraws::recordNone(const gpu::Device& device, VkCommandBuffer commandBuffer) {
    changed_ = true;
    if (buffer_.size() > 0) {
        device.vk.CmdFillBuffer(commandBuffer, buffer_.buffer(), 0, VK_WHOLE_SIZE, 0);
    }
}

HashedPart OneRate::hashedPart(uint32_t) const {
    HashedPart part = hashedPositions(streams_);
    part.slotStride = evaluation_.verticesPerInstance * part.elementWords;
    part.elementCount = vertexCount_;
    return part;
}

void OneRate::setDraws(std::vector<SuppleDrawRange> draws) {
    draws_ = std::move(draws);
    rates_.resize(1);
    rates_.front().rate = evaluation_.rate;
    rates_.front().drawRangeCount = static_cast<uint32_t>(draws_.size());
    hostDraws_.setChanged();
}

void OneRate::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging) {
    OwnVertices::plan(device, staging);
    hostDraws_.plan(device, staging, size_t{drawWindows_} * draws_.size(), desc_.framesInFlight);
}

Status OneRate::cutDraws(InstanceWindows& windows, bool byWindows) {
    Status status = OwnVertices::cutDraws(windows, byWindows);
    drawWindows_ = windows.drawCount();
    return status;
}

Status OneRate::createSets(const SurfaceInput& input, const InstanceListing& listing, const Visibility& visibility) {
    const Status made = createIndices(std::exchange(indexData_, {}), std::exchange(wholeIndexData_, {}));
    rates_.front().instances = visibility.list().slots();
    return made ? OwnVertices::createSets(input, listing, visibility) : made;
}

void OneRate::fillGrid(SuppleGridOutput& output) const {
    OwnVertices::fillGrid(output);
    output.indirect = {hostDraws_.buffer().buffer(), 0, hostDraws_.buffer().size(),
                       sizeof(VkDrawIndexedIndirectCommand)};
}

void OneRate::addTransfers(Transfers& transfers, uint64_t frame) const {
    OwnVertices::addTransfers(transfers, frame);
    transfers.add(hostDraws_.buffer().buffer());
}

VkDeviceSize OneRate::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, bool changed) {
    return OwnVertices::recordUpload(commandBuffer, frame, changed) +
           hostDraws_.recordUpload(*desc_.device, commandBuffer, changed, desc_.handsOver, draws_, windows());
}

PassCost OneRate::recordEvaluate(surface::Round& round) const {
    windows().forEach([&](uint32_t w) { surface::record(round, program_.evaluate, seen(w)); });
    const uint64_t points = uint64_t{vertexCount_} * windows().visible;
    return {points, points * streams_.frameBytes()};
}

PassCost OneRate::recordMotion(surface::Round& round) const {
    if (!writesMotion()) {
        return {};
    }
    bool first = true;
    const auto evaluate = [&](const surface::Sets& sets, uint32_t from, uint32_t count, bool past) {
        if (count == 0 && !round.dispatches.takesEmpty()) {
            return;
        }
        if (!first) {
            round.dispatches.disjointBarrier(); // other instances
        }
        first = false;
        surface::Window window;
        window.sets = sets;
        window.push.firstInstance = from;
        window.push.instanceCount = count;
        surface::record(round, program_.motion, past ? ofPast(window) : window);
    };
    // Instances with a past from the coefficients of the frame before, new ones from today's.
    windows().forEach([&](uint32_t w) {
        const InstanceWindows::Listed& listed = windows().listed[w];
        evaluate(pastSets(w), windows().firstEntry(w), listed.withPast, true);
        evaluate(todaysSets(w), windows().firstEntry(w) + listed.withPast, listed.count - listed.withPast, false);
    });
    const uint64_t points = uint64_t{vertexCount_} * windows().visible;
    return {points, points * streams_.bytes(Stream::previousPositions)};
}

} // namespace supple::runtime
