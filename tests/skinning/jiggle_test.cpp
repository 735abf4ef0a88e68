// The arithmetic of what jiggles, against float64; the table that it is in.
#include "skinning/jiggle_table.h"

#include "shaders/soft/jiggle.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/worst.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using namespace shared;
using test::Noise;

JiggleStep standing() {
    return {identity(), false, false, 0};
}

/// y'' = -k y - c y', goal straight within steps, in many small steps of Runge and Kutta's.
struct Reference {
    glm::dvec3 y{0.0}, z{0.0}, goal{0.0}, goalSpeed{0.0};
    void step(const cage::Jiggle& of, const glm::dvec3& next) {
        const double h = 1.0 / 60.0, w = 2.0 * 3.14159265358979 * static_cast<double>(of.frequency);
        const double k = w * w, c = 2.0 * static_cast<double>(of.damping) * w;
        const glm::dvec3 speed = (next - goal) / h;
        z -= speed - goalSpeed;
        constexpr int kParts = 200;
        for (int i = 0; i < kParts; ++i) {
            const double s = h / kParts;
            const auto f = [&](const glm::dvec3& at, const glm::dvec3& v) { return -k * at - c * v; };
            const glm::dvec3 a1 = f(y, z), v2 = z + a1 * (s / 2), a2 = f(y + z * (s / 2), v2), v3 = z + a2 * (s / 2),
                             a3 = f(y + v2 * (s / 2), v3), v4 = z + a3 * s, a4 = f(y + v3 * s, v4);
            y += (z + 2.0 * v2 + 2.0 * v3 + v4) * (s / 6);
            z += (a1 + 2.0 * a2 + 2.0 * a3 + a4) * (s / 6);
        }
        goal = next;
        goalSpeed = speed;
    }
};

TEST(Jiggles, FollowTheDifferentialEquation) {
    for (const cage::Jiggle& own :
         {cage::Jiggle{4.0f, 0.2f, 1e6f}, cage::Jiggle{1.0f, 0.0f, 1e6f}, cage::Jiggle{7.0f, 1.0f, 1e6f},
          cage::Jiggle{3.0f, 2.5f, 1e6f}, cage::Jiggle{20.0f, 0.05f, 1e6f}}) {
        const vec4 spring = jiggleSpring(own);
        Reference reference;
        Jiggling jiggling = settledAt(vec3(0.0f));
        jiggling.known = 3.0f; // the goal has stood still
        double most = 0.0, off = 0.0;
        for (int n = 1; n < 300; ++n) {
            const double t = n / 60.0;
            const glm::dvec3 goal(0.3 * std::sin(5.0 * t), 0.2 * std::cos(9.0 * t) - 0.2, t < 2.0 ? 0.1 * t : 0.2);
            reference.step(own, goal);
            jiggling = jiggledStep(jiggling, vec3(goal), standing(), spring, own.limit);
            test::raise(most, glm::length(reference.y));
            test::raise(off, glm::length(glm::dvec3(jiggling.offset) - reference.y));
        }
        EXPECT_LT(off, 2e-4 * most + 1e-6) << own.frequency;
    }
}

TEST(Jiggles, KeepTheirEnergyForHours) {
    for (const float frequency : {0.05f, 1.0f, 4.0f, 15.0f, 30.0f}) {
        const cage::Jiggle own{frequency, 0.0f, 1e6f};
        const vec4 spring = jiggleSpring(own);
        const double k = std::pow(2.0 * 3.14159265358979 * static_cast<double>(frequency), 2.0);
        Jiggling jiggling = settledAt(vec3(0.0f));
        jiggling.known = 3.0f;
        jiggling.offset = vec3(0.05f, 0.0f, 0.02f);
        const auto energy = [&] {
            const glm::dvec3 y(jiggling.offset), z(jiggling.speed);
            return glm::dot(z, z) + k * glm::dot(y, y);
        };
        const double first = energy();
        double most = 0.0;
        for (int n = 0; n < 1'000'000; ++n) {
            jiggling = jiggledStep(jiggling, vec3(0.0f), standing(), spring, own.limit);
            test::raise(most, energy());
        }
        EXPECT_LE(most, first * (1.0 + 2e-5)) << frequency << ": an undamped spring gains nothing";
        EXPECT_GT(energy(), 0.8 * first) << frequency << ": and loses little in 4.6 hours";
        std::printf("%.2f Hz: energy after 1,000,000 steps: %.4f of its start\n", static_cast<double>(frequency),
                    energy() / first);
    }
}

