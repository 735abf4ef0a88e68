// All draw ranges of a group by one indirect call, as docs/integration.md and shaders/supple_surface.glsl say: it draws
// the same picture as a call per range with push constants.
#include "shaders/prop_frag.h"
#include "shaders/ranges_vert.h"
#include "shaders/ranges_vert_DRAW_ID.h"
#include "tests/support/canvas.h"
#include "tests/support/crowd.h"
#include "tests/support/shader_range.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

struct RangePush {
    glm::vec4 window{};
    ShaderRange range;
};

std::vector<ShaderRange> shaderRanges(const SuppleGridOutput& grid) {
    std::vector<ShaderRange> ranges;
    for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
        ranges.push_back(shaderRange(grid, r));
    }
    return ranges;
}

/// Draws a group in both ways.
class RangeDrawing {
public:
    RangeDrawing(host::Device& device, const host::GroupOutput& output, std::span<const ShaderRange> ranges)
        : device_(device), output_(output), ranges_(ranges.begin(), ranges.end()), canvas_(device) {
        constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT;
        const VkDescriptorSetLayout setLayout =
            *host::createSetLayout(device, {{0, kStorage, kVertex}, {1, kStorage, kVertex}, {4, kStorage, kVertex}});
        layout_ = *host::createPipelineLayout(device, {setLayout}, sizeof(RangePush), kVertex);
        pool_ = std::move(*host::DescriptorPool::create(device, 1));
        set_ = *pool_.allocate(setLayout);
        buffer_ =
            std::move(*device.uploadBuffer(ranges.data(), ranges.size_bytes(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
        pool_.write(set_, {host::storageBuffer(0, output.grid.rates[0].instances),
                           host::storageBuffer(1, output.streams.vertices),
                           host::storageBuffer(4, buffer_.handle(), 0, VK_WHOLE_SIZE)});
    }

    host::Picture draw(bool byDrawId, const glm::vec4& window) {
        host::GraphicsDesc desc = Canvas::pipelineDesc("test ranges");
        desc.layout = layout_;
        desc.vertexShader =
            byDrawId ? std::span<const uint32_t>(ranges_vert_DRAW_ID) : std::span<const uint32_t>(ranges_vert);
        desc.fragmentShader = prop_frag;
        const VkPipeline pipeline = *host::createGraphicsPipeline(device_, desc);
        return canvas_.draw([&](VkCommandBuffer commands) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
            recordDraws(commands, byDrawId, window);
        });
    }

private:
    void recordDraws(VkCommandBuffer commands, bool byDrawId, const glm::vec4& window) const {
        const SuppleGridOutput& grid = output_.grid;
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set_, 0, nullptr);
        vkCmdBindIndexBuffer(commands, grid.indices.buffer, grid.indices.offset,
                             grid.indices.stride == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
        RangePush push;
        push.window = window;
        if (byDrawId) {
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(push), &push);
            vkCmdDrawIndexedIndirect(commands, grid.indirect.buffer, grid.indirect.offset, grid.drawRangeCount,
                                     grid.indirect.stride);
            return;
        }
        for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
            push.range = ranges_[r];
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(push), &push);
            vkCmdDrawIndexedIndirect(commands, grid.indirect.buffer,
                                     grid.indirect.offset + VkDeviceSize{r} * grid.indirect.stride, 1, 0);
        }
    }

    host::Device& device_;
    const host::GroupOutput output_;
    std::vector<ShaderRange> ranges_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    host::DescriptorPool pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    host::Buffer buffer_;
    Canvas canvas_;
};

uint32_t pixelsThatDiffer(const host::Picture& a, const host::Picture& b) {
    uint32_t count = 0;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        count += std::equal(a.rgba.begin() + static_cast<ptrdiff_t>(i), a.rgba.begin() + static_cast<ptrdiff_t>(i) + 4,
                            b.rgba.begin() + static_cast<ptrdiff_t>(i))
                     ? 0
                     : 1;
    }
    return count;
}

using DrawRanges = CrowdContexts;

TEST_F(DrawRanges, OfAGroupAreDrawnByOneCall) {
    const auto& features = *static_cast<const VkPhysicalDeviceFeatures2*>(testDevice()->enabledFeatures());
    ASSERT_EQ(features.features.multiDrawIndirect, VK_TRUE) << "and shaderDrawParameters with it";
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    const host::Picture blank = Canvas::blank();
    for (const uint32_t flags : {0u, uint32_t{SUPPLE_GROUP_INDEXED_MESH}}) {
        SuppleGroupDesc desc{};
        desc.asset = own.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb"); // three materials
        desc.capacity = 3;
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.rate = 4;
        desc.flags = flags;
        Crowd crowd(own, desc);
        ASSERT_TRUE(crowd.valid());
        for (uint32_t i = 0; i < desc.capacity; ++i) {
            const SuppleInstance instance = crowd.spawn();
            crowd.pose(instance, SUPPLE_BIND_POSE, 0.0,
                       glm::translate(glm::mat4(1.0f), {0.8f * static_cast<float>(i) - 0.8f, 0.0f, 0.0f}));
            // The first instance of some draws is not 0 then.
            EXPECT_EQ(suppleSetPartVisible(own.handle(), instance, 0, i == 1 ? 0 : 1), SUPPLE_OK);
        }
        crowd.run();
        const host::GroupOutput output = crowd.output();
        std::vector<ShaderRange> ranges = shaderRanges(output.grid);
        ASSERT_GE(ranges.size(), 3u);
        const auto draws = crowd.draws();
        EXPECT_TRUE(std::ranges::any_of(draws, [](const auto& draw) { return draw.firstInstance > 0; }));
        const glm::vec4 window(0.0f, 0.8f, 1.3f, 0.0f);
        RangeDrawing drawing(own.device(), output, ranges);
        const host::Picture pushed = drawing.draw(false, window), byDrawId = drawing.draw(true, window);
        std::printf("%zu ranges, %u pixels\n", ranges.size(), pixelsThatDiffer(pushed, blank));
        EXPECT_GT(pixelsThatDiffer(pushed, blank), Canvas::kSide * Canvas::kSide / 16);
        EXPECT_EQ(pixelsThatDiffer(pushed, byDrawId), 0u);
        // And it can be told: with the ranges in another order they are other vertices.
        std::ranges::reverse(ranges);
        RangeDrawing mistaken(own.device(), output, ranges);
        if (flags == 0) {
            EXPECT_GT(pixelsThatDiffer(pushed, mistaken.draw(true, window)), 100u);
        }
    }
}

} // namespace
} // namespace supple::test
