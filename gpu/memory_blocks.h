// Device memory by the block: few large allocations, which many small pieces share.
#pragma once

#include "gpu/free_ranges.h"
#include "gpu/host_memory.h"

#include <list>

namespace supple::gpu {

struct Device;

/// Blocks grow: each is twice as large as all before it together, up to a limit. So there are few, and at most about
/// two thirds is spare. A block goes back when nothing is in it. One thread at a time.
class MemoryBlocks {
    struct Block {
        HostMemory memory;
        FreeRanges ranges;
        MemoryKind kind = MemoryKind::deviceLocal;
        uint32_t typeBits = 0;

        [[nodiscard]] bool serves(const VkMemoryRequirements& requirements, MemoryKind of) const {
            return kind == of && typeBits == requirements.memoryTypeBits;
        }
    };

public:
    /// A piece of a block. Empty: there is none.
    struct Piece {
        HostMemory memory; ///< with the piece's own offset and mapping
        Block* block = nullptr;
        VkDeviceSize offset = 0; ///< in the block
        VkDeviceSize bytes = 0;
    };

    /// Empty: the piece needs memory of its own, as it is large beside a block, or as there is no memory for a block or
    /// none in the budget.
    [[nodiscard]] Piece take(const Device& device, const VkMemoryRequirements& requirements, MemoryKind kind);
    void give(const Device& device, const Piece& piece) noexcept;

private:
    /// 0: no block, as it would exceed the budget or be too small.
    [[nodiscard]] VkDeviceSize nextSize(const Device& device, const VkMemoryRequirements& requirements,
                                        MemoryKind kind) const;
    [[nodiscard]] static Piece takeOf(Block& block, const Device& device, const VkMemoryRequirements& requirements);
    [[nodiscard]] Piece takeOfNew(const Device& device, const VkMemoryRequirements& requirements, MemoryKind kind);

    std::list<Block> blocks_; ///< pieces have their addresses
};

} // namespace supple::gpu
