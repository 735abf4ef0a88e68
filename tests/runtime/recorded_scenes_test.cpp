// Recordings whose hashes are pinned: the scenes in tests/data/recordings come out with the same words on every driver
// and in both mappings. To record them anew, where a change of words is meant:
//
//   SUPPLE_WRITE_RECORDINGS=$PWD/tests/data/recordings build/release/tests/runtime/supple_runtime_tests
//       --gtest_filter='*RecordedScenes.*'
//   build/release/samples/play/supple_play --script --fps 8 --rate 1 --bare --record
//   tests/data/recordings/plays.supprec
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/played_group.h"
#include "tests/support/recordings.h"
#include "tests/support/sample_assets.h"
#include "tests/support/soft_assets.h"
#include "tests/support/springs.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <supple/supple.hpp>
#include <tuple>

namespace supple::test {
namespace {

constexpr uint32_t kSceneFrames = 6;
constexpr double kSceneStep = 0.125; // exact in binary, as most numbers here

std::vector<std::byte> fileBytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file.good()) << path;
    const std::vector<char> text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

void succeed(SuppleResult result) {
    EXPECT_EQ(result, SUPPLE_OK);
}

/// A host that records what it does with one character.
class SceneHost {
public:
    SceneHost(host::Device& device, std::vector<std::byte> bytes, const std::string& character, std::ofstream& out)
        : context(device, SUPPLE_MAPPING_NARROW), bytes_(std::move(bytes)),
          name_(character.substr(character.rfind('/') + 1)) {
        auto recording = sized<SuppleRecordingDesc>();
        recording.flags = SUPPLE_RECORDING_HASHES | SUPPLE_RECORDING_WITHOUT_ASSETS;
        recording.write = [](const void* bytes, size_t count, void* user) {
            static_cast<std::ofstream*>(user)->write(static_cast<const char*>(bytes),
                                                     static_cast<std::streamsize>(count));
            return 1;
        };
        recording.user = &out;
        succeed(suppleStartRecording(context.handle(), &recording));
        const SuppleAssetDesc desc = assetDesc();
        succeed(suppleCreateAsset(context.handle(), &desc, &asset));
    }

    [[nodiscard]] SuppleContext handle() const { return context.handle(); }
    [[nodiscard]] SuppleAssetDesc assetDesc() const {
        auto desc = sized<SuppleAssetDesc>();
        desc.name = name_.c_str();
        desc.bytes = bytes_.data();
        desc.byteCount = bytes_.size();
        return desc;
    }
    SuppleGroup create(SuppleGroupDesc desc, uint32_t instances) {
        desc.structSize = sizeof desc;
        desc.asset = asset;
        desc.capacity = desc.instancesOf.id == 0 ? instances + 1 : 0;
        SuppleGroup group{};
        succeed(suppleCreateGroup(handle(), &desc, &group));
        groups.push_back(group);
        for (uint32_t i = 0; i < instances; ++i) {
            spawn(group);
        }
        return group;
    }
    void spawn(SuppleGroup group) {
        succeed(suppleCreateInstance(handle(), group, &all.emplace_back()));
        place(all.size() - 1, 0.5f * static_cast<float>(all.size()), 0.0f);
    }
    void place(size_t i, float x, float z) const {
        const float transform[] = {0.5f, 0, 0.75f, 0, 0, 1, 0, 0, -0.75f, 0, 0.5f, 0, x, 0, z, 1};
        succeed(suppleSetTransform(handle(), all[i], transform));
    }
    void play(size_t i, std::span<const SupplePlaybackLayer> layers, SupplePlaybackDesc desc = {}) const {
        desc.structSize = sizeof desc;
        desc.layers = layers.data();
        desc.layerCount = static_cast<uint32_t>(layers.size());
        succeed(suppleSetPlayback(handle(), all[i], &desc));
    }
    void loop(size_t i, uint32_t clip, double offset, const SupplePlaybackDesc& desc = {}) const {
        const SupplePlaybackLayer layer = PlayedGroup::loops(clip, offset);
        play(i, {&layer, 1}, desc);
    }
    /// A frame of all groups, each that plays at its time.
    void run() {
        time += kSceneStep;
        for (const SuppleGroup& group : played) {
            succeed(suppleSetTime(handle(), group, time));
        }
        context.run(groups);
    }