TEST(Jiggles, StepsThatAreLeftOutSwingOn) {
    for (const cage::Jiggle& own : {cage::Jiggle{3.0f, 0.1f, 0.06f}, cage::Jiggle{9.0f, 0.0f, 0.06f},
                                    cage::Jiggle{0.05f, 0.0f, 0.06f}, cage::Jiggle{4.0f, 2.0f, 0.06f}}) {
        const vec4 spring = jiggleSpring(own);
        for (const uint32_t skipped : {1u, 9u, 12u, 100u, 511u, 32767u}) {
            Jiggling run = settledAt(vec3(0.3f));
            run.known = 3.0f;
            run.offset = vec3(0.03f, 0.0f, 0.01f);
            run.goalSpeed = vec3(7.0f); // what it was counts for nothing
            Jiggling left = run;
            run.goalSpeed = vec3(0.0f);
            for (uint32_t n = 0; n < skipped; ++n) {
                run = jiggledStep(run, vec3(0.3f), standing(), spring, 1e6f);
            }
            left = jiggledStep(left, vec3(0.9f), {identity(), true, false, skipped}, spring, 1e6f);
            const float off = 2e-6f * static_cast<float>(10 + skipped / 10);
            EXPECT_LT(glm::length(left.offset - run.offset), off) << own.frequency << ", " << skipped;
            EXPECT_LT(glm::length(left.before - run.before), off) << own.frequency << ", " << skipped;
            EXPECT_EQ(left.goal, vec3(0.9f));
            EXPECT_EQ(left.known, 1.0f);
            const Jiggling held = jiggledStep(left, vec3(0.9f), {identity(), true, false, skipped}, spring, 0.01f);
            EXPECT_LE(glm::length(held.offset), 0.0100001f);
        }
    }
    const vec4 spring = jiggleSpring({});
    const Jiggling unknown = jigglingOf(vec4(0.01f), vec4(0.0f), vec4(0.0f), vec4(0.0f));
    EXPECT_EQ(jiggledStep(unknown, vec3(1.0f), {identity(), true, false, 12}, spring, 1.0f).offset, vec3(0.0f))
        << "there was nothing";
}

TEST(Jiggles, FirstSpeedsAreNotBelieved) {
    const cage::Jiggle own{2.5f, 0.12f, 0.12f};
    const vec4 spring = jiggleSpring(own);
    Jiggling jiggling = settledAt(vec3(0.0f));
    float at = 0.02f; // for a part of the first step alone
    for (int n = 0; n < 60; ++n) {
        jiggling = jiggledStep(jiggling, vec3(at, 0.0f, 0.0f), standing(), spring, own.limit);
        EXPECT_LT(glm::length(jiggling.offset), 1e-5f) << n;
        at += 0.0833f;
    }
}

TEST(Jiggles, StayWithinTheirLimit) {
    for (const cage::Jiggle& own :
         {cage::Jiggle{0.05f, 0.0f, 0.05f}, cage::Jiggle{4.0f, 0.2f, 0.05f}, cage::Jiggle{30.0f, 0.0f, 0.05f}}) {
        const vec4 spring = jiggleSpring(own);
        Noise noise(3);
        Jiggling jiggling = settledAt(vec3(0.0f));
        for (int n = 0; n < 100'000; ++n) {
            const vec3 goal(noise(), noise(), noise()); // blows of hundreds of units a second
            jiggling = jiggledStep(jiggling, goal, standing(), spring, own.limit);
            ASSERT_LE(glm::length(jiggling.offset), 0.05f * 1.00001f) << n;
            ASSERT_LT(glm::length(jiggling.speed), 1e6f) << n;
        }
    }
}

