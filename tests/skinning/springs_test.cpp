// The arithmetic of springs, against float64; the table that they are in.
#include "shaders/pose/limbs.h"
#include "shaders/pose/swing.h"
#include "shaders/shared/pose.h"
#include "skinning/clip_table.h"
#include "tests/support/json_vectors.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/worst.h"

#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using namespace shared;
using test::Noise;

shared::Affine affineOf(const std::vector<float>& m) {
    return rowsOf({m[0], m[1], m[2], m[3]}, {m[4], m[5], m[6], m[7]}, {m[8], m[9], m[10], m[11]});
}

TEST(Springs, ChainIsThatOfFloat64) {
    const nlohmann::json data = test::parseFile(std::string(SUPPLE_TEST_DATA) + "/springs/chain.json");
    const auto number = [&](const char* name) { return data.at(name).get<float>(); };
    const size_t joints = data.at("joints").get<size_t>(), every = data.at("every").get<size_t>();
    const float size = number("length"), stiffness = number("stiffness"), keep = number("keep"), pull = number("pull"),
                radius = number("radius");
    const auto capsule = data.at("capsule").get<std::vector<float>>();
    const vec4 point(capsule[0], capsule[1], capsule[2], capsule[3]),
        way(capsule[4], capsule[5], capsule[6], capsule[7]);
    struct Tail {
        vec3 last, before;
    };
    std::vector<Tail> tails(joints);
    const size_t steps = data.at("roots").size();
    double off = 0.0, stretch = 0.0;
    for (size_t n = 0; n < steps; ++n) {
        const shared::Affine root = affineOf(data.at("roots")[n].get<std::vector<float>>());
        const shared::Affine move = affineOf(data.at("moves")[n].get<std::vector<float>>());
        const auto g = data.at("gravity")[n].get<std::vector<float>>();
        vec3 head(root.x.w, root.y.w, root.z.w), axis(root.x.y, root.y.y, root.z.y);
        if (n == 0) {
            for (size_t j = 0; j < joints; ++j) {
                tails[j].last = tails[j].before = head + axis * (size * static_cast<float>(j + 1));
            }
        }
        for (Tail& tail : tails) {
            const vec3 last = through(move, tail.last), before = through(move, tail.before);
            vec3 turned =
                directionOr(swungTail(last, before, axis, stiffness, keep, vec3(g[0], g[1], g[2]) * pull) - head, axis);
            turned = directionOr(pushedOut(head + turned * size, radius, point, way) - head, turned);
            tail = {head + turned * size, last};
            test::raise(stretch, std::abs(static_cast<double>(glm::distance(tail.last, head) / size) - 1.0));
            // Joints below hang on it.
            axis = turnedVector(swingTurn(axis, turned), axis);
            head = tail.last;
        }
        for (size_t j = 0; j < joints && (n + 1) % every == 0; ++j) {
            for (size_t i = 0; i < 3; ++i) {
                const double wanted = data.at("tails")[n / every][3 * j + i].get<double>();
                test::raise(off, std::abs(wanted - static_cast<double>(tails[j].last[static_cast<int>(i)])));
            }
        }
    }
    EXPECT_LT(off, 1e-5);
    EXPECT_LT(stretch, 2e-6);
    std::printf("off by %.1e, lengths by %.1e\n", off, stretch);
}

TEST(Springs, ATailKeepsItsLengthForAMillionSteps) {
    const vec4 ball(0.0f, -0.3f, 0.0f, 0.25f), noWay(0.0f);
    for (const float drag : {0.0f, 0.4f, 1.0f}) {
        Noise noise(5);
        vec3 last(0.0f, -1.0f, 0.0f), before = last;
        double worst = 0.0;
        for (uint32_t n = 0; n < 1'000'000; ++n) {
            const float angle = 0.1f * static_cast<float>(n % 1000);
            const vec3 head(std::sin(angle), 0.2f * std::sin(3.0f * angle), std::cos(2.0f * angle));
            vec3 way = directionOr(
                swungTail(last, before, vec3(0.0f, -1.0f, 0.0f), 4.0f / 60.0f, 1.0f - drag, noise.vector() * 0.05f) -
                    head,
                vec3(0.0f, -1.0f, 0.0f));
            vec3 next = head + way * 0.1f;
            next = pushedOut(next, 0.02f, ball, noWay);
            way = directionOr(next - head, way);
            next = head + way * 0.1f;
            test::raise(worst, std::abs(10.0 * static_cast<double>(glm::distance(next, head)) - 1.0));
            before = last;
            last = next;
        }
        EXPECT_LT(worst, 5e-6); // of heads a metre from the origin, in floats
    }
}

