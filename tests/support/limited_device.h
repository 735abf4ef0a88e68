// A device that says other limits than the driver's, with a context whose commands are counted.
#pragma once

#include "tests/support/crowd.h"
#include "tests/support/wrapped_vulkan.h"

#include <functional>
#include <memory>
#include <optional>

namespace supple::test {

/// Groups that need the same pipelines should use one: they are made once. No two at a time.
class LimitedDevice {
public:
    /// `limit` sets what the device says.
    LimitedDevice(SuppleMapping mapping, const std::function<void(WrappedVulkan&)>& limit) {
        WrappedVulkan& wrapped = wrappedVulkan();
        limit(wrapped);
        limits_ = wrapped;
        device_ = deviceThrough(&wrappedGetInstanceProcAddr);
        EXPECT_NE(device_, nullptr);
        if (device_ != nullptr) {
            context_.emplace(*device_, mapping);
        }
    }
    ~LimitedDevice() {
        context_.reset();
        EXPECT_TRUE(device_ == nullptr || device_->validation()->messageCount() == 0u);
        device_ = nullptr;
        (void)wrappedVulkan();
    }
    LimitedDevice(const LimitedDevice&) = delete;
    LimitedDevice& operator=(const LimitedDevice&) = delete;

    /// Null when there is no device; a failure was recorded then.
    [[nodiscard]] CrowdContext* context() { return context_ ? &*context_ : nullptr; }
    /// A frame of the group; returns what it took.
    WrappedVulkan count(SuppleGroup group) {
        WrappedVulkan& wrapped = currentWrappedVulkan();
        wrapped = limits_;
        context_->run(group);
        return wrapped;
    }

private:
    WrappedVulkan limits_;
    std::unique_ptr<host::Device> device_;
    std::optional<CrowdContext> context_;
};

} // namespace supple::test
