// SUPPLE_CONTEXT_SHARED_DISPATCHES: as many dispatches for many characters as for two, and the same bits. Other suites
// can be run with it: SUPPLE_TEST_SHARED_DISPATCHES=1.
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/test_view.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/procedural.h"

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <optional>

namespace supple::test {
namespace {

constexpr uint32_t kCapacity = 3;

/// A different cage a number, of one scheme's classes all.
cage::Cage figure(uint32_t number) {
    return perturbed(cage::makeCubeSphere(2 + number % 2), 0.02f + 0.01f * static_cast<float>(number % 5), number);
}

struct Use {
    const char* name;
    SuppleScheme scheme = SUPPLE_SCHEME_PM;
    uint32_t flags = 0; ///< SuppleGroupFlags
    std::optional<uint32_t> view;
};
const Use kUses[] = {
    {"prep", SUPPLE_SCHEME_PREP, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_PATCHES, {}},
    {"pm", SUPPLE_SCHEME_PM, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, {}},
    {"catmull-clark", SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_GROUP_INDEXED_MESH, {}},
    {"fragments", SUPPLE_SCHEME_FRAGMENTS, SUPPLE_GROUP_MOTION, {}},
    {"blend", SUPPLE_SCHEME_BLEND, 0, {}},
    {"polygons", SUPPLE_SCHEME_POLYGONS, 0, {}},
    {"pm in a view", SUPPLE_SCHEME_PM, 0, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES},
    {"catmull-clark in a view", SUPPLE_SCHEME_CATMULL_CLARK, 0, SUPPLE_VIEW_BACK_FACES},
    {"fragments in a view", SUPPLE_SCHEME_FRAGMENTS, 0, SUPPLE_VIEW_CULL},
};

/// Groups of different characters that are recorded together.
class Scene {
public:
    Scene(CrowdContext& context, const Use& use, uint32_t characters) : context_(context), use_(use) {
        if (use.view) {
            view_.emplace(context, 200000, *use.view);
            const glm::mat4 both =
                glm::perspectiveRH_ZO(1.2f, 1.0f, 0.1f, 100.0f) *
                glm::lookAt(glm::vec3(0.0f, 0.0f, 14.0f), glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
            std::memcpy(view_->camera.viewProjection, &both, sizeof both);
            view_->camera.smallestEdge = 10.0f;
            view_->look({0.0f, 0.0f, 14.0f});
        }
        for (uint32_t c = 0; c < characters; ++c) {
            add(c);
        }
    }
    void add(uint32_t number) {
        SuppleGroupDesc desc{};
        desc.asset = context_.createAsset(figure(number));
        desc.capacity = kCapacity;
        desc.scheme = use_.scheme;
        desc.flags = use_.flags;
        desc.rate = 4;
        if (view_) {
            desc.view = view_->handle();
        }
        crowds_.push_back(std::make_unique<Crowd>(context_, desc));
        groups_.push_back(crowds_.back()->group());
        for (uint32_t i = 0; i < kCapacity; ++i) {
            instances_.push_back(crowds_.back()->spawn());
            place(number * kCapacity + i, 0.0f);
        }
    }
    void place(uint32_t index, float shift) {
        const auto x = static_cast<float>(index % 5) - 2.0f, y = static_cast<float>(index / 5) - 2.0f;
        crowds_[index / kCapacity]->pose(instances_[index], SUPPLE_BIND_POSE, 0.0,
                                         glm::translate(glm::mat4(1.0f), {2.5f * x + shift, 2.5f * y, -0.1f * y}));
    }
    void run() { context_.run(groups_); }
    void endGroups() {
        for (const std::unique_ptr<Crowd>& crowd : crowds_) {
            crowd->end();
        }
    }
    [[nodiscard]] std::span<const SuppleGroup> groups() const { return groups_; }

    /// What was drawn, without the numbers of vertices.
    [[nodiscard]] std::vector<DrawnPatches> drawn() const {
        std::vector<DrawnPatches> all;
        for (const std::unique_ptr<Crowd>& crowd : crowds_) {
            all.push_back(drawnPatches(*crowd));
        }
        return all;
    }

private:
    CrowdContext& context_;
    const Use& use_;
    std::optional<TestView> view_;
    std::vector<std::unique_ptr<Crowd>> crowds_;
    std::vector<SuppleGroup> groups_;
    std::vector<SuppleInstance> instances_;
};

class SharedDispatches : public testing::Test {
protected:
    void SetUp() override {
        (void)wrappedVulkan();
        device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
    }
    void TearDown() override {
        EXPECT_EQ(device->validation()->messageCount(), 0u);
        device = nullptr;
        (void)wrappedVulkan();
    }
    std::unique_ptr<host::Device> device;
};

TEST_F(SharedDispatches, DrawTheSameBitsAlsoInRows) {
    CrowdContext plain(*device, SUPPLE_MAPPING_WIDE);
    // Rows of three workgroups: dispatches have more of them than their tasks.
    currentWrappedVulkan().maxComputeWorkGroupCountX = 3;
    CrowdContext shared(*device, SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    currentWrappedVulkan().maxComputeWorkGroupCountX = 0;
    for (const Use& use : kUses) {
        SCOPED_TRACE(use.name);
        Scene one(plain, use, 4), other(shared, use, 4);
        for (uint32_t frame = 0; frame < 3; ++frame) {
            for (Scene* scene : {&one, &other}) {
                scene->place(frame, 0.1f); // one that moves
                scene->run();
            }
        }
        const std::vector<DrawnPatches> expected = one.drawn();
        size_t patches = 0;
        for (const DrawnPatches& group : expected) {
            patches += group.size();
        }
        EXPECT_GT(patches, 4u);
        EXPECT_TRUE(other.drawn() == expected);
    }
}

TEST_F(SharedDispatches, DoNotCountCharacters) {
    CrowdContext context(*device, SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    WrappedVulkan& wrapped = currentWrappedVulkan();
    for (const Use& use : {kUses[1], kUses[2], kUses[6]}) {
        SCOPED_TRACE(use.name);
        std::array<uint64_t, 2> dispatches{}, barriers{};
        for (const uint32_t characters : {2u, 6u}) {
            Scene scene(context, use, characters);
            scene.run();
            scene.run();
            wrapped.dispatches = wrapped.indirectDispatches = wrapped.barriers = 0;
            scene.run();
            dispatches[characters / 6] = wrapped.dispatches + wrapped.indirectDispatches;
            barriers[characters / 6] = wrapped.barriers;
        }
        EXPECT_GT(dispatches[0], 4u);
        EXPECT_EQ(dispatches[1], dispatches[0]);
        EXPECT_EQ(barriers[1], barriers[0]);
    }
}

TEST_F(SharedDispatches, GroupsThatAreMadeInAFrameHaveRoom) {
    CrowdContext context(*device, SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    CrowdContext plain(*device, SUPPLE_MAPPING_WIDE);
    const Use use{"pm", SUPPLE_SCHEME_PM, 0, {}};
    Scene scene(context, use, 1), expected(plain, use, 4);
    expected.run();
    context.beginFrame();
    const Status ran = device->submitAndWait([&](VkCommandBuffer commands) {
        EXPECT_EQ(context.record(commands, scene.groups()), SUPPLE_OK);
        for (uint32_t more = 1; more < 4; ++more) {
            scene.add(more);
            EXPECT_EQ(context.record(commands, scene.groups().subspan(more)), SUPPLE_OK);
        }
    });
    EXPECT_TRUE(ran.ok());
    EXPECT_TRUE(scene.drawn() == expected.drawn());
}

TEST_F(SharedDispatches, GroupsThatComeAndGoInAFrameHaveRoom) {
    CrowdContext context(*device, SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    const Use use{"pm", SUPPLE_SCHEME_PM, 0, {}};
    context.beginFrame();
    std::vector<std::unique_ptr<Scene>> scenes;
    const Status ran = device->submitAndWait([&](VkCommandBuffer commands) {
        for (uint32_t i = 0; i < 5; ++i) {
            scenes.push_back(std::make_unique<Scene>(context, use, 1));
            EXPECT_EQ(context.record(commands, scenes.back()->groups()), SUPPLE_OK);
            if (i < 4) { // what it takes of the frame's room stays taken
                scenes.back()->endGroups();
            }
        }
    });
    EXPECT_TRUE(ran.ok());
    CrowdContext plain(*device, SUPPLE_MAPPING_WIDE);
    Scene expected(plain, use, 1);
    expected.run();
    EXPECT_TRUE(scenes.back()->drawn() == expected.drawn());
}

TEST_F(SharedDispatches, TimingsTellEachGroup) {
    CrowdContext context(*device, SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    CrowdContext plain(*device, SUPPLE_MAPPING_WIDE);
    const Use use{"pm", SUPPLE_SCHEME_PM, 0, {}};
    Scene scene(context, use, 3), expected(plain, use, 3);
    expected.run();
    const auto evaluate = [&](uint32_t flags) {
        currentWrappedVulkan().dispatches = 0;
        context.evaluate(scene.groups(), flags);
        return currentWrappedVulkan().dispatches;
    };
    const uint64_t shared = evaluate(0);
    EXPECT_GT(evaluate(SUPPLE_RECORD_TIMINGS), shared);
    EXPECT_TRUE(scene.drawn() == expected.drawn());
}

TEST_F(SharedDispatches, NeedTheFeature) {
    VkPhysicalDeviceFeatures2 features = *static_cast<const VkPhysicalDeviceFeatures2*>(device->enabledFeatures());
    VkPhysicalDeviceVulkan12Features of12 = *static_cast<const VkPhysicalDeviceVulkan12Features*>(features.pNext);
    of12.bufferDeviceAddress = VK_FALSE;
    features.pNext = &of12;
    const auto made = [&](SuppleMapping mapping) {
        return std::make_unique<LoggedContext>(*device, [&](SuppleContextDesc& desc) {
            desc.flags |= SUPPLE_CONTEXT_SHARED_DISPATCHES;
            desc.enabledFeatures = &features;
            desc.mapping = mapping;
        });
    };
    EXPECT_EQ(made(SUPPLE_MAPPING_NARROW)->result(), SUPPLE_OK) << "it shares none";
    const std::unique_ptr<LoggedContext> context = made(SUPPLE_MAPPING_WIDE);
    EXPECT_EQ(context->result(), SUPPLE_ERROR_UNSUPPORTED);
    const std::vector<LogLine> lines = context->takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].text.find("bufferDeviceAddress"), std::string::npos) << lines[0].text;
}

} // namespace
} // namespace supple::test
