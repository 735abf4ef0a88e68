// The draws of a whole view gathered into bins (host/view_draws.h): they make the picture that a call per draw makes.
#include "host/draw_target.h"
#include "host/rendering.h"
#include "host/view_draws.h"
#include "shaders/view_draws_frag.h"
#include "shaders/view_draws_vert.h"
#include "shaders/view_draws_vert_GATHERED.h"
#include "tests/support/crowd.h"
#include "tests/support/test_view.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

constexpr uint32_t kViewPictureSide = 256;
const glm::vec4 kViewWindow(0.0f, 0.8f, 1.5f, 0.0f);

struct EachPush {
    glm::vec4 window{};
    uint32_t index = 0, verticesPerInstance = 0, samplesPerPatch = 0, previousWords = 0;
    uint32_t surface = 0, material = 0;
};
struct GatheredPush {
    glm::vec4 window{};
    uint32_t firstDraw = 0;
};

/// Draws the groups of a view by a call per draw, or by gathered ones.
class ViewDrawing {
public:
    ViewDrawing(host::Device& device, std::vector<host::GroupOutput> outputs)
        : device_(device), outputs_(std::move(outputs)) {
        constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT;
        setLayout_ = *host::createSetLayout(
            device, {{1, kStorage, kVertex}, {4, kStorage, kVertex}, {5, kStorage, kVertex}, {6, kStorage, kVertex}});
        layout_ = *host::createPipelineLayout(device, {setLayout_}, sizeof(EachPush), kVertex);
        each_ = pipeline(view_draws_vert);
        gathered_ = pipeline(view_draws_vert_GATHERED);
        pool_ = std::move(*host::DescriptorPool::create(device, 8));
        target_ =
            std::move(*host::DrawTarget::create(device, {kViewPictureSide, kViewPictureSide}, VK_SAMPLE_COUNT_1_BIT));
    }

    [[nodiscard]] std::vector<SuppleLevelOutput> surfaces() const {
        std::vector<SuppleLevelOutput> all;
        for (const host::GroupOutput& output : outputs_) {
            all.push_back(output.levels);
        }
        return all;
    }

    host::Picture drawEach() {
        std::vector<VkDescriptorSet> sets;
        for (const host::GroupOutput& output : outputs_) {
            sets.push_back(setOf(output.levels.buckets, output.levels.patches, output.levels.buckets));
        }
        return picture([](VkCommandBuffer) {},
                       [&](VkCommandBuffer commands) {
                           vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, each_);
                           for (uint32_t s = 0; s < outputs_.size(); ++s) {
                               recordEach(commands, s, sets[s]);
                           }
                       });
    }

    host::Picture draw(const host::ViewDraws& draws, uint32_t bins) {
        const VkDescriptorSet set =
            setOf(draws.buckets(), draws.patches(), {draws.drawn().handle(), 0, VK_WHOLE_SIZE, 0});
        return picture([&](VkCommandBuffer commands) { draws.record(commands); },
                       [&](VkCommandBuffer commands) {
                           vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, gathered_);
                           vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0,
                                                   nullptr);
                           for (uint32_t bin = 0; bin < bins; ++bin) {
                               const GatheredPush push{kViewWindow, draws.firstDraw(bin)};
                               vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
                               draws.draw(commands, bin);
                           }
                       });
    }

