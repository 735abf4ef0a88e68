#include "gpu/memory.h"

#include <algorithm>
#include <string>
#include <utility>

namespace supple::gpu {

namespace {

Result<BufferHandle> createBuffer(const Device& device, const BufferRequest& request, const std::string& what) {
    if (request.size > device.maxBufferSize) {
        return Error{ErrorCode::limit,
                     what + ": the device's largest has " + std::to_string(device.maxBufferSize) + " bytes"};
    }
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = request.size;
    info.usage = request.usage;
    if (device.mapping.sharesDispatches && (request.usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) != 0) {
        info.usage |= VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    }
    VkBuffer buffer = VK_NULL_HANDLE;
    const VkResult result = device.vk.CreateBuffer(device.handle, &info, device.allocator, &buffer);
    if (result != VK_SUCCESS) {
        return vulkanError(result, what);
    }
    device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer), request.name);
    return BufferHandle(device, buffer);
}

/// Refuses what no heap holds before the driver is asked.
Status checkHeap(const Device& device, VkDeviceSize bytes, const char* name) {
    VkDeviceSize heap = 0;
    for (uint32_t i = 0; i < device.memory.memoryHeapCount; ++i) {
        heap = std::max(heap, device.memory.memoryHeaps[i].size);
    }
    if (bytes > heap) {
        return Error{ErrorCode::deviceMemory, std::string("memory for ") + name + " and its neighbours, " +
                                                  std::to_string(bytes) + " bytes: more than the largest heap's " +
                                                  std::to_string(heap)};
    }
    return success();
}

/// Asks the host if the allocation would exceed its budget.
Status checkBudget(const Device& device, const MemoryRequest& wanted, const std::string& what) {
    const MemoryLedger& ledger = *device.ledger;
    MemoryRequest request = wanted;
    request.used = ledger.use.total();
    request.budget = ledger.budget;
    if (ledger.budget == 0 || request.used + request.bytes <= ledger.budget ||
        (ledger.allowsMore && ledger.allowsMore(request))) {
        return success();
    }
    return Error{ErrorCode::deviceMemory, what + ": the budget of " + std::to_string(request.budget) +
                                              " bytes, of which " + std::to_string(request.used) +
                                              " are in use, does not allow it"};
}

MemoryPurpose purposeOf(const BufferRequest& request, MemoryKind kind) {
    return kind == MemoryKind::deviceLocal ? request.purpose
           : kind == MemoryKind::upload    ? MemoryPurpose::staging
                                           : MemoryPurpose::readback;
}

} // namespace

DeviceMemory::~DeviceMemory() {
    if (piece_.memory.memory == VK_NULL_HANDLE) {
        return;
    }
    device_->ledger->use -= use_;
    if (piece_.block != nullptr) {
        device_->blocks->give(*device_, piece_);
    } else {
        freeHostMemory(*device_, piece_.memory);
    }
}

Result<DeviceMemory> DeviceMemory::allocate(const Device& device, const VkMemoryRequirements& requirements,
                                            MemoryKind kind, const char* name, const MemoryUse& use) {
    if (const MemoryBlocks::Piece shared = device.blocks->take(device, requirements, kind); shared.block != nullptr) {
        return DeviceMemory(device, shared, use);
    }
    const std::string what =
        std::string("memory for ") + name + " and its neighbours, " + std::to_string(requirements.size) + " bytes";
    if (Status allowed = checkBudget(device, {name, requirements.size, kind != MemoryKind::deviceLocal}, what);
        !allowed) {
        return allowed.error();
    }
    MemoryBlocks::Piece own;
    const Result<HostMemory> memory = allocateHostMemory(device, requirements, kind, name, what);
    if (!memory) {
        return memory.error();
    }
    own.memory = *memory;
    MemoryUse counted = use;
    ++counted.allocations;
    return DeviceMemory(device, own, counted);
}