    CrowdContext context;
    SuppleAsset asset{};
    std::vector<SuppleGroup> groups, played;
    std::vector<SuppleInstance> all;
    double time = 0.0;

private:
    std::vector<std::byte> bytes_;
    std::string name_;
};

/// Layers that fade, a mask, teleports.
void fades(SceneHost& host) {
    const SuppleGroup group =
        host.create({.scheme = SUPPLE_SCHEME_CATMULL_CLARK, .rate = 2, .poseSource = SUPPLE_POSES_PLAYBACK}, 3);
    host.played = {group};
    std::vector<float> weights(63, 0.0f);
    for (size_t joint = 20; joint < weights.size(); ++joint) {
        weights[joint] = 0.5f;
    }
    auto mask = sized<SuppleMaskDesc>();
    mask.mask = 1;
    mask.jointMask = weights.data();
    mask.jointMaskCount = static_cast<uint32_t>(weights.size());
    succeed(suppleSetMask(host.handle(), group, &mask));
    for (uint32_t i = 0; i < 3; ++i) {
        SupplePlaybackLayer layers[] = {PlayedGroup::loops(i, 0.25 * i), PlayedGroup::loops((i + 1) % 3, 0.5)};
        layers[1].weight = 0.0f;
        layers[1].fadeWeight = 1.0f;
        layers[1].fadeStart = 0.125;
        layers[1].fadeDuration = 0.5f;
        layers[1].mask = i == 2 ? 1 : 0;
        host.play(i, layers);
    }
    for (uint32_t frame = 0; frame < kSceneFrames; ++frame) {
        if (frame == 3) {
            host.place(1, -2.0f, 1.0f);
            succeed(suppleTeleport(host.handle(), host.all[1]));
        }
        host.run();
    }
}

/// Transitions of both kinds, dual quaternions, modifiers, hidden parts, morph weights of the host's.
void goesOver(SceneHost& host) {
    host.played = {host.create({.flags = SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS,
                                .scheme = SUPPLE_SCHEME_PM,
                                .rate = 1,
                                .skinning = SUPPLE_SKINNING_DUAL_QUATERNION,
                                .poseSource = SUPPLE_POSES_PLAYBACK},
                               2)};
    host.loop(0, 2, 0.0);
    host.loop(1, 1, 0.5);
    succeed(suppleSetPartVisible(host.handle(), host.all[1], 9, 0));
    const float weights[] = {1.0f, 0.0f, 0.5f, 0.0f, 0.25f, 0.0f, 0.75f};
    succeed(suppleSetMorphWeights(host.handle(), host.all[0], weights, 7));
    SuppleModifier aim{};
    aim.kind = SUPPLE_MODIFIER_AIM;
    aim.joint = 10;
    aim.weight = 0.75f;
    aim.target[0] = 4.0;
    aim.target[1] = 2.0;
    auto modifiers = sized<SuppleModifiersDesc>();
    modifiers.modifiers = &aim;
    modifiers.modifierCount = 1;
    succeed(suppleSetModifiers(host.handle(), host.all[1], &modifiers));
    for (uint32_t frame = 0; frame < kSceneFrames; ++frame) {
        if (frame == 2) {
            SupplePlaybackDesc over{};
            over.transition = 0.375;
            host.loop(0, 0, 0.0, over);
            over.transitionKind = SUPPLE_TRANSITION_QUINTIC;
            host.loop(1, 4, 0.25, over);
        }
        host.run();
    }
}

/// Update rates: those that the host asks for, moved, hidden and posed anew meanwhile; frames at any times.
void takesTurns(SceneHost& host) {
    for (const SuppleSkinning skinning : {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION}) {
        host.played.push_back(host.create({.flags = SUPPLE_GROUP_UPDATE_RATES,
                                           .scheme = SUPPLE_SCHEME_PREP,
                                           .rate = 1,
                                           .skinning = skinning,
                                           .poseSource = SUPPLE_POSES_PLAYBACK},
                                          4));
    }
    const auto play = [&](uint32_t i, uint32_t clip) {
        SupplePlaybackDesc desc{};
        desc.updateInterval = 1u << i % 4;
        desc.rootMotion = i % 3 == 0 ? SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW : 0;
        desc.flags = i % 3 == 0 ? SUPPLE_PLAYBACK_TRAVEL : 0;
        host.loop(i, clip, 0.125 * i, desc);
    };
    for (uint32_t i = 0; i < 8; ++i) {
        play(i, i % 3);
    }
    for (uint32_t frame = 0; frame < kSceneFrames; ++frame) {
        host.time -= frame % 2 == 0 ? 0.0 : 0.109375; // in turns 1/64 s and 1/8 s
        if (frame == 3) {
            play(1, 2);
            host.place(2, -2.0f, 1.0f);
        }
        succeed(suppleSetVisible(host.handle(), host.all[5], frame == 2 ? 0 : 1));
        host.run();
    }
}

/// Several schemes at once, one of them over the instances of another; instances that come and go.
void schemes(SceneHost& host) {
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_FRAGMENTS}) {
        host.played.push_back(host.create({.scheme = scheme, .rate = 2, .poseSource = SUPPLE_POSES_PLAYBACK}, 1));
    }
    host.create({.scheme = SUPPLE_SCHEME_LOOP, .rate = 2, .instancesOf = host.played[0]}, 0);
    for (uint32_t i = 0; i < 3; ++i) {
        host.loop(i, i, 0.25 * i);
    }
    for (uint32_t frame = 0; frame < kSceneFrames; ++frame) {
        if (frame == 2) {
            host.spawn(host.played[0]);
            host.loop(3, 1, 0.5);
        }
        if (frame == 4) {
            succeed(suppleDestroyInstance(host.handle(), host.all[0]));
            succeed(suppleSetVisible(host.handle(), host.all[1], 0));
        }
        host.run();
    }
}

