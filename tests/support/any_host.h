// A host that does whatever hosts may do.
#pragma once

#include "tests/support/crowd.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <vector>

namespace supple::test {

/// Does it by chance, frame after frame: the same for the same seed. What it does to
/// poses and places shows.
class AnyHost {
public:
    AnyHost(CrowdContext& context, uint32_t seed) : context_(context), random_(seed) { create(); }

    /// A frame with a few calls of every kind.
    void run(uint32_t frame) {
        context_.beginFrame();
        const uint32_t changes = 6 + upTo(12);
        for (uint32_t i = 0; i < changes; ++i) {
            change();
        }
        changePoints(frame);
        changeQueries(frame);
        time_ += 0.03;
        set(suppleSetTime(handle(), played_.group, time_));
        const float wind[3] = {static_cast<float>(frame % 5), 0.0f, 1.0f};
        set(suppleSetWind(handle(), played_.group, wind));
        setCamera();
        const Status ran = context_.device().submitAndWait([&](VkCommandBuffer commands) {
            if (frame == 3) {
                set(suppleRecordUploads(handle(), commands));
                const SuppleGroup warm[] = {posed_.group, played_.group};
                set(suppleRecordWarmUp(handle(), commands, warm, 2));
            }
            const SuppleGroup groups[] = {posed_.group, follower_, played_.group, rates_.group, sharp_.group};
            set(context_.record(commands, groups));
            ask(commands);
        });
        EXPECT_TRUE(ran.ok());
        if (frame % 9 == 5) {
            set(suppleCancelFrame(handle()));
        }
    }

private:
    struct Many {
        SuppleGroup group{};
        std::vector<SuppleInstance> instances;
        uint32_t capacity = 0;
    };

    [[nodiscard]] SuppleContext handle() const { return context_.handle(); }
    static void set(SuppleResult result) { EXPECT_EQ(result, SUPPLE_OK); }
    [[nodiscard]] uint32_t upTo(uint32_t end) { return std::uniform_int_distribution<uint32_t>(0, end - 1)(random_); }
    [[nodiscard]] float number(float low = -1.0f, float high = 1.0f) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }

    /// A point set that comes and goes.
    void changePoints([[maybe_unused]] uint32_t frame) {
#if defined(SUPPLE_WITH_CPU)
        if (frame % 4 == 2) {
            const SuppleSurfacePoint point{0, 0, 0.5f, 0.25f};
            SupplePointSetDesc desc{};
            desc.structSize = sizeof desc;
            desc.group = posed_.group;
            desc.points = &point;
            desc.pointCount = 1;
            desc.format = SUPPLE_POINT_FRAME_64;
            set(suppleCreatePointSet(handle(), &desc, &points_));
        } else if (frame % 4 == 0 && points_.id != 0) {
            set(suppleDestroyPointSet(handle(), points_));
            points_ = {};
        }
#endif
    }

