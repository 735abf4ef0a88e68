// Recordings: what a host did to a context, done again by another one, has the same hashes.
#include "tests/support/crowd.h"
#include "tools/common/word_hash.h"
#include "tools/replay/replayer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <supple/supple_recording.h>
#include <vector>

namespace supple::test {
namespace {

using runtime::FrameHashes;
using runtime::HashedStage;
using runtime::RecordingReader;
using runtime::StageHash;

class Recordings : public CrowdContexts {};

constexpr uint32_t kHostFrames = 40;

/// A recording that is kept in memory.
struct Recorded {
    std::vector<std::byte> bytes;
    uint32_t refusedAfter = UINT32_MAX; ///< writes

    [[nodiscard]] SuppleResult start(SuppleContext context, uint32_t flags = SUPPLE_RECORDING_HASHES) {
        SuppleRecordingDesc desc{};
        desc.structSize = sizeof desc;
        desc.flags = flags;
        desc.write = [](const void* from, size_t count, void* user) {
            auto& own = *static_cast<Recorded*>(user);
            const auto* first = static_cast<const std::byte*>(from);
            own.bytes.insert(own.bytes.end(), first, first + count);
            return own.refusedAfter-- > 0 ? 1 : 0;
        };
        desc.user = this;
        return suppleStartRecording(context, &desc);
    }
};

/// By frame, group of the recording, stage and surface.
using HashKey = std::tuple<uint64_t, uint64_t, uint32_t, uint32_t>;
using Hashes = std::map<HashKey, std::array<uint32_t, 2>>;
void put(Hashes& hashes, uint64_t frame, const StageHash& hash) {
    hashes[{frame, hash.group.id, static_cast<uint32_t>(hash.stage), hash.surface}] = {hash.sums[0], hash.sums[1]};
}

struct Read {
    Hashes hashes;
    std::set<size_t> calls; ///< numbers of those that were made
    bool ended = false;
};
Read read(const Recorded& recorded) {
    Read result;
    Result<RecordingReader> reader = RecordingReader::open(recorded.bytes, "recording");
    EXPECT_TRUE(reader.ok());
    while (reader) {
        const auto event = reader->next();
        EXPECT_TRUE(event.ok()) << event.error().message;
        if (!event || !*event) {
            break;
        }
        if (const auto* const hashes = std::get_if<FrameHashes>(&**event)) {
            for (uint32_t i = 0; i < hashes->count; ++i) {
                put(result.hashes, hashes->frame, hashes->hashes[i]);
            }
        } else if (const auto* const call = std::get_if<runtime::Call>(&**event)) {
            result.calls.insert(call->index());
        }
        result.ended = std::holds_alternative<runtime::RecordingEnd>(**event);
    }
    return result;
}

/// What another context makes of the recording.
Hashes replay(host::Device& device, const Recorded& recorded, tools::Replayer::Options options = {}) {
    Hashes hashes;
    Result<RecordingReader> reader = RecordingReader::open(recorded.bytes, "recording");
    if (!reader) {
        ADD_FAILURE() << reader.error().message;
        return hashes;
    }
    auto replayer = tools::Replayer::create(device, reader->context(), std::move(options));
    if (!replayer) {
        ADD_FAILURE() << replayer.error().message;
        return hashes;
    }
    Status status = success();
    while (status) {
        const auto event = reader->next();
        if (!event || !*event) {
            break;
        }
        status = (*replayer)->play(**event);
    }
    status = status ? (*replayer)->finish() : status;
    EXPECT_TRUE(status.ok()) << status.error().message;
    for (const tools::ReplayedFrame& frame : (*replayer)->takeHashes()) {
        for (const StageHash& hash : frame.hashes) {
            put(hashes, frame.number, hash);
        }
    }
    return hashes;
}

/// How many hashes of the recording the replay has; others are failures.
size_t expectSame(const Hashes& recorded, const Hashes& replayed) {
    size_t compared = 0;
    for (const auto& [key, sums] : recorded) {
        const auto found = replayed.find(key);
        if (found == replayed.end()) {
            continue;
        }
        ++compared;
        EXPECT_EQ(found->second, sums) << "frame " << std::get<0>(key) << ", stage " << std::get<2>(key) << ", surface "
                                       << std::get<3>(key);
    }
    return compared;
}

/// A host that does whatever hosts may do, by chance, frame after frame: the same for the same seed. What it does to
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
        time_ += 0.03;
        set(suppleSetTime(handle(), played_.group, time_));
        setCamera();
        const Status ran = context_.device().submitAndWait([&](VkCommandBuffer commands) {
            if (frame == 3) {
                set(suppleRecordUploads(handle(), commands));
                const SuppleGroup warm[] = {posed_.group, played_.group};
                set(suppleRecordWarmUp(handle(), commands, warm, 2));
            }
            const SuppleGroup groups[] = {posed_.group, follower_, played_.group, rates_.group, sharp_.group};
            set(context_.record(commands, groups));
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
        played_ = createMany({.flags = SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS,
                              .scheme = SUPPLE_SCHEME_PM,
                              .skinning = SUPPLE_SKINNING_DUAL_QUATERNION,
                              .poseSource = SUPPLE_POSES_PLAYBACK,
                              .view = view_});
        rates_ = createMany({.scheme = SUPPLE_SCHEME_FRAGMENTS, .rate = 8, .view = view_});
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
        switch (upTo(6)) {
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
    double time_ = 0.0;
    VkDeviceSize budget_ = 1u << 22;
    bool hasMask_ = false;
};

/// What the host has recorded that did something by `seed`, beginning with frame `first` (0: before anything is
/// created).
Recorded recordedHost(host::Device& device, SuppleMapping mapping, uint32_t seed, uint32_t first, uint32_t frames,
                      uint32_t flags = 0) {
    Recorded recorded;
    CrowdContext context(device, mapping, 2, first > 0 ? flags | SUPPLE_CONTEXT_RECORDABLE : flags);
    if (first == 0) {
        EXPECT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    }
    AnyHost host(context, seed);
    for (uint32_t frame = 1; frame <= frames; ++frame) {
        if (frame == first) {
            context.beginFrame(); // one that has recorded nothing
            EXPECT_EQ(recorded.start(context.handle()), SUPPLE_OK);
        }
        host.run(frame);
    }
    context.beginFrame(); // the last one is complete
    EXPECT_EQ(suppleStopRecording(context.handle()), SUPPLE_OK);
    return recorded;
}

TEST_F(Recordings, MadeAgainHaveTheSameHashes) {
    std::set<size_t> calls;
    for (const uint32_t seed : {1u, 2u, 3u}) {
        const Recorded recorded = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, seed, 0, kHostFrames);
        const Read own = read(recorded);
        EXPECT_TRUE(own.ended);
        calls.insert(own.calls.begin(), own.calls.end());
        const size_t compared = expectSame(own.hashes, replay(*testDevice(), recorded));
        EXPECT_EQ(compared, own.hashes.size());
        EXPECT_GT(compared, 300u);
    }
    for (size_t call = 0; call < runtime::kCallNames.size(); ++call) {
        EXPECT_TRUE(calls.contains(call) || call == runtime::kCallNumber<runtime::calls::SetDepthPyramid>)
            << runtime::kCallNames[call] << " was never made";
    }
}

TEST_F(Recordings, HaveTheSameHashesInTheOtherMapping) {
    const Recorded recorded = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, 4, 0, 12);
    const Read own = read(recorded);
    tools::Replayer::Options options;
    options.mapping = SUPPLE_MAPPING_WIDE;
    EXPECT_EQ(expectSame(own.hashes, replay(*testDevice(), recorded, options)), own.hashes.size());
}

TEST_F(Recordings, HaveTheSameHashesWhereGroupsShareDispatches) {
    const Recorded recorded =
        recordedHost(*testDevice(), SUPPLE_MAPPING_WIDE, 8, 0, 8, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    const Read own = read(recorded);
    tools::Replayer::Options options;
    options.mapping = SUPPLE_MAPPING_NARROW;
    EXPECT_EQ(expectSame(own.hashes, replay(*testDevice(), recorded, options)), own.hashes.size());
}

TEST_F(Recordings, MayBeginAgain) {
    CrowdContext context(*testDevice(), SUPPLE_MAPPING_NARROW, 2, SUPPLE_CONTEXT_RECORDABLE);
    AnyHost host(context, 9);
    for (uint32_t frame = 1; frame <= 12; frame += 3) {
        Recorded recorded;
        context.beginFrame();
        ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
        host.run(frame);
        host.run(frame + 1);
        context.beginFrame();
        ASSERT_EQ(suppleStopRecording(context.handle()), SUPPLE_OK);
        host.run(frame + 2);
        const Read own = read(recorded);
        EXPECT_GT(own.hashes.size(), 5u);
        EXPECT_EQ(expectSame(own.hashes, replay(*testDevice(), recorded)), own.hashes.size());
    }
}

TEST_F(Recordings, ThatBeginLateBeginWithWhatThereIs) {
    for (const uint32_t first : {1u, 2u, 7u, 16u, 31u}) {
        SCOPED_TRACE(first);
        const Recorded recorded = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, 10 + first, first, first + 8);
        const Read own = read(recorded);
        const size_t compared = expectSame(own.hashes, replay(*testDevice(), recorded));
        EXPECT_EQ(compared, own.hashes.size());
        EXPECT_GT(compared, 50u);
    }
}

TEST_F(Recordings, HashWhatTheDeviceWrote) {
    CrowdContext context(*testDevice(), SUPPLE_MAPPING_NARROW);
    Recorded recorded;
    ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(tubeFile(), "tube");
    desc.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    desc.rate = 5;
    desc.capacity = 1;
    Crowd crowd(context, desc);
    const SuppleInstance instance = crowd.spawn();
    ASSERT_EQ(suppleSetClipPose(context.handle(), instance, 0, 0.7), SUPPLE_OK);
    context.run(crowd.group());
    const host::GroupOutput output = crowd.output();
    const std::vector<std::byte> poses = crowd.read(output.info.poses), cage = crowd.read(output.info.deformedCage),
                                 vertices = crowd.read(output.streams.vertices);
    context.beginFrame();
    ASSERT_EQ(suppleStopRecording(context.handle()), SUPPLE_OK);

    tools::WordHash ofPoses, ofCage, ofVertices;
    constexpr size_t kPoseWords = 3 * 12 + 4; // joints, morph weights
    ofPoses.add(std::span(poses).first(sizeof(float) * kPoseWords));
    ofCage.add(std::span(cage).first(size_t{16} * output.info.cageVertexCount));
    for (uint32_t v = 0; v < output.grid.vertexCount; ++v) {
        ofVertices.add(std::span(vertices).subspan(size_t{v} * output.streams.vertices.stride, 12));
    }
    const Hashes hashes = read(recorded).hashes;
    ASSERT_EQ(hashes.size(), 3u);
    const tools::WordHash own[] = {ofPoses, ofCage, ofVertices};
    for (uint32_t stage = 0; stage < 3; ++stage) {
        const auto found = hashes.find({1, crowd.group().id, stage, 0});
        ASSERT_NE(found, hashes.end());
        EXPECT_EQ(found->second[0] | uint64_t{found->second[1]} << 32u, own[stage].value()) << "stage " << stage;
    }
}

TEST_F(Recordings, ShowWhereAnotherPoseIsPlayed) {
    Recorded recorded = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, 5, 0, 6);
    const Hashes own = read(recorded).hashes;
    // The time of frame 4, a little later.
    const double time = 4 * 0.03;
    std::array<std::byte, sizeof(time)> bytes{};
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += 0.03;
    }
    std::memcpy(bytes.data(), &sum, sizeof(sum));
    const auto found = std::search(recorded.bytes.begin(), recorded.bytes.end(), bytes.begin(), bytes.end());
    ASSERT_NE(found, recorded.bytes.end());
    const double later = time + 0.01;
    std::memcpy(&*found, &later, sizeof(later));
    const Hashes other = replay(*testDevice(), recorded);
    std::set<uint64_t> frames;
    for (const auto& [key, sums] : own) {
        const auto here = other.find(key);
        if (here != other.end() && here->second != sums) {
            frames.insert(std::get<0>(key));
        }
    }
    EXPECT_EQ(frames, std::set<uint64_t>{4});
}

