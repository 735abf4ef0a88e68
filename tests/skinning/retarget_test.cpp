// Clips of one skeleton for another: against the stored results of an independent implementation, and by what a user
// sees: ankles, names, messages.
#include "skinning/retarget.h"

#include "cage/node_match.h"
#include "cage/refusal.h"
#include "cage/skeleton.h"
#include "skinning/followers.h"
#include "skinning/pose.h"
#include "skinning/rotation.h"
#include "tests/support/read_character.h"
#include "tests/support/sample_assets.h"
#include "tests/support/shared_assets.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace supple::skinning {
namespace {

using Json = nlohmann::json;

/// Its clips as those of a file without meshes.
cage::ClipSet clipsOf(const cage::Character& character, const std::string& name) {
    cage::ClipSet set;
    set.name = name;
    set.skeleton = character.skeleton;
    set.meshes.assign(set.skeleton.nodes.size(), cage::kNone);
    set.clips = character.clips;
    for (cage::Clip& clip : set.clips) {
        std::erase_if(clip.channels,
                      [](const cage::Channel& channel) { return channel.path == cage::ChannelPath::weights; });
    }
    return set;
}

/// What becomes of clips, and what is said of it.
struct Outcome {
    cage::ClipSet set;
    std::string refusal;
    [[nodiscard]] std::string warning() const { return set.warnings.empty() ? "" : set.warnings.back(); }
};
Outcome fit(const cage::Character& from, const cage::Character& to, RetargetOptions options = {}) {
    Outcome outcome{clipsOf(from, "clips.glb"), {}};
    try {
        fitClips(options, to.skeleton, outcome.set);
    } catch (const cage::Refusal& refusal) {
        outcome.refusal = refusal.faults.front();
    }
    return outcome;
}

const cage::Clip& clipCalled(const std::vector<cage::Clip>& clips, const std::string& name) {
    const auto found =
        std::find_if(clips.begin(), clips.end(), [&](const cage::Clip& clip) { return clip.name == name; });
    EXPECT_NE(found, clips.end()) << name;
    return found != clips.end() ? *found : clips.front();
}

/// A pose in model space. By node.
struct ModelPose {
    std::vector<glm::dvec3> places;
    std::vector<glm::dquat> turns;
};
ModelPose poseOf(const cage::Skeleton& skeleton, const cage::Clip& clip, double time) {
    ModelPose pose{std::vector<glm::dvec3>(skeleton.nodes.size()), std::vector<glm::dquat>(skeleton.nodes.size())};
    std::vector<glm::dmat4> globals(skeleton.nodes.size());
    for (const uint32_t n : skeleton.parentsFirst) {
        const Transform local = sampleNode(skeleton, clip, time, n);
        const uint32_t parent = skeleton.nodes[n].parent;
        const glm::dmat4 matrix = localMatrix(skeleton.nodes[n], local);
        globals[n] = parent == cage::kNone ? matrix : globals[parent] * matrix;
        pose.turns[n] = parent == cage::kNone ? unit(local.rotation) : pose.turns[parent] * unit(local.rotation);
        pose.places[n] = glm::dvec3(globals[n][3]);
    }
    return pose;
}
double angleApart(const glm::dquat& a, const glm::dquat& b) {
    return 2.0 * std::asin(std::min(
                     glm::length(glm::dvec3(0.0) + glm::dvec3((glm::conjugate(a) * b).x, (glm::conjugate(a) * b).y,
                                                              (glm::conjugate(a) * b).z)),
                     1.0));
}

uint32_t nodeOf(const cage::Skeleton& skeleton, const std::string& name) {
    for (const uint32_t n : skeleton.parentsFirst) {
        if (skeleton.nodes[n].name == name) {
            return n;
        }
    }
    ADD_FAILURE() << name;
    return 0;
}

Roles rolesOf(const cage::Character& character) {
    Roles none{};
    none.fill(cage::kNone);
    return findRoles(character.skeleton, none);
}

std::string sampleFile(const std::string& name) {
    return name == "pip" ? test::kPip : test::kWren;
}

TEST(Retarget, IsWhatAnIndependentImplementationMakesOfIt) {
    std::ifstream stream(std::string(SUPPLE_TEST_DATA) + "/retarget/biped_pairs.json");
    ASSERT_TRUE(stream);
    const Json pairs = Json::parse(stream);
    ASSERT_EQ(pairs.size(), 3u);
    for (const Json& pair : pairs) {
        const cage::Character from = test::readCharacter(sampleFile(pair["source"]));
        const cage::Character to = test::readCharacter(sampleFile(pair["target"]));
        const Outcome outcome = fit(from, to);
        ASSERT_TRUE(outcome.set.isFitted) << outcome.refusal;
        const cage::Clip& clip = clipCalled(outcome.set.clips, pair["clip"]);
        const Roles roles = rolesOf(to);
        const double height = hipsHeight(RestPlaces(to.skeleton), roles);
        double farthest = 0.0, mostTurned = 0.0;
        for (const Json& frame : pair["frames"]) {
            const ModelPose pose = poseOf(to.skeleton, clip, frame["time"]);
            for (size_t i = 0; i < pair["nodes"].size(); ++i) {
                const uint32_t node = *std::find_if(roles.begin(), roles.end(), [&](uint32_t n) {
                    return to.skeleton.nodes[n].name == pair["nodes"][i];
                }); // a mesh may have the name as well
                const Json &p = frame["places"][i], &q = frame["turns"][i];
                test::raise(farthest, glm::length(pose.places[node] - glm::dvec3(p[0], p[1], p[2])) / height);
                test::raise(mostTurned, angleApart(pose.turns[node], unit(glm::dquat(q[3], q[0], q[1], q[2]))));
            }
        }
        // There a straight leg bends about a hinge in model space, here about one in the knee's own frame.
        const bool isStraight = pair["clip"] == "run";
        EXPECT_LT(farthest, isStraight ? 0.01 : 1e-6) << pair["source"] << " " << pair["clip"];
        EXPECT_LT(mostTurned, isStraight ? 0.03 : 1e-5) << pair["source"] << " " << pair["clip"];
        std::printf("%s's %s on %s: joints within %.2g heights of the hips, %.2g rad\n",
                    std::string(pair["source"]).c_str(), std::string(pair["clip"]).c_str(),
                    std::string(pair["target"]).c_str(), farthest, mostTurned);
    }
}

TEST(Retarget, OntoItselfNothingChanges) {
    for (const std::string& file : {test::kPip, test::kWren}) {
        const cage::Character character = test::readCharacter(file);
        EXPECT_FALSE(fit(character, character).set.isFitted) << "names fit, and bones are as long";
        const Outcome placed = fit(character, character, {Retargeting::all, {}, true});
        const Outcome outcome = fit(character, character, {Retargeting::freeFeet, {}, true});
        ASSERT_TRUE(outcome.set.isFitted && placed.set.isFitted) << outcome.refusal;
        const Roles roles = rolesOf(character);
        for (size_t c = 0; c < character.clips.size(); ++c) {
            for (int k = 0; k <= 10; ++k) {
                const double time = character.clips[c].duration * k / 10.0;
                const ModelPose was = poseOf(character.skeleton, character.clips[c], time);
                const ModelPose now = poseOf(character.skeleton, outcome.set.clips[c], time);
                const ModelPose bent = poseOf(character.skeleton, placed.set.clips[c], time);
                for (const uint32_t node : roles) {
                    const std::string where = character.clips[c].name + " " + character.skeleton.nodes[node].name;
                    EXPECT_LT(angleApart(was.turns[node], now.turns[node]), 1e-3) << where << " " << time;
                    // Legs that are nearly straight bend about the axis of the other frames.
                    EXPECT_LT(angleApart(was.turns[node], bent.turns[node]), 0.15) << where << " " << time;
                }
            }
        }
    }
}

TEST(Retarget, AnklesGoWhereThoseOfTheClipGo) {
    const cage::Character from = test::readCharacter(test::kWren), to = test::readCharacter(test::kPip);
    const auto worst = [&](Retargeting retargeting) {
        const Outcome outcome = fit(from, to, {retargeting, {}, false});
        const Roles leading = rolesOf(from), own = rolesOf(to);
        const RestPlaces fromRest(from.skeleton), rest(to.skeleton);
        const double scale = hipsHeight(rest, own) / hipsHeight(fromRest, leading);
        double miss = 0.0;
        const cage::Clip &walk = clipCalled(from.clips, "walk"), &fitted = clipCalled(outcome.set.clips, "walk");
        for (int k = 0; k <= 40; ++k) {
            const double time = walk.duration * k / 40.0;
            const ModelPose was = poseOf(from.skeleton, walk, time), now = poseOf(to.skeleton, fitted, time);
            for (const Role foot : {roleOf(BodyPart::foot, kLeft), roleOf(BodyPart::foot, kRight)}) {
                const glm::dvec3 way = now.places[own[foot]] - rest.place(own[foot]);
                const glm::dvec3 wanted = (was.places[leading[foot]] - fromRest.place(leading[foot])) * scale;
                test::raise(miss, glm::length(way - wanted) / hipsHeight(rest, own));
            }
        }
        return miss;
    };
    const double placed = worst(Retargeting::all), free = worst(Retargeting::freeFeet);
    std::printf("ankles off by %.2g heights of the hips, %.2g if legs keep their angles\n", placed, free);
    EXPECT_LT(placed, 0.01) << "between keys, too";
    EXPECT_GT(free, 3.0 * placed);
}

TEST(Retarget, JointsOfOneNameFollowToo) {
    const cage::Character from = test::readCharacter(test::kWren), to = test::readCharacter(test::kPip);
    const Roles leading = rolesOf(from), own = rolesOf(to);
    const Followers followers = findFollowers({from.skeleton, leading}, {to.skeleton, own}, {},
                                              cage::matchNodes(from.skeleton, to.skeleton).partners);
    EXPECT_EQ(followers.byRole, 19u);
    EXPECT_GT(followers.byName, 0u);
    std::vector<std::string> names;
    for (const TurnFollower& follower : followers.turned) {
        names.push_back(to.skeleton.nodes[follower.node].name);
    }
    for (const char* name : {"hips", "spine", "chest", "hand.L", "foot.R"}) {
        EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    }
    EXPECT_EQ(followers.legs[kLeft].path.size(), 3u);
}

TEST(Retarget, WhatIsNoBipedIsLeftAsItIsOrRefused) {
    const cage::Character wren = test::readCharacter(test::kWren);
    cage::Character helmet = test::readCharacter(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb");
    EXPECT_FALSE(fit(wren, helmet).set.isFitted);
    EXPECT_EQ(
        fit(wren, helmet, {Retargeting::all, {}, false}).refusal,
        "clips.glb: cannot be retargeted: no left and right thigh, shin and foot below each other in the character's "
        "skeleton");
    helmet.clips = {{.name = "turn", .duration = 1.0, .channels = {}, .markers = {}, .sharpness = {}, .packed = {}}};
    EXPECT_EQ(
        fit(helmet, wren, {Retargeting::freeFeet, {}, false}).refusal,
        "clips.glb: cannot be retargeted: no left and right thigh, shin and foot below each other in its skeleton");
    const cage::Character pip = test::readCharacter(test::kPip);
    EXPECT_FALSE(fit(wren, pip, {Retargeting::never, {}, false}).set.isFitted);
}

/// Wren, whose joints have names that say nothing.
cage::Character nameless() {
    cage::Character character = test::readCharacter(test::kWren);
    for (size_t n = 0; n < character.skeleton.nodes.size(); ++n) {
        character.skeleton.nodes[n].name = "Bone." + std::to_string(n);
    }
    return character;
}

TEST(Retarget, PairsSayWhatNamesDoNot) {
    const cage::Character wren = test::readCharacter(test::kWren), pip = test::readCharacter(test::kPip);
    const cage::Character from = nameless();
    EXPECT_FALSE(fit(from, pip).set.isFitted);
    RetargetOptions options;
    const Roles roles = rolesOf(wren);
    for (Role role = 0; role < kRoles; ++role) {
        options.pairs.push_back({role, from.skeleton.nodes[roles[role]].name, ""});
    }
    const Outcome outcome = fit(from, pip, options);
    ASSERT_TRUE(outcome.set.isFitted) << outcome.refusal;
    const Outcome named = fit(wren, pip);
    const cage::Clip &a = clipCalled(outcome.set.clips, "run"), &b = clipCalled(named.set.clips, "run");
    for (const uint32_t node : rolesOf(pip)) {
        EXPECT_LT(angleApart(poseOf(pip.skeleton, a, 0.3).turns[node], poseOf(pip.skeleton, b, 0.3).turns[node]), 1e-6)
            << pip.skeleton.nodes[node].name;
    }

    options.pairs.push_back({std::nullopt, "Bone.3", "no such"});
    EXPECT_EQ(fit(from, pip, options).refusal, "joint pairs: the character has no node \"no such\"");
    options.pairs.back() = {std::nullopt, "other rig's", "jaw"};
    EXPECT_NE(fit(from, pip, options).warning().find("not in its skeleton: other rig's"), std::string::npos);
    options.pairs.push_back({roleOf(BodyPart::hips), "other rig's", ""});
    EXPECT_TRUE(fit(from, pip, options).set.isFitted) << "what an earlier pair says stays";
    const auto moves = [&](const char* leader, const char* follower) {
        const uint32_t node = nodeOf(pip.skeleton, follower);
        const Outcome paired = fit(wren, pip, {Retargeting::differing, {{std::nullopt, leader, follower}}, false});
        const cage::Clip& clip = clipCalled(paired.set.clips, "run");
        const uint32_t leading = nodeOf(wren.skeleton, leader);
        const ModelPose was = poseOf(wren.skeleton, clipCalled(wren.clips, "run"), 0.3),
                        now = poseOf(pip.skeleton, clip, 0.3);
        const RestPlaces fromRest(wren.skeleton), rest(pip.skeleton);
        return angleApart(was.turns[leading] * glm::conjugate(fromRest.turns[leading]),
                          now.turns[node] * glm::conjugate(rest.turns[node]));
    };
    EXPECT_LT(moves("ponytail1", "jaw"), 1e-3) << "a joint without a role turns as its counterpart";
    EXPECT_LT(moves("chest", "spine"), 1e-3) << "pairs go before the spine";
    EXPECT_LT(moves("ponytail1", "tail1"), 1e-3) << "and may hang on other parts";
    EXPECT_EQ(fit(from, pip, {Retargeting::never, {{std::nullopt, "a", "jaw"}}, false}).refusal,
              "joint pairs: they say how to retarget, which is turned off");
    const JointPair wrong{roleOf(BodyPart::shin, kLeft), "", "hand.L"};
    EXPECT_EQ(fit(wren, pip, {Retargeting::differing, {wrong}, false}).refusal,
              "clips.glb: cannot be retargeted: no left thigh, shin and foot below each other in the character's "
              "skeleton");
    cage::Character unnamed = pip;
    unnamed.skeleton.nodes[unnamed.skeleton.parentsFirst[0]].name.clear();
    EXPECT_TRUE(
        fit(wren, unnamed, {Retargeting::differing, {{roleOf(BodyPart::hips), "", "hips"}}, false}).set.isFitted)
        << "no name is nobody's";
}

TEST(Retarget, TellsWhatDoesNotFit) {
    const std::vector<std::string> files = test::sharedAssets({"whole/kaykit_Knight.glb"});
    if (files.empty()) {
        GTEST_SKIP() << "its character is not in " << test::sharedFolder();
    }
    const cage::Character knight = test::readCharacter(files[0]), wren = test::readCharacter(test::kWren);
    const Outcome outcome = fit(knight, wren);
    ASSERT_TRUE(outcome.set.isFitted);
    EXPECT_NE(outcome.warning().find("76 clips retargeted: 16 joints by role"), std::string::npos) << outcome.warning();
    EXPECT_NE(outcome.warning().find("and by so much that they keep the clip's angles: "), std::string::npos)
        << "a chibi's steps are too large for long legs\n"
        << outcome.warning();
    EXPECT_NE(outcome.warning().find("\"Running_A\" 0.59"), std::string::npos) << outcome.warning();
    EXPECT_EQ(outcome.warning().find("movements of root"), std::string::npos) << "the hips have those";
    EXPECT_NE(fit(knight, wren, {Retargeting::differing, {}, true}).refusal.find("legs are too short for its clips"),
              std::string::npos);
    EXPECT_EQ(fit(knight, wren, {Retargeting::freeFeet, {}, true}).refusal, "");
    EXPECT_EQ(fit(wren, knight).warning().find("too short"), std::string::npos);
}

/// One clip that turns a node from 0 to `end` seconds.
cage::Clip turningOne(uint32_t node, float end) {
    cage::Channel turn{node, cage::ChannelPath::rotation, cage::Interpolation::linear, {}, {}, 0};
    turn.times = {0.0f, end};
    turn.values = {0, 0, 0, 1, 0, 1, 0, 0};
    return {.name = "long", .duration = double{end}, .channels = {turn}, .markers = {}, .sharpness = {}, .packed = {}};
}

TEST(Retarget, FewKeysFarApartTakeNoMemory) {
    const cage::Character wren = test::readCharacter(test::kWren), pip = test::readCharacter(test::kPip);
    cage::Character from = wren;
    from.clips = {turningOne(nodeOf(wren.skeleton, "hips"), 1e9f)};
    const Outcome outcome = fit(from, pip);
    ASSERT_EQ(outcome.set.clips.size(), 1u);
    EXPECT_NE(outcome.warning().find("fewer keys than they need, as they are too long: \"long\""), std::string::npos)
        << outcome.warning();
    size_t keys = 0;
    for (const cage::Channel& channel : outcome.set.clips[0].channels) {
        keys += channel.times.size();
        EXPECT_TRUE(std::is_sorted(channel.times.begin(), channel.times.end(), std::less_equal<>()));
    }
    EXPECT_LT(keys, 250'000u);
    from.clips = {turningOne(nodeOf(wren.skeleton, "hips"), 30.0f)};
    EXPECT_EQ(fit(from, pip).warning().find("fewer keys"), std::string::npos)
        << "half a minute of three keys is no more";
    from.clips[0].channels.clear();
    EXPECT_EQ(fit(from, pip).set.clips.size(), 1u) << "a clip that moves nothing stays";
    from.clips = wren.clips;
    for (cage::Channel& channel : from.clips[0].channels) { // where floats are half a second apart
        std::transform(channel.times.begin(), channel.times.end(), channel.times.begin(),
                       [](float time) { return time + 8e6f; });
        channel.times.erase(std::unique(channel.times.begin(), channel.times.end()), channel.times.end());
        channel.values.resize(channel.times.size() * channel.width());
    }
    from.clips.resize(1);
    const Outcome late = fit(from, pip);
    for (const cage::Channel& channel : late.set.clips.at(0).channels) {
        EXPECT_EQ(std::adjacent_find(channel.times.begin(), channel.times.end(), std::greater_equal<>()),
                  channel.times.end());
    }
}

TEST(Retarget, InWhichPoseASkeletonRestsDoesNotMakeItAnother) {
    const cage::Character wren = test::readCharacter(test::kWren);
    cage::Character posed = wren;
    const cage::Clip& walk = clipCalled(wren.clips, "walk");
    for (uint32_t n = 0; n < posed.skeleton.nodes.size(); ++n) {
        const Transform local = sampleNode(wren.skeleton, walk, 0.3, n);
        posed.skeleton.nodes[n].translation = glm::vec3(local.translation);
        posed.skeleton.nodes[n].rotation = glm::quat(local.rotation);
    }
    EXPECT_FALSE(fit(posed, wren).set.isFitted);
    cage::Character rolled = wren; // the same places, other axes
    const glm::quat roll = glm::angleAxis(1.5f, glm::vec3(0.0f, 1.0f, 0.0f));
    const uint32_t thigh = nodeOf(wren.skeleton, "thigh.L");
    rolled.skeleton.nodes[thigh].rotation = rolled.skeleton.nodes[thigh].rotation * roll;
    for (cage::Node& node : rolled.skeleton.nodes) {
        if (node.parent == thigh) {
            node.translation = glm::inverse(roll) * (node.translation + glm::vec3(0.01f, 0.0f, 0.0f));
        }
    }
    EXPECT_TRUE(fit(rolled, wren).set.isFitted);
}

TEST(Retarget, FourLegsAreNotTakenForTwo) {
    const cage::Character wren = test::readCharacter(test::kWren);
    cage::Character beast = wren;
    const uint32_t spine = nodeOf(wren.skeleton, "spine");
    beast.skeleton.nodes[spine].rotation =
        beast.skeleton.nodes[spine].rotation * glm::angleAxis(1.5f, glm::vec3(1.0f, 0.0f, 0.0f));
    beast.skeleton.nodes[nodeOf(wren.skeleton, "shin.L")].translation *= 1.2f;
    const Outcome outcome = fit(beast, wren);
    EXPECT_FALSE(outcome.set.isFitted);
    EXPECT_EQ(outcome.set.whyNotFitted, "not both skeletons stand upright");
    EXPECT_TRUE(fit(beast, wren, {Retargeting::all, {}, false}).set.isFitted) << "unless a user asks for it";
}

TEST(Retarget, WhatMovesAboveTheHipsIsInTheHips) {
    const cage::Character wren = test::readCharacter(test::kWren), pip = test::readCharacter(test::kPip);
    cage::Character from = wren;
    cage::Node root;
    root.name = "mover";
    const auto number = static_cast<uint32_t>(from.skeleton.nodes.size());
    from.skeleton.nodes.push_back(root);
    const uint32_t hips = nodeOf(wren.skeleton, "hips");
    from.skeleton.nodes[number].parent = from.skeleton.nodes[hips].parent;
    from.skeleton.nodes[hips].parent = number;
    from.skeleton.parentsFirst.clear();
    cage::orderParentsFirst(from.skeleton);
    cage::Clip walk{.name = "go", .duration = 1.0, .channels = {}, .markers = {}, .sharpness = {}, .packed = {}};
    walk.channels.push_back(
        {number, cage::ChannelPath::translation, cage::Interpolation::linear, {0.0f, 1.0f}, {0, 0, 0, 0, 0, 2}, 0});
    from.clips = {walk};
    const Outcome outcome = fit(from, pip);
    ASSERT_TRUE(outcome.set.isFitted);
    const Roles own = rolesOf(pip);
    const uint32_t moved = own[roleOf(BodyPart::hips)];
    const cage::Clip& clip = outcome.set.clips[0];
    const double way =
        poseOf(pip.skeleton, clip, 1.0).places[moved].z - poseOf(pip.skeleton, clip, 0.0).places[moved].z;
    const double scale =
        hipsHeight(RestPlaces(pip.skeleton), own) / hipsHeight(RestPlaces(wren.skeleton), rolesOf(wren));
    EXPECT_NEAR(way, 2.0 * scale, 1e-5);
    EXPECT_EQ(outcome.warning().find("mover"), std::string::npos) << outcome.warning();
}

TEST(Retarget, MarkersAndStepsStay) {
    const cage::Character wren = test::readCharacter(test::kWren), pip = test::readCharacter(test::kPip);
    cage::Character from = wren;
    const uint32_t thigh = nodeOf(wren.skeleton, "thigh.L");
    cage::Channel turn{thigh, cage::ChannelPath::rotation, cage::Interpolation::step, {}, {}, 0};
    turn.times = {0.0f, 1.0f};
    turn.values = {0, 0, 0, 1, 0.6f, 0, 0, 0.8f};
    from.clips = {{.name = "kick",
                   .duration = 2.0,
                   .channels = {turn},
                   .markers = {{"hit", 1.0}},
                   .sharpness = {},
                   .packed = {}}};
    const Outcome outcome = fit(from, pip);
    ASSERT_EQ(outcome.set.clips.size(), 1u);
    const cage::Clip& clip = outcome.set.clips[0];
    EXPECT_EQ(clip.markers.at(0).name, "hit");
    EXPECT_EQ(clip.duration, 2.0);
    const uint32_t own = nodeOf(pip.skeleton, "thigh.L");
    const ModelPose before = poseOf(pip.skeleton, clip, 0.99), at = poseOf(pip.skeleton, clip, 1.0);
    EXPECT_GT(angleApart(before.turns[own], at.turns[own]), 0.5) << "it jumps, as the clip does";
}

} // namespace
} // namespace supple::skinning
