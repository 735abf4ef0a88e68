// Where clips have feet on the ground: what is found is looked at again with the sampler of poses.
#include "skinning/contacts.h"

#include "skinning/pose.h"
#include "skinning/root_motion.h"
#include "tests/support/read_character.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/walkers.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

const cage::Clip& clipCalled(const cage::Character& character, const std::string& name) {
    return character.clips[test::clipNumber(character, name)];
}

glm::dvec2 placeAt(const cage::Character& character, const cage::Clip& clip, uint32_t node, double time) {
    std::vector<glm::mat4> globals(character.skeleton.nodes.size());
    sampleClip(character.skeleton, clip, time, globals);
    globalTransforms(character.skeleton, globals, globals);
    return {globals[node][3].x, globals[node][3].z};
}

/// The largest distance, in legs, between a foot and the place where its contacts hold it.
double farthest(const cage::Character& character, const cage::Clip& clip, const Foot& foot,
                const std::vector<Contact>& contacts) {
    double worst = 0.0;
    for (const Contact& contact : contacts) {
        for (int k = 0; k <= 20; ++k) {
            const double time = contact.begin + (contact.end - contact.begin) * k / 20.0;
            if (time >= 0.0 && time <= clip.duration) {
                const glm::dvec2 held = contact.place + contact.drift * time;
                worst = std::max(worst, glm::length(placeAt(character, clip, foot.node, time) - held) / foot.leg);
            }
        }
    }
    return worst;
}

std::string nameOf(const cage::Character& character, const Foot& foot) {
    return character.skeleton.nodes[foot.node].name;
}

TEST(Contacts, AreThoseOfTwoFeetThatStandInTurn) {
    for (const std::string& file : {test::kPip, test::kWren}) {
        const cage::Character character = test::readCharacter(file);
        const Contacts contacts = findContacts(character);
        ASSERT_EQ(contacts.feet.size(), 2u) << "toes and knees are none";
        EXPECT_EQ(nameOf(character, contacts.feet[0]), "foot.L");
        EXPECT_EQ(nameOf(character, contacts.feet[1]), "foot.R");
        ASSERT_EQ(contacts.ofClips.size(), 2 * character.clips.size());
        for (const Foot& foot : contacts.feet) {
            EXPECT_NEAR(foot.sole, 0.0, 0.01 * foot.leg) << "both stand on the ground in the rest pose";
            EXPECT_GT(foot.height, 0.05 * foot.leg);
            EXPECT_LT(foot.height, 0.5 * foot.leg);
        }
        for (size_t c = 0; c < character.clips.size(); ++c) {
            for (size_t f = 0; f < 2; ++f) {
                EXPECT_LT(farthest(character, character.clips[c], contacts.feet[f], contacts.of(c, f)), 0.12)
                    << file << " " << character.clips[c].name;
            }
        }
        const cage::Clip& walk = clipCalled(character, "walk");
        const size_t number = test::clipNumber(character, "walk");
        int both = 0, some = 0;
        for (int k = 0; k < 100; ++k) {
            const double time = walk.duration * k / 100.0;
            int standing = 0;
            for (size_t f = 0; f < 2; ++f) {
                const std::vector<Contact>& own = contacts.of(number, f);
                standing += std::any_of(own.begin(), own.end(), [&](const Contact& contact) {
                    return time >= contact.begin && time <= contact.end;
                });
            }
            both += standing == 2 ? 1 : 0;
            some += standing > 0 ? 1 : 0;
        }
        EXPECT_GT(some, 70) << "of a hundred";
        EXPECT_LT(both, 10);
    }
}

TEST(Contacts, OfOneWhoStandsLastFromLoopToLoop) {
    const cage::Character wren = test::readCharacter(test::kWren);
    const Contacts contacts = findContacts(wren);
    const size_t idle = test::clipNumber(wren, "idle");
    for (size_t f = 0; f < 2; ++f) {
        ASSERT_EQ(contacts.of(idle, f).size(), 1u);
        const Contact& own = contacts.of(idle, f).front();
        EXPECT_LE(own.begin, -1.0);
        EXPECT_GE(own.end, wren.clips[idle].duration + 1.0);
        EXPECT_LT(glm::length(own.drift), 1e-3);
    }
}

