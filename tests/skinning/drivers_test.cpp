// Pose drivers: the solution against float64's, the device's arithmetic at the artist's poses and elsewhere.
#include "cage/gltf/reader.h"
#include "cage/solved_driver.h"
#include "shaders/pose/affine.h"
#include "shaders/shared/pose.h"
#include "skinning/clip_bounds.h"
#include "skinning/clip_packer.h"
#include "skinning/driven_weights.h"
#include "skinning/driver_table.h"
#include "skinning/driver_twin.h"
#include "skinning/pose.h"
#include "skinning/pose_distance.h"
#include "skinning/pose_twin.h"
#include "skinning/reach.h"
#include "skinning/update_errors.h"
#include "tests/support/json_vectors.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using cage::DriverInput;
using cage::PoseDriver;
using cage::TurnPart;
using test::Noise;

nlohmann::json vectors() {
    return test::parseFile(std::string(SUPPLE_TEST_DATA) + "/drivers/solved.json");
}
glm::vec4 vec4Of(const nlohmann::json& j) {
    return {j[0].get<float>(), j[1].get<float>(), j[2].get<float>(), j[3].get<float>()};
}
glm::vec4 turnAbout(const glm::vec3& axis, double degrees) {
    const double half = degrees * 3.14159265358979323846 / 360.0;
    return glm::vec4(glm::dvec4(glm::normalize(glm::dvec3(axis)) * std::sin(half), std::cos(half)));
}

/// A driver of node 2 that gives each pose a target of its own.
PoseDriver driverOf(const std::vector<glm::vec4>& poses, float width = 2.0f, TurnPart part = TurnPart::rotation) {
    PoseDriver driver;
    driver.inputs.push_back({2, part, {1.0f, 0.0f, 0.0f}, 1.0f});
    driver.poses = poses;
    driver.width = width;
    for (uint32_t p = 0; p < poses.size(); ++p) {
        driver.targets.push_back(p);
        for (uint32_t t = 0; t < poses.size(); ++t) {
            driver.values.push_back(t == p ? 1.0f : 0.0f);
        }
    }
    return driver;
}

/// A character with drivers, and what these make of its nodes' rotations.
class Driven {
public:
    explicit Driven(std::vector<PoseDriver> drivers, uint32_t targets = 24)
        : character(test::riggedTube({.joints = 4, .morphTargets = targets})) {
        character.drivers = std::move(drivers);
        table = buildDriverTable(character);
    }
    /// `turns`: by node; others are as at rest.
    std::vector<float> weights(const std::map<uint32_t, glm::vec4>& turns) const {
        std::vector<glm::vec4> rotations;
        for (const uint32_t node : table.nodes) {
            const glm::quat& q = character.skeleton.nodes[node].rotation;
            const auto found = turns.find(node);
            rotations.push_back(found != turns.end() ? found->second : glm::vec4(q.x, q.y, q.z, q.w));
        }
        std::vector<glm::vec4> quads((character.morphs.targets.size() + 3) / 4, glm::vec4(0.0f));
        addDriven(table.words, 0, rotations, quads);
        return {&quads[0].x, &quads[0].x + character.morphs.targets.size()};
    }

    cage::Character character;
    DriverTable table;
};