private:
    VkPipeline pipeline(std::span<const uint32_t> vertexShader) {
        host::GraphicsDesc desc;
        desc.name = "test draws of a view";
        desc.layout = layout_;
        desc.vertexShader = vertexShader;
        desc.fragmentShader = view_draws_frag;
        desc.colors = {host::kPictureFormat};
        desc.depth = host::kDepthFormat;
        return *host::createGraphicsPipeline(device_, desc);
    }

    VkDescriptorSet setOf(const SuppleBufferRange& buckets, const SuppleBufferRange& patches,
                          const SuppleBufferRange& drawn) {
        const VkDescriptorSet set = *pool_.allocate(setLayout_);
        pool_.write(set, {host::storageBuffer(1, outputs_.front().streams.vertices), host::storageBuffer(4, buckets),
                          host::storageBuffer(5, patches), host::storageBuffer(6, drawn)});
        return set;
    }

    void recordEach(VkCommandBuffer commands, uint32_t surface, VkDescriptorSet set) const {
        const SuppleLevelOutput& levels = outputs_[surface].levels;
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0, nullptr);
        vkCmdBindIndexBuffer(commands, levels.indices.buffer, levels.indices.offset, VK_INDEX_TYPE_UINT16);
        for (uint32_t i = 0; i < levels.drawCount; ++i) {
            const SuppleLevelDraw& draw = levels.draws[i];
            const EachPush push{kViewWindow,  i, draw.verticesPerInstance, draw.samplesPerPatch, 0, surface,
                                draw.material};
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
            vkCmdDrawIndexedIndirect(commands, levels.indirect.buffer,
                                     levels.indirect.offset + VkDeviceSize{i} * levels.indirect.stride, 1, 0);
        }
    }

    host::Picture picture(const std::function<void(VkCommandBuffer)>& before,
                          const std::function<void(VkCommandBuffer)>& draws) {
        constexpr VkImageLayout kColor = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                kDepth = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
        const SuppleSyncScope any = kAnyUse;
        EXPECT_TRUE(
            device_
                .submitAndWait([&](VkCommandBuffer commands) {
                    before(commands);
                    host::memoryBarrier(commands, host::ViewDraws::kWrites, host::kDrawn);
                    host::imageBarrier(commands, target_.color(), {VK_IMAGE_LAYOUT_UNDEFINED, any}, {kColor, any});
                    host::imageBarrier(commands, target_.depth(), {VK_IMAGE_LAYOUT_UNDEFINED, any}, {kDepth, any});
                    const VkRenderingAttachmentInfo color = host::attachment(target_.color(), kColor);
                    host::beginRendering(commands, target_.extent(), {&color, 1},
                                         host::attachment(target_.depth(), kDepth, {.depthStencil = {1.0f, 0}}));
                    draws(commands);
                    vkCmdEndRendering(commands);
                    host::imageBarrier(commands, target_.color(), {kColor, any},
                                       {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, any});
                })
                .ok());
        Result<host::Picture> made = host::readPicture(device_, target_.color());
        EXPECT_TRUE(made.ok());
        return made.ok() ? std::move(*made) : host::Picture::blank(kViewPictureSide, kViewPictureSide);
    }

    host::Device& device_;
    const std::vector<host::GroupOutput> outputs_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline each_ = VK_NULL_HANDLE, gathered_ = VK_NULL_HANDLE;
    host::DescriptorPool pool_;
    host::DrawTarget target_;
};

uint32_t unlikePixels(const host::Picture& a, const host::Picture& b) {
    uint32_t count = 0;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        count += std::memcmp(&a.rgba[i], &b.rgba[i], 4) == 0 ? 0 : 1;
    }
    return count;
}

/// How many commands of the surfaces draw something.
uint32_t drawnOf(std::initializer_list<const Crowd*> crowds) {
    uint32_t count = 0;
    for (const Crowd* const crowd : crowds) {
        for (const VkDrawIndexedIndirectCommand& draw : crowd->draws()) {
            count += draw.instanceCount > 0 ? 1 : 0;
        }
    }
    return count;
}

using ViewDrawsOf = CrowdContexts;

