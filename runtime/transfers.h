// The buffers that a frame hands from the compute queue family to the one that draws.
#pragma once

#include "gpu/barriers.h"

#include <array>
#include <cstdint>
#include <span>

namespace supple::runtime {

/// The two queue families of a context with SUPPLE_CONTEXT_ASYNC_COMPUTE.
struct QueueFamilies {
    uint32_t compute = VK_QUEUE_FAMILY_IGNORED, draw = VK_QUEUE_FAMILY_IGNORED;
};

/// What a group and its view hand over, buffer by buffer. Nothing is kept, so there may be any number of them.
class Transfers {
public:
    /// Null handles are passed over. `size` bytes from `offset` on change hands.
    void add(VkBuffer buffer, VkDeviceSize offset = 0, VkDeviceSize size = VK_WHOLE_SIZE);

protected:
    explicit Transfers(QueueFamilies families) : families_(families) {}
    Transfers(const Transfers&) = default;
    Transfers& operator=(const Transfers&) = default;
    ~Transfers() = default;

    /// What changes hands, in a barrier without scopes.
    template <class Barrier>
    void fill(Barrier& barrier, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) const {
        barrier.srcQueueFamilyIndex = families_.compute;
        barrier.dstQueueFamilyIndex = families_.draw;
        barrier.buffer = buffer;
        barrier.offset = offset;
        barrier.size = size;
    }

private:
    virtual void take(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) = 0;

    QueueFamilies families_;
};

/// Records the release of each buffer, some at a time. Allocates nothing.
class Releases final : public Transfers {
public:
    static constexpr size_t kAtOnce = 64; ///< barriers of a call; most groups have fewer

    Releases(const gpu::Device& device, VkCommandBuffer commandBuffer, QueueFamilies families, gpu::SyncScope after)
        : Transfers(families), device_(device), commandBuffer_(commandBuffer), after_(basic(after)) {}
    Releases(const Releases&) = delete;
    Releases& operator=(const Releases&) = delete;
    ~Releases() { flush(); }

private:
    void take(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) override;
    void flush();

    const gpu::Device& device_;
    VkCommandBuffer commandBuffer_;
    gpu::BasicScope after_;
    std::array<VkBufferMemoryBarrier, kAtOnce> barriers_{};
    uint32_t count_ = 0;
};

/// Writes the barrier that acquires each buffer into `out`, and counts those that do not fit as well.
class Acquires final : public Transfers {
public:
    Acquires(QueueFamilies families, gpu::SyncScope use, std::span<VkBufferMemoryBarrier2> out)
        : Transfers(families), use_(use), out_(out) {}

    [[nodiscard]] uint32_t count() const { return count_; }

private:
    void take(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) override;

    gpu::SyncScope use_;
    std::span<VkBufferMemoryBarrier2> out_;
    uint32_t count_ = 0;
};

} // namespace supple::runtime
