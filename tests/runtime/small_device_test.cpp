// The least that Supple runs on: Vulkan 1.1 of instance and device, no feature and no extension. Surfaces have the bits
// that they have with all that a newer device offers.
#include "tests/support/crowd.h"
#include "tests/support/played_group.h"
#include "tests/support/sample_assets.h"
#include "tests/support/wrapped_vulkan.h"

#include <gtest/gtest.h>

namespace supple::test {
namespace {

/// Through a table that hides what is newer. The instance is of Vulkan 1.1 indeed, so the validation layer sees it too.
std::unique_ptr<host::Device> smallDevice() {
    wrappedVulkan().apiVersion = VK_API_VERSION_1_1;
    host::DeviceOptions options;
    options.validation = true;
    options.onlyCompute = true;
    options.suppleGetInstanceProcAddr = &wrappedGetInstanceProcAddr;
    Result<std::unique_ptr<host::Device>> device = host::Device::create(options);
    if (!device) {
        ADD_FAILURE() << device.error().message;
        return nullptr;
    }
    return std::move(*device);
}

/// Positions and previous positions of a character that plays, at a rate and then in two frames of another.
std::vector<PositionBits> played(CrowdContext& context, SuppleScheme scheme, uint32_t flags) {
    SuppleGroupDesc desc{};
    desc.asset = context.asset(kPipQuads);
    desc.scheme = scheme;
    desc.rate = 3;
    desc.capacity = 2;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    desc.flags = flags;
    Crowd crowd(context, desc);
    if (!crowd.valid()) {
        return {};
    }
    const SuppleInstance instance = crowd.spawn();
    std::vector<PositionBits> bits;
    for (const double time : {0.0, 0.3, 0.4}) {
        crowd.pose(instance, 0, time, glm::mat4(1.0f));
        crowd.run();
        bits.push_back(crowd.positions(instance.slot));
        bits.push_back(crowd.previous(instance.slot));
    }
    return bits;
}

/// Words of poses and cages that differ from the CPU's, of two instances that play on the device.
uint64_t wordsOffWhenPlaying(CrowdContext& context) {
    PlayedGroup played(context, playedGroup(context.asset(kPipQuads), 2, 0));
    if (!played.crowd.valid()) {
        return 1;
    }
    played.play(0, 0, 0.0);
    played.play(1, 1, 0.2);
    uint64_t off = 0;
    for (const double time : {0.0, 0.3, 0.4}) {
        off += played.run(time);
    }
    return off;
}

class SmallDevice : public testing::TestWithParam<SuppleMapping> {};

TEST_P(SmallDevice, HasTheSameBits) {
    ASSERT_NE(testDevice(), nullptr);
    const std::unique_ptr<host::Device> small = smallDevice();
    ASSERT_NE(small, nullptr);
    {
        CrowdContext few(*small, GetParam()), all(*testDevice(), GetParam());
        ASSERT_TRUE(few.valid() && all.valid());
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK}) {
            constexpr uint32_t kFlags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_MOTION | SUPPLE_GROUP_BOUNDS;
            const std::vector<PositionBits> bits = played(few, scheme, kFlags), wanted = played(all, scheme, kFlags);
            ASSERT_EQ(wanted.size(), 6u);
            ASSERT_EQ(bits.size(), wanted.size());
            for (size_t i = 0; i < wanted.size(); ++i) {
                EXPECT_GT(wanted[i].size(), 100u);
                EXPECT_EQ(differences(bits[i], wanted[i]), 0u) << "scheme " << scheme << ", " << i;
            }
        }
        EXPECT_EQ(wordsOffWhenPlaying(few), 0u);
        EXPECT_EQ(few.takeError(), 0);
    }
    EXPECT_EQ(currentWrappedVulkan().unknownStructs, 0u);
    EXPECT_EQ(small->validation()->messageCount(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Mappings, SmallDevice, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& info) { return info.param == SUPPLE_MAPPING_WIDE ? "Wide" : "Narrow"; });

TEST(SmallDevices, NameWhatNeedsMore) {
    ASSERT_NE(testDevice(), nullptr);
    const std::unique_ptr<host::Device> small = smallDevice();
    ASSERT_NE(small, nullptr);
    for (const auto& [flag, name] : {std::pair{SUPPLE_CONTEXT_SHARED_DISPATCHES, "shared dispatches"},
                                     std::pair{SUPPLE_CONTEXT_RAY_TRACING, "ray tracing"}}) {
        SuppleRequirements needs{};
        needs.structSize = sizeof(needs);
        needs.contextFlags = flag;
        EXPECT_EQ(
            suppleQueryRequirements(small->instance(), small->physicalDevice(), &wrappedGetInstanceProcAddr, &needs),
            SUPPLE_ERROR_UNSUPPORTED);
        EXPECT_STRNE(needs.reason, "");
        LoggedContext context(*small, [&, flags = flag](SuppleContextDesc& desc) {
            desc.mapping = SUPPLE_MAPPING_WIDE;
            desc.flags |= flags;
        });
        EXPECT_EQ(context.result(), SUPPLE_ERROR_UNSUPPORTED);
        const std::vector<LogLine> lines = context.takeLines();
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_NE(lines[0].text.find(std::string(name) + ": the device lacks " + needs.reason), std::string::npos)
            << lines[0].text << " / " << needs.reason;
    }
}

/// Instances of Vulkan 1.1 may get no function of 1.2 from a device that has its feature.
TEST(SmallDevices, NameTheFunctionThatIsNotGiven) {
    for (const char* const hidden : {"vkGetBufferDeviceAddress", "vkCmdDispatchIndirect"}) {
        wrappedVulkan().hiddenFunction = hidden;
        const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        LoggedContext context(*device, [](SuppleContextDesc& desc) {
            desc.mapping = SUPPLE_MAPPING_WIDE;
            desc.flags |= SUPPLE_CONTEXT_SHARED_DISPATCHES;
        });
        EXPECT_EQ(context.result(), SUPPLE_ERROR_UNSUPPORTED);
        const std::vector<LogLine> lines = context.takeLines();
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_NE(lines[0].text.find(std::string("the device gives no ") + hidden), std::string::npos) << lines[0].text;
        LoggedContext other(*device, [](SuppleContextDesc& desc) {
            desc.mapping = SUPPLE_MAPPING_WIDE;
            desc.flags &= ~static_cast<uint32_t>(SUPPLE_CONTEXT_SHARED_DISPATCHES);
        });
        EXPECT_EQ(other.result() == SUPPLE_OK, std::string_view(hidden) == "vkGetBufferDeviceAddress");
    }
}

TEST(SmallDevices, ReadStorageBuffersWhereTexelsAreFew) {
    ASSERT_NE(testDevice(), nullptr);
    const std::unique_ptr<host::Device> small = smallDevice();
    ASSERT_NE(small, nullptr);
    currentWrappedVulkan().maxTexelBufferElements = 65536;
    for (const SuppleMapping asked : {SUPPLE_MAPPING_AUTO, SUPPLE_MAPPING_NARROW}) {
        LoggedContext context(*small, [&](SuppleContextDesc& desc) { desc.mapping = asked; });
        ASSERT_EQ(context.result(), SUPPLE_OK);
        SuppleMapping mapping = SUPPLE_MAPPING_AUTO;
        EXPECT_EQ(suppleGetMapping(context.handle(), &mapping), SUPPLE_OK);
        const bool isChosen = asked == SUPPLE_MAPPING_AUTO && small->isCpu();
        EXPECT_EQ(mapping == SUPPLE_MAPPING_WIDE, asked == SUPPLE_MAPPING_AUTO);
        EXPECT_EQ(context.takeCount(SUPPLE_MESSAGE_LIMIT), isChosen ? 1u : 0u);
    }
}

} // namespace
} // namespace supple::test