/// Matrices of the host's, of all joints and of some; places in a large world.
void matrices(SceneHost& host) {
    host.create({.scheme = SUPPLE_SCHEME_PM, .rate = 2}, 2);
    constexpr uint32_t kJoints = 63;
    for (uint32_t frame = 0; frame < kSceneFrames; ++frame) {
        const float turn = 0.0625f * static_cast<float>(frame);
        std::vector<float> joints;
        for (uint32_t joint = 0; joint < kJoints; ++joint) {
            const float shift = 0.015625f * static_cast<float>(joint);
            joints.insert(joints.end(), {1, turn, 0, 0, -turn, 1, 0, 0, 0, 0, 1, 0, shift, turn, -shift, 1});
        }
        succeed(suppleSetMatrixPose(host.handle(), host.all[0], joints.data(), kJoints));
        const uint32_t some[] = {3, 17};
        auto desc = sized<SuppleJointMatricesDesc>();
        desc.jointCount = 2;
        desc.jointMatrices = joints.data() + 16 * size_t{frame};
        desc.joints = some;
        succeed(suppleSetJointMatrices(host.handle(), host.all[1], &desc));
        const double position[] = {1048576.0 + 0.25 * frame, 0.0, -0.5};
        succeed(suppleSetPosition(host.handle(), host.all[1], position));
        if (frame == 3) {
            const double origin[] = {1048576.0, 0.0, 0.0};
            succeed(suppleSetOrigin(host.handle(), origin));
        }
        host.run();
    }
}

