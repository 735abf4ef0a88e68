// Tasks of shared dispatches that stand from frame to frame (gpu/kept_tasks.h): whatever changes between frames, groups
// draw the bits that they draw without shared dispatches, and a frame without changes writes no task anew.
#include "tests/support/drawn_patches.h"
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

constexpr uint32_t kRoom = 3; ///< instances of a group

struct SceneKind {
    const char* name;
    SuppleScheme scheme = SUPPLE_SCHEME_PM;
    uint32_t groupFlags = 0;
    std::optional<uint32_t> viewFlags; ///< none: at rate 4
};
const SceneKind kKinds[] = {
    {"at a rate", SUPPLE_SCHEME_PM, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, {}},
    {"in a view", SUPPLE_SCHEME_PM, 0, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL},
    {"at rates in a view", SUPPLE_SCHEME_FRAGMENTS, 0, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL},
};

/// Two groups whose poses are set and one that plays, of different characters, in a context of its own.
class KeptScene {
public:
    KeptScene(host::Device& device, uint32_t flags, uint32_t framesInFlight, const SceneKind& kind)
        : context_(device, SUPPLE_MAPPING_WIDE, framesInFlight, flags), kind_(kind) {
        if (kind.viewFlags) {
            view_.emplace(context_, 200000, *kind.viewFlags);
            view_->camera.smallestEdge = 10.0f;
            lookFrom({0.0f, 0.0f, 14.0f});
        }
        for (uint32_t number = 0; number < 3; ++number) {
            add(number);
        }
    }

