// How the dispatches of surface passes reach a command buffer: one by one, or shared between groups (gpu/tasks.h).
#pragma once

#include "gpu/barriers.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "shaders/shared/tasks.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace supple::gpu {

/// What a task binds: the address of a buffer by binding, 0 where there is none. It stays where it is while it is in
/// use.
struct TaskBuffers {
    std::array<VkDeviceAddress, shared::kTaskBindings> at{};
    uint64_t writtenIn = 0;    ///< the recording whose memory has them
    VkDeviceAddress where = 0; ///< in it
};

/// What a dispatch binds: the one that its device's mapping takes.
struct BoundSet {
    VkDescriptorSet set = VK_NULL_HANDLE;
    TaskBuffers* buffers = nullptr;
};

/// Takes the dispatches of a command buffer. Allocates nothing.
class Dispatches {
public:
    Dispatches(const Device& device, VkCommandBuffer commandBuffer) : device_(&device), commandBuffer_(commandBuffer) {}
    virtual ~Dispatches() = default;
    Dispatches(const Dispatches&) = delete;
    Dispatches& operator=(const Dispatches&) = delete;

    /// At least `groups` workgroups (dispatchLinear). They may be recorded as late as the next flush().
    virtual void dispatch(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                          uint64_t groups) = 0;
    template <class Push>
    void dispatch(const Kernel& kernel, const BoundSet& bound, const Push& push, uint64_t groups) {
        dispatch(kernel, bound, std::as_bytes(std::span(&push, 1)), groups);
    }
    /// Whether dispatches of no workgroups are to come too, though nothing is to be done: the tasks of later frames
    /// find places so (gpu/kept_tasks.h).
    [[nodiscard]] virtual bool takesEmpty() const { return false; }
    /// As many workgroups as the three words there say.
    virtual void dispatchIndirect(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                                  VkBuffer arguments, VkDeviceSize offset) = 0;
    /// Whose dispatches come next, by a number of the caller's (gpu/kept_tasks.h).
    virtual void setOwner(uint32_t /*owner*/) {}
    /// Records what was dispatched since the last time.
    virtual void flush() = 0;
    /// To be called when the device has written sizes, behind a barrier. Until the next call, dispatchIndirect() is
    /// told of these sizes alone. What the call records itself has its own barrier.
    virtual void count() {}

    /// gpu::computeBarrier and gpu::disjointBarrier, behind all that was dispatched.
    virtual void computeBarrier() {
        flush();
        gpu::computeBarrier(*device_, commandBuffer_);
    }
    void disjointBarrier() { gpu::disjointBarrier(*device_, commandBuffer_); } // nothing waits in the narrow mapping

    [[nodiscard]] const Device& device() const { return *device_; }
    [[nodiscard]] VkCommandBuffer commandBuffer() const { return commandBuffer_; }

private:
    const Device* device_;
    VkCommandBuffer commandBuffer_;
};

/// Each by itself, with its descriptor set.
class SingleDispatches final : public Dispatches {
public:
    using Dispatches::Dispatches;
    void dispatch(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                  uint64_t groups) override;
    void dispatchIndirect(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                          VkBuffer arguments, VkDeviceSize offset) override;
    void flush() override {}
};

} // namespace supple::gpu