TEST(Jiggles, FramesThatMoveSteadilyMoveNothing) {
    const cage::Jiggle own{4.0f, 0.2f, 1.0f};
    const vec4 spring = jiggleSpring(own);
    Jiggling jiggling = settledAt(vec3(0.1f, 1.0f, 0.2f));
    JiggleStep now = standing();
    now.move.x.w = -0.07f; // the model runs: in its frame, what was there lies behind
    for (int n = 0; n < 50; ++n) {
        jiggling = jiggledStep(jiggling, vec3(0.1f, 1.0f, 0.2f), now, spring, own.limit);
        EXPECT_LT(glm::length(jiggling.offset), 1e-6f) << n;
    }
    now.move.x.w = 0.0f; // and stops
    jiggling = jiggledStep(jiggling, vec3(0.1f, 1.0f, 0.2f), now, spring, own.limit);
    EXPECT_GT(jiggling.offset.x, 0.01f) << "it goes on";
    const vec3 offset = jiggling.offset, speed = jiggling.speed;
    now.jumps = true;
    const Jiggling told = jiggledStep(jiggling, vec3(5.0f), now, spring, own.limit);
    EXPECT_EQ(told.offset, offset * spring.x + speed * spring.y) << "as if the goal had not jumped";
    EXPECT_EQ(told.goal, vec3(5.0f));
}

TEST(Jiggles, AbsurdNumbersLeaveThemInTwoSteps) {
    const cage::Jiggle own{4.0f, 0.2f, 0.05f};
    const vec4 spring = jiggleSpring(own);
    for (const float absurd : {std::nanf(""), INFINITY, 1e38f, 1e11f, 1e6f}) {
        Jiggling jiggling = settledAt(vec3(0.0f));
        jiggling.known = 3.0f;
        jiggling = jiggledStep(jiggling, vec3(absurd), standing(), spring, own.limit);
        EXPECT_FALSE(glm::length(jiggling.goalSpeed) < 1e7f) << absurd << " is known of it";
        for (int n = 0; n < 3; ++n) {
            jiggling = jiggledStep(jiggling, vec3(0.0f), standing(), spring, own.limit);
        }
        EXPECT_LE(glm::length(jiggling.offset), 0.05f * 1.00001f) << absurd;
        EXPECT_LT(glm::length(jiggling.speed), 10.0f) << absurd;
        EXPECT_EQ(jiggling.goal, vec3(0.0f)) << absurd;
        EXPECT_EQ(jiggling.goalSpeed, vec3(0.0f)) << absurd;
    }
}

TEST(Jiggles, TableHasTheVerticesThatDo) {
    cage::Character tube = test::riggedTube();
    const JiggleTable none = buildJiggleTable(tube);
    EXPECT_EQ(none.vertexCount, 0u);
    EXPECT_TRUE(none.words.empty());
    tube.jiggles = {{4.0f, 0.2f, 0.05f}, {9.0f, 0.0f, 0.5f}};
    tube.weights.jiggles.resize(tube.cage.vertexCount());
    tube.weights.jiggles[3] = {1, 0.5f};
    tube.weights.jiggles[7] = {0, 1.0f};
    const JiggleTable table = buildJiggleTable(tube);
    ASSERT_EQ(table.vertexCount, 2u);
    ASSERT_EQ(table.words.size(), 2 * 4 * size_t{kJiggleTableElements});
    EXPECT_EQ(table.words[0], 3u);
    EXPECT_EQ(uintBitsToFloat(table.words[1]), 0.5f);
    EXPECT_EQ(uintBitsToFloat(table.words[2]), 0.5f);
    EXPECT_EQ(table.words[8], 7u);
    EXPECT_EQ(uintBitsToFloat(table.words[12]), jiggleSpring(tube.jiggles[0]).x);
    EXPECT_GE(table.mostWork, 1u);
    const ClipTable clips = buildClipTable(tube);
    size_t marked = 0;
    for (uint32_t place = 0; place < clips.nodes.size(); ++place) {
        marked += (clips.words[4 * size_t{kNodeElements * place} + 1] & kNodeOfSoft) != 0 ? 1 : 0;
    }
    EXPECT_GE(marked, 1u);
}

} // namespace
} // namespace supple::skinning
