// What a frame records: as many commands for two instances as for a hundred, whatever the group; and the same bits
// where the device's limit of workgroups splits dispatches.
#include "tests/support/depth_pyramid.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/test_view.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/procedural.h"

#include <cstring>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <optional>
#include <ostream>

namespace supple::test {
namespace {

struct CommandCase {
    const char* name;
    SuppleScheme scheme;
    uint32_t flags = 0; ///< SuppleGroupFlags
    bool plays = false;
    bool triangles = false;
    std::optional<uint32_t> view; ///< SuppleViewFlags
    uint32_t vertexBudget = 0;
    friend void PrintTo(const CommandCase& c, std::ostream* out) { *out << c.name; }
};

constexpr uint32_t kAllOutputs = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_PATCHES;
constexpr uint32_t kLevelOutputs = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES;

const CommandCase kFixedRates[] = {
    {"the cage alone", SUPPLE_SCHEME_CAGE},
    {"p-rep", SUPPLE_SCHEME_PREP, kAllOutputs},
    {"p-rep, shared samples", SUPPLE_SCHEME_PREP, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_INDEXED_MESH},
    {"P_m", SUPPLE_SCHEME_PM, kAllOutputs, false, true},
    {"P_m, shared samples", SUPPLE_SCHEME_PM, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_INDEXED_MESH, false, true},
    {"fragments", SUPPLE_SCHEME_FRAGMENTS, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES},
    {"Loop", SUPPLE_SCHEME_LOOP, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, false, true},
    {"blend", SUPPLE_SCHEME_BLEND, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, false, true},
    {"Catmull-Clark", SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, false, true},
    {"polygons", SUPPLE_SCHEME_POLYGONS, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, false, true},
    {"p-rep, playing", SUPPLE_SCHEME_PREP, SUPPLE_GROUP_MOTION, true},
};
const CommandCase kViews[] = {
    {"view, p-rep", SUPPLE_SCHEME_PREP, 0, false, false, kLevelOutputs},
    {"view, P_m", SUPPLE_SCHEME_PM, 0, false, true, kLevelOutputs},
    {"view, blend", SUPPLE_SCHEME_BLEND, 0, false, true, kLevelOutputs},
    {"view, Catmull-Clark", SUPPLE_SCHEME_CATMULL_CLARK, 0, false, true, kLevelOutputs},
    {"view, polygons", SUPPLE_SCHEME_POLYGONS, 0, false, true, kLevelOutputs},
    {"view, one level an instance", SUPPLE_SCHEME_PREP, SUPPLE_GROUP_ONE_LEVEL, false, false, kLevelOutputs},
    {"view, culling of all kinds", SUPPLE_SCHEME_PM, 0, false, false,
     SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION | SUPPLE_VIEW_BACK_FACES},
    {"view, playing", SUPPLE_SCHEME_PM, 0, true, false, kLevelOutputs},
    {"view, fragments", SUPPLE_SCHEME_FRAGMENTS, 0, false, false, kLevelOutputs},
    {"view, fragments in a budget", SUPPLE_SCHEME_FRAGMENTS, 0, false, false, kLevelOutputs, 200000},
};

/// Six frames of `visible` instances of `capacity`: what each recorded, and what the last one left.
struct Recorded {
    std::vector<std::array<uint64_t, 5>> frames; ///< dispatches, indirect ones, barriers, copies, fills
    std::vector<std::vector<std::byte>> outputs; ///< of groups without a view: surfaces, pasts, cages, by slot
};

cage::Character waggingTube() {
    cage::Character tube = riggedTube({.segments = 4, .sides = 4, .joints = 2});
    tube.clips.push_back(
        clipOf({channel(1, cage::ChannelPath::translation, {0.0f, 1.0f}, {0.0f, 0.0f, 0.0f, 1.0f, 0.5f, 0.2f})}));
    tube.clips[0].name = "wag";
    return tube;
}

Recorded recordOf(CrowdContext& context, const CommandCase& c, uint32_t visible, uint32_t capacity) {
    Recorded recorded;
    const cage::Cage sphere = perturbed(cage::makeCubeSphere(2), 0.05f, 3);
    const SuppleAsset asset = c.plays       ? context.createAsset(waggingTube())
                              : c.triangles ? context.createAsset(inTriangles(sphere))
                                            : context.createAsset(sphere);
    std::optional<TestView> view;
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = c.scheme;
    desc.flags = c.flags;
    desc.rate = 4;
    desc.poseSource = c.plays ? SUPPLE_POSES_PLAYBACK : SUPPLE_POSES_SET;
    std::unique_ptr<DepthPyramid> pyramid;
    if (c.view) {
        view.emplace(context, 600000, *c.view);
        desc.view = view->handle();
        desc.vertexFormat = SUPPLE_VERTEX_24;
        view->camera.vertexBudget = c.vertexBudget;
        view->camera.smallestEdge = 20.0f;
        const glm::mat4 both = glm::perspectiveRH_ZO(2.0f, 1.0f, 0.5f, 1000.0f) *
                               glm::lookAt(glm::vec3(0.0f, 5.0f, 60.0f), glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
        std::memcpy(view->camera.viewProjection, &both, sizeof(both));
        view->look({0.0f, 5.0f, 60.0f});
        if ((*c.view & SUPPLE_VIEW_OCCLUSION) != 0) {
            pyramid = DepthPyramid::create(context.device(), {16, 16, false, std::vector<float>(256, 1.0f)}, 16, 16);
            EXPECT_NE(pyramid, nullptr);
            std::array<float, 16> columns{};
            std::memcpy(columns.data(), &both, sizeof(both));
            const SuppleDepthPyramidDesc open = pyramid->desc(columns);
            EXPECT_EQ(suppleSetDepthPyramid(context.handle(), view->handle(), &open), SUPPLE_OK);
        }
    }
    {
        Crowd crowd(context, desc);
        EXPECT_TRUE(crowd.valid());
        std::vector<SuppleInstance> instances;
        for (uint32_t i = 0; i < capacity; ++i) {
            instances.push_back(crowd.spawn());
            crowd.setVisible(instances.back(), i < visible);
            const glm::mat4 at =
                glm::translate(glm::mat4(1.0f), 3.0f * glm::vec3(i % 16 - 7.5f, 0.0f, -static_cast<float>(i / 16)));
            if (c.plays) {
                SupplePlaybackLayer layer{};
                layer.flags = SUPPLE_LAYER_LOOP;
                layer.weight = layer.speed = 1.0f;
                layer.offset = 0.1 * i;
                SupplePlaybackDesc playback{};
                playback.structSize = sizeof(playback);
                playback.layers = &layer;
                playback.layerCount = 1;
                EXPECT_EQ(suppleSetPlayback(context.handle(), instances[i], &playback), SUPPLE_OK);
                EXPECT_EQ(suppleSetTransform(context.handle(), instances[i], &at[0][0]), SUPPLE_OK);
            } else {
                crowd.pose(instances[i], SUPPLE_BIND_POSE, 0.0, at);
            }
        }
        WrappedVulkan& wrapped = currentWrappedVulkan();
        for (int frame = 0; frame < 6; ++frame) {
            if (c.plays) {
                EXPECT_EQ(suppleSetTime(context.handle(), crowd.group(), 0.1 * frame), SUPPLE_OK);
            } else if (frame == 2) { // one that moves
                crowd.pose(instances[0], SUPPLE_BIND_POSE, 0.0,
                           glm::translate(glm::mat4(1.0f), glm::vec3(-22.0f, 0.5f, 0.0f)));
            } else if (frame == 4) {
                crowd.teleport(instances[0]);
            }
            wrapped.dispatches = wrapped.indirectDispatches = wrapped.barriers = wrapped.copies = wrapped.fills = 0;
            context.run(crowd.group());
            recorded.frames.push_back(
                {wrapped.dispatches, wrapped.indirectDispatches, wrapped.barriers, wrapped.copies, wrapped.fills});
        }
        const host::GroupOutput output = crowd.output();
        const auto take = [&](const SuppleBufferRange& buffer, uint32_t count) {
            const std::vector<std::byte> bytes = crowd.read(buffer);
            const size_t each = bytes.size() / output.info.capacity,
                         own = size_t{count} * buffer.stride; // without padding
            EXPECT_GE(each, own);
            for (size_t first = 0; first < visible * each && own > 0; first += each) {
                const auto begin = bytes.begin() + static_cast<ptrdiff_t>(first);
                recorded.outputs.emplace_back(begin, begin + static_cast<ptrdiff_t>(own));
            }
        };
        if (!c.view) {
            take(output.info.deformedCage, output.info.cageVertexCount);
        }
        if (!c.view && c.scheme != SUPPLE_SCHEME_CAGE) {
            take(output.streams.vertices, output.grid.vertexCount);
        }
        if (!c.view && (c.flags & SUPPLE_GROUP_MOTION) != 0) {
            take(output.streams.previousPositions, output.grid.vertexCount);
        }
        if ((c.flags & SUPPLE_GROUP_ATTRIBUTES) != 0 && !c.view) {
            std::vector<std::byte> bytes = crowd.read(output.streams.attributes);
            bytes.resize(size_t{output.grid.vertexCount} * output.streams.attributes.stride);
            recorded.outputs.push_back(std::move(bytes));
        }
        if (pyramid) {
            EXPECT_EQ(suppleSetDepthPyramid(context.handle(), view->handle(), nullptr), SUPPLE_OK);
        }
    }
    return recorded;
}

class Commanded : public testing::TestWithParam<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, Commanded, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(Commanded, CommandsDoNotCountInstances) {
    (void)wrappedVulkan();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    CrowdContext context(*device, GetParam());
    std::vector<CommandCase> cases(std::begin(kFixedRates), std::end(kFixedRates));
    cases.insert(cases.end(), std::begin(kViews), std::end(kViews));
    (void)recordOf(context, kFixedRates[0], 1, 8); // uploads what is the context's
    const uint32_t most = lessInWide(GetParam(), 100, 25);
    for (const CommandCase& c : cases) {
        SCOPED_TRACE(c.name);
        // Two, so that one is left with a past where the other is teleported.
        const Recorded two = recordOf(context, c, 2, most);
        ASSERT_EQ(two.frames.size(), 6u);
        const std::array<uint64_t, 5>& last = two.frames.back();
        EXPECT_GT(last[0] + last[1], 0u);
        std::printf("%s: %llu dispatches, %llu indirect ones, %llu barriers, %llu copies, %llu fills\n", c.name,
                    static_cast<unsigned long long>(last[0]), static_cast<unsigned long long>(last[1]),
                    static_cast<unsigned long long>(last[2]), static_cast<unsigned long long>(last[3]),
                    static_cast<unsigned long long>(last[4]));
        for (const uint32_t visible : {most / 3, most}) {
            EXPECT_EQ(recordOf(context, c, visible, most).frames, two.frames) << visible;
        }
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
    (void)wrappedVulkan();
}

TEST_P(Commanded, SplitDispatchesWriteTheSameBits) {
    std::array<std::vector<Recorded>, 2> all;
    for (const bool split : {false, true}) {
        wrappedVulkan().maxComputeWorkGroupCountX = split ? 3 : 0;
        const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        CrowdContext context(*device, GetParam());
        for (const CommandCase& c : kFixedRates) {
            const uint32_t count = lessInWide(GetParam(), 40, 20);
            all[split ? 1 : 0].push_back(recordOf(context, c, count, count));
        }
        EXPECT_EQ(device->validation()->messageCount(), 0u);
    }
    size_t bytes = 0;
    for (size_t c = 0; c < std::size(kFixedRates); ++c) {
        SCOPED_TRACE(kFixedRates[c].name);
        ASSERT_EQ(all[0][c].outputs.size(), all[1][c].outputs.size());
        for (size_t i = 0; i < all[0][c].outputs.size(); ++i) {
            ASSERT_TRUE(all[0][c].outputs[i] == all[1][c].outputs[i]) << "output " << i;
            bytes += all[0][c].outputs[i].size();
        }
        EXPECT_EQ(all[0][c].frames, all[1][c].frames);
    }
    std::printf("%zu bytes are the same\n", bytes);
    EXPECT_GT(bytes, 1000000u);
    (void)wrappedVulkan();
}

/// Runs `body` in a secondary command buffer that a primary one executes.
void runAsSecondary(host::Device& device, const std::function<void(VkCommandBuffer)>& body) {
    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.queueFamilyIndex = device.queueFamily();
    VkCommandPool pool = VK_NULL_HANDLE;
    ASSERT_EQ(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool), VK_SUCCESS);
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_SECONDARY;
    info.commandBufferCount = 1;
    VkCommandBuffer secondary = VK_NULL_HANDLE;
    ASSERT_EQ(vkAllocateCommandBuffers(device.handle(), &info, &secondary), VK_SUCCESS);
    const VkCommandBufferInheritanceInfo inherited{VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO};
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    begin.pInheritanceInfo = &inherited;
    EXPECT_EQ(vkBeginCommandBuffer(secondary, &begin), VK_SUCCESS);
    body(secondary);
    EXPECT_EQ(vkEndCommandBuffer(secondary), VK_SUCCESS);
    const Status ran =
        device.submitAndWait([&](VkCommandBuffer commands) { vkCmdExecuteCommands(commands, 1, &secondary); });
    EXPECT_TRUE(ran.ok());
    vkDestroyCommandPool(device.handle(), pool, nullptr);
}

TEST_P(Commanded, SecondaryCommandBuffersDo) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    CrowdContext context(*device, GetParam());
    ASSERT_TRUE(context.valid());
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(torus(8, 5));
    desc.capacity = 2;
    desc.rate = 4;
    desc.flags = SUPPLE_GROUP_MOTION;
    Crowd crowd(context, desc);
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance instance = crowd.spawn();
    crowd.pose(instance, SUPPLE_BIND_POSE, 0.0, glm::mat4(1.0f));
    crowd.run();
    const SuppleBufferRange vertices = crowd.output().streams.vertices;
    const std::vector<std::byte> expected = crowd.read(vertices);
    crowd.pose(instance, SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), glm::vec3(1.0f, 0.0f, 0.0f)));
    crowd.run();
    EXPECT_TRUE(crowd.read(vertices) != expected) << "or the comparison says nothing";

    crowd.pose(instance, SUPPLE_BIND_POSE, 0.0, glm::mat4(1.0f));
    context.beginFrame();
    const SuppleGroup group = crowd.group();
    runAsSecondary(*device, [&](VkCommandBuffer commands) {
        SuppleRecordDesc record{};
        record.structSize = sizeof(record);
        record.flags = SUPPLE_RECORD_TIMINGS;
        record.groups = &group;
        record.groupCount = 1;
        record.after = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
        record.before = record.after;
        EXPECT_EQ(suppleRecord(context.handle(), commands, &record), SUPPLE_OK);
    });
    EXPECT_TRUE(crowd.read(vertices) == expected);
}

} // namespace
} // namespace supple::test