TEST(Drivers, SolutionIsThatOfFloat64) {
    const nlohmann::json data = vectors();
    ASSERT_EQ(data.at("sets").size(), 12u);
    for (const nlohmann::json& set : data.at("sets")) {
        const std::string name = set.at("name").get<std::string>();
        std::vector<glm::vec4> poses;
        for (const nlohmann::json& pose : set.at("poses")) {
            poses.push_back(vec4Of(pose));
        }
        // A driver sets eight targets at most: a driver for every eight.
        const float width = set.at("width").get<float>();
        std::vector<PoseDriver> drivers;
        for (size_t first = 0; first < poses.size(); first += cage::kMaxDriverTargets) {
            PoseDriver driver = driverOf(poses, width);
            driver.targets.clear();
            driver.values.clear();
            for (size_t t = first; t < std::min(poses.size(), first + cage::kMaxDriverTargets); ++t) {
                driver.targets.push_back(static_cast<uint32_t>(t));
            }
            for (size_t p = 0; p < poses.size(); ++p) {
                for (const uint32_t t : driver.targets) {
                    driver.values.push_back(t == p ? 1.0f : 0.0f);
                }
            }
            driver.low = -10.0f;
            driver.high = 10.0f;
            drivers.push_back(std::move(driver));
        }
        const Result<cage::SolvedDriver> solved = cage::solveDriver(drivers[0]);
        ASSERT_TRUE(solved.ok()) << name;
        const double condition = set.at("condition").get<double>();
        EXPECT_NEAR(solved->condition / condition, 1.0, 0.02) << name << " " << width;
        EXPECT_NEAR(static_cast<double>(solved->inverseSigma2) / set.at("inverseSigma2").get<double>(), 1.0, 1e-5);
        EXPECT_EQ(solved->samples.size(), poses.size() + 1);

        const Driven driven(drivers);
        double atPoses = 0.0, elsewhere = 0.0;
        for (size_t p = 0; p < poses.size(); ++p) {
            const std::vector<float> own = driven.weights({{2, poses[p]}});
            for (size_t t = 0; t < poses.size(); ++t) {
                test::raise(atPoses, std::abs(static_cast<double>(own[t]) - (t == p ? 1.0 : 0.0)));
            }
        }
        for (size_t q = 0; q < set.at("queries").size(); ++q) {
            const std::vector<float> own = driven.weights({{2, vec4Of(set.at("queries")[q])}});
            for (size_t t = 0; t < poses.size(); ++t) {
                test::raise(elsewhere, std::abs(static_cast<double>(own[t]) - set.at("weights")[q][t].get<double>()));
            }
        }
        const bool warned = solved->condition > 100.0 || solved->closestDegrees < 10.0; // as the reader does
        EXPECT_LT(atPoses, warned ? 1e-5 : 2e-6) << name << " " << width;
        EXPECT_LT(elsewhere, 1e-5) << name << " " << width;
    }
}

TEST(Drivers, AHingeIsThatOfTheTable) {
    const nlohmann::json data = vectors().at("hinge");
    const Driven driven({driverOf({turnAbout({1, 0, 0}, 45), turnAbout({1, 0, 0}, 90), turnAbout({1, 0, 0}, 135)})});
    for (size_t i = 0; i < data.at("degrees").size(); ++i) {
        const std::vector<float> own = driven.weights({{2, turnAbout({1, 0, 0}, data.at("degrees")[i].get<double>())}});
        for (size_t t = 0; t < 3; ++t) {
            const double wanted = std::clamp(data.at("weights")[i][t].get<double>(), 0.0, 1.0);
            EXPECT_NEAR(static_cast<double>(own[t]), wanted, 1e-5) << data.at("degrees")[i];
        }
    }
}

TEST(Drivers, SwingsAndTwistsAreThoseOfFloat64) {
    const nlohmann::json data = vectors();
    const glm::vec3 axis(0.6f, 0.8f, 0.0f);
    // The driver of one pose tells how far a rotation is from it.
    size_t compared = 0;
    for (const bool twist : {false, true}) {
        for (size_t i = 0; i < data.at("rotations").size(); ++i) {
            PoseDriver driver = driverOf({vec4Of(data.at(twist ? "twists" : "swings")[i])});
            driver.inputs[0].part = twist ? TurnPart::twist : TurnPart::swing;
            driver.inputs[0].axis = axis;
            if (const Result<cage::SolvedDriver> solved = cage::solveDriver(driver); !solved) {
                EXPECT_NE(solved.error().message.find("rest pose"), std::string::npos) << solved.error().message;
                continue;
            }
            ++compared;
            const Driven driven({driver});
            const glm::vec4 q = vec4Of(data.at("rotations")[i]);
            EXPECT_NEAR(static_cast<double>(driven.weights({{2, q}})[0]), 1.0, 2e-6) << i;
            EXPECT_NEAR(static_cast<double>(driven.weights({{2, q * -3.0f}})[0]), 1.0, 2e-6)
                << "the same rotation, of another length";
        }
    }
    EXPECT_GE(compared + 4, 2 * data.at("rotations").size()) << "few are no swing, or no twist";
}

