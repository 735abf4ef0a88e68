// Tasks of shared dispatches that stand from frame to frame (gpu/kept_tasks.h): whatever changes between frames, groups
// draw the bits that they draw without shared dispatches, and only what has changed is written anew.
#include "tests/support/drawn_patches.h"
#include "tests/support/logged_context.h"
#include "tests/support/meshes.h"
#include "tests/support/spring_files.h"
#include "tests/support/test_view.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/cage_arrays.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <optional>

namespace supple::test {
namespace {

constexpr uint32_t kRoom = 3; ///< instances of a group
constexpr uint32_t kViewVertices = 20000;
constexpr uint32_t kPlayFlags = SUPPLE_GROUP_TRANSITIONS | SUPPLE_GROUP_MODIFIERS;

std::vector<std::byte> testData(const std::string& name) {
    const std::string path = std::string(SUPPLE_TEST_DATA) + name;
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file.good()) << path;
    const std::string glb((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const auto all = std::as_bytes(std::span(glb));
    return {all.begin(), all.end()};
}
/// Drivers set its morph weights.
const std::vector<std::byte>& armFile() {
    static const std::vector<std::byte> bytes = testData("/drivers/arm.glb");
    return bytes;
}
/// A belly jiggles, and a cape hangs.
const std::vector<std::byte>& capedFile() {
    static const std::vector<std::byte> bytes = testData("/cloth/caped.glb");
    return bytes;
}
/// Hair and a scarf swing.
const std::vector<std::byte>& wrenFile() {
    static const std::vector<std::byte> bytes = withExtensions(kWren, kWrenSprings);
    return bytes;
}

struct SceneKind {
    const char* name;
    SuppleScheme scheme = SUPPLE_SCHEME_PM;
    uint32_t groupFlags = 0, playFlags = 0;
    std::optional<uint32_t> viewFlags; ///< none: at a rate
    uint64_t coefficientBytes = 0;
    const std::vector<std::byte>& (*played)() = tubeFile; ///< the file of the group that plays
};
const SceneKind kAtRate = {
    "at a rate", SUPPLE_SCHEME_PM, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, kPlayFlags, {}};
const SceneKind kInView = {"in a view", SUPPLE_SCHEME_PM, 0, kPlayFlags,
                           SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL};
const SceneKind kKinds[] = {
    kAtRate,
    kInView,
    {"at rates in a view", SUPPLE_SCHEME_FRAGMENTS, 0, kPlayFlags, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL},
    {"with update rates, and a pool of coefficients", SUPPLE_SCHEME_PM, 0, kPlayFlags | SUPPLE_GROUP_UPDATE_RATES,
     SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL, 1 << 20},
    {"with drivers", SUPPLE_SCHEME_PM, 0, kPlayFlags, SUPPLE_VIEW_CULL, 0, armFile},
    {"with springs", SUPPLE_SCHEME_PM, SUPPLE_GROUP_MOTION, kPlayFlags | SUPPLE_GROUP_SPRINGS, {}, 0, wrenFile},
    {"with what is soft", SUPPLE_SCHEME_PM, SUPPLE_GROUP_MOTION, kPlayFlags | SUPPLE_GROUP_SOFT, {}, 0, capedFile},
};

/// Two groups whose poses are set and one that plays, of different characters, and one that draws the second's
/// instances too, in a context of its own.
class KeptScene {
public:
    KeptScene(host::Device& device, uint32_t flags, uint32_t framesInFlight, const SceneKind& kind, uint32_t groups = 3)
        : context_(device, SUPPLE_MAPPING_WIDE, framesInFlight, flags | SUPPLE_CONTEXT_DEBUG_UTILS), kind_(kind) {
        if (kind.viewFlags) {
            view_.emplace(context_, kViewVertices, *kind.viewFlags, 0, kind.coefficientBytes);
            view_->camera.smallestEdge = 40.0f;
            lookFrom({0.0f, 0.0f, 14.0f});
        }
        for (uint32_t number = 0; number < groups; ++number) {
            add(number);
        }
        if (groups == 3) {
            follow(1);
        }
    }

    void add(uint32_t number) {
        const bool plays = number % 3 == 2;
        SuppleGroupDesc desc{};
        desc.asset = plays ? context_.createAsset(kind_.played(), "it plays")
                           : context_.createAsset(perturbed(cage::makeCubeSphere(1), 0.02f, number));
        desc.capacity = kRoom;
        desc.scheme = kind_.scheme;
        desc.flags = kind_.groupFlags | (plays ? kind_.playFlags : 0);
        desc.rate = 2;
        desc.poseSource = plays ? SUPPLE_POSES_PLAYBACK : SUPPLE_POSES_SET;
        if (view_) {
            desc.view = view_->handle();
        }
        assets_.push_back(desc.asset);
        crowds_.push_back(std::make_unique<Crowd>(context_, desc));
        instances_.emplace_back();
        for (uint32_t i = 0; i < 2; ++i) {
            spawn(static_cast<uint32_t>(crowds_.size() - 1));
        }
    }
    void follow(uint32_t leader) {
        SuppleGroupDesc desc{};
        desc.asset = assets_[leader];
        desc.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
        desc.rate = 2;
        desc.instancesOf = crowds_[leader]->group();
        if (view_) {
            desc.view = view_->handle();
        }
        assets_.push_back(desc.asset);
        crowds_.push_back(std::make_unique<Crowd>(context_, desc));
        instances_.emplace_back();
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
    void play(float weight, float transition = 0.0f, bool adds = false, uint32_t rootMotion = 0) {
        SupplePlaybackLayer layers[2]{};
        for (SupplePlaybackLayer& layer : layers) {
            layer.flags = SUPPLE_LAYER_LOOP;
            layer.weight = weight;
            layer.speed = 1.0f;
        }
        layers[1].mode = SUPPLE_LAYER_ADDITIVE;
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof(desc);
        desc.layers = layers;
        desc.layerCount = adds ? 2 : 1;
        desc.transition = transition;
        desc.rootMotion = rootMotion;
        desc.updateInterval = (kind_.playFlags & SUPPLE_GROUP_UPDATE_RATES) != 0 ? 4 : 0;
        EXPECT_EQ(suppleSetPlayback(context_.handle(), instances_[2][0], &desc), SUPPLE_OK);
    }
    void modify() {
        SuppleModifier modifier{};
        modifier.kind = SUPPLE_MODIFIER_SET;
        modifier.joint = 1;
        modifier.weight = 1.0f;
        modifier.rotation[0] = modifier.rotation[3] = 0.70710678f;
        SuppleModifiersDesc desc{};
        desc.structSize = sizeof(desc);
        desc.modifiers = &modifier;
        desc.modifierCount = 1;
        EXPECT_EQ(suppleSetModifiers(context_.handle(), instances_[2][1], &desc), SUPPLE_OK);
    }
    void hidePart(uint32_t group, bool visible) {
        EXPECT_EQ(suppleSetPartVisible(context_.handle(), instances_[group][0], 0, visible ? 1 : 0), SUPPLE_OK);
    }
    void setTime(double seconds) {
        EXPECT_EQ(suppleSetTime(context_.handle(), crowds_[2]->group(), seconds), SUPPLE_OK);
    }
    /// In views surfaces have no rate that could be set.
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
        assets_[group] = assets_.back();
        crowds_.pop_back();
        instances_.pop_back();
        assets_.pop_back();
    }
    void reload(uint32_t group) {
        const cage::Cage other = perturbed(cage::makeCubeSphere(2), 0.02f, 9);
        const host::CageArrays arrays(other);
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.name = "other";
        desc.cage = &arrays.desc;
        EXPECT_EQ(suppleReloadAsset(context_.handle(), assets_[group], &desc), SUPPLE_OK);
    }
    void lookFrom(const glm::vec3& eye) {
        if (view_) {
            const glm::mat4 seen = glm::perspectiveRH_ZO(1.2f, 1.0f, 0.1f, 100.0f) *
                                   glm::lookAt(eye, glm::vec3(eye.x, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
            std::memcpy(view_->camera.viewProjection, &seen, sizeof seen);
            eye_ = eye;
            view_->look(eye);
        }
    }
    void setBudget(uint32_t vertices) {
        if (view_) {
            view_->camera.vertexBudget = vertices;
            view_->look(eye_);
        }
    }
    void cancel() { context_.cancel(groups()); }
    /// With timings all is recorded anew, and nothing is kept.
    void time() { context_.evaluate(groups(), SUPPLE_RECORD_TIMINGS); }
    /// Two recordings of a frame, the second of what stood first before. In a view one call takes all.
    void runInTwo() {
        if (view_) {
            return run();
        }
        const std::vector<SuppleGroup> all = groups();
        context_.beginFrame();
        const Status ran = context_.device().submitAndWait([&](VkCommandBuffer commands) {
            EXPECT_EQ(context_.record(commands, std::span(all).subspan(1)), SUPPLE_OK);
            EXPECT_EQ(context_.record(commands, std::span(all).first(1)), SUPPLE_OK);
        });
        EXPECT_TRUE(ran.ok());
    }
    void runWithout(uint32_t group) {
        std::vector<SuppleGroup> some = groups();
        some.erase(some.begin() + group);
        context_.run(some);
    }
    void swapOrder() { backwards_ = !backwards_; }
    void run() { context_.run(groups()); }

    [[nodiscard]] std::vector<SuppleGroup> groups() const {
        std::vector<SuppleGroup> all;
        for (const std::unique_ptr<Crowd>& crowd : crowds_) {
            all.push_back(crowd->group());
        }
        if (backwards_) {
            std::reverse(all.begin(), all.end());
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
    /// What the view counts, frames later.
    [[nodiscard]] std::vector<uint64_t> counted() const {
        if (!view_) {
            return {};
        }
        SuppleViewStatistics is{};
        is.structSize = sizeof(is);
        // At first no frame has counted.
        const SuppleResult known = suppleGetViewStatistics(context_.handle(), view_->handle(), &is);
        return {static_cast<uint64_t>(known),
                is.frame,
                is.vertexCount,
                is.wantedVertexCount,
                is.patchCount,
                is.instanceCount,
                is.drawnInstanceCount,
                is.droppedInstanceCount,
                is.shortfall,
                is.coefficientBytes};
    }

private:
    CrowdContext context_;
    const SceneKind& kind_;
    std::optional<TestView> view_;
    glm::vec3 eye_{0.0f};
    bool backwards_ = false;
    std::vector<std::unique_ptr<Crowd>> crowds_;
    std::vector<SuppleAsset> assets_;
    std::vector<std::vector<SuppleInstance>> instances_;
};

struct Event {
    const char* name;
    std::function<void(KeptScene&)> happen;
};
/// Frames are run behind each, so that those that keep tasks have done so in every room.
std::vector<Event> events() {
    using Scene = KeptScene&;
    return {
        {"nothing", [](Scene) {}},
        {"an instance moves",
         [](Scene s) {
             s.place(0, 0, {-2.4f, -1.0f, 0.3f});
         }},
        {"time goes on", [](Scene s) { s.setTime(0.4); }},
        {"it plays", [](Scene s) { s.play(1.0f); }},
        {"time goes on again", [](Scene s) { s.setTime(0.7); }},
        {"time goes on a little", [](Scene s) { s.setTime(0.71); }},
        {"a transition begins", [](Scene s) { s.play(0.5f, 0.4f); }},
        {"it goes on", [](Scene s) { s.setTime(0.9); }},
        {"it is over", [](Scene s) { s.setTime(1.4); }},
        {"an additive layer", [](Scene s) { s.play(0.7f, 0.0f, true); }},
        {"its root stays", [](Scene s) { s.play(0.7f, 0.0f, true, SUPPLE_ROOT_MOTION_GROUND); }},
        {"a modifier", [](Scene s) { s.modify(); }},
        {"a part hides", [](Scene s) { s.hidePart(2, false); }},
        {"the part is shown again", [](Scene s) { s.hidePart(2, true); }},
        {"one hides", [](Scene s) { s.show(1, 1, false); }},
        {"a whole group hides", [](Scene s) { s.show(1, 0, false); }},
        {"one of it is shown again", [](Scene s) { s.show(1, 0, true); }},
        {"the group that plays hides", [](Scene s) { s.show(2, 0, false), s.show(2, 1, false); }},
        {"it is shown again at another time", [](Scene s) { s.show(2, 1, true), s.setTime(0.9); }},
        {"an instance is born", [](Scene s) { s.spawn(0); }},
        {"an instance dies", [](Scene s) { s.destroy(0); }},
        {"another rate", [](Scene s) { s.setRate(1); }},
        {"the first rate", [](Scene s) { s.setRate(2); }},
        {"more capacity", [](Scene s) { s.setCapacity(1, kRoom + 4); }},
        {"a group is made in another one's place", [](Scene s) { s.replace(0, 3); }},
        {"the asset of one is loaded anew", [](Scene s) { s.reload(1); }},
        {"the camera moves",
         [](Scene s) {
             s.lookFrom({0.5f, 0.2f, 9.0f});
         }},
        {"some are out of sight",
         [](Scene s) {
             s.lookFrom({7.0f, 0.0f, 5.0f});
         }},
        {"they are seen again",
         [](Scene s) {
             s.lookFrom({0.0f, 0.0f, 14.0f});
         }},
        {"all are out of sight",
         [](Scene s) {
             s.lookFrom({200.0f, 0.0f, 5.0f});
         }},
        {"a frame of them is cancelled", [](Scene s) { s.cancel(); }},
        {"they are in sight again",
         [](Scene s) {
             s.lookFrom({0.0f, 0.0f, 14.0f});
         }},
        {"there is no room for all", [](Scene s) { s.setBudget(60); }},
        {"there is room again", [](Scene s) { s.setBudget(0); }},
        {"the groups come in another order", [](Scene s) { s.swapOrder(); }},
        {"they come in the first order", [](Scene s) { s.swapOrder(); }},
        {"a frame leaves one out",
         [](Scene s) {
             s.place(1, 0, {0.1f, -1.1f, 0.2f}), s.runWithout(0);
         }},
        {"a frame is cancelled",
         [](Scene s) {
             s.place(1, 0, {0.2f, -1.0f, 0.0f}), s.cancel();
         }},
        {"a frame with a new rate is cancelled", [](Scene s) { s.setRate(1), s.cancel(); }},
        {"a frame is timed",
         [](Scene s) {
             s.place(1, 0, {0.3f, -1.2f, 0.0f}), s.time();
         }},
        {"a change in a frame that is recorded in two", [](Scene s) { s.show(1, 1, true), s.runInTwo(); }},
        {"another origin", [](Scene s) { s.setOrigin(0.25); }},
    };
}

class KeptTasks : public testing::Test {
protected:
    void SetUp() override {
        wrappedVulkan().watchedName = "supple tasks";
        device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
    }
    void TearDown() override {
        EXPECT_EQ(device->validation()->messageCount(), 0u);
        device = nullptr;
        (void)wrappedVulkan();
    }
    /// What a frame copies of tasks, in bytes.
    static uint64_t copiedIn(KeptScene& scene) {
        WrappedVulkan& wrapped = currentWrappedVulkan();
        EXPECT_FALSE(wrapped.watched.empty()) << "the device names no buffers";
        wrapped.watchedBytes = 0;
        scene.run();
        return wrapped.watchedBytes;
    }
    void expectNeverStale(const SceneKind& kind, uint32_t framesInFlight, uint32_t frames);
    void expectNeverStaleInSteps(const SceneKind& kind, uint32_t flag);
    std::unique_ptr<host::Device> device;
};

void KeptTasks::expectNeverStale(const SceneKind& kind, uint32_t framesInFlight, uint32_t frames) {
    KeptScene plain(*device, 0, framesInFlight, kind);
    KeptScene shared(*device, SUPPLE_CONTEXT_SHARED_DISPATCHES, framesInFlight, kind);
    for (const Event& event : events()) {
        SCOPED_TRACE(std::string(kind.name) + ", " + std::to_string(framesInFlight) + ": " + event.name);
        event.happen(plain);
        event.happen(shared);
        for (uint32_t frame = 0; frame < frames; ++frame) {
            plain.run();
            shared.run();
            ASSERT_TRUE(shared.drawn() == plain.drawn()) << "frame " << frame;
            ASSERT_EQ(shared.counted(), plain.counted()) << "frame " << frame;
        }
    }
}

/// What is due of the steps of springs, and of what jiggles, in the first of two frames at a time.
struct StepsDue {
    const char* name;
    double steps; ///< the time, in steps
    /// Whether they show something else than the pose. Unknown: springs do, what jiggles does not, or the other way.
    std::optional<bool> swings;
};
constexpr StepsDue kStepsDue[] = {{"the group begins", 100.1, false},     {"one step is due", 101.1, {}},
                                  {"five are due", 106.2, true},          {"none is due", 106.7, true},
                                  {"more than eight are due", 160.1, {}}, {"eight are due", 168.3, true}};

/// Whatever is due, groups draw what they draw without shared dispatches. What swings by `flag` is seen beside a scene
/// without it.
void KeptTasks::expectNeverStaleInSteps(const SceneKind& kind, uint32_t flag) {
    SceneKind without = kind;
    without.playFlags &= ~flag;
    KeptScene plain(*device, 0, 2, kind), still(*device, 0, 2, without);
    KeptScene shared(*device, SUPPLE_CONTEXT_SHARED_DISPATCHES, 2, kind);
    for (KeptScene* const scene : {&plain, &still, &shared}) {
        scene->play(1.0f);
    }
    uint64_t all = 0;
    for (const StepsDue& due : kStepsDue) {
        SCOPED_TRACE(std::string(kind.name) + ": " + due.name);
        for (KeptScene* const scene : {&plain, &still, &shared}) {
            scene->setTime(due.steps / 60.0);
        }
        for (uint32_t frame = 0; frame < 2; ++frame) {
            plain.run();
            still.run();
            const uint64_t bytes = copiedIn(shared);
            all = all == 0 ? bytes : all;
            if (due.swings == true) { // by then there is something to keep in both rooms
                EXPECT_LT(bytes, all);
                EXPECT_GT(bytes, 0u);
            }
            ASSERT_TRUE(shared.drawn() == plain.drawn()) << "frame " << frame;
        }
        // In the second frame of a time, previous positions are those of the first. Cloth hangs otherwise from the
        // first frame on.
        if (due.swings && (*due.swings || flag != SUPPLE_GROUP_SOFT)) {
            EXPECT_EQ(shared.drawn() != still.drawn(), *due.swings);
        }
    }
}

// As many frames as there are rooms, and one more that keeps all.

TEST_F(KeptTasks, AreNeverStaleAtRate) {
    expectNeverStale(kKinds[0], 2, 3);
}
TEST_F(KeptTasks, AreNeverStaleInView) {
    expectNeverStale(kKinds[1], 2, 3);
}
TEST_F(KeptTasks, AreNeverStaleAtRatesInView) {
    expectNeverStale(kKinds[2], 2, 3);
}
TEST_F(KeptTasks, AreNeverStaleWithUpdateRates) {
    expectNeverStale(kKinds[3], 2, 3);
}
TEST_F(KeptTasks, AreNeverStaleWithDrivers) {
    expectNeverStale(kKinds[4], 2, 3);
}
TEST_F(KeptTasks, AreNeverStaleWithSprings) {
    expectNeverStale(kKinds[5], 2, 3);
    expectNeverStaleInSteps(kKinds[5], SUPPLE_GROUP_SPRINGS);
}
TEST_F(KeptTasks, AreNeverStaleWithWhatIsSoft) {
    expectNeverStale(kKinds[6], 2, 3);
    expectNeverStaleInSteps(kKinds[6], SUPPLE_GROUP_SOFT);
}
/// Where nothing changes, not a byte of tasks is copied: also where coefficients take turns.
TEST_F(KeptTasks, AreNotCopiedIfNothingChanges) {
    for (const SceneKind* kind : {&kKinds[0], &kKinds[1], &kKinds[2]}) {
        SCOPED_TRACE(kind->name);
        KeptScene scene(*device, SUPPLE_CONTEXT_SHARED_DISPATCHES, 2, *kind, 2);
        for (uint32_t frame = 0; frame < 2; ++frame) {
            EXPECT_GT(copiedIn(scene), 0u) << "frame " << frame;
        }
        for (uint32_t frame = 0; frame < 2; ++frame) {
            (void)copiedIn(scene); // instances that were new have a past
        }
        for (uint32_t frame = 0; frame < 4; ++frame) {
            EXPECT_EQ(copiedIn(scene), 0u) << "frame " << frame;
        }
        scene.show(0, 1, false);
        for (const bool changes : {true, true, false, false}) {
            EXPECT_EQ(copiedIn(scene) > 0, changes);
        }
    }
}

/// What a change costs: how many of the frames behind it copy all tasks, of which there are two rooms.
struct Cost {
    const char* name;
    std::function<void(KeptScene&)> happen;
    uint32_t atRate = 0, inView = 0;
};
TEST_F(KeptTasks, AreRecordedAnewOnlyWhereGroupsHaveOthers) {
    using Scene = KeptScene&;
    const Cost costs[] = {
        {"time goes on", [](Scene s) { s.setTime(0.4); }},
        {"it plays", [](Scene s) { s.play(1.0f); }},
        {"a transition begins", [](Scene s) { s.play(0.5f, 0.4f); }},
        {"it goes on", [](Scene s) { s.setTime(0.6); }},
        {"it is over", [](Scene s) { s.setTime(1.4); }},
        {"an instance is born", [](Scene s) { s.spawn(0); }},
        {"one of another group is", [](Scene s) { s.spawn(1); }},
        {"one dies", [](Scene s) { s.destroy(0); }},
        {"a whole group hides", [](Scene s) { s.show(1, 0, false), s.show(1, 1, false), s.show(1, 2, false); }},
        {"it is shown again", [](Scene s) { s.show(1, 0, true), s.show(1, 1, true), s.show(1, 2, true); }},
        {"the camera moves",
         [](Scene s) {
             s.lookFrom({0.5f, 0.2f, 9.0f});
         }},
        {"another origin", [](Scene s) { s.setOrigin(0.25); }},
        {"the groups come in another order", [](Scene s) { s.swapOrder(); }, 2, 2},
        {"a frame is cancelled", [](Scene s) { s.cancel(); }, 1, 1},
        {"a frame is timed", [](Scene s) { s.time(); }, 1, 1},
        // Its coefficients take turns in the view, so it finds its own in neither room.
        {"a frame leaves one out", [](Scene s) { s.runWithout(0); }, 1, 2},
    };
    for (const SceneKind* kind : {&kAtRate, &kInView}) {
        KeptScene scene(*device, SUPPLE_CONTEXT_SHARED_DISPATCHES, 2, *kind);
        const uint64_t all = copiedIn(scene);
        for (uint32_t frame = 0; frame < 3; ++frame) {
            (void)copiedIn(scene);
        }
        for (const Cost& cost : costs) {
            SCOPED_TRACE(std::string(kind->name) + ": " + cost.name);
            cost.happen(scene);
            uint32_t anew = 0;
            for (uint32_t frame = 0; frame < 4; ++frame) {
                const uint64_t bytes = copiedIn(scene);
                EXPECT_LE(bytes, all);
                anew += bytes == all ? 1 : 0;
                EXPECT_TRUE(frame < 3 || bytes < all / 4) << bytes << " of " << all;
            }
            EXPECT_EQ(anew, kind == &kAtRate ? cost.atRate : cost.inView);
        }
    }
}

/// A frame that writes attributes stands too, but they are written once.
TEST_F(KeptTasks, DoNotWriteAttributesAgain) {
    KeptScene scene(*device, SUPPLE_CONTEXT_SHARED_DISPATCHES, 2, kAtRate);
    WrappedVulkan& wrapped = currentWrappedVulkan();
    const auto dispatchesIn = [&] {
        wrapped.dispatches = 0;
        scene.run();
        return wrapped.dispatches;
    };
    const auto settle = [&] {
        for (uint32_t frame = 0; frame < 4; ++frame) {
            scene.run();
        }
        return dispatchesIn();
    };
    const uint64_t first = dispatchesIn();
    const uint64_t settled = settle();
    EXPECT_GT(first, settled);
    scene.setRate(1);
    const uint64_t anew = dispatchesIn();
    std::vector<uint64_t> later;
    for (uint32_t frame = 0; frame < 6; ++frame) {
        later.push_back(dispatchesIn());
    }
    EXPECT_EQ(later, std::vector<uint64_t>(6, settle()));
    EXPECT_GT(anew, later.back());
}

/// There are four rooms: each finds what several events have changed.
TEST_F(KeptTasks, AreNeverStaleWithMoreFramesInFlight) {
    expectNeverStale(kKinds[1], 3, 1);
}

} // namespace
} // namespace supple::test
