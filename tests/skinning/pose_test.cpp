#include "skinning/pose.h"

#include "cage/gltf/reader.h"
#include "tests/support/shared_assets.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace supple::skinning {
namespace {

using namespace cage;

Skeleton oneNode(const Node& node = {}) {
    return {{node}, {0}};
}

Clip oneChannel(ChannelPath path, Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
    Clip clip;
    clip.duration = times.back();
    clip.channels.push_back({0, path, interpolation, std::move(times), std::move(values)});
    return clip;
}

glm::mat4 sampled(const Clip& clip, double time, const Skeleton& skeleton = oneNode()) {
    std::vector<glm::mat4> locals(skeleton.nodes.size());
    sampleClip(skeleton, clip, time, locals);
    return locals[0];
}

glm::vec3 translationAt(const Clip& clip, double time) {
    return glm::vec3(sampled(clip, time)[3]);
}

void expectNear(const glm::mat4& a, const glm::mat4& b, float tolerance = 1e-6f) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            EXPECT_NEAR(a[c][r], b[c][r], tolerance) << "column " << c << " row " << r;
}

/// Angle about +z of a rotation about z.
double angleAt(const Clip& clip, double time) {
    const glm::mat4 m = sampled(clip, time);
    return std::atan2(m[0][1], m[0][0]);
}

std::vector<float> aboutZ(std::initializer_list<double> degrees, double sign = 1.0) {
    std::vector<float> values;
    for (const double d : degrees) {
        const double half = d * std::numbers::pi / 360.0;
        values.insert(values.end(),
                      {0, 0, static_cast<float>(sign * std::sin(half)), static_cast<float>(sign * std::cos(half))});
    }
    return values;
}

TEST(Pose, ClampsOutsideTheKeys) {
    for (const Interpolation interpolation : {Interpolation::step, Interpolation::linear}) {
        const Clip clip = oneChannel(ChannelPath::translation, interpolation, {1, 2}, {1, 2, 3, 4, 5, 6});
        for (const double time : {-5.0, 0.0, 0.999, 1.0})
            EXPECT_EQ(translationAt(clip, time), glm::vec3(1, 2, 3)) << time;
        for (const double time : {2.0, 2.001, 1e300})
            EXPECT_EQ(translationAt(clip, time), glm::vec3(4, 5, 6)) << time;
    }
    const Clip single = oneChannel(ChannelPath::translation, Interpolation::linear, {3}, {7, 8, 9});
    for (const double time : {0.0, 3.0, 4.0})
        EXPECT_EQ(translationAt(single, time), glm::vec3(7, 8, 9));
}

TEST(Pose, KeysGiveTheirValuesExactly) {
    // 1/3 in single precision is no sum of the neighbors' fractions.
    const std::vector<float> times = {0.1f, 1.0f / 3.0f, 0.7f, 2.3f};
    const std::vector<float> values = {0.1f, 0.2f, 0.3f, 1e-7f, -3.3f, 1e7f, 1, 2, 3, -0.7f, 1.1f, 9.9f};
    for (const Interpolation interpolation : {Interpolation::step, Interpolation::linear}) {
        const Clip clip = oneChannel(ChannelPath::translation, interpolation, times, values);
        for (size_t k = 0; k < times.size(); ++k)
            EXPECT_EQ(translationAt(clip, times[k]), glm::vec3(values[3 * k], values[3 * k + 1], values[3 * k + 2]));
    }
    std::vector<float> cubic;
    for (size_t k = 0; k < times.size(); ++k)
        cubic.insert(cubic.end(), {100, 200, 300, values[3 * k], values[3 * k + 1], values[3 * k + 2], -9, -8, -7});
    const Clip clip = oneChannel(ChannelPath::translation, Interpolation::cubicSpline, times, cubic);
    for (size_t k = 0; k < times.size(); ++k)
        EXPECT_EQ(translationAt(clip, times[k]), glm::vec3(values[3 * k], values[3 * k + 1], values[3 * k + 2]));
    EXPECT_EQ(translationAt(clip, 0.0), glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(translationAt(clip, 9.0), glm::vec3(-0.7f, 1.1f, 9.9f));
}

TEST(Pose, StepHoldsUntilTheNextKey) {
    const Clip clip = oneChannel(ChannelPath::scale, Interpolation::step, {0, 1, 2}, {1, 1, 1, 2, 2, 2, 3, 3, 3});
    EXPECT_EQ(sampled(clip, std::nextafter(1.0, 0.0))[0][0], 1.0f);
    EXPECT_EQ(sampled(clip, 1.0)[0][0], 2.0f);
    EXPECT_EQ(sampled(clip, 1.9)[1][1], 2.0f);
    EXPECT_EQ(sampled(clip, 2.0)[2][2], 3.0f);
}

TEST(Pose, LinearTranslation) {
    const Clip clip = oneChannel(ChannelPath::translation, Interpolation::linear, {1, 3}, {0, 0, 8, 4, -2, 8});
    EXPECT_EQ(translationAt(clip, 1.5), glm::vec3(1, -0.5f, 8));
    EXPECT_EQ(translationAt(clip, 2.5), glm::vec3(3, -1.5f, 8));
}

TEST(Pose, SlerpTurnsEvenly) {
    const Clip clip = oneChannel(ChannelPath::rotation, Interpolation::linear, {0, 1}, aboutZ({0, 120}));
    for (const double t : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0})
        EXPECT_NEAR(angleAt(clip, t), t * 120.0 * std::numbers::pi / 180.0, 1e-6) << t;
}

