// The viewer without its window: two frames in flight, the rate and the file exchanged between frames, under the
// validation layer.
#include "tools/supple/view_stage.h"

#include "host/vk_struct.h"
#include "tests/tools/validated_device.h"

#include <chrono>
#include <gtest/gtest.h>
#include <thread>

namespace supple::tools {
namespace {

constexpr VkExtent2D kSize{160, 120};
constexpr float kAspect = 160.0f / 120.0f;

/// What a window does with its slots: a command buffer and a fence each.
class FrameRing {
public:
    explicit FrameRing(host::Device& device) : device_(device) {
        for (Slot& slot : slots_) {
            auto allocate = host::vkStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
            allocate.commandPool = device.commandPool();
            allocate.commandBufferCount = 1;
            EXPECT_EQ(vkAllocateCommandBuffers(device.handle(), &allocate, &slot.commands), VK_SUCCESS);
            auto fence = host::vkStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
            fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
            EXPECT_EQ(vkCreateFence(device.handle(), &fence, nullptr, &slot.done), VK_SUCCESS);
        }
    }
    ~FrameRing() {
        vkDeviceWaitIdle(device_.handle());
        for (const Slot& slot : slots_)
            vkDestroyFence(device_.handle(), slot.done, nullptr);
    }
    FrameRing(const FrameRing&) = delete;
    FrameRing& operator=(const FrameRing&) = delete;

