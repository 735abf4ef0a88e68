// Buffers that live and die together, in as few pieces of device memory as the device allows: one, unless they are
// huge.
#pragma once

#include "base/result.h"
#include "gpu/handle.h"
#include "gpu/memory_blocks.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace supple::gpu {

/// What most buffers hold: four words of 32 bits, read whole.
inline constexpr VkDeviceSize kVec4Bytes = 16;
inline constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT, kUint4 = VK_FORMAT_R32G32B32A32_UINT;

/// The first multiple of `alignment` from `value` on.
constexpr VkDeviceSize roundUp(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

struct BufferRequest {
    const char* name = ""; ///< for debuggers and messages
    VkDeviceSize size = 0; ///< 0 leaves the buffer out: its handle is null
    VkBufferUsageFlags usage = 0;
    MemoryPurpose purpose = MemoryPurpose::lists; ///< of device-local memory; the other kinds are their own purpose
};

/// A piece of device memory: of a block, or an allocation of its own, which is freed the way it came.
class DeviceMemory {
public:
    DeviceMemory() = default;
    DeviceMemory(DeviceMemory&& other) noexcept
        : device_(std::exchange(other.device_, nullptr)), piece_(std::exchange(other.piece_, {})),
          use_(std::exchange(other.use_, {})) {}
    DeviceMemory& operator=(DeviceMemory&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(piece_, other.piece_);
        std::swap(use_, other.use_);
        return *this;
    }
    ~DeviceMemory();

    [[nodiscard]] static Result<DeviceMemory> allocate(const Device& device, const VkMemoryRequirements& requirements,
                                                       MemoryKind kind, const char* name, const MemoryUse& use);
    [[nodiscard]] const HostMemory& piece() const { return piece_.memory; }
    [[nodiscard]] const MemoryUse& use() const { return use_; }

private:
    DeviceMemory(const Device& device, const MemoryBlocks::Piece& piece, const MemoryUse& use)
        : device_(&device), piece_(piece), use_(use) {
        device.ledger->use += use;
    }
    const Device* device_ = nullptr;
    MemoryBlocks::Piece piece_;
    MemoryUse use_;
};

/// Buffers in the order of the requests, every offset aligned as its buffer needs.
class BufferSet {
public:
    [[nodiscard]] static Result<BufferSet> create(const Device& device, std::span<const BufferRequest> requests,
                                                  MemoryKind kind);

    BufferSet() = default;
    BufferSet(BufferSet&&) noexcept = default;
    BufferSet& operator=(BufferSet&&) noexcept = default;

    /// All that it has. Its buffers are null and have no bytes from then on.
    [[nodiscard]] BufferSet release();

    [[nodiscard]] VkBuffer buffer(size_t index) const { return buffers_[index].handle.get(); }
    [[nodiscard]] VkDeviceSize size(size_t index) const { return buffers_[index].size; }
    /// What is allocated, alignment included: each byte counts for the buffer that it, or the gap before it, is for.
    [[nodiscard]] MemoryUse use() const;
    /// Mapped bytes of an upload or readback buffer.
    [[nodiscard]] std::byte* mapped(size_t index) const {
        const HostMemory& piece = allocations_[buffers_[index].allocation].piece();
        return static_cast<std::byte*>(piece.mapped) + buffers_[index].offset;
    }

private:
    struct Entry {
        BufferHandle handle;
        VkDeviceSize size = 0;
        VkDeviceSize offset = 0; ///< in its allocation
        size_t allocation = 0;
    };
    [[nodiscard]] VkResult bind(const Device& device) const;

    std::vector<DeviceMemory> allocations_; // declared before the buffers: destroyed after them
    std::vector<Entry> buffers_;
};

/// A uniform texel view of a part of a buffer.
[[nodiscard]] Result<BufferViewHandle> createTexelView(const Device& device, VkBuffer buffer, VkFormat format,
                                                       VkDeviceSize offset, VkDeviceSize range, const char* name);

/// The texel views that some descriptor sets bind.
class TexelViews {
public:
    /// Null where `status` is an error, be it of an earlier call or of this one.
    [[nodiscard]] VkBufferView make(const Device& device, VkBuffer buffer, VkFormat format, VkDeviceSize offset,
                                    VkDeviceSize range, const char* name, Status& status);

private:
    std::vector<BufferViewHandle> views_;
};

} // namespace supple::gpu
