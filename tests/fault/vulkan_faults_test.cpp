// Every call of Vulkan that may fail does, one after the other, and every callback for memory: the function that made
// it says so, and the next call does what it would have done. A device that is lost stays lost.
#include "tests/fault/every_call.h"
#include "tests/fault/vulkan_faults.h"
#include "tests/support/logged_context.h"

#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace supple::test {
namespace {

Fault faultOf(VkResult failure, SuppleResult result) {
    return {[failure](uint64_t n) { failVulkan(n, failure); }, liftVulkanFailure, result};
}

/// A device whose validation has nothing to say when it is gone, which is when leaks are told.
class CheckedDevice {
public:
    CheckedDevice() : device_(deviceThrough(&faultyGetInstanceProcAddr)), validation_(device_->validation()) {}
    ~CheckedDevice() {
        device_ = nullptr;
        EXPECT_EQ(validation_->messageCount(), 0u) << "something leaked";
    }
    CheckedDevice(const CheckedDevice&) = delete;
    CheckedDevice& operator=(const CheckedDevice&) = delete;
    host::Device& operator*() const { return *device_; }

private:
    std::unique_ptr<host::Device> device_;
    decltype(std::declval<host::Device>().validation()) validation_;
};

TEST(VulkanFaults, EveryCallOfEveryFunctionMayFail) {
    const CheckedDevice device;
    const std::vector<std::byte> sound = makeEveryCall(*device, makeOnce);
    ASSERT_FALSE(sound.empty());
    for (const Fault& fault : {faultOf(VK_ERROR_OUT_OF_DEVICE_MEMORY, SUPPLE_ERROR_DEVICE_MEMORY),
                               faultOf(VK_ERROR_OUT_OF_HOST_MEMORY, SUPPLE_ERROR_HOST_MEMORY)}) {
        Calls calls(fault);
        EXPECT_TRUE(makeEveryCall(*device, std::bind_front(&Calls::make, &calls)) == sound);
        EXPECT_GT(calls.positions(), 300u);
        std::printf("  %s: %llu calls of Vulkan failed\n", suppleResultString(fault.result),
                    static_cast<unsigned long long>(calls.positions()));
    }
}

TEST(VulkanFaults, AContextThatCannotBeMadeIsNotThere) {
    const CheckedDevice device;
    SuppleContextDesc desc = host::contextDesc(*device);
    quiet(desc);
    for (const Fault& fault : {faultOf(VK_ERROR_OUT_OF_DEVICE_MEMORY, SUPPLE_ERROR_DEVICE_MEMORY),
                               faultOf(VK_ERROR_OUT_OF_HOST_MEMORY, SUPPLE_ERROR_HOST_MEMORY),
                               faultOf(VK_ERROR_DEVICE_LOST, SUPPLE_ERROR_DEVICE_LOST)}) {
        Calls calls(fault);
        SuppleContext context = nullptr;
        calls.make("suppleCreateContext", [&] {
            const SuppleResult result = suppleCreateContext(&desc, &context);
            EXPECT_EQ(context != nullptr, result == SUPPLE_OK);
            return result;
        });
        suppleDestroyContext(context);
        EXPECT_GT(calls.positions(), 3u);
    }
}

/// Memory of the host, an allocation for each piece; the callback fails where it is told to.
class HostPieces {
public:
    explicit HostPieces(const host::Device& device) : device_(device.handle()) {
        vkGetPhysicalDeviceMemoryProperties(device.physicalDevice(), &properties_);
        callbacks_.user = this;
        callbacks_.allocate = [](const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                                 VkMemoryPropertyFlags, const char*, SuppleMemory* out, void* user) {
            return static_cast<HostPieces*>(user)->allocate(*requirements, required, *out);
        };
        callbacks_.free = [](const SuppleMemory* memory, void* user) {
            auto& own = *static_cast<HostPieces*>(user);
            vkFreeMemory(own.device_, memory->memory, nullptr);
            --own.live_;
        };
    }
    [[nodiscard]] const SuppleMemoryCallbacks* callbacks() const { return &callbacks_; }
    [[nodiscard]] int64_t live() const { return live_; }
    [[nodiscard]] Fault fault() {
        return {[this](uint64_t n) { untilFailure_ = static_cast<int64_t>(n); },
                [this] {
                    untilFailure_ = -1;
                    return std::exchange(failed_, false);
                },
                SUPPLE_ERROR_DEVICE_MEMORY};
    }

private:
    VkResult allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required, SuppleMemory& out) {
        if (untilFailure_ >= 0 && untilFailure_-- == 0) {
            failed_ = true;
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        }
        uint32_t type = 0;
        while ((requirements.memoryTypeBits >> type & 1u) == 0 ||
               (properties_.memoryTypes[type].propertyFlags & required) != required) {
            ++type;
        }
        const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, requirements.size, type};
        EXPECT_EQ(vkAllocateMemory(device_, &info, nullptr, &out.memory), VK_SUCCESS);
        out.offset = 0;
        if ((required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
            EXPECT_EQ(vkMapMemory(device_, out.memory, 0, VK_WHOLE_SIZE, 0, &out.mapped), VK_SUCCESS);
        }
        ++live_;
        return VK_SUCCESS;
    }

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    SuppleMemoryCallbacks callbacks_{};
    int64_t untilFailure_ = -1;
    bool failed_ = false;
    int64_t live_ = 0;
};