    /// Waits for the slot that frame `number` takes, and no longer.
    void draw(ViewStage& stage, uint64_t number, const host::DrawTarget& target) {
        const auto index = static_cast<uint32_t>(number % 2);
        Slot& slot = slots_[index];
        vkWaitForFences(device_.handle(), 1, &slot.done, VK_TRUE, UINT64_MAX);
        vkResetFences(device_.handle(), 1, &slot.done);
        completed_ = std::max(completed_, slot.number);
        stage.retire(completed_);
        auto begin = host::vkStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        vkBeginCommandBuffer(slot.commands, &begin);
        const Status status = stage.record(slot.commands, index, number, completed_, target);
        EXPECT_TRUE(status.ok()) << status.error().message;
        vkEndCommandBuffer(slot.commands);
        auto commands = host::vkStruct<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO);
        commands.commandBuffer = slot.commands;
        auto submit = host::vkStruct<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
        submit.commandBufferInfoCount = 1;
        submit.pCommandBufferInfos = &commands;
        EXPECT_EQ(vkQueueSubmit2(device_.queue(), 1, &submit, slot.done), VK_SUCCESS);
        slot.number = number;
    }
    void waitIdle(uint64_t number) {
        vkDeviceWaitIdle(device_.handle());
        completed_ = std::max(completed_, number);
    }

private:
    struct Slot {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence done = VK_NULL_HANDLE;
        uint64_t number = 0;
    };
    host::Device& device_;
    Slot slots_[2];
    uint64_t completed_ = 0;
};

TEST(ViewStageTest, RateAndFileChangeWhileFramesAreInFlight) {
    Result<std::unique_ptr<host::Device>> device = host::createValidatedDevice();
    ASSERT_TRUE(device.ok()) << device.error().message;
    const std::shared_ptr<const host::ValidationLog> validation = (*device)->validation();
    {
        Result<std::unique_ptr<host::Context>> context = host::Context::create(**device, {.framesInFlight = 2});
        ASSERT_TRUE(context.ok()) << context.error().message;
        Result<std::unique_ptr<host::SurfaceRenderer>> renderer = host::SurfaceRenderer::create(
            **device, {.quality = host::StudioQuality::interactive(true), .framesInFlight = 2});
        ASSERT_TRUE(renderer.ok()) << renderer.error().message;
        Result<host::DrawTarget> target = host::DrawTarget::create(**device, kSize, (*renderer)->samples());
        ASSERT_TRUE(target.ok()) << target.error().message;
        DrawOptions options;
        options.rate = 2;
        Result<std::unique_ptr<ViewStage>> opened = ViewStage::create(**context, **renderer, options);
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        ViewStage& stage = **opened;
        FrameRing ring(**device);

        const std::string file = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
        const Status first = stage.open(file, "1", kAspect);
        ASSERT_TRUE(first.ok()) << first.error().message;
        EXPECT_EQ(stage.settings.clip, 1u);
        ring.waitIdle((*context)->lastFrame());
        for (int i = 0; i < 14; ++i) {
            stage.advance(1.0 / 30.0);
            stage.orbit(0.1f, 0.02f);
            stage.settings.cageOverlay = i % 3 == 0;
            stage.settings.cageFaces = i % 5 == 4;
            ring.draw(stage, (*context)->nextFrame(), *target);
            // New groups one after another, while the old ones are still being drawn.
            if (i == 3 || i == 4 || i == 10) {
                const auto half = static_cast<uint32_t>(3 + i); // of an edge: the cage takes a step first
                const Status changed = stage.setRate(2 * half, (*context)->lastFrame());
                ASSERT_TRUE(changed.ok()) << changed.error().message;
                EXPECT_EQ(stage.group().surfaces()[0].output.grid.rate, half);
            }
            if (i == 7) {
                ring.waitIdle((*context)->lastFrame());
                EXPECT_FALSE(stage.open("/nowhere.glb", {}, kAspect).ok());
                EXPECT_EQ(stage.figure().path(), file) << "a file that cannot be opened leaves the old one";
                const Status second = stage.open(file, {}, kAspect);
                ASSERT_TRUE(second.ok()) << second.error().message;
                ring.waitIdle((*context)->lastFrame());
            }
        }
        EXPECT_FALSE(stage.passTimes().names().empty());
        EXPECT_FALSE(stage.partTimes().names().empty());
        ring.waitIdle((*context)->lastFrame());
    }
    device->reset();
    EXPECT_EQ(validation->messageCount(), 0u);
}

/// What a stage stands on.
class RemadeStage : public testing::Test {
protected:
    void SetUp() override {
        device_ = host::createValidatedDevice();
        ASSERT_TRUE(device_.ok()) << device_.error().message;
        context_ = host::Context::create(**device_, {.framesInFlight = 2});
        ASSERT_TRUE(context_.ok()) << context_.error().message;
        renderer_ = host::SurfaceRenderer::create(
            **device_, {.quality = host::StudioQuality::interactive(true), .framesInFlight = 2});
        ASSERT_TRUE(renderer_.ok()) << renderer_.error().message;
    }
    void TearDown() override {
        renderer_->reset();
        context_->reset();
        EXPECT_EQ((*device_)->validation()->messageCount(), 0u);
    }
    /// A whole frame, which is complete afterwards.
    void draw(ViewStage& stage) {
        Result<host::DrawTarget> target = host::DrawTarget::create(**device_, kSize, (*renderer_)->samples());
        ASSERT_TRUE(target.ok()) << target.error().message;
        const uint64_t number = (*context_)->nextFrame();
        Status recorded = success();
        const Status submitted = (*device_)->submitAndWait(
            [&](VkCommandBuffer commands) { recorded = stage.record(commands, 0, number, number - 1, *target); });
        EXPECT_TRUE(recorded.ok() && submitted.ok());
    }
    [[nodiscard]] Result<std::unique_ptr<ViewStage>> create(const DrawOptions& options) {
        return ViewStage::create(**context_, **renderer_, options);
    }
    [[nodiscard]] uint64_t lastFrame() const { return (*context_)->lastFrame(); }
    void waitIdle() const { vkDeviceWaitIdle((*device_)->handle()); }

private:
    Result<std::unique_ptr<host::Device>> device_ = Error{ErrorCode::vulkan, "not made"};
    Result<std::unique_ptr<host::Context>> context_ = Error{ErrorCode::vulkan, "not made"};
    Result<std::unique_ptr<host::SurfaceRenderer>> renderer_ = Error{ErrorCode::vulkan, "not made"};
};

/// Scheme and skinning change as rates do; what a scheme refuses leaves the old surface.
TEST_F(RemadeStage, SchemeAndSkinningChange) {
    Result<std::unique_ptr<ViewStage>> opened = create({.rate = 6});
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    ViewStage& stage = **opened;
    ASSERT_TRUE(stage.open(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb", {}, kAspect).ok());
    EXPECT_EQ(stage.scheme(), SUPPLE_SCHEME_AUTO);
    EXPECT_EQ(stage.group().schemeOfPart(0), SUPPLE_SCHEME_CATMULL_CLARK);
    ASSERT_TRUE(stage.setScheme(SUPPLE_SCHEME_LOOP, lastFrame()).ok());
    EXPECT_EQ(stage.group().schemeOfPart(0), SUPPLE_SCHEME_LOOP);
    EXPECT_EQ(stage.settings.rate, 6) << "patches have every rate";
    const Status refused = stage.setScheme(SUPPLE_SCHEME_PREP, lastFrame());
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("quads only"), std::string::npos) << refused.error().message;
    EXPECT_EQ(stage.scheme(), SUPPLE_SCHEME_LOOP);
    EXPECT_EQ(stage.group().schemeOfPart(0), SUPPLE_SCHEME_LOOP);
    ASSERT_TRUE(stage.setSkinning(SUPPLE_SKINNING_DUAL_QUATERNION, lastFrame()).ok());
    EXPECT_EQ(stage.skinning(), SUPPLE_SKINNING_DUAL_QUATERNION);
    waitIdle();
}

/// Levels come with their view, follow the camera, and stay while it is frozen.
TEST_F(RemadeStage, LevelsFollowTheCameraUntilItIsFrozen) {
    Result<std::unique_ptr<ViewStage>> opened = create({.rate = 4, .view = "levels"});
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    ViewStage& stage = **opened;
    ASSERT_TRUE(stage.open(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb", {}, kAspect).ok());
    stage.settings.playing = false;
    ASSERT_TRUE(stage.needsOtherGroup());
    ASSERT_TRUE(stage.changeGroup(lastFrame()).ok());
    EXPECT_FALSE(stage.needsOtherGroup());
    const auto vertices = [&] {
        draw(stage);
        draw(stage); // the statistics are those of the frame before
        const std::optional<SuppleViewStatistics> drawn = stage.group().levelStatistics();
        return drawn ? drawn->vertexCount : 0u;
    };
    const uint32_t far = vertices();
    stage.settings.levelsFrozen = true;
    stage.zoom(8.0f);
    EXPECT_EQ(vertices(), far);
    stage.settings.levelsFrozen = false;
    EXPECT_GT(vertices(), far);

    stage.settings.levels = true;
    stage.settings.view = host::shared::kViewShaded;
    EXPECT_FALSE(stage.needsOtherGroup()) << "other views may have them too";
    stage.settings.view = host::shared::kViewWeights;
    ASSERT_TRUE(stage.needsOtherGroup()) << "but not those of measured values";
    ASSERT_TRUE(stage.changeGroup(lastFrame()).ok());
    EXPECT_EQ(stage.settings.rate, 4);
    waitIdle();
}

/// The farthest that a vertex has moved.
float farthest(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    float most = 0.0f;
    for (size_t v = 0; v < a.size(); ++v)
        most = std::max(most, glm::length(a[v] - b[v]));
    return most;
}

/// Ears and a tail swing, and their numbers change while they do.
TEST_F(RemadeStage, WhatIsSoftMovesAndIsTuned) {
    Result<std::unique_ptr<ViewStage>> opened = create({.rate = 1});
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    ViewStage& stage = **opened;
    ASSERT_TRUE(stage.open(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_moving.glb", "walk", kAspect).ok());
    EXPECT_TRUE(stage.settings.simulate) << "the file has springs";
    stage.settings.soft.springs = true;
    const auto walked = [&] {
        EXPECT_TRUE(!stage.needsOtherGroup() || stage.changeGroup(lastFrame()).ok());
        stage.settings.time = 0.0;
        for (int i = 0; i < 16; ++i) {
            draw(stage);
            stage.advance(1.0 / 30.0);
        }
        const Result<std::vector<glm::vec3>> cage = stage.group().readCage();
        EXPECT_TRUE(cage.ok());
        return cage.ok() ? *cage : std::vector<glm::vec3>();
    };
    const std::vector<glm::vec3> swung = walked();
    std::vector<PlacedStroke> strokes = stage.shownStrokes(kAspect);
    const auto dots = [&] {
        return std::count_if(strokes.begin(), strokes.end(), [](const PlacedStroke& stroke) { return stroke.isDot(); });
    };
    EXPECT_EQ(dots(), 2 * 3 + 8) << "two ears and a tail, with their ends";
    stage.settings.soft = {.painted = true};
    strokes = stage.shownStrokes(kAspect);
    EXPECT_EQ(dots(), std::ssize(strokes));
    EXPECT_GT(dots(), 20);
    stage.settings.tuning.gravity = 8.0f;
    ASSERT_TRUE(stage.tune(lastFrame()).ok());
    EXPECT_TRUE(stage.shownStrokes(kAspect).empty()) << "no frame of the new group yet";
    const std::vector<glm::vec3> heavy = walked();
    stage.settings.simulate = false;
    EXPECT_TRUE(stage.needsOtherGroup());
    const std::vector<glm::vec3> stiff = walked();
    EXPECT_GT(farthest(swung, stiff), 0.02f);
    EXPECT_GT(farthest(swung, heavy), 0.02f);
    waitIdle();
}

TEST_F(RemadeStage, ClipsGoOverIntoEachOther) {
    Result<std::unique_ptr<ViewStage>> opened = create({.rate = 1});
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    ViewStage& stage = **opened;
    ASSERT_TRUE(stage.open(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb", "walk", kAspect).ok());
    const auto surface = [&] {
        draw(stage);
        waitIdle();
        Result<std::vector<glm::vec3>> read = stage.group().readSurface();
        EXPECT_TRUE(read.ok());
        return read.ok() ? *read : std::vector<glm::vec3>();
    };
    const uint32_t walk = stage.settings.clip, joy = 2;
    stage.advance(0.5);
    const std::vector<glm::vec3> walks = surface();
    const auto changeTo = [&](uint32_t clip) {
        stage.settings.clip = clip;
        stage.settings.time = 0.0;
        return surface();
    };
    const std::vector<glm::vec3> atOnce = changeTo(joy);
    const float jump = farthest(walks, atOnce);
    ASSERT_GT(jump, 0.0f);
    for (const host::TransitionMethod method :
         {host::TransitionMethod::crossfade, host::TransitionMethod::deadBlending, host::TransitionMethod::quintic}) {
        stage.settings.change = method;
        stage.settings.clip = walk;
        stage.settings.time = 0.5;
        ASSERT_TRUE(stage.needsOtherGroup());
        ASSERT_TRUE(stage.changeGroup(lastFrame()).ok());
        EXPECT_TRUE(stage.group().plays());
        stage.settings.playing = false; // at once
        EXPECT_LT(farthest(surface(), walks), 1e-4f * jump);
        stage.settings.playing = true;
        EXPECT_LT(farthest(changeTo(joy), walks), 1e-3f * jump);
        stage.advance(0.1);
        EXPECT_GT(farthest(surface(), walks), 0.02f * jump) << "on its way";
        stage.advance(0.4);
        const std::vector<glm::vec3> later = surface();
        stage.settings.playing = false;
        stage.settings.change.reset();
        ASSERT_TRUE(stage.needsOtherGroup());
        ASSERT_TRUE(stage.changeGroup(lastFrame()).ok());
        EXPECT_LT(farthest(surface(), later), 1e-4f * jump) << "it is over";
        stage.settings.playing = true;
    }
    // Time does not go on in the rest pose, so it is taken at once.
    stage.settings.clip = SUPPLE_REST_POSE;
    const std::vector<glm::vec3> rests = surface();
    stage.settings.change = host::TransitionMethod::quintic;
    stage.settings.clip = walk;
    stage.settings.time = 0.5;
    ASSERT_TRUE(stage.changeGroup(lastFrame()).ok());
    EXPECT_LT(farthest(surface(), walks), 1e-4f * jump);
    EXPECT_LT(farthest(changeTo(SUPPLE_REST_POSE), rests), 1e-4f * jump);
    stage.settings.view = host::shared::kViewWeights;
    ASSERT_TRUE(stage.needsOtherGroup()) << "weights are measured in poses that are set";
    ASSERT_TRUE(stage.changeGroup(lastFrame()).ok());
    EXPECT_FALSE(stage.group().plays());
    EXPECT_FALSE(stage.needsOtherGroup());
    stage.settings.view = host::shared::kViewShaded;
    waitIdle();
}

/// Distances are measured once for each pose in which the figure stands; what is looked at meanwhile may change.
TEST_F(RemadeStage, DistancesAreMeasuredOncePerPose) {
    Result<std::unique_ptr<ViewStage>> opened = create({.rate = 2, .view = "distance"});
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    ViewStage& stage = **opened;
    ASSERT_TRUE(stage.open(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb", {}, kAspect).ok());
    ASSERT_TRUE(stage.needsValues());
    ASSERT_TRUE(stage.measureValues(true).ok());
    EXPECT_FALSE(stage.needsValues());
    draw(stage);
    stage.settings.time = 0.25;
    EXPECT_FALSE(stage.needsValues()) << "it plays";
    stage.settings.playing = false;
    ASSERT_TRUE(stage.needsValues());
    ASSERT_TRUE(stage.measureValues(false).ok());
    stage.settings.view = host::shared::kViewShaded;
    while (!stage.needsValues())
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ASSERT_TRUE(stage.measureValues(false).ok());
    EXPECT_FALSE(stage.needsValues());
    stage.settings.view = host::shared::kViewDistance;
    EXPECT_TRUE(stage.needsValues()) << "what was measured was not shown";
    waitIdle();
}

/// The rate that is shown is along an edge of the cage, of which subdivision's patches are a half or a quarter.
TEST_F(RemadeStage, RatesOfSubdivisionArePowersOfTwo) {
    struct Case {
        const char* file;
        const char* scheme;
        uint32_t steps; ///< halvings between the cage's edges and the patches'
    };
    for (const Case& c : {Case{"pip.glb", "fragments", 2}, {"pip_quads.glb", "fragments", 1}}) {
        SCOPED_TRACE(c.file);
        DrawOptions options;
        options.scheme = c.scheme;
        options.rate = 5;
        Result<std::unique_ptr<ViewStage>> opened = create(options);
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        ViewStage& stage = **opened;
        EXPECT_TRUE(stage.ratesArePowersOfTwo());
        EXPECT_EQ(stage.offeredRate(1), 2u);
        EXPECT_EQ(stage.offeredRate(5), 8u);
        EXPECT_EQ(stage.offeredRate(64), 64u);
        const Status status = stage.open(std::string(SUPPLE_SAMPLE_ASSETS) + "/" + c.file, {}, kAspect);
        ASSERT_TRUE(status.ok()) << status.error().message;
        EXPECT_EQ(stage.settings.rate, 8);
        EXPECT_EQ(stage.group().surfaces()[0].output.grid.rate, 8u >> c.steps);
        ASSERT_TRUE(stage.setRate(2, lastFrame()).ok());
        EXPECT_EQ(stage.settings.rate, 1 << c.steps) << "no fewer segments than patches";
        EXPECT_EQ(stage.group().surfaces()[0].output.grid.rate, 1u);
        waitIdle();
    }
}

} // namespace
} // namespace supple::tools
