// Buffers that live and die together, in as few device allocations as the device allows: one, unless they are huge.
#pragma once

#include "base/result.h"
#include "gpu/handle.h"

#include <cstddef>
#include <span>
#include <vector>

namespace supple::gpu {

struct BufferRequest {
    const char* name = ""; ///< for debuggers and messages
    VkDeviceSize size = 0; ///< 0 leaves the buffer out: its handle is null
    VkBufferUsageFlags usage = 0;
};

enum class MemoryKind {
    deviceLocal, ///< never mapped
    upload,      ///< host visible, mapped for its whole life
};

/// Buffers in the order of the requests, every offset aligned as its buffer needs.
class BufferSet {
public:
    [[nodiscard]] static Result<BufferSet> create(const Device& device, std::span<const BufferRequest> requests,
                                                  MemoryKind kind);

    BufferSet() = default;
    BufferSet(BufferSet&&) noexcept = default;
    BufferSet& operator=(BufferSet&&) noexcept = default;

    [[nodiscard]] VkBuffer buffer(size_t index) const { return buffers_[index].handle.get(); }
    [[nodiscard]] VkDeviceSize size(size_t index) const { return buffers_[index].size; }
    [[nodiscard]] VkDeviceSize allocatedBytes() const { return allocatedBytes_; }
    /// Mapped bytes of an upload buffer.
    [[nodiscard]] std::byte* mapped(size_t index) const {
        return allocations_[buffers_[index].allocation].mapped + buffers_[index].offset;
    }
    /// Makes host writes to [offset, offset + size) of an upload buffer visible; nothing where memory is coherent.
    [[nodiscard]] Status flush(size_t index, VkDeviceSize offset, VkDeviceSize size) const;

private:
    struct Entry {
        BufferHandle handle;
        VkDeviceSize size = 0;
        VkDeviceSize offset = 0; ///< in its allocation
        size_t allocation = 0;
    };
    struct Allocation {
        MemoryHandle memory;
        std::byte* mapped = nullptr;
        VkDeviceSize size = 0;
    };
    const Device* device_ = nullptr;
    std::vector<Allocation> allocations_; // declared before the buffers: destroyed after them
    std::vector<Entry> buffers_;
    bool coherent_ = true;
    VkDeviceSize allocatedBytes_ = 0;
};

/// A uniform texel view of a part of a buffer.
[[nodiscard]] Result<BufferViewHandle> createTexelView(const Device& device, VkBuffer buffer, VkFormat format,
                                                       VkDeviceSize offset, VkDeviceSize range, const char* name);

} // namespace supple::gpu
