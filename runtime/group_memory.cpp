// Memory that a group gives back while none of its instances is drawn (SuppleGroupDesc.keepUnseenFrames).
#include "runtime/context.h"

namespace supple::runtime {

bool Group::findsInstance() {
    if (outOfSight_.isAskedFor()) {
        boxes_.find(slots(), poses());
        if (findUnseen()) {
            listing_.noteUnseenChanged(); // recordUpload() will not find it again
        }
    }
    for (uint32_t slot = 0; slot < slots().end(); ++slot) {
        if (slots().shows(slot) && !(outOfSight_.isAskedFor() && outOfSight_.holds(slot))) {
            return true;
        }
    }
    return false;
}

uint32_t Group::unposed() const {
    if (!leftOutAll_) {
        return outOfSight_.count();
    }
    uint32_t shown = 0;
    for (uint32_t slot = 0; slot < instances_->slots().end(); ++slot) {
        shown += instances_->slots().shows(slot) ? 1 : 0;
    }
    return shown;
}

void Group::giveSurfaces(uint64_t frame) {
    surfaceBuffers_.give(frame);
    listing_.leaveOutAll(true);
    for (const auto& surface : surfaces_) {
        surface->giveBuffers();
    }
}

void Group::freeSurfaces() {
    for (const auto& surface : surfaces_) {
        surface->freeSets();
    }
    points_.unbindVertices();
    hashes_ = nullptr; // its sets name the buffers
    hashed_.clear();
    surfaceBuffers_.free();
}

Status Group::remakeSurfaces() {
    Status status = success();
    for (const auto& surface : surfaces_) {
        status = status ? surface->remakeSets() : status;
    }
    status = status ? points_.bindVertices() : status;
    staticsThere_ = false; // buffers are zeroed once more
    return status;
}

Status Group::takeSurfaces(uint64_t frame, const std::shared_ptr<const StageHashes>& hashes) {
    const bool freed = surfaceBuffers_.areFreed();
    if (Status taken = surfaceBuffers_.take(*device_); !taken) {
        return taken;
    }
    Status status = freed ? remakeSurfaces() : success();
    status = status && hashes != nullptr ? createHashes(hashes) : status;
    if (!status) {
        surfaceBuffers_.give(frame);
        if (freed) { // nothing has used the new ones
            freeSurfaces();
        }
        return status;
    }
    for (const auto& surface : surfaces_) {
        surface->takeBuffers();
    }
    listing_.leaveOutAll(false);
    lackTold_ = false;
    return status;
}

Result<bool> Group::fitMemory(uint64_t frame, uint64_t completedFrame,
                              const std::shared_ptr<const StageHashes>& hashes) {
    const bool wanted = surfaceBuffers_.areThere() && !surfaceBuffers_.areIdle();
    if (!surfaceBuffers_.mayGo() || wanted) {
        return false;
    }
    const bool keeps = (!follows() && drawnElsewhere()) || findsInstance();
    if (surfaceBuffers_.areThere()) {
        if (keeps || lacksStatics()) { // the next frame zeroes them for one that was cancelled
            return false;
        }
        giveSurfaces(frame);
        return true;
    }
    if (keeps) {
        const Status taken = takeSurfaces(frame, hashes);
        return taken ? Result<bool>(true) : taken.error();
    }
    if (surfaceBuffers_.mayBeFreed(completedFrame)) {
        freeSurfaces();
    }
    return false;
}

Status Context::fitMemory(Group& group) {
    const Result<bool> changed = group.fitMemory(frame_, completedFrame_, hashes_);
    if (changed && *changed) {
        group.noteBuffersChanged(++groupsMade_);
    }
    return changed ? success() : Status(changed.error());
}

void Context::fitMemory() {
    groups.forEach([&](Group& group) {
        if (isOrphan(group)) {
            return;
        }
        if (const Status fits = fitMemory(group); !fits && group.lacksMemoryAnew()) {
            log(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_DEVICE_MEMORY,
                group.asset().character.name +
                    ": nothing of the group is drawn, as there is no memory for what it has given back: " +
                    fits.error().message);
        }
    });
}

} // namespace supple::runtime
