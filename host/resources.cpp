// Buffers and images of the host device: one allocation each, which is all that tools and tests need.
#include "host/device.h"
#include "host/vk_struct.h"

#include <cstring>
#include <utility>

namespace supple::host {

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    if (this != &other) {
        reset();
        device_ = std::exchange(other.device_, VK_NULL_HANDLE);
        buffer_ = std::exchange(other.buffer_, VK_NULL_HANDLE);
        memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
        size_ = std::exchange(other.size_, 0);
        mapped_ = std::exchange(other.mapped_, nullptr);
    }
    return *this;
}

void Buffer::reset() {
    if (device_ == VK_NULL_HANDLE)
        return;
    vkDestroyBuffer(device_, buffer_, nullptr);
    vkFreeMemory(device_, memory_, nullptr);
    device_ = VK_NULL_HANDLE;
    buffer_ = VK_NULL_HANDLE;
    memory_ = VK_NULL_HANDLE;
    size_ = 0;
    mapped_ = nullptr;
}

VkDeviceAddress Buffer::address() const {
    auto info = vkStruct<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
    info.buffer = buffer_;
    return vkGetBufferDeviceAddress(device_, &info);
}

Image& Image::operator=(Image&& other) noexcept {
    if (this != &other) {
        reset();
        device_ = std::exchange(other.device_, VK_NULL_HANDLE);
        image_ = std::exchange(other.image_, VK_NULL_HANDLE);
        memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
        view_ = std::exchange(other.view_, VK_NULL_HANDLE);
        desc_ = std::exchange(other.desc_, {});
    }
    return *this;
}

void Image::reset() {
    if (device_ == VK_NULL_HANDLE)
        return;
    vkDestroyImageView(device_, view_, nullptr);
    vkDestroyImage(device_, image_, nullptr);
    vkFreeMemory(device_, memory_, nullptr);
    device_ = VK_NULL_HANDLE;
    image_ = VK_NULL_HANDLE;
    memory_ = VK_NULL_HANDLE;
    view_ = VK_NULL_HANDLE;
}

Result<VkDeviceMemory> Device::allocate(const VkMemoryRequirements& requirements, MemoryKind kind, bool addressed) {
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkMemoryPropertyFlags needed = 0;
    VkMemoryPropertyFlags preferred = 0;
    switch (kind) {
    case MemoryKind::device:
        preferred = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        break;
    case MemoryKind::upload:
        needed = kMapped;
        break;
    case MemoryKind::readback:
        needed = kMapped;
        preferred = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
        break;
    }
    for (const VkMemoryPropertyFlags flags : {needed | preferred, needed}) {
        for (uint32_t i = 0; i < memoryProperties_.memoryTypeCount; ++i) {
            const bool allowed = (requirements.memoryTypeBits & (1u << i)) != 0;
            if (!allowed || (memoryProperties_.memoryTypes[i].propertyFlags & flags) != flags)
                continue;
            auto info = vkStruct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
            info.allocationSize = requirements.size;
            info.memoryTypeIndex = i;
            auto addresses = vkStruct<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
            addresses.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
            info.pNext = addressed ? &addresses : nullptr;
            VkDeviceMemory memory = VK_NULL_HANDLE;
            if (const VkResult result = vkAllocateMemory(device_, &info, nullptr, &memory); result != VK_SUCCESS)
                return vulkanError(result, "allocating " + std::to_string(requirements.size) + " bytes");
            return memory;
        }
    }
    return Error{ErrorCode::unsupported, "the device has no memory type for this use"};
}

