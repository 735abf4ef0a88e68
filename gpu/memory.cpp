#include "gpu/memory.h"

#include <algorithm>
#include <string>

namespace supple::gpu {

namespace {

constexpr uint32_t kNoType = 0xFFFFFFFFu;

uint32_t findMemoryType(const Device& device, uint32_t typeBits, VkMemoryPropertyFlags wanted) {
    for (uint32_t i = 0; i < device.memory.memoryTypeCount; ++i) {
        if ((typeBits & (1u << i)) != 0 && (device.memory.memoryTypes[i].propertyFlags & wanted) == wanted) {
            return i;
        }
    }
    return kNoType;
}

} // namespace

Result<BufferSet> BufferSet::create(const Device& device, std::span<const BufferRequest> requests, MemoryKind kind) {
    BufferSet set;
    set.device_ = &device;
    // Buffers share an allocation until it would exceed what the device allocates at once.
    std::vector<VkDeviceSize> ends; // one an allocation
    uint32_t typeBits = 0xFFFFFFFFu;
    for (const BufferRequest& request : requests) {
        Entry entry;
        if (request.size > 0) {
            const std::string what =
                std::string("buffer ") + request.name + " of " + std::to_string(request.size) + " bytes";
            if (request.size > device.maxBufferSize) {
                return Error{ErrorCode::limit,
                             what + ": the device's largest has " + std::to_string(device.maxBufferSize) + " bytes"};
            }
            VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
            info.size = request.size;
            info.usage = request.usage;
            VkBuffer buffer = VK_NULL_HANDLE;
            const VkResult result = device.vk.CreateBuffer(device.handle, &info, device.allocator, &buffer);
            if (result != VK_SUCCESS) {
                return vulkanError(result, what);
            }
            entry.handle = BufferHandle(device, buffer);
            device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer), request.name);
            VkMemoryRequirements needs;
            device.vk.GetBufferMemoryRequirements(device.handle, buffer, &needs);
            // Flushes round to the atom size: neighbours must not share one.
            const VkDeviceSize alignment = std::max(needs.alignment, device.limits.nonCoherentAtomSize);
            const auto roundUp = [&](VkDeviceSize value) { return (value + alignment - 1) / alignment * alignment; };
            if (roundUp(needs.size) > device.maxAllocationSize) {
                return Error{ErrorCode::limit, what + ": the device allocates at most " +
                                                   std::to_string(device.maxAllocationSize) + " bytes at once"};
            }
            if (ends.empty() || roundUp(ends.back()) + roundUp(needs.size) > device.maxAllocationSize) {
                ends.push_back(0);
            }
            entry.offset = roundUp(ends.back());
            entry.allocation = ends.size() - 1;
            ends.back() = entry.offset + roundUp(needs.size);
            typeBits &= needs.memoryTypeBits;
        }
        entry.size = request.size;
        set.buffers_.push_back(std::move(entry));
    }

    const char* name = requests.empty() ? "" : requests.front().name;
    uint32_t type = kNoType;
    if (kind == MemoryKind::upload) {
        type = findMemoryType(device, typeBits,
                              VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
        if (type == kNoType) {
            type = findMemoryType(device, typeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT);
        }
    } else {
        type = findMemoryType(device, typeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
        if (type == kNoType) {
            type = findMemoryType(device, typeBits, 0);
        }
    }
    if (type == kNoType) {
        return Error{ErrorCode::unsupported, std::string("buffer ") + name + ": no suitable memory type"};
    }
    set.coherent_ = (device.memory.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0;

    const VkDeviceSize heap = device.memory.memoryHeaps[device.memory.memoryTypes[type].heapIndex].size;
    for (const VkDeviceSize end : ends) {
        set.allocatedBytes_ += end;
        if (set.allocatedBytes_ > heap) {
            return Error{ErrorCode::deviceMemory, std::string("memory for ") + name +
                                                      " and its neighbours: more than the heap's " +
                                                      std::to_string(heap) + " bytes"};
        }
        VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        info.allocationSize = end;
        info.memoryTypeIndex = type;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkResult result = device.vk.AllocateMemory(device.handle, &info, device.allocator, &memory);
        if (result != VK_SUCCESS) {
            return vulkanError(result, std::string("memory for ") + name + " and its neighbours, " +
                                           std::to_string(end) + " bytes");
        }
        device.setName(VK_OBJECT_TYPE_DEVICE_MEMORY, reinterpret_cast<uint64_t>(memory), name);
        set.allocations_.push_back({MemoryHandle(device, memory), nullptr, end});
        if (kind == MemoryKind::upload) {
            void* mapped = nullptr;
            result = device.vk.MapMemory(device.handle, memory, 0, VK_WHOLE_SIZE, 0, &mapped);
            if (result != VK_SUCCESS) {
                return vulkanError(result, std::string("mapping ") + name);
            }
            set.allocations_.back().mapped = static_cast<std::byte*>(mapped);
        }
    }
    for (const Entry& entry : set.buffers_) {
        if (entry.size == 0) {
            continue;
        }
        const VkDeviceMemory memory = set.allocations_[entry.allocation].memory.get();
        const VkResult result = device.vk.BindBufferMemory(device.handle, entry.handle.get(), memory, entry.offset);
        if (result != VK_SUCCESS) {
            return vulkanError(result, std::string("binding memory of ") + name);
        }
    }
    return set;
}

Status BufferSet::flush(size_t index, VkDeviceSize offset, VkDeviceSize size) const {
    if (coherent_ || size == 0) {
        return success();
    }
    const VkDeviceSize atom = device_->limits.nonCoherentAtomSize;
    const VkDeviceSize first = (buffers_[index].offset + offset) / atom * atom;
    const VkDeviceSize last = (buffers_[index].offset + offset + size + atom - 1) / atom * atom;
    VkMappedMemoryRange range{VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE};
    range.memory = allocations_[buffers_[index].allocation].memory.get();
    range.offset = first;
    range.size = std::min(last, allocations_[buffers_[index].allocation].size) - first;
    const VkResult result = device_->vk.FlushMappedMemoryRanges(device_->handle, 1, &range);
    if (result != VK_SUCCESS) {
        return vulkanError(result, "flushing upload memory");
    }
    return success();
}

Result<BufferViewHandle> createTexelView(const Device& device, VkBuffer buffer, VkFormat format, VkDeviceSize offset,
                                         VkDeviceSize range, const char* name) {
    VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
    info.buffer = buffer;
    info.format = format;
    info.offset = offset;
    const VkDeviceSize texelBytes = format == VK_FORMAT_R32_UINT ? 4 : 16;
    info.range = std::min<VkDeviceSize>(range, device.limits.maxTexelBufferElements * texelBytes);
    VkBufferView view = VK_NULL_HANDLE;
    const VkResult result = device.vk.CreateBufferView(device.handle, &info, device.allocator, &view);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("texel view of ") + name);
    }
    device.setName(VK_OBJECT_TYPE_BUFFER_VIEW, reinterpret_cast<uint64_t>(view), name);
    return BufferViewHandle(device, view);
}

} // namespace supple::gpu