/// Root motion that moves instances; another capacity, and the character loaded anew.
void travels(SceneHost& host) {
    const SuppleGroup group = host.create(
        {.scheme = SUPPLE_SCHEME_POLYGONS, .skinning = SUPPLE_SKINNING_LINEAR, .poseSource = SUPPLE_POSES_PLAYBACK}, 2);
    host.played = {group};
    SupplePlaybackDesc desc{};
    desc.flags = SUPPLE_PLAYBACK_TRAVEL;
    desc.rootMotion = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW;
    host.loop(0, 1, 0.0, desc);
    host.loop(1, 5, 0.75, desc);
    for (uint32_t frame = 0; frame < kSceneFrames; ++frame) {
        if (frame == 2) {
            succeed(suppleSetCapacity(host.handle(), group, 6));
        }
        if (frame == 4) {
            const SuppleAssetDesc again = host.assetDesc();
            succeed(suppleReloadAsset(host.handle(), host.asset, &again));
        }
        host.run();
    }
}

/// Springs: moved, teleported and hidden meanwhile; with modifiers, and where root motion travels.
void swings(SceneHost& host) {
    for (const uint32_t modifiers : {0u, uint32_t{SUPPLE_GROUP_MODIFIERS}}) {
        host.played.push_back(host.create({.flags = SUPPLE_GROUP_SPRINGS | SUPPLE_GROUP_TRANSITIONS | modifiers,
                                           .scheme = SUPPLE_SCHEME_PREP,
                                           .rate = 1,
                                           .poseSource = SUPPLE_POSES_PLAYBACK},
                                          3));
    }
    const auto play = [&](uint32_t i, uint32_t clip, double transition) {
        SupplePlaybackDesc desc{};
        desc.transition = transition;
        desc.rootMotion = i % 3 == 0 ? SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW : 0;
        desc.flags = i % 3 == 0 ? SUPPLE_PLAYBACK_TRAVEL : 0;
        host.loop(i, clip, 0.125 * i, desc);
    };
    for (uint32_t i = 0; i < 6; ++i) {
        play(i, i % 3, 0.0);
    }
    SuppleModifier turn{};
    turn.kind = SUPPLE_MODIFIER_ADD;
    turn.joint = 5; // the head
    turn.weight = 1.0f;
    turn.rotation[1] = 0.6f;
    turn.rotation[3] = 0.8f;
    auto modifiers = sized<SuppleModifiersDesc>();
    modifiers.modifiers = &turn;
    modifiers.modifierCount = 1;
    succeed(suppleSetModifiers(host.handle(), host.all[4], &modifiers));
    for (uint32_t frame = 0; frame < 2 * kSceneFrames; ++frame) {
        host.time -= frame % 2 == 0 ? 0.03125 : 0.109375;
        if (frame == 3) {
            play(1, 2, 0.25);
        }
        host.place(2, 0.25f * static_cast<float>(frame), 1.0f);
        if (frame == 5) {
            host.place(4, 8.0f, 8.0f);
            succeed(suppleTeleport(host.handle(), host.all[4]));
        }
        succeed(suppleSetVisible(host.handle(), host.all[5], frame > 3 && frame < 6 ? 0 : 1));
        host.run();
    }
}

/// What jiggles: moved, teleported and hidden meanwhile; many frames are left out, and root motion travels.
void jiggles(SceneHost& host) {
    const SuppleGroup group = host.create({.flags = SUPPLE_GROUP_SOFT | SUPPLE_GROUP_TRANSITIONS,
                                           .scheme = SUPPLE_SCHEME_PM,
                                           .rate = 1,
                                           .poseSource = SUPPLE_POSES_PLAYBACK},
                                          4);
    host.played = {group};
    for (uint32_t i = 0; i < 4; ++i) {
        SupplePlaybackDesc desc{};
        desc.rootMotion = i == 3 ? SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_HEIGHT : 0;
        desc.flags = i == 3 ? SUPPLE_PLAYBACK_TRAVEL : 0;
        host.loop(i, i % 2, 0.125 * i, desc);
    }
    for (uint32_t frame = 0; frame < 3 * kSceneFrames; ++frame) {
        host.time -= frame % 2 == 0 ? 0.03125 : 0.109375;
        host.time += frame == 12 ? 0.25 : 0.0;
        if (frame == 4) {
            SupplePlaybackDesc over{};
            over.transition = 0.25;
            host.loop(0, 1, 0.5, over);
        }
        host.place(2, 0.25f * static_cast<float>(frame), 1.0f);
        if (frame == 7) {
            host.place(1, 8.0f, 8.0f);
            succeed(suppleTeleport(host.handle(), host.all[1]));
        }
        succeed(suppleSetVisible(host.handle(), host.all[3], frame > 8 && frame < 11 ? 0 : 1));
        host.run();
    }
}

