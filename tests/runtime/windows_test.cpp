// Groups that are larger than what the device can bind at a time: a host draws them window by window, or creation is
// refused and names the largest capacity.
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_assets.h"
#include "tests/support/test_view.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/procedural.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

constexpr uint32_t kWindowCapacity = 23, kWindowRange = 1u << 18;
constexpr uint32_t kViewRange = 1u << 23; ///< room for what every view has

class GroupWindows : public CrowdContexts {
protected:
    /// Runs `body` with a context whose device binds few bytes at a time.
    template <class Body>
    static void onSmallDevice(SuppleMapping mapping, uint32_t range, Body&& body) {
        WrappedVulkan& wrapped = wrappedVulkan();
        const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        wrapped.maxStorageBufferRange = range;
        {
            CrowdContext small(*device, mapping);
            ASSERT_TRUE(small.valid());
            body(small);
        }
        EXPECT_EQ(device->validation()->messageCount(), 0u);
        wrapped.maxStorageBufferRange = 0;
    }
};

struct WindowCase {
    const char* name;
    SuppleScheme scheme;
    uint32_t flags;
    uint32_t rate;
};
constexpr WindowCase kWindowCases[] = {
    {"P_m", SUPPLE_SCHEME_PM, SUPPLE_GROUP_MOTION, 5},
    {"indexed mesh", SUPPLE_SCHEME_PM, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_INDEXED_MESH, 6},
    {"fragments", SUPPLE_SCHEME_FRAGMENTS, SUPPLE_GROUP_ATTRIBUTES, 2},
    {"polygons", SUPPLE_SCHEME_POLYGONS, 0, 1},
};

/// Some instances are hidden, come and go; some hide parts. One window has none at all.
void stir(Crowd& crowd, std::vector<SuppleInstance>& instances, uint32_t frame, uint32_t parts) {
    for (uint32_t i = static_cast<uint32_t>(instances.size()); i < kWindowCapacity; ++i) {
        instances.push_back(crowd.spawn());
    }
    for (SuppleInstance& instance : instances) {
        const uint32_t slot = instance.slot;
        if ((slot + frame) % 9 == 8) {
            crowd.destroy(instance);
            instance = crowd.spawn();
            EXPECT_EQ(instance.slot, slot);
        }
        crowd.setVisible(instance, (slot * 7 + frame) % 5 != 0 && (frame != 2 || slot > 9));
        for (uint32_t part = 0; part < parts; ++part) {
            EXPECT_EQ(suppleSetPartVisible(crowd.context().handle(), instance, part, (slot + part + frame) % 4 != 0),
                      SUPPLE_OK);
        }
        const auto f = static_cast<float>(frame), s = static_cast<float>(slot);
        crowd.pose(instance, SUPPLE_BIND_POSE, 0.0,
                   glm::rotate(glm::translate(glm::mat4(1.0f), {s, 0.3f * f, 0.0f}), 0.1f * f + s, {0, 1, 0}));
    }
}

TEST_F(GroupWindows, DrawWhatOneWindowDraws) {
    for (const SuppleMapping mapping : kMappings) {
        onSmallDevice(mapping, kWindowRange, [&](CrowdContext& small) {
            CrowdContext& large = context(mapping);
            ASSERT_TRUE(large.valid());
            for (const WindowCase& c : kWindowCases) {
                SCOPED_TRACE(mappingName(mapping) + " " + c.name);
                const auto desc = [&](CrowdContext& own) {
                    SuppleGroupDesc desc{};
                    desc.asset = own.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb");
                    desc.capacity = kWindowCapacity;
                    desc.scheme = c.scheme;
                    desc.rate = c.rate;
                    desc.flags = c.flags | SUPPLE_GROUP_WINDOWS;
                    return desc;
                };
                Crowd windows(small, desc(small)), one(large, desc(large));
                ASSERT_TRUE(windows.valid() && one.valid());
                const host::GroupOutput cut = windows.output();
                EXPECT_GE(cut.info.windowCount, 2u) << "too small to need windows";
                EXPECT_EQ(one.output().info.windowCount, 1u);
                for (const SuppleBufferRange& range : {cut.streams.vertices, cut.info.deformedCage, cut.info.poses}) {
                    const VkDeviceSize perSlot = range.size / kWindowCapacity;
                    EXPECT_LE(perSlot * cut.info.windowSize, kWindowRange);
                    EXPECT_EQ(perSlot * cut.info.windowSize % 256, 0u) << "a window begins where no descriptor may";
                }
                SuppleAssetInfo info{};
                info.structSize = sizeof info;
                ASSERT_EQ(suppleGetAssetInfo(small.handle(), desc(small).asset, &info), SUPPLE_OK);
                std::vector<SuppleInstance> instances[2];
                for (uint32_t frame = 0; frame < 4; ++frame) {
                    stir(windows, instances[0], frame, info.partCount);
                    stir(one, instances[1], frame, info.partCount);
                    windows.run();
                    one.run();
                    const DrawnPatches expected = drawnPatches(one);
                    EXPECT_FALSE(expected.empty());
                    EXPECT_TRUE(drawnPatches(windows) == expected) << "frame " << frame;
                }
            }
        });
    }
}