TEST(Drivers, AreFromTheRestPoseAndBlindToWhatTheyDoNotLookAt) {
    PoseDriver driver = driverOf({turnAbout({0, 0, 1}, 90)}, 2.0f, TurnPart::swing);
    Driven driven({driver});
    driven.character.skeleton.nodes[2].rotation = glm::quat(0.8f, 0.0f, 0.6f, 0.0f);
    driven.table = buildDriverTable(driven.character);
    const glm::vec4 rest(0.0f, 0.6f, 0.0f, 0.8f), bend = turnAbout({0, 0, 1}, 90), roll = turnAbout({1, 0, 0}, 70);
    EXPECT_NEAR(driven.weights({})[0], 0.0f, 2e-7f);
    EXPECT_NEAR(driven.weights({{2, shared::turned(rest, bend)}})[0], 1.0f, 2e-6f);
    EXPECT_NEAR(driven.weights({{2, shared::turned(rest, shared::turned(bend, roll))}})[0], 1.0f, 2e-6f)
        << "rolls first, then swings";
    EXPECT_NEAR(driven.weights({{2, shared::turned(rest, roll)}})[0], 0.0f, 2e-6f);
    EXPECT_EQ(driven.weights({{2, glm::vec4(0.0f)}})[0], driven.weights({{2, glm::vec4(0, 0, 0, 1)}})[0])
        << "no rotation";
    const std::vector<float> halfTurn = driven.weights({{2, glm::vec4(0, 0, 1, 0)}});
    EXPECT_TRUE(std::isfinite(halfTurn[0]));
}

TEST(Drivers, SeveralAddUpAndReadSeveralJoints) {
    PoseDriver both = driverOf({turnAbout({0, 0, 1}, 60), turnAbout({0, 0, 1}, 60)});
    both.inputs.push_back({3, TurnPart::twist, {1.0f, 0.0f, 0.0f}, 0.5f});
    both.poses = {turnAbout({0, 0, 1}, 60), glm::vec4(0, 0, 0, 1), turnAbout({0, 0, 1}, 60), turnAbout({1, 0, 0}, 80)};
    both.targets = {5, 2}; // in two quads
    both.values = {0.75f, 0.0f, 0.25f, 1.0f};
    PoseDriver more = driverOf({turnAbout({0, 0, 1}, 60)});
    more.targets = {2};
    more.values = {0.5f};
    const Driven driven({both, more});
    EXPECT_EQ(driven.table.quads, 2u);
    const glm::vec4 bend = turnAbout({0, 0, 1}, 60), twist = turnAbout({1, 0, 0}, 80);
    const std::vector<float> a = driven.weights({{2, bend}}), b = driven.weights({{2, bend}, {3, twist}});
    EXPECT_NEAR(a[5], 0.75f, 2e-6f);
    EXPECT_NEAR(a[2], 0.5f, 2e-6f) << "of the other driver alone";
    EXPECT_NEAR(b[5], 0.25f, 2e-6f);
    EXPECT_NEAR(b[2], 1.5f, 2e-6f);
    for (const size_t untouched : {0, 1, 3, 4, 6, 7, 8}) {
        EXPECT_EQ(b[untouched], 0.0f);
    }
}

TEST(Drivers, ClampWhatTheySet) {
    PoseDriver driver = driverOf({turnAbout({0, 0, 1}, 60)});
    driver.values = {3.0f};
    const auto set = [&](float low, float high) {
        driver.low = low;
        driver.high = high;
        return Driven({driver}).weights({{2, turnAbout({0, 0, 1}, 60)}})[0];
    };
    EXPECT_EQ(set(0.0f, 1.0f), 1.0f);
    EXPECT_NEAR(set(0.0f, 4.0f), 3.0f, 6e-6f);
    driver.values = {-2.0f};
    EXPECT_EQ(set(0.0f, 1.0f), 0.0f);
    EXPECT_NEAR(set(-3.0f, 0.0f), -2.0f, 4e-6f);
}

TEST(Drivers, PosesThatContradictEachOtherAreRefused) {
    const auto refused = [](const PoseDriver& driver) {
        const Result<cage::SolvedDriver> solved = cage::solveDriver(driver);
        return solved.ok() ? std::string() : solved.error().message;
    };
    PoseDriver driver = driverOf({turnAbout({0, 0, 1}, 60), turnAbout({0, 0, 1}, 60.5)});
    EXPECT_EQ(refused(driver), "pose 1 and pose 0 are one pose, but for a degree, and have different values");
    driver.values = {1.0f, 0.5f, 1.0f, 0.5f};
    EXPECT_EQ(refused(driver), "");
    EXPECT_EQ(cage::solveDriver(driver)->samples.size(), 2u) << "they are one";
    driver = driverOf({turnAbout({0, 0, 1}, 60), glm::vec4(0, 0, 0, -2)});
    EXPECT_EQ(refused(driver), "pose 1 and the rest pose, in which all weights are 0, are one pose, but for a degree, "
                               "and have different values");
    driver.values = {1.0f, 0.0f, 0.0f, 0.0f};
    EXPECT_EQ(refused(driver), "") << "the rest pose may be listed";
    EXPECT_EQ(refused(driverOf({turnAbout({1, 0, 0}, 60)}, 2.0f, TurnPart::swing)),
              "pose 0 and the rest pose, in which all weights are 0, are one pose, but for a degree, and have "
              "different values")
        << "a twist is no swing";
    driver = driverOf({glm::vec4(0, 0, 0, 1)});
    driver.values = {0.0f};
    EXPECT_EQ(refused(driver), "it has no pose but the rest pose");
    std::vector<glm::vec4> close;
    for (int k = 1; k <= 8; ++k) {
        close.push_back(turnAbout({0, 0, 1}, 1.2 * k));
    }
    EXPECT_EQ(refused(driverOf(close, 100.0f)), "its poses are too close to each other to be told apart");
}