TEST(Pose, SlerpTakesTheShorterWay) {
    // q and -q are one rotation; the second key is written the far way round.
    std::vector<float> values = aboutZ({10});
    const std::vector<float> far = aboutZ({50}, -1.0);
    values.insert(values.end(), far.begin(), far.end());
    const Clip clip = oneChannel(ChannelPath::rotation, Interpolation::linear, {0, 1}, values);
    EXPECT_NEAR(angleAt(clip, 0.5), 30.0 * std::numbers::pi / 180.0, 1e-6);
    EXPECT_NEAR(angleAt(clip, 1.0), 50.0 * std::numbers::pi / 180.0, 1e-6);
}

TEST(Pose, SlerpOverHalfATurn) {
    // 180 degrees apart: either way is as long, the one between the quaternions as written is taken.
    const Clip clip = oneChannel(ChannelPath::rotation, Interpolation::linear, {0, 1}, aboutZ({0, 180}));
    for (const double t : {0.25, 0.5, 0.75})
        EXPECT_NEAR(angleAt(clip, t), t * std::numbers::pi, 1e-6) << t;
    // A whole turn is no turn: the quaternions are opposite, their arc has no direction.
    const Clip whole = oneChannel(ChannelPath::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0, 0, -1});
    expectNear(sampled(whole, 0.5), glm::mat4(1.0f));
    // Nearly opposite: still finite, still a rotation.
    const Clip nearly = oneChannel(ChannelPath::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0, 1e-9f, -1});
    expectNear(sampled(nearly, 0.5), glm::mat4(1.0f));
}

TEST(Pose, SlerpOfNearKeysIsSmooth) {
    // Across the switch to straight interpolation nothing may jump.
    for (const double degrees : {1e-7, 1e-5, 1e-4, 1e-3, 1.0}) {
        const Clip clip = oneChannel(ChannelPath::rotation, Interpolation::linear, {0, 1}, aboutZ({0, degrees}));
        EXPECT_NEAR(angleAt(clip, 0.5), 0.5 * degrees * std::numbers::pi / 180.0, 1e-9 + 1e-7 * degrees);
    }
}

TEST(Pose, CubicSplineFollowsItsFormula) {
    // Two keys 2 s apart: tangents are per second and scaled by the span.
    const std::vector<float> values = {9, 9, 9, 1, 0, 0, 2, 0, 4, -1, 0, 8, 3, 1, 0, 9, 9, 9};
    const Clip clip = oneChannel(ChannelPath::translation, Interpolation::cubicSpline, {1, 3}, values);
    const double t = 0.25;
    const double h00 = 2 * t * t * t - 3 * t * t + 1, h10 = t * t * t - 2 * t * t + t;
    const double h01 = -2 * t * t * t + 3 * t * t, h11 = t * t * t - t * t;
    const glm::vec3 p = translationAt(clip, 1.5);
    EXPECT_NEAR(p.x, h00 * 1 + 2 * h10 * 2 + h01 * 3 + 2 * h11 * -1, 1e-6);
    EXPECT_NEAR(p.y, h01 * 1, 1e-6);
    EXPECT_NEAR(p.z, 2 * h10 * 4 + 2 * h11 * 8, 1e-6);
}

TEST(Pose, CubicSplineReproducesCubics) {
    // x(t) = t^3 - 2t + 1 with its own derivatives.
    const std::vector<float> times = {0, 0.5f, 2, 3};
    std::vector<float> values;
    for (const float t : times) {
        const float x = t * t * t - 2 * t + 1, d = 3 * t * t - 2;
        values.insert(values.end(), {d, 0, 0, x, 0, 0, d, 0, 0});
    }
    const Clip clip = oneChannel(ChannelPath::translation, Interpolation::cubicSpline, times, values);
    for (double t = 0; t <= 3; t += 0.0625)
        EXPECT_NEAR(translationAt(clip, t).x, t * t * t - 2 * t + 1, 1e-5) << t;
}