/// The number behind "the largest capacity is".
uint32_t largestCapacityOf(const std::vector<LogLine>& lines) {
    for (const LogLine& line : lines) {
        const size_t at = line.text.find("the largest capacity is ");
        if (line.message == SUPPLE_MESSAGE_LIMIT && at != std::string::npos) {
            return static_cast<uint32_t>(std::stoul(line.text.substr(at + 24)));
        }
    }
    return 0;
}

TEST_F(GroupWindows, AreAskedForOrTheLargestCapacityIsNamed) {
    onSmallDevice(SUPPLE_MAPPING_NARROW, kViewRange, [&](CrowdContext& small) {
        TestView view(small, 1024);
        for (const bool viewed : {false, true}) {
            SuppleGroupDesc desc{};
            desc.structSize = sizeof desc;
            desc.asset = small.createAsset(cage::makeCubeSphere(3));
            desc.capacity = 1000;
            desc.scheme = viewed ? SUPPLE_SCHEME_FRAGMENTS : SUPPLE_SCHEME_PM;
            desc.rate = 4;
            desc.view = viewed ? view.handle() : SuppleView{};
            SuppleGroup group{};
            (void)small.takeLines();
            EXPECT_EQ(suppleCreateGroup(small.handle(), &desc, &group), SUPPLE_ERROR_LIMIT);
            const uint32_t largest = largestCapacityOf(small.takeLines());
            ASSERT_GT(largest, 0u);
            ASSERT_LT(largest, 1000u);
            desc.capacity = largest + 1;
            EXPECT_EQ(suppleCreateGroup(small.handle(), &desc, &group), SUPPLE_ERROR_LIMIT);
            desc.capacity = largest;
            ASSERT_EQ(suppleCreateGroup(small.handle(), &desc, &group), SUPPLE_OK);
            const host::GroupOutput output = outputOf(small.handle(), group);
            EXPECT_LE(output.streams.vertices.size, kViewRange);
            EXPECT_EQ(output.grid.indirect.size, output.grid.drawRangeCount * sizeof(VkDrawIndexedIndirectCommand));
            (void)small.takeLines();
        }
    });
}

TEST_F(GroupWindows, AreNotOfViews) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    TestView view(own, 1024);
    SuppleGroupDesc desc{};
    desc.structSize = sizeof desc;
    desc.asset = own.createAsset(cube());
    desc.capacity = 1;
    desc.flags = SUPPLE_GROUP_WINDOWS;
    desc.view = view.handle();
    SuppleGroup group{};
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeCount(SUPPLE_MESSAGE_CONFLICT), 1u);
}

TEST_F(GroupWindows, ViewsNameTheMostVertices) {
    onSmallDevice(SUPPLE_MAPPING_NARROW, kViewRange, [&](CrowdContext& small) {
        SuppleViewDesc desc{};
        desc.structSize = sizeof desc;
        desc.maxVertices = 1u << 20;
        SuppleView view{};
        EXPECT_EQ(suppleCreateView(small.handle(), &desc, &view), SUPPLE_ERROR_LIMIT);
        const std::vector<LogLine> lines = small.takeLines();
        ASSERT_EQ(lines.size(), 1u);
        const size_t at = lines[0].text.find("at most ");
        ASSERT_NE(at, std::string::npos) << lines[0].text;
        desc.maxVertices = static_cast<uint32_t>(std::stoul(lines[0].text.substr(at + 8)));
        EXPECT_EQ(suppleCreateView(small.handle(), &desc, &view), SUPPLE_OK);
        ++desc.maxVertices;
        EXPECT_EQ(suppleCreateView(small.handle(), &desc, &view), SUPPLE_ERROR_LIMIT);
        (void)small.takeLines();
    });
}

} // namespace
} // namespace supple::test