cage::Character arm() {
    Result<cage::Character> read = cage::readGltfFile(std::string(SUPPLE_TEST_DATA) + "/drivers/arm.glb");
    EXPECT_TRUE(read.ok()) << (read ? "" : read.error().message);
    return read ? std::move(*read) : cage::Character();
}

/// What instances show of a clip at a time.
std::vector<double> shownAt(const cage::Character& character, const cage::Clip& clip, double time) {
    Pose pose;
    sampleClip(character, clip, time, pose);
    const DriverTable table = buildDriverTable(character);
    std::vector<double> weights = pose.morphWeights;
    DrivenWeights(table).addTo(pose, weights);
    return weights;
}

TEST(Drivers, BoxesHoldWhatTheySet) {
    cage::Character character = arm();
    for (cage::MorphTarget& target : character.morphs.targets) {
        for (glm::vec3& delta : target.deltas) {
            delta = delta * 8.0f; // far beyond what linear skinning reaches
        }
    }
    cage::Character silent = character;
    silent.drivers.clear();
    const Reach reach = reachOf(character);
    double outside = 0.0;
    const auto holds = [](const Box& box, const glm::dvec3& v) {
        return glm::all(glm::lessThanEqual(box.low, v)) && glm::all(glm::greaterThanEqual(box.high, v));
    };
    for (const cage::Clip& clip : character.clips) {
        const Box box = clipBounds(character, &clip, {}), without = clipBounds(silent, &clip, {});
        for (double time = 0.0; time <= clip.duration; time += 0.05) {
            Pose pose;
            sampleClip(character, clip, time, pose);
            pose.morphWeights = shownAt(character, clip, time);
            for (const glm::dvec3& v : deformOnCpu(character, pose)) {
                EXPECT_TRUE(holds(box, v)) << clip.name << " " << time;
                EXPECT_TRUE(holds(reach.blended, v)) << clip.name << " " << time;
                outside += holds(without, v) ? 0.0 : 1.0;
            }
        }
    }
    EXPECT_GT(outside, 0.0) << "the box without drivers would not";
    // At rest drivers add what floats leave of nothing: little of a weight, but weights may be large.
    const Box plain = clipBounds(silent, nullptr, {});
    const double size = glm::length(plain.high - plain.low);
    for (const float high : {1.0f, 1e7f}) {
        for (PoseDriver& driver : character.drivers) {
            for (float& value : driver.values) {
                value *= high;
            }
            driver.high = high;
        }
        const Box rest = clipBounds(character, nullptr, {});
        EXPECT_TRUE(holds(rest, plain.low) && holds(rest, plain.high));
        EXPECT_LT(glm::length(rest.high - rest.low) - size, 1e-4 * static_cast<double>(high) * size);
        Pose pose;
        restPose(character, pose);
        const DriverTable table = buildDriverTable(character);
        DrivenWeights(table).addTo(pose, pose.morphWeights);
        for (const glm::dvec3& v : deformOnCpu(character, pose)) {
            EXPECT_TRUE(holds(rest, v)) << high;
        }
    }
}

TEST(Drivers, ErrorsOfUpdateRatesCountWhatTheySet) {
    cage::Character character = arm();
    const UpdateFacts with = measureUpdates(character);
    character.drivers.clear();
    const UpdateFacts without = measureUpdates(character);
    EXPECT_GT(with.ofClips[0].every[2], without.ofClips[0].every[2] * 1.01);
}

