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
    VkDeviceSize end = 0;
    uint32_t typeBits = 0xFFFFFFFFu;
    for (const BufferRequest& request : requests) {
        Entry entry;
        if (request.size > 0) {
            VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
            info.size = request.size;
            info.usage = request.usage;
            VkBuffer buffer = VK_NULL_HANDLE;
            const VkResult result = device.vk.CreateBuffer(device.handle, &info, device.allocator, &buffer);
            if (result != VK_SUCCESS) {
                return vulkanError(result, std::string("buffer ") + request.name + " of " +
                                               std::to_string(request.size) + " bytes");
            }
            entry.handle = BufferHandle(device, buffer);
            device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer), request.name);
            VkMemoryRequirements needs;
            device.vk.GetBufferMemoryRequirements(device.handle, buffer, &needs);
            // Flushes round to the atom size: neighbours must not share one.
            const VkDeviceSize alignment = std::max(needs.alignment, device.limits.nonCoherentAtomSize);
            entry.offset = (end + alignment - 1) / alignment * alignment;
            end = entry.offset + needs.size;
            typeBits &= needs.memoryTypeBits;
        }
        entry.size = request.size;
        set.buffers_.push_back(std::move(entry));
    }
    if (end == 0) {
        return set;
    }

    const char* name = requests.front().name;
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

    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    const VkDeviceSize atom = std::max<VkDeviceSize>(device.limits.nonCoherentAtomSize, 1);
    info.allocationSize = (end + atom - 1) / atom * atom;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkResult result = device.vk.AllocateMemory(device.handle, &info, device.allocator, &memory);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("memory for ") + name + " and its neighbours, " +
                                       std::to_string(info.allocationSize) + " bytes");
    }
    set.memory_ = MemoryHandle(device, memory);
    set.allocatedBytes_ = info.allocationSize;
    device.setName(VK_OBJECT_TYPE_DEVICE_MEMORY, reinterpret_cast<uint64_t>(memory), name);
    for (const Entry& entry : set.buffers_) {
        if (entry.size == 0) {
            continue;
        }
        result = device.vk.BindBufferMemory(device.handle, entry.handle.get(), memory, entry.offset);
        if (result != VK_SUCCESS) {
            return vulkanError(result, std::string("binding memory of ") + name);
        }
    }
    if (kind == MemoryKind::upload) {
        void* mapped = nullptr;
        result = device.vk.MapMemory(device.handle, memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (result != VK_SUCCESS) {
            return vulkanError(result, std::string("mapping ") + name);
        }
        set.mapped_ = static_cast<std::byte*>(mapped);
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
    range.memory = memory_.get();
    range.offset = first;
    range.size = std::min(last, allocatedBytes_) - first;
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