/// Helmets of three materials and dragons, side by side, at different distances.
TEST_F(ViewDrawsOf, GroupsMakeThePictureOfACallPerDraw) {
    ASSERT_TRUE(testDevice()->drawsMany());
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    TestView view(own, 200'000, SUPPLE_VIEW_CULL);
    view.look({0.0f, 1.0f, 3.0f});
    SuppleGroupDesc desc{};
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.view = view.handle();
    desc.asset = own.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb");
    Crowd helmets(own, desc);
    desc.asset = own.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb");
    Crowd dragons(own, desc);
    ASSERT_TRUE(helmets.valid() && dragons.valid());
    for (Crowd* const crowd : {&helmets, &dragons}) {
        const float side = crowd == &helmets ? -0.8f : 0.8f;
        crowd->pose(crowd->spawn(), SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), {side, 0.0f, 0.0f}));
        crowd->pose(crowd->spawn(), SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, 5.0f * side}));
    }
    const SuppleGroup groups[] = {helmets.group(), dragons.group()};
    own.run(groups);

    ViewDrawing drawing(own.device(), {helmets.output(), dragons.output()});
    const host::Picture blank = host::Picture::blank(kViewPictureSide, kViewPictureSide);
    const host::Picture each = drawing.drawEach();
    EXPECT_GT(unlikePixels(each, blank), kViewPictureSide * kViewPictureSide / 16);

    const std::vector<SuppleLevelOutput> surfaces = drawing.surfaces();
    Result<host::ViewDraws> all =
        host::ViewDraws::create(own.device(), surfaces, 1, [](uint32_t, const SuppleLevelDraw&) { return 0u; });
    ASSERT_TRUE(all.ok()) << all.error().message;
    const uint32_t drawn = drawnOf({&helmets, &dragons});
    std::printf("%u of %u draws draw something\n", drawn, all->drawCount(0));
    EXPECT_EQ(all->drawCount(0), surfaces[0].drawCount + surfaces[1].drawCount);
    EXPECT_LT(2 * drawn, all->drawCount(0)) << "or nothing would be gathered";
    EXPECT_EQ(unlikePixels(each, drawing.draw(*all, 1)), 0u);

    // A bin a material of helmets, and all dragons in the last one. Where patches of two materials meet, the first to
    // be drawn is seen; else the picture is the same.
    const auto byMaterial = [](uint32_t surface, const SuppleLevelDraw& draw) {
        return surface == 0 ? std::min(draw.material, 3u) : 4u;
    };
    Result<host::ViewDraws> binned = host::ViewDraws::create(own.device(), surfaces, 5, byMaterial);
    ASSERT_TRUE(binned.ok());
    EXPECT_LT(unlikePixels(each, drawing.draw(*binned, 5)), 64u);
    // What is left out is missing.
    Result<host::ViewDraws> helmetsAlone =
        host::ViewDraws::create(own.device(), surfaces, 1, [](uint32_t surface, const SuppleLevelDraw&) {
            return surface == 0 ? 0u : host::ViewDraws::kNoBin;
        });
    ASSERT_TRUE(helmetsAlone.ok());
    const host::Picture withoutDragons = drawing.draw(*helmetsAlone, 1);
    EXPECT_GT(unlikePixels(each, withoutDragons), 1000u);
    EXPECT_GT(unlikePixels(blank, withoutDragons), 1000u);

    // A frame in which nothing is seen draws nothing: what the last one gathered is gone.
    view.camera.farthest = 0.1f;
    view.look({0.0f, 1.0f, 100.0f});
    own.run(groups);
    EXPECT_EQ(drawnOf({&helmets, &dragons}), 0u);
    EXPECT_EQ(unlikePixels(blank, drawing.draw(*all, 1)), 0u);
}

TEST_F(ViewDrawsOf, SeveralViewsAreRefused) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    TestView first(own, 20'000), second(own, 20'000);
    SuppleGroupDesc desc{};
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.asset = own.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb");
    desc.view = first.handle();
    Crowd one(own, desc);
    desc.view = second.handle();
    Crowd other(own, desc);
    ASSERT_TRUE(one.valid() && other.valid());
    const auto bin = [](uint32_t, const SuppleLevelDraw&) { return 0u; };
    const SuppleLevelOutput both[] = {one.output().levels, other.output().levels};
    const Result<host::ViewDraws> mixed = host::ViewDraws::create(own.device(), both, 1, bin);
    ASSERT_FALSE(mixed.ok());
    EXPECT_NE(mixed.error().message.find("several views"), std::string::npos) << mixed.error().message;
    EXPECT_FALSE(host::ViewDraws::create(own.device(), {}, 1, bin).ok());
}

} // namespace
} // namespace supple::test
