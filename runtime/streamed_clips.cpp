// Clips whose segments come and go (runtime/clip_stream.h), in the frames of a context.
#include "gpu/barriers.h"
#include "runtime/context.h"

#include <algorithm>
#include <limits>

namespace supple::runtime {

namespace {

constexpr VkDeviceSize kFrameBytes = VkDeviceSize{64} << 10; ///< without a budget of uploads
constexpr VkDeviceSize kLeastBytes = 4;                      // that a transfer takes

constexpr gpu::SyncScope kTransfers{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};

/// What a host would have said.
calls::RequestClip requestCall(SuppleAsset asset, double duration, const ClipRequest& request) {
    SuppleClipRequest said{};
    said.use = request.use == ClipRequest::Use::pinned ? SUPPLE_CLIP_PIN : SUPPLE_CLIP_REQUEST;
    said.begin = request.begin * duration;
    said.end = request.end * duration;
    return {asset, request.clip, said};
}

} // namespace

Status Context::requestClip(Asset& asset, const ClipRequest& request) {
    ClipRequest own = request;
    own.stamp = ++clipStamp_;
    return asset.stream != nullptr ? asset.stream->request(own) : success();
}

void Context::takeOverRequests(const Asset& before, Asset& asset, std::span<const uint32_t> clips) {
    const std::vector<ClipRequest> all =
        before.stream != nullptr ? before.stream->requests() : std::vector<ClipRequest>();
    for (ClipRequest own : all) {
        own.clip = clips[own.clip];
        if (own.clip != cage::kNone && !requestClip(asset, own)) {
            own.use = ClipRequest::Use::wanted; // there is less room than there was
            (void)requestClip(asset, own);
        }
    }
}

void Context::streamClips(Asset& asset, uint64_t poolBytes) const {
    asset.streamClips(poolBytes);
    if (poolBytes > 0 && asset.stream == nullptr) {
        log(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_ASSET_WARNING,
            asset.character.name + ": clipPoolBytes: no clip has a coarse twin, so the device has all clips");
    }
}

void Context::planStreams() {
    streams_.clear();
    groups.forEach([this](const Group& group) {
        Asset& asset = *group.sharedAsset();
        if (asset.stream != nullptr && asset.stream->beginFrame(frame_, !asset.clips.staticsPending())) {
            streams_.push_back(&asset);
        }
    });
    // What waits longest comes first, but for assets that nobody draws.
    std::sort(streams_.begin(), streams_.end(), [](const Asset* a, const Asset* b) {
        const bool first = a->stream->isIdle(), second = b->stream->isIdle();
        return first != second ? second : a->stream->firstStamp() < b->stream->firstStamp();
    });
    // Half of a budget, so that new groups are not kept waiting.
    const VkDeviceSize most = uploads_.bounded() ? std::max(uploads_.budget() / 2, kLeastBytes) : kFrameBytes;
    VkDeviceSize left = most;
    for (Asset* const asset : streams_) {
        const bool reserves = !asset->stream->isIdle();
        const VkDeviceSize bytes = asset->stream->plan(most, left);
        left -= reserves ? bytes : 0;
        uploads_.reserve(reserves ? bytes : 0);
    }
}

VkDeviceSize Context::recordStream(VkCommandBuffer commandBuffer, Group& group, VkDeviceSize statics) {
    Asset& asset = *group.sharedAsset();
    if (asset.stream == nullptr || asset.clips.empty() || asset.clips.staticsPending()) {
        return 0;
    }
    if (asset.stream->hasWork(frame_)) {
        group.noteRecorded(frame_); // it keeps the table until the frame is complete
        if (statics > 0) {          // they may be the table
            gpu::memoryBarrier(*device_, commandBuffer, kTransfers, kTransfers);
        }
    }
    const bool reserved = !asset.stream->isIdle();
    const VkDeviceSize most = reserved ? std::numeric_limits<VkDeviceSize>::max() : uploads_.left();
    const VkDeviceSize bytes = asset.stream->record(*device_, commandBuffer, asset.clips.buffer(0), frame_, most);
    reserved ? uploads_.countReserved(bytes) : uploads_.count(bytes);
    return bytes;
}

bool Context::recordStreams(VkCommandBuffer commandBuffer) {
    bool hasWork = false;
    groups.forEach([&](const Group& group) {
        const ClipStream* const stream = group.sharedAsset()->stream.get();
        hasWork = hasWork || (stream != nullptr && stream->hasWork(frame_));
    });
    if (hasWork) { // earlier frames read what is overwritten
        gpu::memoryBarrier(*device_, commandBuffer,
                           {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                            VK_ACCESS_2_TRANSFER_WRITE_BIT},
                           kTransfers);
    }
    groups.forEach([&](Group& group) { recordStream(commandBuffer, group, 0); });
    return hasWork;
}

std::vector<Context::AskedClip> Context::askedClips() const {
    std::vector<AskedClip> all;
    assets.forEachId([&](uint64_t id, const Asset& asset) {
        if (asset.stream != nullptr) {
            for (const ClipRequest& own : asset.stream->requests()) {
                all.push_back({id, own});
            }
        }
    });
    return all;
}

void Context::noteClips(Recorder& recorder, std::span<const AskedClip> asked) const {
    for (const AskedClip& own : asked) {
        const double duration = assets.find(own.asset)->character.clips[own.request.clip].duration;
        recorder.note(requestCall({own.asset}, duration, own.request));
    }
}

void Context::restartStreams(std::span<const AskedClip> asked) {
    forStreams([](Asset& asset) { asset.stream->restart(); });
    for (const AskedClip& own : asked) {
        (void)requestClip(*assets.find(own.asset), own.request); // what is pinned has been pinned before
    }
}

} // namespace supple::runtime