TEST(Springs, CollidersKeepTailsOutOrInside) {
    Noise noise(9);
    const auto inside = [](const vec3& p, const vec4& point, const vec4& way) {
        const vec3 q = p - vec3(point);
        const float t = std::clamp(dot3(q, vec3(way)) * std::max(way.w, 0.0f), 0.0f, 1.0f);
        return way.w < 0.0f ? -dot3(q, vec3(way)) : std::abs(point.w) - glm::length(q - vec3(way) * t);
    };
    for (uint32_t run = 0; run < 20000; ++run) {
        const vec3 tail = noise.vector() * 2.0f, at = noise.vector(), along = noise.vector();
        const float radius = 0.1f + 0.5f * std::abs(noise()), hit = 0.1f * std::abs(noise());
        const vec4 sphere(at, radius), ball(at, -radius - 0.2f), noWay(0.0f);
        const vec4 capsule(along, 1.0f / glm::dot(along, along)), plane(glm::normalize(along), -1.0f);
        EXPECT_LT(inside(pushedOut(tail, hit, sphere, noWay), sphere, noWay), 1e-5f - hit);
        EXPECT_LT(inside(pushedOut(tail, hit, sphere, capsule), sphere, capsule), 1e-4f - hit);
        EXPECT_GT(inside(pushedOut(tail, hit, ball, noWay), ball, noWay), hit - 1e-5f);
        EXPECT_GT(inside(pushedOut(tail, hit, ball, capsule), ball, capsule), hit - 1e-4f);
        EXPECT_LT(inside(pushedOut(tail, hit, sphere, plane), sphere, plane), 1e-5f - hit);
        // Who touches nothing stays.
        if (inside(tail, sphere, capsule) < -hit) {
            EXPECT_EQ(pushedOut(tail, hit, sphere, capsule), tail);
        }
    }
}

TEST(Springs, AbsurdNumbersAreGoneInTwoSteps) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
    for (const float bad : {kNan, kInf, -kInf, 1e30f}) {
        vec3 last(bad), before(0.0f);
        for (uint32_t n = 0; n < 3; ++n) {
            const vec3 down(0.0f, -1.0f, 0.0f),
                way = directionOr(swungTail(last, before, down, 0.1f, 0.6f, vec3(0.0f)), down);
            before = last;
            last = way;
            EXPECT_TRUE(std::isfinite(way.x) && std::isfinite(way.y) && std::isfinite(way.z));
        }
        EXPECT_TRUE(std::isfinite(before.x));
    }
}

cage::Character tubeWithSprings() {
    cage::Character tube = test::riggedTube({.joints = 6});
    cage::SpringBones& bones = tube.springBones;
    bones.colliders = {{.node = 1, .radius = 2.0f}, {.node = 5, .radius = 1.0f}, {.node = 2, .radius = 1.0f}};
    bones.colliderGroups = {{1, 0}};
    bones.springs.push_back(
        {.name = "end", .center = 1, .joints = {{.node = 3}, {.node = 5}, {.node = 6}}, .colliderGroups = {0}});
    return tube;
}

TEST(Springs, TheTableHasWhatStepsNeed) {
    const ClipTable table = buildClipTable(tubeWithSprings());
    ASSERT_NE(table.springs, 0u);
    EXPECT_EQ(table.springJointCount, 2u) << "the last joint is a tail";
    EXPECT_EQ(table.springColliderCount, 2u) << "no spring has the third";
    EXPECT_EQ(table.swinging, (std::vector<uint32_t>{3, 5}));
    std::vector<uint32_t> flags;
    for (const uint32_t place : table.places) {
        flags.push_back(place != cage::kNone ? table.words[4 * size_t{kNodeElements * place} + 1] : 9);
    }
    constexpr uint32_t kNeeded = kNodeOfSprings, kChain = kNodeOfSprings | kNodeInChain;
    EXPECT_EQ(flags, (std::vector<uint32_t>{kNeeded, kNeeded, kNeeded, kChain, kChain, kChain, kNodeInChain}));
    const auto word = [&](uint32_t element, uint32_t i) { return table.words[4 * size_t{element} + i]; };
    EXPECT_EQ(word(table.springs, 2), 1u) << "one chain";
    const uint32_t chain = word(table.springs, 3), first = word(chain, 0);
    EXPECT_EQ(word(chain, 1) - first, 3 * kSpringNodeElements) << "with the node between";
    EXPECT_EQ(word(first, 0), table.places[3]);
    EXPECT_EQ(word(first, 1), 0u);
    EXPECT_EQ(word(first, 3), 2u) << "colliders";
    EXPECT_EQ(word(first + 3, 2), table.places[1]) << "center";
    EXPECT_EQ(word(first + kSpringNodeElements, 1), kNoNode);
    EXPECT_EQ(word(first + 2 * kSpringNodeElements, 1), 1u);
    EXPECT_EQ(std::bit_cast<float>(word(first + 1, 3)), 1.0f / 60.0f) << "VRM's stiffness";
    EXPECT_EQ(std::bit_cast<float>(word(first + 3, 0)), 0.5f) << "and its drag";

    cage::Character tree = tubeWithSprings();
    tree.springBones.springs[0].isTree = true;
    tree.springBones.springs[0].joints[1].node = 4;
    EXPECT_EQ(buildClipTable(tree).springJointCount, 3u) << "leaves move too";
    cage::Character fixed = tubeWithSprings();
    fixed.skeleton.nodes[3].hasMatrix = fixed.skeleton.nodes[5].hasMatrix = true;
    EXPECT_EQ(buildClipTable(fixed).springs, 0u) << "nothing turns a fixed matrix";
}

} // namespace
} // namespace supple::skinning
