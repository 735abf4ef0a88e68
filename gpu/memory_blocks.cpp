#include "gpu/memory_blocks.h"

#include "gpu/device.h"

#include <algorithm>
#include <cstddef>

namespace supple::gpu {

namespace {

constexpr VkDeviceSize kBlockAlignment = 65536; ///< as much as buffers ask for anywhere
constexpr VkDeviceSize kFirstBlock = VkDeviceSize{8} << 20;
constexpr VkDeviceSize kFirstVisibleBlock = VkDeviceSize{1} << 20;
constexpr VkDeviceSize kGrowth = 2;    ///< beside all before it together
constexpr VkDeviceSize kHeapShare = 8; ///< a block takes at most such a part of the largest heap

VkDeviceSize largestBlock(const Device& device) {
    VkDeviceSize heap = 0;
    for (uint32_t i = 0; i < device.memory.memoryHeapCount; ++i) {
        heap = std::max(heap, device.memory.memoryHeaps[i].size);
    }
    return std::min({device.memoryBlockSize, heap / kHeapShare, device.maxAllocationSize});
}

VkDeviceSize& spareOf(const Device& device, MemoryKind kind) {
    return device.ledger->use.of(kind == MemoryKind::deviceLocal ? MemoryPurpose::spare : MemoryPurpose::spareVisible);
}

} // namespace

VkDeviceSize MemoryBlocks::nextSize(const Device& device, const VkMemoryRequirements& requirements,
                                    MemoryKind kind) const {
    VkDeviceSize size = 0; // of those before it
    for (const Block& block : blocks_) {
        size += block.serves(requirements, kind) ? block.ranges.size() : 0;
    }
    size = std::max(
        {kGrowth * size, requirements.size, kind == MemoryKind::deviceLocal ? kFirstBlock : kFirstVisibleBlock});
    size = std::min(size, largestBlock(device)) / kBlockAlignment * kBlockAlignment;
    const MemoryLedger& ledger = *device.ledger;
    const bool allowed = ledger.budget == 0 || ledger.use.total() + size <= ledger.budget;
    return allowed && size >= requirements.size ? size : 0;
}

MemoryBlocks::Piece MemoryBlocks::takeOf(Block& block, const Device& device, const VkMemoryRequirements& requirements) {
    const std::optional<uint64_t> offset = block.ranges.take(requirements.size, requirements.alignment);
    if (!offset) {
        return {};
    }
    Piece piece{block.memory, &block, *offset, requirements.size};
    piece.memory.offset += *offset;
    if (piece.memory.mapped != nullptr) {
        piece.memory.mapped = static_cast<std::byte*>(piece.memory.mapped) + *offset;
    }
    spareOf(device, block.kind) -= requirements.size;
    return piece;
}

MemoryBlocks::Piece MemoryBlocks::takeOfNew(const Device& device, const VkMemoryRequirements& requirements,
                                            MemoryKind kind) {
    const VkDeviceSize size = nextSize(device, requirements, kind);
    if (size == 0) {
        return {};
    }
    // What may throw comes before there is memory to lose: a new block has room for its first piece.
    std::list<Block> made;
    made.push_back({{}, FreeRanges(size), kind, requirements.memoryTypeBits});
    const VkMemoryRequirements wanted{size, kBlockAlignment, requirements.memoryTypeBits};
    const Result<HostMemory> memory = allocateHostMemory(device, wanted, kind, "supple block", "a block of memory");
    if (!memory) {
        return {};
    }
    made.back().memory = *memory;
    spareOf(device, kind) += size;
    ++device.ledger->use.allocations;
    blocks_.splice(blocks_.end(), made);
    return takeOf(blocks_.back(), device, requirements);
}

MemoryBlocks::Piece MemoryBlocks::take(const Device& device, const VkMemoryRequirements& requirements,
                                       MemoryKind kind) {
    if (requirements.size > largestBlock(device) / 2 || requirements.alignment > kBlockAlignment) {
        return {};
    }
    for (Block& block : blocks_) {
        if (block.serves(requirements, kind)) {
            if (const Piece piece = takeOf(block, device, requirements); piece.block != nullptr) {
                return piece;
            }
        }
    }
    return takeOfNew(device, requirements, kind);
}

void MemoryBlocks::give(const Device& device, const Piece& piece) noexcept {
    Block& block = *piece.block;
    block.ranges.give(piece.offset, piece.bytes);
    spareOf(device, block.kind) += piece.bytes;
    if (!block.ranges.isWhole()) {
        return;
    }
    spareOf(device, block.kind) -= block.ranges.size();
    --device.ledger->use.allocations;
    freeHostMemory(device, block.memory);
    blocks_.remove_if([&](const Block& other) { return &other == &block; });
}

} // namespace supple::gpu