TEST(Contacts, StandOnTheGroundThatAWalkPasses) {
    for (const std::string& file : {test::kPip, test::kWren}) {
        const cage::Character before = test::readCharacter(file);
        const size_t number = test::clipNumber(before, "walk");
        const cage::Character walker = test::walking(before, 0.0);
        const Contacts in = findContacts(before), onward = findContacts(walker);
        for (size_t f = 0; f < 2; ++f) {
            const std::vector<Contact>&a = in.of(number, f), &b = onward.of(number, f);
            ASSERT_FALSE(a.empty());
            ASSERT_EQ(a.size(), b.size());
            for (size_t k = 0; k < a.size(); ++k) {
                EXPECT_NEAR(a[k].begin, b[k].begin, 0.02);
                EXPECT_NEAR(a[k].end, b[k].end, 0.02);
                EXPECT_GT(glm::length(a[k].drift), 0.2 * in.feet[f].leg) << "it walks in place";
                EXPECT_LT(glm::length(b[k].drift), 0.02 * in.feet[f].leg) << "and here over the ground";
            }
        }
    }
}

/// While a foot rolls over its toes, its joint goes slower than the ground, which must not count.
TEST(Contacts, DriftAsFastAsTheGround) {
    struct Gait {
        const std::string& file;
        const char* clip;
        double speed; ///< samples/assets/README.md
    };
    for (const Gait& gait :
         {Gait{test::kWren, "walk", 0.672}, {test::kWren, "run", 1.958}, {test::kPip, "walk", 0.406}}) {
        const cage::Character character = test::readCharacter(gait.file);
        const Contacts contacts = findContacts(character);
        for (size_t f = 0; f < 2; ++f) {
            for (const Contact& contact : contacts.of(test::clipNumber(character, gait.clip), f)) {
                EXPECT_NEAR(contact.drift.x, 0.0, 0.02) << gait.file << " " << gait.clip;
                EXPECT_NEAR(contact.drift.y, -gait.speed, 0.07 * gait.speed) << gait.file << " " << gait.clip;
            }
        }
    }
}

TEST(Contacts, GoOnOverTheEndOfALoopWhereTheRootHasGone) {
    // It jumps forward and turns in the air.
    cage::Character wren = test::readCharacter(test::kWren);
    const size_t number = test::clipNumber(wren, "jump");
    cage::Clip& jump = wren.clips[number];
    const std::vector<float> times{0.0f, 0.6f, 1.0f};
    const float s = std::sin(0.3f), c = std::cos(0.3f);
    jump.channels.push_back(test::channel(0, cage::ChannelPath::translation, times, {0, 0, 0, 0, 0, 0, 0.3f, 0, 0.8f}));
    jump.channels.push_back(test::channel(0, cage::ChannelPath::rotation, times, {0, 0, 0, 1, 0, 0, 0, 1, 0, s, 0, c}));
    ASSERT_EQ(wren.skeleton.nodes[0].parent, cage::kNone);
    const Contacts contacts = findContacts(wren);
    const RootSelection root{findRoot(wren), kRootGround | kRootYaw};
    ASSERT_EQ(root.node, 0u);
    const glm::dmat4 loop = toMatrix(rootMotionBetween(wren, jump, root, 0.0, jump.duration, false));
    for (size_t f = 0; f < 2; ++f) {
        const std::vector<Contact>& own = contacts.of(number, f);
        ASSERT_EQ(own.size(), 2u);
        const Contact &first = own.front(), &last = own.back();
        EXPECT_LT(first.begin, -0.3);
        EXPECT_GT(last.end, jump.duration + 0.3);
        EXPECT_NEAR(last.end - last.begin, first.end - first.begin, 0.02) << "it is one";
        const glm::dvec4 moved = loop * glm::dvec4(first.place.x, 0.0, first.place.y, 1.0);
        EXPECT_LT(glm::length(glm::dvec2(moved.x, moved.z) - (last.place + last.drift * jump.duration)), 1e-6);
        EXPECT_LT(farthest(wren, jump, contacts.feet[f], own), 0.12);
    }
}

TEST(Contacts, NeedTheGround) {
    cage::Character bird = test::readCharacter(test::kWren);
    for (cage::Clip& clip : bird.clips) {
        test::raise(bird, clip, 3.0f);
    }
    const Contacts contacts = findContacts(bird);
    EXPECT_EQ(contacts.feet.size(), 2u);
    for (const std::vector<Contact>& own : contacts.ofClips) {
        EXPECT_TRUE(own.empty());
    }
}

TEST(Contacts, OfWhatHasNoLegsAreNone) {
    EXPECT_TRUE(findContacts(cage::Character()).feet.empty());
    EXPECT_TRUE(findContacts(test::riggedTube({.joints = 5})).feet.empty()) << "it lies";
}

} // namespace
} // namespace supple::skinning