Result<Buffer> Device::createBuffer(VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind) {
    Buffer buffer;
    buffer.device_ = device_;
    buffer.size_ = size;
    auto info = vkStruct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = size;
    info.usage = usage;
    if (const VkResult result = vkCreateBuffer(device_, &info, nullptr, &buffer.buffer_); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateBuffer");
    VkMemoryRequirements requirements{};
    vkGetBufferMemoryRequirements(device_, buffer.buffer_, &requirements);
    const bool addressed = (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
    Result<VkDeviceMemory> memory = allocate(requirements, kind, addressed);
    if (!memory)
        return memory.error();
    buffer.memory_ = *memory;
    if (const VkResult result = vkBindBufferMemory(device_, buffer.buffer_, buffer.memory_, 0); result != VK_SUCCESS)
        return vulkanError(result, "vkBindBufferMemory");
    if (kind != MemoryKind::device) {
        if (const VkResult result = vkMapMemory(device_, buffer.memory_, 0, VK_WHOLE_SIZE, 0, &buffer.mapped_);
            result != VK_SUCCESS)
            return vulkanError(result, "vkMapMemory");
    }
    return buffer;
}

Result<Image> Device::createImage(const ImageDesc& desc) {
    Image image;
    image.device_ = device_;
    image.desc_ = desc;
    auto info = vkStruct<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = desc.format;
    info.extent = {desc.extent.width, desc.extent.height, 1};
    info.mipLevels = desc.mipLevels;
    info.arrayLayers = desc.layers;
    info.samples = desc.samples;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = desc.usage;
    if (const VkResult result = vkCreateImage(device_, &info, nullptr, &image.image_); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateImage");
    VkMemoryRequirements requirements{};
    vkGetImageMemoryRequirements(device_, image.image_, &requirements);
    Result<VkDeviceMemory> memory = allocate(requirements, MemoryKind::device);
    if (!memory)
        return memory.error();
    image.memory_ = *memory;
    if (const VkResult result = vkBindImageMemory(device_, image.image_, image.memory_, 0); result != VK_SUCCESS)
        return vulkanError(result, "vkBindImageMemory");
    auto viewInfo = vkStruct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    viewInfo.image = image.image_;
    viewInfo.viewType = desc.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.format = desc.format;
    viewInfo.subresourceRange = {desc.aspect, 0, desc.mipLevels, 0, desc.layers};
    if (const VkResult result = vkCreateImageView(device_, &viewInfo, nullptr, &image.view_); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateImageView");
    return image;
}

namespace {

/// By what Vulkan 1.1 has: buffers are read back from such devices too (DeviceOptions::onlyCompute).
void copyBarrier(VkCommandBuffer commands, VkPipelineStageFlags before, VkAccessFlags written,
                 VkPipelineStageFlags after, VkAccessFlags read) {
    auto barrier = vkStruct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = written;
    barrier.dstAccessMask = read;
    vkCmdPipelineBarrier(commands, before, after, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

} // namespace

Result<std::vector<std::byte>> Device::readBuffer(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    std::vector<std::byte> bytes(size);
    if (size == 0)
        return bytes;
    Result<Buffer> staging = createBuffer(size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback);
    if (!staging)
        return staging.error();
    const Status status = submitAndWait([&](VkCommandBuffer commands) {
        copyBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_ACCESS_MEMORY_WRITE_BIT,
                    VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT);
        const VkBufferCopy region{offset, 0, size};
        vkCmdCopyBuffer(commands, buffer, staging->handle(), 1, &region);
        copyBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                    VK_ACCESS_HOST_READ_BIT);
    });
    if (!status)
        return status.error();
    std::memcpy(bytes.data(), staging->mapped(), size);
    return bytes;
}

Result<Buffer> Device::uploadBuffer(const void* bytes, VkDeviceSize size, VkBufferUsageFlags usage) {
    Result<Buffer> staging = createBuffer(size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload);
    if (!staging)
        return staging.error();
    std::memcpy(staging->mapped(), bytes, size);
    Result<Buffer> buffer = createBuffer(size, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::device);
    if (!buffer)
        return buffer.error();
    const Status status = submitAndWait([&](VkCommandBuffer commands) {
        const VkBufferCopy region{0, 0, size};
        vkCmdCopyBuffer(commands, staging->handle(), buffer->handle(), 1, &region);
        memoryBarrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                      {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT});
    });
    if (!status)
        return status.error();
    return buffer;
}

void memoryBarrier(VkCommandBuffer commands, SuppleSyncScope before, SuppleSyncScope after) {
    auto barrier = vkStruct<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
    barrier.srcStageMask = before.stages;
    barrier.srcAccessMask = before.access;
    barrier.dstStageMask = after.stages;
    barrier.dstAccessMask = after.access;
    auto dependency = vkStruct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
}

void imageBarrier(VkCommandBuffer commands, const Image& image, ImageUse before, ImageUse after) {
    imageBarrier(commands, image.handle(), {image.desc().aspect, 0, image.desc().mipLevels, 0, image.desc().layers},
                 before, after);
}

void imageBarrier(VkCommandBuffer commands, VkImage image, const VkImageSubresourceRange& range, ImageUse before,
                  ImageUse after) {
    auto barrier = vkStruct<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
    barrier.srcStageMask = before.scope.stages;
    barrier.srcAccessMask = before.scope.access;
    barrier.dstStageMask = after.scope.stages;
    barrier.dstAccessMask = after.scope.access;
    barrier.oldLayout = before.layout;
    barrier.newLayout = after.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = range;
    auto dependency = vkStruct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
}

} // namespace supple::host
