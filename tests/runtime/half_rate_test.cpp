// Groups that are not recorded in every frame: the shader of the other frames finds no motion, as docs/integration.md
// says.
#include "host/pipelines.h"
#include "shaders/motion_comp.h"
#include "shaders/motion_comp_VERTEX_24.h"
#include "tests/support/crowd.h"
#include "tests/support/shader_range.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

struct MotionPush {
    ShaderRange range;
    uint32_t count = 0; ///< of vertices that are drawn
};

/// How far the shader finds each vertex of a group of one range to have moved.
std::vector<float> moved(const Crowd& crowd, uint32_t instances, const SuppleBufferRange& previous,
                         uint32_t previousWords) {
    host::Device& device = crowd.context().device();
    const host::GroupOutput output = crowd.output();
    const SuppleGridOutput& grid = output.grid;
    const SuppleBufferRange& vertices = output.streams.vertices;
    EXPECT_EQ(grid.drawRangeCount, 1u);
    MotionPush push;
    push.range = shaderRange(grid, 0);
    push.range.previousWords = previousWords;
    push.count = instances * push.range.patchCount * push.range.samplesPerPatch;

    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    constexpr VkShaderStageFlags kCompute = VK_SHADER_STAGE_COMPUTE_BIT;
    const VkDescriptorSetLayout setLayout = *host::createSetLayout(
        device, {{0, kStorage, kCompute}, {1, kStorage, kCompute}, {2, kStorage, kCompute}, {4, kStorage, kCompute}});
    const VkPipelineLayout layout = *host::createPipelineLayout(device, {setLayout}, sizeof(push), kCompute);
    const VkPipeline pipeline =
        *host::createComputePipeline(device, layout,
                                     vertices.stride == 24 ? std::span<const uint32_t>(motion_comp_VERTEX_24)
                                                           : std::span<const uint32_t>(motion_comp));
    const std::vector<float> none(size_t{instances} * grid.verticesPerInstance, -1.0f);
    const host::Buffer result =
        std::move(*device.uploadBuffer(none.data(), none.size() * sizeof(float),
                                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT));
    host::DescriptorPool pool = std::move(*host::DescriptorPool::create(device, 1));
    const VkDescriptorSet set = *pool.allocate(setLayout);
    pool.write(set, {host::storageBuffer(0, grid.rates[0].instances), host::storageBuffer(1, vertices),
                     host::storageBuffer(2, previous), host::storageBuffer(4, result.handle(), 0, VK_WHOLE_SIZE)});
    EXPECT_TRUE(device
                    .submitAndWait([&](VkCommandBuffer commands) {
                        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
                        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0,
                                                nullptr);
                        vkCmdPushConstants(commands, layout, kCompute, 0, sizeof(push), &push);
                        vkCmdDispatch(commands, (push.count + 63) / 64, 1, 1);
                    })
                    .ok());
    std::vector<float> distances = as<float>(*device.readBuffer(result.handle(), 0, none.size() * sizeof(float)));
    std::erase(distances, -1.0f); // room between instances
    EXPECT_EQ(distances.size(), push.count);
    return distances;
}

float least(const std::vector<float>& distances) {
    return *std::ranges::min_element(distances);
}
float most(const std::vector<float>& distances) {
    return *std::ranges::max_element(distances);
}

class HalfRate : public CrowdContexts, public testing::WithParamInterface<SuppleVertexFormat> {};

TEST_P(HalfRate, AFrameThatDoesNotRecordAGroupFindsNoMotion) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    SuppleGroupDesc desc{};
    desc.asset = own.createAsset(cage::makeCubeSphere(3));
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 3;
    desc.flags = SUPPLE_GROUP_MOTION;
    desc.vertexFormat = GetParam();
    Crowd crowd(own, desc);
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance instances[] = {crowd.spawn(), crowd.spawn()};
    const auto place = [&](float x) {
        for (const SuppleInstance instance : instances) {
            crowd.pose(instance, SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), {x, 0.0f, 0.0f}));
        }
    };
    place(0.0f);
    crowd.run();
    place(0.5f);
    crowd.run();
    const SuppleVertexStreams streams = crowd.output().streams;
    const uint32_t words = streams.vertices.stride / 4;
    EXPECT_EQ(words, GetParam() == SUPPLE_VERTEX_24 ? 6u : 4u);
    const std::vector<float> recorded = moved(crowd, 2, streams.previousPositions, 0);
    EXPECT_NEAR(least(recorded), 0.5f, 1e-6f);
    EXPECT_NEAR(most(recorded), 0.5f, 1e-6f);
    const PositionBits shown[] = {crowd.positions(0), crowd.positions(1)};

    own.run(std::span<const SuppleGroup>{}); // the frame of half the rate
    const std::vector<float> left = moved(crowd, 2, streams.vertices, words);
    EXPECT_EQ(least(left), 0.0f);
    EXPECT_EQ(most(left), 0.0f);
    EXPECT_GT(most(moved(crowd, 2, streams.vertices, 0)), 0.1f) << "the shader does not heed previousWords";

    place(0.75f);
    crowd.run(); // has moved since the last frame that showed it anew
    const std::vector<float> again = moved(crowd, 2, streams.previousPositions, 0);
    EXPECT_NEAR(least(again), 0.25f, 1e-6f);
    EXPECT_NEAR(most(again), 0.25f, 1e-6f);
    for (uint32_t slot = 0; slot < 2; ++slot) {
        EXPECT_EQ(differences(crowd.previous(slot), shown[slot]), 0u);
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, HalfRate, testing::Values(SUPPLE_VERTEX_16, SUPPLE_VERTEX_24),
                         [](const auto& info) { return info.param == SUPPLE_VERTEX_24 ? "Of24Bytes" : "Of16Bytes"; });

} // namespace
} // namespace supple::test
