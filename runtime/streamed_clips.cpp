// Clips whose segments come and go (runtime/clip_stream.h), in the frames of a context.
#include "runtime/context.h"

namespace supple::runtime {

namespace {

constexpr VkDeviceSize kFrameBytes = VkDeviceSize{64} << 10; ///< without a budget of uploads

/// What a host would have said.
calls::RequestClip requestCall(SuppleAsset asset, double duration, const ClipRequest& request) {
    SuppleClipRequest said{};
    said.use = request.use == ClipRequest::Use::pinned ? SUPPLE_CLIP_PIN : SUPPLE_CLIP_REQUEST;
    said.begin = request.begin * duration;
    said.end = request.end * duration;
    return {asset, request.clip, said};
}

} // namespace

void Context::streamClips() {
    // Half of a budget, so that new groups are not kept waiting.
    VkDeviceSize left = uploads_.bounded() ? uploads_.budget() / 2 : kFrameBytes;
    forStreams([&](Asset& asset) {
        const bool ready = !asset.clips.empty() && !asset.clips.staticsPending();
        const VkDeviceSize bytes = asset.stream->beginFrame(frame_, left, ready);
        left -= bytes;
        uploads_.reserve(bytes);
    });
}

VkDeviceSize Context::recordStream(VkCommandBuffer commandBuffer, Asset& asset) {
    if (asset.stream == nullptr || asset.clips.empty()) {
        return 0;
    }
    const VkDeviceSize bytes = asset.stream->record(*device_, commandBuffer, asset.clips.buffer(0), frame_);
    uploads_.countReserved(bytes);
    return bytes;
}

bool Context::recordStreams(VkCommandBuffer commandBuffer) {
    bool hasWork = false;
    forStreams([&](const Asset& asset) { hasWork = hasWork || asset.stream->hasWork(frame_); });
    if (hasWork) { // earlier frames read what is overwritten
        gpu::memoryBarrier(*device_, commandBuffer,
                           {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                            VK_ACCESS_2_TRANSFER_WRITE_BIT},
                           {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT});
    }
    forStreams([&](Asset& asset) { recordStream(commandBuffer, asset); });
    return hasWork;
}

void Context::restartStreams(Recorder& recorder) {
    assets.forEachId([&](uint64_t id, Asset& asset) {
        if (asset.stream != nullptr) {
            for (const ClipRequest& own : asset.stream->restart()) {
                recorder.note(requestCall({id}, asset.character.clips[own.clip].duration, own));
            }
        }
    });
}

} // namespace supple::runtime