    /// A query pool for a few frames: its kernels take long to compile.
    void changeQueries([[maybe_unused]] uint32_t frame) {
#if defined(SUPPLE_WITH_CPU)
        if (frame == 20) {
            SuppleQueryPoolDesc desc{};
            desc.structSize = sizeof desc;
            desc.groups = &posed_.group;
            desc.groupCount = desc.rayCount = 1;
            set(suppleCreateQueryPool(handle(), &desc, &queries_));
        } else if (frame == 24 && queries_.id != 0) {
            set(suppleDestroyQueryPool(handle(), queries_));
            queries_ = {};
        }
#endif
    }
    void ask(VkCommandBuffer commands) {
        if (queries_.id == 0) {
            return;
        }
        const SuppleRay ray{{0.5f, 0.25f, 9.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, 20.0f};
        SuppleQueryDesc desc{};
        desc.structSize = sizeof desc;
        desc.hostRays = &ray;
        desc.rayCount = 1;
        set(suppleRecordQueries(handle(), commands, queries_, &desc));
    }

    void create() {
        tube_ = context_.createAsset(tubeFile(), "tube");
        createSharp();
        SuppleViewDesc view{};
        view.structSize = sizeof view;
        view.flags = SUPPLE_VIEW_CULL;
        view.maxVertices = 1u << 16;
        set(suppleCreateView(handle(), &view, &view_));
        set(suppleCreateView(handle(), &view, &unused_));
        posed_ = createMany({.flags = SUPPLE_GROUP_MODIFIERS, .scheme = SUPPLE_SCHEME_CATMULL_CLARK, .rate = 4});
        played_ = createMany({.flags = SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS | SUPPLE_GROUP_UPDATE_RATES,
                              .scheme = SUPPLE_SCHEME_PM,
                              .skinning = SUPPLE_SKINNING_DUAL_QUATERNION,
                              .poseSource = SUPPLE_POSES_PLAYBACK,
                              .view = view_});
        rates_ = createMany({.scheme = SUPPLE_SCHEME_FRAGMENTS,
                             .rate = 8,
                             .skinning = SUPPLE_SKINNING_CENTERS_OF_ROTATION,
                             .view = view_});
        SuppleGroupDesc follower{};
        follower.structSize = sizeof follower;
        follower.asset = tube_;
        follower.scheme = SUPPLE_SCHEME_PREP;
        follower.rate = 3;
        follower.instancesOf = posed_.group;
        set(suppleCreateGroup(handle(), &follower, &follower_));
        setCamera();
    }
    /// A cube with a crease set, from arrays.
    void createSharp() {
        const float positions[] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1};
        const uint32_t counts[] = {4, 4, 4, 4, 4, 4}, creases[] = {4, 5, 5, 6}, sets[] = {0, 0};
        const uint32_t corners[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
        const float sharpnesses[] = {1.0f, 2.0f};
        const char* const names[] = {"rim"};
        SuppleCageDesc cage{};
        cage.structSize = sizeof cage;
        cage.vertexCount = 8;
        cage.faceCount = 6;
        cage.positions = positions;
        cage.faceVertexCounts = counts;
        cage.faceVertexIndices = corners;
        cage.creaseCount = 2;
        cage.creaseVertices = creases;
        cage.creaseSharpnesses = sharpnesses;
        cage.creaseSetCount = 1;
        cage.creaseSetNames = names;
        cage.creaseSets = sets;
        SuppleAssetDesc desc{};
        desc.structSize = sizeof desc;
        desc.name = "cube";
        desc.cage = &cage;
        SuppleAsset cube{};
        set(suppleCreateAsset(handle(), &desc, &cube));
        SuppleGroupDesc group{};
        group.asset = cube;
        group.scheme = SUPPLE_SCHEME_PM;
        group.rate = 4;
        sharp_ = createMany(group);
        set(suppleDestroyAsset(handle(), cube)); // its group keeps what it needs
    }
    Many createMany(SuppleGroupDesc desc) {
        Many made;
        made.capacity = desc.capacity = 5;
        desc.structSize = sizeof desc;
        desc.asset = desc.asset.id != 0 ? desc.asset : tube_;
        set(suppleCreateGroup(handle(), &desc, &made.group));
        for (uint32_t i = 0; i < 4; ++i) {
            set(suppleCreateInstance(handle(), made.group, &made.instances.emplace_back()));
        }
        return made;
    }
    void setCamera() {
        SuppleCameraDesc camera{};
        camera.structSize = sizeof camera;
        camera.position[0] = number();
        camera.position[2] = number(4.0f, 9.0f);
        camera.pixelsPerUnit = 400.0f;
        camera.vertexBudget = 40000;
        set(suppleSetCamera(handle(), view_, &camera));
    }

    void change() {
        const std::function<void()> all[] = {
            [&] { changeInstances(any()); },
            [&] { set(suppleSetVisible(handle(), anyOf(any()), upTo(2))); },
            [&] { set(suppleSetPartVisible(handle(), anyOf(posed_), 0, upTo(4) > 0 ? 1 : 0)); },
            [&] { set(suppleTeleport(handle(), anyOf(any()))); },
            [&] { place(anyOf(any())); },
            [&] { place(anyOf(any())); },
            [&] { setData(anyOf(any())); },
            [&] { set(suppleSetSharpness(handle(), anyOf(sharp_), 0, number(0.0f, 3.0f))); },
            [&] { set(suppleSetPriority(handle(), anyOf(upTo(2) == 0 ? played_ : rates_), upTo(4))); },
            [&] { pose(anyOf(upTo(2) == 0 ? posed_ : rates_)); },
            [&] { pose(anyOf(upTo(2) == 0 ? posed_ : rates_)); },
            [&] { poseJoints(anyOf(posed_)); },
            [&] { setWeights(anyOf(upTo(2) == 0 ? posed_ : played_)); },
            [&] { play(anyOf(played_)); },
            [&] { play(anyOf(played_)); },
            [&] { modify(anyOf(upTo(2) == 0 ? posed_ : played_)); },
            [&] { changeGroups(); },
            [&] { moveOrigin(); },
        };
        all[upTo(std::size(all))]();
    }
    Many& any() {
        Many* const all[] = {&posed_, &played_, &rates_, &sharp_};
        return *all[upTo(4)];
    }
    SuppleInstance anyOf(const Many& many) {
        return many.instances[upTo(static_cast<uint32_t>(many.instances.size()))];
    }
    void changeInstances(Many& many) {
        if (many.instances.size() > 2 && upTo(2) == 0) {
            const uint32_t gone = upTo(static_cast<uint32_t>(many.instances.size()));
            set(suppleDestroyInstance(handle(), many.instances[gone]));
            many.instances.erase(many.instances.begin() + gone);
        } else if (many.instances.size() < many.capacity) {
            SuppleInstance made{};
            set(suppleCreateInstance(handle(), many.group, &made));
            many.instances.push_back(made);
            place(made);
        }
    }
    void place(SuppleInstance instance) {
        if (upTo(3) == 0) {
            const double position[] = {static_cast<double>(number()), 0.5, static_cast<double>(number())};
            set(suppleSetPosition(handle(), instance, position));
            return;
        }
        const float c = std::cos(number()), s = number();
        const float transform[] = {c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, 0, number(), number(), number(), 1};
        set(suppleSetTransform(handle(), instance, transform));
    }
    void setData(SuppleInstance instance) {
        const float data[] = {number(), number(), number(), number()};
        set(suppleSetUserData(handle(), instance, data));
    }
    void pose(SuppleInstance instance) {
        const uint32_t kind = upTo(4);
        if (kind == 0) {
            set(suppleSetClipPose(handle(), instance, upTo(3) == 0 ? SUPPLE_REST_POSE : 0, number(0.0f, 2.0f)));
        } else if (kind == 1) {
            std::vector<float> matrices;
            for (uint32_t joint = 0; joint < kJoints; ++joint) {
                addMatrix(matrices);
            }
            set(suppleSetMatrixPose(handle(), instance, matrices.data(), kJoints));
        } else {
            const float mask[kJoints] = {1.0f, number(0.0f, 1.0f), 0.5f};
            SuppleClipLayer layers[2]{};
            for (SuppleClipLayer& layer : layers) {
                layer.weight = number(0.0f, 1.0f);
                layer.time = static_cast<double>(number(0.0f, 2.0f));
            }
            layers[1].jointMask = mask;
            layers[1].jointMaskCount = kJoints;
            SupplePoseDesc desc{};
            desc.structSize = sizeof desc;
            desc.layers = layers;
            desc.layerCount = upTo(3);
            set(suppleSetPose(handle(), instance, &desc));
        }
    }
    void addMatrix(std::vector<float>& matrices) {
        const float s = number();
        matrices.insert(matrices.end(), {1, 0, s, 0, 0, 1, 0, 0, -s, 0, 1, 0, number(), number(), number(), 1});
    }
    void poseJoints(SuppleInstance instance) {
        const uint32_t joint = upTo(kJoints);
        std::vector<float> matrices;
        addMatrix(matrices);
        SuppleJointMatricesDesc desc{};
        desc.structSize = sizeof desc;
        desc.jointCount = 1;
        desc.jointMatrices = matrices.data();
        desc.joints = &joint;
        set(suppleSetJointMatrices(handle(), instance, &desc));
    }
    void setWeights(SuppleInstance instance) {
        const float weights[] = {number(), number(), number(), number()};
        const bool own = upTo(3) > 0;
        set(suppleSetMorphWeights(handle(), instance, own ? weights : nullptr, own ? 4 : 0));
    }
    void play(SuppleInstance instance) {
        if (upTo(6) == 0) {
            const float mask[kJoints] = {number(0.0f, 1.0f), 1.0f, number(0.0f, 1.0f)};
            SuppleMaskDesc desc{};
            desc.structSize = sizeof desc;
            desc.mask = 1 + upTo(2);
            desc.jointMask = mask;
            desc.jointMaskCount = kJoints;
            set(suppleSetMask(handle(), played_.group, &desc));
            hasMask_ = hasMask_ || desc.mask == 1;
        }
        SupplePlaybackLayer layer{};
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = 1.0f;
        layer.speed = number();
        layer.offset = static_cast<double>(number(0.0f, 2.0f));
        layer.mask = hasMask_ ? upTo(2) : 0;
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof desc;
        desc.layers = &layer;
        desc.layerCount = upTo(4) > 0 ? 1 : 0;
        desc.flags = upTo(3) == 0 ? SUPPLE_PLAYBACK_KEEP_TRANSITION : 0;
        if (desc.flags == 0 && upTo(3) > 0) {
            desc.transition = static_cast<double>(number(0.05f, 0.4f));
            desc.transitionKind = upTo(2) == 0 ? SUPPLE_TRANSITION_QUINTIC : SUPPLE_TRANSITION_DEAD_BLENDING;
        }
        desc.updateInterval = 1u << upTo(5) >> 1u; // 0 to 8
        set(suppleSetPlayback(handle(), instance, &desc));
    }
    void modify(SuppleInstance instance) {
        SuppleModifier modifiers[2]{};
        modifiers[0].kind = SUPPLE_MODIFIER_ADD;
        modifiers[1].kind = SUPPLE_MODIFIER_SET;
        for (SuppleModifier& modifier : modifiers) {
            modifier.joint = upTo(kJoints);
            modifier.weight = number(0.0f, 1.0f);
            modifier.rotation[2] = number();
            modifier.rotation[3] = 1.0f;
        }
        SuppleModifiersDesc desc{};
        desc.structSize = sizeof desc;
        desc.modifiers = modifiers;
        desc.modifierCount = upTo(3);
        set(suppleSetModifiers(handle(), instance, &desc));
        if (desc.modifierCount > 0) {
            SuppleModifierTarget target{};
            target.structSize = sizeof target;
            target.weight = number(0.0f, 1.0f);
            target.rotation[1] = number();
            target.rotation[3] = 1.0f;
            set(suppleSetModifierTarget(handle(), instance, 0, &target));
        }
    }
    void changeGroups() {
        switch (upTo(7)) {
        case 0:
            posed_.capacity = posed_.capacity == 5 ? 7 : 5;
            if (std::all_of(posed_.instances.begin(), posed_.instances.end(),
                            [](const SuppleInstance& instance) { return instance.slot < 5; })) {
                set(suppleSetCapacity(handle(), posed_.group, posed_.capacity));
            } else {
                posed_.capacity = 7;
            }
            break;
        case 1:
            set(suppleSetRate(handle(), posed_.group, 3 + upTo(2)));
            break;
        case 2: {
            const SuppleAssetDesc desc = tubeDesc();
            set(suppleReloadAsset(handle(), tube_, &desc));
            break;
        }
        case 3:
            set(suppleSetUploadBudget(handle(), budget_));
            budget_ = budget_ == 0 ? 1u << 22 : 0;
            break;
        case 4: {
            SuppleGroupDesc desc{};
            desc.structSize = sizeof desc;
            desc.asset = tube_;
            desc.capacity = 1;
            desc.scheme = SUPPLE_SCHEME_CAGE;
            SuppleGroup brief{};
            set(suppleCreateGroup(handle(), &desc, &brief));
            set(suppleDestroyGroup(handle(), brief));
            break;
        }
        case 5:
            if (unused_.id != 0) {
                set(suppleDestroyView(handle(), unused_));
                unused_ = {};
            }
            break;
        case 6: // all of its clips are there
            set(suppleRequestClip(handle(), tube_, 0, nullptr));
            break;
        }
    }
    void moveOrigin() {
        const double origin[] = {static_cast<double>(number()), 0.0, 0.25};
        set(suppleSetOrigin(handle(), origin));
    }

    static constexpr uint32_t kJoints = 3;
    CrowdContext& context_;
    std::mt19937 random_;
    SuppleAsset tube_{};
    SuppleView view_{}, unused_{};
    Many posed_, played_, rates_, sharp_;
    SuppleGroup follower_{};
    SupplePointSet points_{};
    SuppleQueryPool queries_{};
    double time_ = 0.0;
    VkDeviceSize budget_ = 1u << 22;
    bool hasMask_ = false;
};

} // namespace supple::test