struct RecordedScene {
    const char* name;
    const std::string& character;
    void (*play)(SceneHost&); ///< null: a sample has recorded it
    bool springs = false;     ///< the character has some
    bool isSmall = false;     ///< its tables fit in the texel buffers of every device

    [[nodiscard]] std::vector<std::byte> bytes() const {
        return springs ? withExtensions(character, kWrenSprings) : fileBytes(character);
    }
};
const RecordedScene kScenes[] = {
    {"fades", kPip, fades},          {"goes_over", kWren, goesOver},  {"takes_turns", kWren, takesTurns},
    {"schemes", kPipQuads, schemes}, {"matrices", kPip, matrices},    {"travels", kWren, travels},
    {"plays", kWren, nullptr},       {"swings", kWren, swings, true}, {"jiggles", kBellyFile, jiggles, false, true}};

class RecordedScenes : public testing::TestWithParam<std::tuple<RecordedScene, SuppleMapping>> {
protected:
    void SetUp() override { ASSERT_NE(testDevice(), nullptr); }
};

/// Plays the recording, and compares every hash of it.
void expectSameWords(const std::vector<std::byte>& recording, const RecordedScene& scene, SuppleMapping mapping) {
    tools::Replayer::Options options;
    options.mapping = mapping;
    options.characters.emplace_back(scene.character, scene.bytes());
    const Hashes recorded = read(recording).hashes;
    const size_t compared = expectSame(recorded, replay(*testDevice(), recording, std::move(options)));
    EXPECT_EQ(compared, recorded.size());
    EXPECT_GE(compared, size_t{kSceneFrames} * 3);
}

TEST_P(RecordedScenes, ComeOutWithTheWordsThatArePinned) {
    const auto& [scene, mapping] = GetParam();
    const bool records = scene.play != nullptr && mapping == SUPPLE_MAPPING_NARROW;
    const char* const folder = records ? std::getenv("SUPPLE_WRITE_RECORDINGS") : nullptr;
    const std::string path = (folder != nullptr ? std::string(folder) : std::string(SUPPLE_TEST_DATA) + "/recordings") +
                             "/" + scene.name + ".supprec";
    if (folder != nullptr) {
        std::ofstream out(path, std::ios::binary);
        SceneHost host(*testDevice(), scene.bytes(), scene.character, out);
        scene.play(host);
        host.context.beginFrame(); // the last frame is complete
        succeed(suppleStopRecording(host.handle()));
    }
    // In the narrow mapping the tables of the character have to fit in texel buffers.
    const uint32_t elements = testDevice()->properties().limits.maxTexelBufferElements;
    if (mapping == SUPPLE_MAPPING_NARROW && !scene.isSmall && elements < 1u << 20u) {
        GTEST_SKIP() << "left out: the device has " << elements << " texel-buffer elements";
    }
    expectSameWords(fileBytes(path), scene, mapping);
}

INSTANTIATE_TEST_SUITE_P(All, RecordedScenes,
                         testing::Combine(testing::ValuesIn(kScenes), testing::ValuesIn(kMappings)),
                         [](const auto& info) {
                             return std::get<0>(info.param).name + ("_" + mappingName(std::get<1>(info.param)));
                         });

} // namespace
} // namespace supple::test