/// A tube whose node `control` moves no joint, but sets a large morph.
cage::Character controlledTube() {
    cage::Character character = test::riggedTube({.joints = 3, .morphTargets = 3});
    const auto control = static_cast<uint32_t>(character.skeleton.nodes.size());
    character.skeleton.nodes.push_back({.name = "control", .parent = 0});
    character.skeleton.parentsFirst.push_back(control);
    PoseDriver driver = driverOf({turnAbout({0, 0, 1}, 90)});
    driver.inputs[0].node = control;
    character.drivers.push_back(driver);
    for (glm::vec3& delta : character.morphs.targets[0].deltas) {
        delta = delta * 10.0f;
    }
    cage::Clip& clip = character.clips.emplace_back();
    clip.name = "control";
    for (const uint32_t node : {control, uint32_t{2}}) {
        cage::Channel& channel = clip.channels.emplace_back();
        channel.node = node;
        channel.path = cage::ChannelPath::rotation;
        for (int k = 0; k <= 60; ++k) {
            const double part = std::sin(3.14159265 * k / 60.0);
            const glm::vec4 q = turnAbout({0, 0, 1}, (node == control ? 90.0 : 20.0) * part);
            channel.times.push_back(static_cast<float>(k) / 30.0f);
            channel.values.insert(channel.values.end(), {q.x, q.y, q.z, q.w});
        }
    }
    clip.duration = 2.0;
    return character;
}

TEST(Drivers, ErrorsOfPackedClipsCountWhatTheySet) {
    constexpr double kError = 1e-4;
    const cage::Character plain = controlledTube();
    cage::Character packed = plain;
    EXPECT_EQ(packClips(packed, kError), std::vector<std::string>());
    const size_t c = plain.clips.size() - 1;
    ASSERT_FALSE(packed.clips[c].packed.words.empty());
    EXPECT_LE(packed.clips[c].packed.error, kError);
    const double extent = PoseDistance(plain).extent();
    double most = 0.0;
    for (int k = 0; k <= 240; ++k) {
        const double time = k / 120.0;
        Pose a, b;
        sampleClip(plain, plain.clips[c], time, a);
        sampleClip(packed, packed.clips[c], time, b);
        a.morphWeights = shownAt(plain, plain.clips[c], time);
        b.morphWeights = shownAt(packed, packed.clips[c], time);
        const std::vector<glm::dvec3> from = deformOnCpu(plain, a), to = deformOnCpu(packed, b);
        for (size_t v = 0; v < from.size(); ++v) {
            test::raise(most, glm::length(from[v] - to[v]) / extent);
        }
    }
    EXPECT_LE(most, 1.1 * kError);
    EXPECT_GT(packed.clips[c].packed.error, 0.3 * kError) << "it takes what it is given";
}

TEST(Drivers, ThoseWithoutASolutionSetNothing) {
    PoseDriver wrong = driverOf({turnAbout({0, 0, 1}, 60), turnAbout({0, 0, 1}, 60)});
    PoseDriver right = driverOf({turnAbout({0, 0, 1}, 60)});
    right.targets = {5};
    const Driven none({wrong});
    EXPECT_EQ(none.table.quads, 0u);
    EXPECT_TRUE(none.table.words.empty());
    const Driven one({wrong, right});
    EXPECT_EQ(one.table.quads, 1u);
    const std::vector<float> weights = one.weights({{2, turnAbout({0, 0, 1}, 60)}});
    EXPECT_NEAR(weights[5], 1.0f, 2e-6f);
    EXPECT_EQ(weights[0], 0.0f);
}

TEST(Drivers, NodesThatMoveNoJointArePosed) {
    cage::Character character = test::riggedTube({.joints = 3, .morphTargets = 3});
    character.skeleton.nodes.push_back({.name = "control", .parent = 0});
    character.skeleton.parentsFirst.push_back(static_cast<uint32_t>(character.skeleton.nodes.size() - 1));
    const auto control = static_cast<uint32_t>(character.skeleton.nodes.size() - 1);
    EXPECT_EQ(nodeOrder(character).places[control], cage::kNone);
    PoseDriver driver = driverOf({turnAbout({0, 0, 1}, 90)});
    driver.inputs[0].node = control;
    character.drivers.push_back(driver);
    EXPECT_NE(nodeOrder(character).places[control], cage::kNone);
    const ClipTable table = buildClipTable(character);
    EXPECT_EQ(table.driverNodes, std::vector<uint32_t>{control});
    EXPECT_EQ(table.drivenQuads, 1u);
}

} // namespace
} // namespace supple::skinning