Result<BufferSet> BufferSet::create(const Device& device, std::span<const BufferRequest> requests, MemoryKind kind) {
    BufferSet set;
    // Buffers share an allocation until it would exceed what the device allocates at once.
    std::vector<VkMemoryRequirements> pieces;
    std::vector<MemoryUse> uses; ///< of the pieces
    for (const BufferRequest& request : requests) {
        Entry& entry = set.buffers_.emplace_back();
        entry.size = request.size;
        if (request.size == 0) {
            continue;
        }
        const std::string what =
            std::string("buffer ") + request.name + " of " + std::to_string(request.size) + " bytes";
        Result<BufferHandle> buffer = createBuffer(device, request, what);
        if (!buffer) {
            return buffer.error();
        }
        entry.handle = std::move(*buffer);
        VkMemoryRequirements needs;
        device.vk.GetBufferMemoryRequirements(device.handle, entry.handle.get(), &needs);
        if (needs.size > device.maxAllocationSize) {
            return Error{ErrorCode::limit, what + ": the device allocates at most " +
                                               std::to_string(device.maxAllocationSize) + " bytes at once"};
        }
        if (pieces.empty() || roundUp(pieces.back().size, needs.alignment) + needs.size > device.maxAllocationSize) {
            pieces.push_back({0, 1, 0xFFFFFFFFu});
            uses.emplace_back();
        }
        VkMemoryRequirements& piece = pieces.back();
        entry.offset = roundUp(piece.size, needs.alignment);
        entry.allocation = pieces.size() - 1;
        uses.back().of(purposeOf(request, kind)) += entry.offset + needs.size - piece.size;
        piece.size = entry.offset + needs.size;
        piece.alignment = std::max(piece.alignment, needs.alignment);
        piece.memoryTypeBits &= needs.memoryTypeBits;
    }

    const char* name = requests.empty() ? "" : requests.front().name;
    VkDeviceSize bytes = 0;
    for (const VkMemoryRequirements& piece : pieces) {
        bytes += piece.size;
    }
    if (Status fits = checkHeap(device, bytes, name); !fits) {
        return fits.error();
    }
    for (size_t i = 0; i < pieces.size(); ++i) {
        Result<DeviceMemory> memory = DeviceMemory::allocate(device, pieces[i], kind, name, uses[i]);
        if (!memory) {
            return memory.error();
        }
        set.allocations_.push_back(std::move(*memory));
    }
    const VkResult result = set.bind(device);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("binding memory of ") + name);
    }
    return set;
}

BufferSet BufferSet::release() {
    BufferSet released = std::move(*this);
    allocations_.clear();
    buffers_.clear();
    buffers_.resize(released.buffers_.size());
    return released;
}

MemoryUse BufferSet::use() const {
    MemoryUse use;
    for (const DeviceMemory& memory : allocations_) {
        use += memory.use();
    }
    return use;
}

VkResult BufferSet::bind(const Device& device) const {
    for (const Entry& entry : buffers_) {
        if (entry.size == 0) {
            continue;
        }
        const HostMemory& piece = allocations_[entry.allocation].piece();
        const VkResult result =
            device.vk.BindBufferMemory(device.handle, entry.handle.get(), piece.memory, piece.offset + entry.offset);
        if (result != VK_SUCCESS) {
            return result;
        }
    }
    return VK_SUCCESS;
}

Result<BufferViewHandle> createTexelView(const Device& device, VkBuffer buffer, VkFormat format, VkDeviceSize offset,
                                         VkDeviceSize range, const char* name) {
    VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
    info.buffer = buffer;
    info.format = format;
    info.offset = offset;
    const VkDeviceSize texelBytes = format == VK_FORMAT_R32_UINT ? 4 : format == VK_FORMAT_R32G32_UINT ? 8 : 16;
    info.range = std::min<VkDeviceSize>(range, device.limits.maxTexelBufferElements * texelBytes);
    VkBufferView view = VK_NULL_HANDLE;
    const VkResult result = device.vk.CreateBufferView(device.handle, &info, device.allocator, &view);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("texel view of ") + name);
    }
    device.setName(VK_OBJECT_TYPE_BUFFER_VIEW, reinterpret_cast<uint64_t>(view), name);
    return BufferViewHandle(device, view);
}

VkBufferView TexelViews::make(const Device& device, VkBuffer buffer, VkFormat format, VkDeviceSize offset,
                              VkDeviceSize range, const char* name, Status& status) {
    if (!status) {
        return VK_NULL_HANDLE;
    }
    Result<BufferViewHandle> made = createTexelView(device, buffer, format, offset, range, name);
    if (!made) {
        status = made.error();
        return VK_NULL_HANDLE;
    }
    views_.push_back(std::move(*made));
    return views_.back().get();
}

} // namespace supple::gpu
