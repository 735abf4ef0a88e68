// What takes part in frames, and the calls that all of it gets.
#pragma once

#include "gpu/device.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace supple::gpu {

/// What static data is on its way.
struct StaticCount {
    uint64_t number = 0;         ///< of the count, never 0: what stands in several lists counts once
    uint64_t frame = 0;          ///< the open one
    VkDeviceSize bytes = 0;      ///< in all
    VkDeviceSize left = 0;       ///< that no frame has uploaded yet
    VkDeviceSize frameBytes = 0; ///< that the open frame uploads
};

/// Whatever uploads something once, has kernels to warm up, or must know when frames end. Each overrides what it needs.
class FrameMember {
public:
    /// Whether something is due for recordStatics().
    [[nodiscard]] virtual bool staticsPending() const { return false; }
    /// Uploads and clears that are recorded once, as far as the frame's budget goes; the bytes. The caller puts the
    /// barrier after it, and sees to it that no other thread does the same: members may be shared.
    virtual VkDeviceSize recordStatics(VkCommandBuffer /*commandBuffer*/, uint64_t /*frame*/) { return 0; }
    /// Adds what it has to the count, unless it has counted already.
    virtual void countStatics(StaticCount& /*count*/) const {}
    /// There is no budget any more: takes the memory for what is due.
    [[nodiscard]] virtual Status stageStatics() { return success(); }
    /// Every kernel that frames may run, as dispatches of nothing.
    virtual void recordWarmUp(VkCommandBuffer /*commandBuffer*/) const {}
    /// A frame begins, and all up to `completedFrame` are complete.
    virtual void beginFrame(uint64_t /*completedFrame*/) {}
    /// The command buffers of `frame` will never run: what was recorded in it is due again.
    virtual void cancelFrame(uint64_t /*frame*/) {}

protected:
    FrameMember() = default;
    FrameMember(const FrameMember&) = default;
    FrameMember(FrameMember&&) = default;
    FrameMember& operator=(const FrameMember&) = default;
    FrameMember& operator=(FrameMember&&) = default;
    ~FrameMember() = default;
};

/// Passes every call on to all its members, in the order in which they came. One that stands in several lists gets a
/// call several times: the second time it does nothing.
class FrameMembers : public FrameMember {
public:
    FrameMembers() = default;
    FrameMembers(const FrameMembers&) = delete;
    FrameMembers& operator=(const FrameMembers&) = delete;

    [[nodiscard]] bool staticsPending() const override {
        return std::any_of(members_.begin(), members_.end(),
                           [](const FrameMember* member) { return member->staticsPending(); });
    }
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) override {
        VkDeviceSize bytes = 0;
        for (FrameMember* const member : members_) {
            bytes += member->recordStatics(commandBuffer, frame);
        }
        return bytes;
    }
    void countStatics(StaticCount& count) const override {
        for (const FrameMember* const member : members_) {
            member->countStatics(count);
        }
    }
    [[nodiscard]] Status stageStatics() override {
        Status status = success();
        for (FrameMember* const member : members_) {
            status = status ? member->stageStatics() : status;
        }
        return status;
    }
    void recordWarmUp(VkCommandBuffer commandBuffer) const override {
        for (const FrameMember* const member : members_) {
            member->recordWarmUp(commandBuffer);
        }
    }
    void beginFrame(uint64_t completedFrame) override {
        for (FrameMember* const member : members_) {
            member->beginFrame(completedFrame);
        }
    }
    void cancelFrame(uint64_t frame) override {
        for (FrameMember* const member : members_) {
            member->cancelFrame(frame);
        }
    }

protected:
    ~FrameMembers() = default;
    /// The member must outlive the list and stay where it is.
    void addMember(FrameMember& member) { members_.push_back(&member); }

private:
    std::vector<FrameMember*> members_;
};

} // namespace supple::gpu