TEST_F(Recordings, EndIfTheHostTakesNoMore) {
    CrowdContext context(*testDevice());
    Recorded recorded;
    recorded.refusedAfter = 2;
    ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    for (int i = 0; i < 4; ++i) {
        context.beginFrame();
    }
    EXPECT_EQ(context.takeCount(SUPPLE_MESSAGE_RECORDING_ENDED), 1u);
    EXPECT_EQ(suppleStopRecording(context.handle()), SUPPLE_ERROR_ARGUMENT);
    EXPECT_FALSE(read(recorded).ended);
}

TEST_F(Recordings, WithoutCharactersTakeThemFromTheHost) {
    CrowdContext context(*testDevice());
    Recorded recorded;
    ASSERT_EQ(recorded.start(context.handle(), SUPPLE_RECORDING_HASHES | SUPPLE_RECORDING_WITHOUT_ASSETS), SUPPLE_OK);
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(tubeFile(), "tube");
    desc.capacity = 1;
    desc.rate = 2;
    Crowd crowd(context, desc);
    (void)crowd.spawn();
    context.run(crowd.group());
    context.beginFrame();
    ASSERT_EQ(suppleStopRecording(context.handle()), SUPPLE_OK);
    EXPECT_LT(recorded.bytes.size(), 4096u);
    const Hashes own = read(recorded).hashes;
    tools::Replayer::Options options;
    options.characters.emplace_back("the same tube", tubeFile());
    EXPECT_EQ(expectSame(own, replay(*testDevice(), recorded, options)), 3u);
}