TEST(Pose, CubicSplineRotationsAreNormalised) {
    std::vector<float> values;
    for (const double degrees : {0.0, 90.0}) {
        const std::vector<float> q = aboutZ({degrees});
        values.insert(values.end(), {0, 0, 0, 0});
        values.insert(values.end(), q.begin(), q.end());
        values.insert(values.end(), {0, 0, 0, 0});
    }
    const Clip clip = oneChannel(ChannelPath::rotation, Interpolation::cubicSpline, {0, 1}, values);
    const glm::mat4 m = sampled(clip, 0.5);
    EXPECT_NEAR(glm::length(glm::vec3(m[0])), 1.0f, 1e-6f);
    EXPECT_NEAR(glm::length(glm::vec3(m[1])), 1.0f, 1e-6f);
    EXPECT_NEAR(angleAt(clip, 0.5), std::numbers::pi / 4, 1e-6);
    // Straight through zero: no rotation, and no NaN.
    const Clip through = oneChannel(ChannelPath::rotation, Interpolation::cubicSpline, {0, 1},
                                    {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0});
    expectNear(sampled(through, 0.5), glm::mat4(1.0f));
}

TEST(Pose, NodesWithoutChannelsKeepTheirRest) {
    Skeleton skeleton;
    skeleton.nodes.resize(3);
    skeleton.nodes[1].translation = {1, 2, 3};
    skeleton.nodes[1].scale = {2, 2, 2};
    skeleton.nodes[2].hasMatrix = true;
    skeleton.nodes[2].matrix[3] = {7, 8, 9, 1};
    skeleton.parentsFirst = {0, 1, 2};
    std::vector<glm::mat4> rest(3);
    restPose(skeleton, rest);
    EXPECT_EQ(rest[0], glm::mat4(1.0f));
    EXPECT_EQ(rest[1][3], glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(rest[1][0], glm::vec4(2, 0, 0, 0));
    EXPECT_EQ(rest[2], skeleton.nodes[2].matrix);

    // Node 1's translation moves, its scale stays.
    Clip clip = oneChannel(ChannelPath::translation, Interpolation::linear, {0}, {5, 5, 5});
    clip.channels[0].node = 1;
    std::vector<glm::mat4> locals(3);
    sampleClip(skeleton, clip, 0.0, locals);
    EXPECT_EQ(locals[0], rest[0]);
    EXPECT_EQ(locals[1][3], glm::vec4(5, 5, 5, 1));
    EXPECT_EQ(locals[1][0], glm::vec4(2, 0, 0, 0));
    EXPECT_EQ(locals[2], rest[2]);
}

TEST(Pose, TranslationRotationScaleInThatOrder) {
    Node node;
    node.translation = {1, 2, 3};
    node.rotation = glm::angleAxis(static_cast<float>(std::numbers::pi / 2), glm::vec3(0, 0, 1));
    node.scale = {2, 3, -4};
    std::vector<glm::mat4> locals(1);
    restPose(oneNode(node), locals);
    const glm::vec4 p = locals[0] * glm::vec4(1, 1, 1, 1);
    EXPECT_NEAR(p.x, 1 - 3, 1e-6);
    EXPECT_NEAR(p.y, 2 + 2, 1e-6);
    EXPECT_NEAR(p.z, 3 - 4, 1e-6);
}

TEST(Pose, GlobalsFollowTheOrderNotTheNumbers) {
    // Node 0 is the child of 2, which is the child of 1.
    Skeleton skeleton;
    skeleton.nodes.resize(3);
    skeleton.nodes[0].parent = 2;
    skeleton.nodes[2].parent = 1;
    for (Node& node : skeleton.nodes) {
        node.translation = {1, 0, 0};
        node.scale = {2, 2, 2};
    }
    skeleton.parentsFirst = {1, 2, 0};
    std::vector<glm::mat4> locals(3);
    std::vector<glm::mat4> globals(3);
    restPose(skeleton, locals);
    globalTransforms(skeleton, locals, globals);
    EXPECT_EQ(globals[1][3].x, 1.0f);
    EXPECT_EQ(globals[2][3].x, 3.0f);
    EXPECT_EQ(globals[0][3].x, 7.0f);
    globalTransforms(skeleton, locals, locals);
    EXPECT_EQ(locals, globals) << "in place";
}

TEST(Pose, PaletteAndDeformation) {
    Skin skin;
    skin.joints = {1, 0};
    skin.inverseBinds.assign(2, glm::mat4(1.0f));
    skin.inverseBinds[0][3] = {-1, 0, 0, 1};
    std::vector<glm::mat4> globals(2, glm::mat4(1.0f));
    globals[1][3] = {1, 5, 0, 1};
    glm::mat4 transform(1.0f);
    transform[3] = {0, 0, 7, 1};
    std::vector<Affine> palette(2);
    jointPalette(skin, globals, transform, palette);
    EXPECT_EQ(palette[0].rows[0], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(palette[0].rows[1], glm::vec4(0, 1, 0, 5));
    EXPECT_EQ(palette[0].rows[2], glm::vec4(0, 0, 1, 7));
    EXPECT_EQ(palette[1].rows[1], glm::vec4(0, 1, 0, 0));

    Cage cage;
    cage.positions = {{1, 2, 3}, {4, 5, 6}};
    SkinWeights weights{{0, 1, 3}, {{0, 1.0f}, {0, 0.25f}, {1, 0.75f}}};
    const std::vector<glm::dvec3> deformed = deformOnCpu(cage, weights, palette);
    EXPECT_EQ(deformed[0], glm::dvec3(1, 7, 10));
    EXPECT_EQ(deformed[1], glm::dvec3(4, 6.25, 13));
}

TEST(Pose, AffineIsTheTransposedTop) {
    glm::mat4 m;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            m[c][r] = static_cast<float>(10 * r + c);
    const Affine a = toAffine(m);
    EXPECT_EQ(a.rows[0], glm::vec4(0, 1, 2, 3));
    EXPECT_EQ(a.rows[2], glm::vec4(20, 21, 22, 23));
}

TEST(Pose, KhronosInterpolationTest) {
    const std::string path = test::sharedFolder() + "khronos/InterpolationTest.gltf";
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "9 clips left out: " << path << " is not present";
    }
    const Result<Character> c = readGltfFile(path);
    ASSERT_TRUE(c.ok()) << c.error().message;
    ASSERT_EQ(c->clips.size(), 9u);
    // One after another: scale, rotation, translation, each by step, linear and cubic spline in some order. (The clip
    // named "Linear Scale" is stored as a spline.)
    const Interpolation step = Interpolation::step, linear = Interpolation::linear, cubic = Interpolation::cubicSpline;
    const Interpolation interpolations[9] = {step, cubic, cubic, step, cubic, linear, step, cubic, linear};
    for (size_t i = 0; i < 9; ++i) {
        SCOPED_TRACE(c->clips[i].name);
        ASSERT_EQ(c->clips[i].channels.size(), 1u);
        const Channel& channel = c->clips[i].channels[0];
        EXPECT_EQ(channel.interpolation, interpolations[i]);
        EXPECT_EQ(c->clips[i].duration, static_cast<double>(channel.times.back()));
        const size_t width = channel.path == ChannelPath::rotation ? 4 : 3;
        const bool spline = channel.interpolation == cubic;
        std::vector<glm::mat4> locals(c->skeleton.nodes.size());
        const auto at = [&](double time) {
            sampleClip(c->skeleton, c->clips[i], time, locals);
            return locals[channel.node];
        };
        // A one-key clip with that value, and the node's rest for the rest, is what a key's time must give, bit by bit.
        const auto keyOnly = [&](size_t k) {
            const float* value = &channel.values[width * (spline ? 3 * k + 1 : k)];
            Clip clip;
            clip.channels.push_back({channel.node, channel.path, step, {0.0f}, {value, value + width}});
            sampleClip(c->skeleton, clip, 0.0, locals);
            return locals[channel.node];
        };
        for (size_t k = 0; k < channel.times.size(); ++k)
            EXPECT_EQ(at(channel.times[k]), keyOnly(k)) << "key " << k;
        EXPECT_EQ(at(-1.0), keyOnly(0));
        EXPECT_EQ(at(0.0), keyOnly(0)) << "the clip starts at 0, its first key may be later";
        EXPECT_EQ(at(1e6), keyOnly(channel.times.size() - 1));
        for (size_t k = 0; k + 1 < channel.times.size(); ++k) {
            const double middle = 0.5 * (double(channel.times[k]) + double(channel.times[k + 1]));
            const glm::mat4 m = at(middle);
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row)
                    EXPECT_TRUE(std::isfinite(m[column][row]));
            if (channel.interpolation == step) {
                EXPECT_EQ(m, keyOnly(k));
            }
            if (channel.interpolation == linear && channel.path == ChannelPath::translation) {
                expectNear(m, (keyOnly(k) + keyOnly(k + 1)) * 0.5f);
            }
            if (channel.path == ChannelPath::rotation) {
                EXPECT_NEAR(glm::length(glm::vec3(m[0])), glm::length(glm::vec3(keyOnly(k)[0])), 1e-5f);
            }
        }
    }
}

} // namespace
} // namespace supple::skinning
