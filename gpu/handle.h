// Owning wrapper of a device object: destroys it with the device's function table and the host's allocator.
#pragma once

#include "gpu/device.h"

#include <utility>

namespace supple::gpu {

/// The Device must outlive the handle and stay where it is.
template <class T, auto Destroy>
class Handle {
public:
    Handle() = default;
    Handle(const Device& device, T handle) : device_(&device), handle_(handle) {}
    Handle(Handle&& other) noexcept
        : device_(std::exchange(other.device_, nullptr)), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Handle() {
        if (handle_ != VK_NULL_HANDLE) {
            (device_->vk.*Destroy)(device_->handle, handle_, device_->allocator);
        }
    }
    [[nodiscard]] T get() const { return handle_; }

private:
    const Device* device_ = nullptr;
    T handle_ = VK_NULL_HANDLE;
};

using BufferHandle = Handle<VkBuffer, &Functions::DestroyBuffer>;
using BufferViewHandle = Handle<VkBufferView, &Functions::DestroyBufferView>;
using ShaderModuleHandle = Handle<VkShaderModule, &Functions::DestroyShaderModule>;
using SetLayoutHandle = Handle<VkDescriptorSetLayout, &Functions::DestroyDescriptorSetLayout>;
using PipelineLayoutHandle = Handle<VkPipelineLayout, &Functions::DestroyPipelineLayout>;
using PipelineHandle = Handle<VkPipeline, &Functions::DestroyPipeline>;
using DescriptorPoolHandle = Handle<VkDescriptorPool, &Functions::DestroyDescriptorPool>;
using QueryPoolHandle = Handle<VkQueryPool, &Functions::DestroyQueryPool>;

} // namespace supple::gpu
