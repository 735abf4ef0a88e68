// What frames may upload of static data, and what is still to be uploaded.
#include "runtime/context.h"

namespace supple::runtime {

namespace {

SuppleUploadState stateOf(const gpu::StaticCount& count) {
    SuppleUploadState state{};
    state.complete = count.left == 0 ? 1 : 0;
    state.bytes = count.bytes;
    state.bytesLeft = count.left;
    state.frameBytes = count.frameBytes;
    return state;
}

} // namespace

Status Context::setUploadBudget(VkDeviceSize bytes) {
    const std::scoped_lock lock(uploading_);
    Status status = success();
    if (bytes == 0) { // what was to go through the budget's memory needs its own
        const auto stage = [&](gpu::FrameMember& member) { status = status ? member.stageStatics() : status; };
        forMembers(stage);
        assets.forEach([&](Asset& asset) { asset.forStatics(stage); });
    }
    return status ? uploads_.setBudget(*device_, bytes, framesInFlight_) : status;
}

gpu::StaticCount Context::newCount() const {
    gpu::StaticCount count;
    count.number = ++statesAsked_;
    count.frame = frame_;
    return count;
}

SuppleUploadState Context::uploadState(const Group& group) const {
    const std::scoped_lock lock(uploading_);
    gpu::StaticCount count = newCount();
    group.countStatics(count);
    if (const std::shared_ptr<Group> leader = group.follows() ? groups.find(group.leader()) : nullptr) {
        leader->countStatics(count); // whose cages it draws
    }
    return stateOf(count);
}

SuppleUploadState Context::uploadState(Asset& asset) const {
    const std::scoped_lock lock(uploading_);
    gpu::StaticCount count = newCount();
    asset.forStatics([&](const gpu::StaticBuffers& buffers) { buffers.countStatics(count); });
    return stateOf(count);
}

SuppleUploadState Context::uploadState() const {
    const std::scoped_lock lock(uploading_);
    gpu::StaticCount count = newCount();
    const auto add = [&](const gpu::FrameMember& member) { member.countStatics(count); };
    add(pairs_);
    groups.forEach(add);
    views.forEach(add);
    queryPools.forEach(add);
    assets.forEach([&](Asset& asset) { asset.forStatics(add); });
    SuppleUploadState state = stateOf(count);
    state.frameBytes = uploads_.frameBytes(); // of what is destroyed, too
    state.totalBytes = uploads_.totalBytes();
    return state;
}

} // namespace supple::runtime
