// A VkInstance that is too old: the reason is said at once if the host tells its version or the loader shows it, and
// when the context is created otherwise.
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace supple::test {
namespace {

const std::string kNewInstanceText = "the VkInstance must be created with apiVersion 1.1 or more";

/// An instance of some version, and the physical device that the tests run on as it shows it.
class OldInstance {
public:
    explicit OldInstance(uint32_t version) {
        VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
        application.apiVersion = version;
        VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
        info.pApplicationInfo = &application;
        EXPECT_EQ(vkCreateInstance(&info, nullptr, &instance_), VK_SUCCESS);
        uint32_t count = 0;
        vkEnumeratePhysicalDevices(instance_, &count, nullptr);
        std::vector<VkPhysicalDevice> all(count);
        vkEnumeratePhysicalDevices(instance_, &count, all.data());
        for (const VkPhysicalDevice one : all) {
            VkPhysicalDeviceProperties properties{};
            vkGetPhysicalDeviceProperties(one, &properties);
            if (testDevice()->name() == properties.deviceName) {
                physicalDevice_ = one;
            }
        }
        EXPECT_NE(physicalDevice_, VkPhysicalDevice{VK_NULL_HANDLE});
    }
    ~OldInstance() {
        if (device_ != VK_NULL_HANDLE) {
            vkDestroyDevice(device_, nullptr);
        }
        vkDestroyInstance(instance_, nullptr);
    }
    OldInstance(const OldInstance&) = delete;
    OldInstance& operator=(const OldInstance&) = delete;

    SuppleResult query(uint32_t told, std::string& reason) const {
        SuppleRequirements needs{};
        needs.structSize = sizeof(needs);
        needs.instanceVersion = told;
        const SuppleResult result = suppleQueryRequirements(instance_, physicalDevice_, vkGetInstanceProcAddr, &needs);
        EXPECT_EQ(needs.instanceVersion, told);
        reason = needs.reason;
        return result;
    }

    /// Without any feature; what the log says.
    SuppleResult createContext(std::string& text) {
        const float priority = 1.0f;
        VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
        queue.queueFamilyIndex = testDevice()->queueFamily();
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue;
        EXPECT_EQ(vkCreateDevice(physicalDevice_, &info, nullptr, &device_), VK_SUCCESS);
        SuppleContextDesc desc{};
        desc.structSize = sizeof(desc);
        desc.instance = instance_;
        desc.physicalDevice = physicalDevice_;
        desc.device = device_;
        desc.queueFamily = queue.queueFamilyIndex;
        desc.getInstanceProcAddr = vkGetInstanceProcAddr;
        desc.mapping = SUPPLE_MAPPING_WIDE;
        desc.logUser = &text;
        desc.log = [](SuppleSeverity, SuppleMessage message, const char* line, void* user) {
            EXPECT_EQ(message, SUPPLE_MESSAGE_DEVICE_UNSUITED);
            *static_cast<std::string*>(user) = line;
        };
        SuppleContext context = nullptr;
        const SuppleResult result = suppleCreateContext(&desc, &context);
        suppleDestroyContext(context);
        return result;
    }

private:
    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
};

TEST(InstanceVersion, IsTheReasonWhenTheHostTellsIt) {
    ASSERT_NE(testDevice(), nullptr);
    std::string reason;
    const OldInstance old(VK_API_VERSION_1_0);
    EXPECT_EQ(old.query(VK_API_VERSION_1_0, reason), SUPPLE_ERROR_UNSUPPORTED);
    EXPECT_EQ(reason, kNewInstanceText + ": this one has 1.0");
    for (const uint32_t minor : {1u, 2u, 3u}) {
        const uint32_t version = VK_MAKE_API_VERSION(0, 1, minor, 0);
        const OldInstance fit(version);
        EXPECT_EQ(fit.query(version, reason), SUPPLE_OK) << reason;
        EXPECT_EQ(reason, "");
        EXPECT_EQ(fit.query(VK_MAKE_API_VERSION(0, 1, 4, 300), reason), SUPPLE_OK) << reason;
    }
}

TEST(InstanceVersion, OfOneDotZeroIsSeenWithoutBeingTold) {
    ASSERT_NE(testDevice(), nullptr);
    for (const uint32_t version : {uint32_t{0}, VK_API_VERSION_1_0}) { // 0 means 1.0
        OldInstance instance(version);
        std::string reason, text;
        EXPECT_EQ(instance.query(0, reason), SUPPLE_ERROR_UNSUPPORTED);
        EXPECT_EQ(reason, kNewInstanceText + ": this one has 1.0");
        EXPECT_EQ(instance.createContext(text), SUPPLE_ERROR_UNSUPPORTED);
        EXPECT_EQ(text, reason);
    }
}

TEST(InstanceVersion, OfOneDotOneIsEnough) {
    ASSERT_NE(testDevice(), nullptr);
    for (const uint32_t minor : {1u, 2u, 3u}) {
        OldInstance instance(VK_MAKE_API_VERSION(0, 1, minor, 0));
        std::string reason, text;
        EXPECT_EQ(instance.query(0, reason), SUPPLE_OK) << reason;
        EXPECT_EQ(instance.createContext(text), SUPPLE_OK);
        EXPECT_EQ(text, "");
    }
}

} // namespace
} // namespace supple::test