    void add(uint32_t number) {
        const bool plays = number % 3 == 2;
        SuppleGroupDesc desc{};
        desc.asset = plays ? context_.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb")
                           : context_.createAsset(perturbed(cage::makeCubeSphere(2), 0.02f, number));
        desc.capacity = kRoom;
        desc.scheme = kind_.scheme;
        desc.flags = kind_.groupFlags;
        desc.rate = 4;
        desc.poseSource = plays ? SUPPLE_POSES_PLAYBACK : SUPPLE_POSES_SET;
        if (view_) {
            desc.view = view_->handle();
        }
        crowds_.push_back(std::make_unique<Crowd>(context_, desc));
        instances_.emplace_back();
        for (uint32_t i = 0; i < 2; ++i) {
            spawn(static_cast<uint32_t>(crowds_.size() - 1));
        }
    }
    void spawn(uint32_t group) {
        instances_[group].push_back(crowds_[group]->spawn());
        const auto number = static_cast<uint32_t>(instances_[group].size() - 1);
        place(group, number, {2.5f * static_cast<float>(group) - 2.5f, 2.5f * static_cast<float>(number) - 1.5f, 0.0f});
    }
    void place(uint32_t group, uint32_t number, const glm::vec3& at) {
        const glm::mat4 transform = glm::translate(glm::mat4(1.0f), at);
        EXPECT_EQ(suppleSetTransform(context_.handle(), instances_[group][number], &transform[0][0]), SUPPLE_OK);
    }
    void destroy(uint32_t group) {
        crowds_[group]->destroy(instances_[group].back());
        instances_[group].pop_back();
    }
    void show(uint32_t group, uint32_t number, bool visible) {
        crowds_[group]->setVisible(instances_[group][number], visible);
    }
    void play(uint32_t clip, float weight) {
        SupplePlaybackLayer layer{};
        layer.clip = clip;
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = weight;
        layer.speed = 1.0f;
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof(desc);
        desc.layers = &layer;
        desc.layerCount = 1;
        EXPECT_EQ(suppleSetPlayback(context_.handle(), instances_[2][0], &desc), SUPPLE_OK);
    }
    void setTime(double seconds) {
        EXPECT_EQ(suppleSetTime(context_.handle(), crowds_[2]->group(), seconds), SUPPLE_OK);
    }
    void setRate(uint32_t rate) {
        if (!view_) {
            crowds_[0]->setRate(rate);
        }
    }
    void setCapacity(uint32_t group, uint32_t capacity) {
        EXPECT_EQ(suppleSetCapacity(context_.handle(), crowds_[group]->group(), capacity), SUPPLE_OK);
    }
    void setOrigin(double x) {
        const double origin[3] = {x, 0.0, 0.0};
        EXPECT_EQ(suppleSetOrigin(context_.handle(), origin), SUPPLE_OK);
    }
    /// The group goes, and another takes its place in the list.
    void replace(uint32_t group, uint32_t number) {
        crowds_[group]->end();
        crowds_[group].reset();
        instances_[group].clear();
        add(number);
        crowds_[group] = std::move(crowds_.back());
        instances_[group] = std::move(instances_.back());
        crowds_.pop_back();
        instances_.pop_back();
    }
    void lookFrom(const glm::vec3& eye) {
        if (view_) {
            const glm::mat4 seen = glm::perspectiveRH_ZO(1.2f, 1.0f, 0.1f, 100.0f) *
                                   glm::lookAt(eye, glm::vec3(eye.x, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
            std::memcpy(view_->camera.viewProjection, &seen, sizeof seen);
            view_->look(eye);
        }
    }
    void cancel() { context_.cancel(groups()); }
    /// With timings all is recorded anew, and nothing is kept.
    void time() { context_.evaluate(groups(), SUPPLE_RECORD_TIMINGS); }
    /// Two recordings of a frame, the second of what stood first before. In a view one call takes all.
    void runInTwo() {
        if (view_) {
            return;
        }
        const std::vector<SuppleGroup> all = groups();
        context_.beginFrame();
        const Status ran = context_.device().submitAndWait([&](VkCommandBuffer commands) {
            EXPECT_EQ(context_.record(commands, std::span(all).subspan(1)), SUPPLE_OK);
            EXPECT_EQ(context_.record(commands, std::span(all).first(1)), SUPPLE_OK);
        });
        EXPECT_TRUE(ran.ok());
    }
    void run() { context_.run(groups()); }

    [[nodiscard]] std::vector<SuppleGroup> groups() const {
        std::vector<SuppleGroup> all;
        for (const std::unique_ptr<Crowd>& crowd : crowds_) {
            all.push_back(crowd->group());
        }
        return all;
    }
    [[nodiscard]] std::vector<DrawnPatches> drawn() const {
        std::vector<DrawnPatches> all;
        for (const std::unique_ptr<Crowd>& crowd : crowds_) {
            all.push_back(drawnPatches(*crowd));
        }
        return all;
    }

private:
    CrowdContext context_;
    const SceneKind& kind_;
    std::optional<TestView> view_;
    std::vector<std::unique_ptr<Crowd>> crowds_;
    std::vector<std::vector<SuppleInstance>> instances_;
};

struct Event {
    const char* name;
    std::function<void(KeptScene&)> happen;
};
/// Frames are run behind each, so that those that keep tasks have done so in every room.
std::vector<Event> events() {
    return {
        {"nothing", [](KeptScene&) {}},
        {"an instance moves",
         [](KeptScene& s) {
             s.place(0, 0, {-2.4f, -1.0f, 0.3f});
         }},
        {"time goes on", [](KeptScene& s) { s.setTime(0.4); }},
        {"it plays", [](KeptScene& s) { s.play(0, 1.0f); }},
        {"time goes on again", [](KeptScene& s) { s.setTime(0.7); }},
        {"one hides", [](KeptScene& s) { s.show(1, 1, false); }},
        {"a whole group hides", [](KeptScene& s) { s.show(1, 0, false); }},
        {"one of it is shown again", [](KeptScene& s) { s.show(1, 0, true); }},
        {"the group that plays hides", [](KeptScene& s) { s.show(2, 0, false), s.show(2, 1, false); }},
        {"it is shown again at another time", [](KeptScene& s) { s.show(2, 1, true), s.setTime(0.9); }},
        {"an instance is born", [](KeptScene& s) { s.spawn(0); }},
        {"an instance dies", [](KeptScene& s) { s.destroy(0); }},
        {"another rate", [](KeptScene& s) { s.setRate(2); }},
        {"the first rate", [](KeptScene& s) { s.setRate(4); }},
        {"more capacity", [](KeptScene& s) { s.setCapacity(1, kRoom + 4); }},
        {"a group is made in another one's place", [](KeptScene& s) { s.replace(0, 3); }},
        {"the camera moves",
         [](KeptScene& s) {
             s.lookFrom({0.5f, 0.2f, 9.0f});
         }},
        {"some are out of sight",
         [](KeptScene& s) {
             s.lookFrom({7.0f, 0.0f, 5.0f});
         }},
        {"they are seen again",
         [](KeptScene& s) {
             s.lookFrom({0.0f, 0.0f, 14.0f});
         }},
        {"a frame is cancelled",
         [](KeptScene& s) {
             s.place(1, 0, {0.2f, -1.0f, 0.0f}), s.cancel();
         }},
        {"a frame is timed",
         [](KeptScene& s) {
             s.place(1, 0, {0.3f, -1.2f, 0.0f}), s.time();
         }},
        {"a change in a frame that is recorded in two", [](KeptScene& s) { s.show(1, 1, true), s.runInTwo(); }},
        {"another origin", [](KeptScene& s) { s.setOrigin(0.25); }},
    };
}

class KeptTasks : public testing::Test {
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

TEST_F(KeptTasks, AreNeverStale) {
    for (const SceneKind& kind : kKinds) {
        for (const uint32_t framesInFlight : {2u, 3u}) {
            KeptScene plain(*device, 0, framesInFlight, kind);
            KeptScene shared(*device, SUPPLE_CONTEXT_SHARED_DISPATCHES, framesInFlight, kind);
            for (const Event& event : events()) {
                SCOPED_TRACE(std::string(kind.name) + ", " + std::to_string(framesInFlight) + ": " + event.name);
                event.happen(plain);
                event.happen(shared);
                // As many as there are rooms, and one that keeps all. The first shows what is wrong at once.
                for (uint32_t frame = 0; frame < (framesInFlight == 2 ? 4u : 2u); ++frame) {
                    plain.run();
                    shared.run();
                    ASSERT_TRUE(shared.drawn() == plain.drawn()) << "frame " << frame;
                }
            }
        }
    }
}

/// What changes is alone what is copied: a second like frame copies less than the first of its kind.
TEST_F(KeptTasks, AreCopiedOnlyWhenTheyChange) {
    KeptScene scene(*device, SUPPLE_CONTEXT_SHARED_DISPATCHES, 2, kKinds[1]);
    WrappedVulkan& wrapped = currentWrappedVulkan();
    const auto copiedIn = [&] {
        wrapped.copiedBytes = 0;
        scene.run();
        return wrapped.copiedBytes;
    };
    const uint64_t first = copiedIn();
    (void)copiedIn();
    (void)copiedIn(); // what was new has a past
    (void)copiedIn();
    const uint64_t settled = copiedIn();
    EXPECT_LT(settled, first / 2);
    (void)copiedIn();
    EXPECT_EQ(copiedIn(), settled);
    scene.setTime(0.3);
    const uint64_t timed = copiedIn();
    EXPECT_LE(timed, settled) << "the time is written in every frame";
    scene.show(0, 1, false);
    EXPECT_GT(copiedIn(), settled);
}

} // namespace
} // namespace supple::test
