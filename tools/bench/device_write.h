// What the device's memory takes: a buffer filled by a command and stored to by a shader, with nothing computed.
#pragma once

#include "base/result.h"
#include "host/device.h"

#include <memory>

namespace supple::bench {

class DeviceWrite {
public:
    /// About so many bytes, and at most what a shader can reach: size() has what it came to.
    [[nodiscard]] static Result<std::unique_ptr<DeviceWrite>> create(host::Device& device, VkDeviceSize bytes);
    ~DeviceWrite();
    DeviceWrite(const DeviceWrite&) = delete;
    DeviceWrite& operator=(const DeviceWrite&) = delete;

    [[nodiscard]] VkDeviceSize size() const { return buffer_.size(); }
    void recordFill(VkCommandBuffer commands) const;  ///< vkCmdFillBuffer
    void recordStore(VkCommandBuffer commands) const; ///< a uvec4 an invocation

private:
    explicit DeviceWrite(host::Device& device) : device_(device) {}
    [[nodiscard]] VkResult createPipeline();
    [[nodiscard]] VkResult createSet();

    host::Device& device_;
    host::Buffer buffer_;
    uint32_t groupsAcross_ = 0, groupsDown_ = 0;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

} // namespace supple::bench