/// Whatever is cut off or changed, reading it ends.
TEST_F(Recordings, MayBeDamaged) {
    const Recorded whole = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, 6, 0, 4);
    const auto readAll = [](std::span<const std::byte> bytes) {
        size_t events = 0;
        Result<RecordingReader> reader = RecordingReader::open(bytes, "damaged");
        for (bool more = reader.ok(); more;) {
            const auto event = reader->next();
            more = event.ok() && event->has_value();
            events += more ? 1 : 0;
        }
        return events;
    };
    const size_t all = readAll(whole.bytes);
    size_t last = 0;
    for (size_t length = 0; length < whole.bytes.size(); length += 509) {
        const size_t events = readAll(std::span(whole.bytes).first(length));
        EXPECT_GE(events, last);
        last = events;
    }
    EXPECT_LT(last, all);
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::byte> bytes = whole.bytes;
        for (int k = 0; k < 4; ++k) {
            bytes[random() % bytes.size()] ^= static_cast<std::byte>(1u << random() % 8);
        }
        EXPECT_LE(readAll(bytes), all + 4);
    }
}

TEST_F(Recordings, AreRefusedWhereTheyLackTheBeginning) {
    CrowdContext context(*testDevice());
    (void)context.createAsset(tubeFile(), "tube");
    Recorded recorded;
    EXPECT_EQ(recorded.start(context.handle()), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(context.takeError(), SUPPLE_MESSAGE_OUT_OF_ORDER);
    EXPECT_EQ(suppleStopRecording(context.handle()), SUPPLE_ERROR_ARGUMENT);
    CrowdContext fresh(*testDevice());
    EXPECT_EQ(recorded.start(fresh.handle()), SUPPLE_OK);
    EXPECT_EQ(recorded.start(fresh.handle()), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleStopRecording(fresh.handle()), SUPPLE_OK);
    EXPECT_EQ(recorded.start(fresh.handle()), SUPPLE_OK);
}

} // namespace
} // namespace supple::test