TEST(VulkanFaults, EveryCallbackForMemoryMayFail) {
    const CheckedDevice device;
    HostPieces memory(*device);
    const Adjust adjust = [&](SuppleContextDesc& desc) {
        quiet(desc);
        desc.memory = memory.callbacks();
    };
    const std::vector<std::byte> sound = makeEveryCall(*device, makeOnce, adjust);
    Calls calls(memory.fault());
    EXPECT_TRUE(makeEveryCall(*device, std::bind_front(&Calls::make, &calls), adjust) == sound);
    EXPECT_GT(calls.positions(), 50u);
    EXPECT_EQ(memory.live(), 0);
    std::printf("  %llu callbacks failed\n", static_cast<unsigned long long>(calls.positions()));
}

/// The device is lost at one call of Vulkan, counted from the first public function on.
class LostAt {
public:
    explicit LostAt(uint64_t position) : position_(position) {}

    void make(const char* name, const std::function<SuppleResult()>& call, SuppleResult good) {
        if (!std::exchange(begun_, true)) {
            first_ = vulkanCalls();
            failVulkan(position_, VK_ERROR_DEVICE_LOST);
        }
        const bool before = lost();
        const SuppleResult result = call();
        if (!before && lost()) {
            EXPECT_EQ(result, SUPPLE_ERROR_DEVICE_LOST) << name;
        } else if (before) {
            // What needs no device goes on; some handles were never made, and some capacities not raised.
            EXPECT_TRUE(result == SUPPLE_ERROR_DEVICE_LOST || result == good || result == SUPPLE_ERROR_ARGUMENT ||
                        result == SUPPLE_ERROR_LIMIT)
                << name << ": " << suppleResultString(result);
        } else {
            EXPECT_EQ(result, good) << name;
        }
    }
    /// The failing call was the last that the device was asked.
    [[nodiscard]] bool askedNoMore() const { return vulkanCalls() == first_ + position_ + 1; }

private:
    [[nodiscard]] bool lost() const { return vulkanCalls() > first_ + position_; }

    uint64_t position_, first_ = 0;
    bool begun_ = false;
};

/// Where each public function first makes each call of Vulkan. Functions are told apart by their names up to a space.
std::vector<uint64_t> firstOfEachKind(host::Device& device) {
    std::vector<uint64_t> positions;
    std::vector<const char*> names;
    std::set<std::pair<std::string, std::string>> seen;
    makeEveryCall(device, [&](const char* name, const std::function<SuppleResult()>& call, SuppleResult) {
        listVulkanCalls(&names);
        size_t position = names.size();
        (void)call();
        const std::string function(name, std::strcspn(name, " "));
        for (; position < names.size(); ++position) {
            if (seen.emplace(function, names[position]).second) {
                positions.push_back(position);
            }
        }
    });
    listVulkanCalls(nullptr);
    return positions;
}

TEST(VulkanFaults, ALostDeviceIsAskedNoMore) {
    const CheckedDevice device;
    const std::vector<uint64_t> positions = firstOfEachKind(*device);
    EXPECT_GT(positions.size(), 30u);
    for (const uint64_t position : positions) {
        LostAt lostAt(position);
        EXPECT_TRUE(makeEveryCall(*device, std::bind_front(&LostAt::make, &lostAt)).empty()) << position;
        EXPECT_TRUE(liftVulkanFailure());
        EXPECT_TRUE(lostAt.askedNoMore()) << position;
    }
    std::printf("  lost at %zu calls\n", positions.size());
}

} // namespace
} // namespace supple::test
