// Morph targets and all ways of skinning on the device, against double precision on the CPU.
#include "cage/gltf/reader.h"
#include "skinning/rotation.h"
#include "tests/support/centers_reference.h"
#include "tests/support/dual_quaternion_reference.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/mush_reference.h"
#include "tests/support/posed_group.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/shared_assets.h"
#include "tests/support/skinnings.h"
#include "tests/support/spirv_precise.h"
#include "tests/support/wrapped_vulkan.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

/// Contexts of both mappings for all tests, made once: a context compiles every pipeline.
class DeformOnGpu : public testing::Test {
protected:
    static void TearDownTestSuite() {
        for (std::unique_ptr<PosedContext>& context : contexts()) {
            context = nullptr;
        }
    }
    static PosedContext& context(SuppleMapping mapping) {
        std::unique_ptr<PosedContext>& own = contexts()[mapping];
        if (own == nullptr) {
            own = std::make_unique<PosedContext>(*testDevice(), mapping);
        }
        return *own;
    }
    void SetUp() override { ASSERT_NE(testDevice(), nullptr); }

private:
    static std::array<std::unique_ptr<PosedContext>, 3>& contexts() {
        static std::array<std::unique_ptr<PosedContext>, 3> all;
        return all;
    }
};

/// The largest distance, in parts of the wanted cage's extent.
double worstError(const std::vector<glm::vec3>& cage, const std::vector<glm::dvec3>& wanted) {
    double worst = 0.0;
    for (size_t v = 0; v < wanted.size(); ++v) {
        worst = std::max(worst, glm::length(glm::dvec3(cage[v]) - wanted[v]));
    }
    return worst / extent(wanted);
}

bool sameBits(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(glm::vec3)) == 0;
}

struct JointNoise {
    float stretch = 0.0f; ///< scales and shears
    float mirror = 1.0f;  ///< along x
    float upright = 1.5f; ///< what rotations lean to: 0 turns any way
};
/// Model-space joint matrices of a chain that turns and moves by noise.
std::vector<glm::mat4> noisyJoints(const cage::Character& character, uint32_t seed, const JointNoise& own) {
    Noise noise(seed);
    std::vector<glm::mat4> joints;
    for (size_t j = 0; j < character.skin.joints.size(); ++j) {
        const glm::mat4 bind = glm::inverse(character.skin.inverseBinds[j]);
        glm::mat4 turn(glm::mat3_cast(skinning::unit({noise() + own.upright, noise(), noise(), noise()})));
        turn[3] = glm::vec4(0.3f * noise.vector(), 1.0f);
        glm::mat4 shape(1.0f);
        for (int c = 0; c < 3; ++c) {
            shape[c] += glm::vec4(own.stretch * 0.4f * noise.vector(), 0.0f);
        }
        joints.push_back(glm::scale(glm::mat4(1.0f), {own.mirror, 1.0f, 1.0f}) * bind * turn * shape);
    }
    return joints;
}

std::vector<skinning::Affine> paletteOf(const cage::Character& character, const std::vector<glm::mat4>& joints) {
    std::vector<skinning::Affine> palette;
    for (size_t j = 0; j < joints.size(); ++j) {
        palette.push_back(skinning::toAffine(joints[j] * character.skin.inverseBinds[j]));
    }
    return palette;
}

/// Influences whose quaternion lies on the other side from that of their vertex' heaviest joint.
uint32_t flippedInfluences(const cage::Character& character, const std::vector<glm::mat4>& joints) {
    std::vector<glm::vec4> rotations(joints.size());
    skinning::jointRotations(paletteOf(character, joints), rotations);
    const cage::SkinWeights& weights = character.weights;
    uint32_t flips = 0;
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        const auto own =
            std::span(weights.influences).subspan(weights.starts[v], weights.starts[v + 1] - weights.starts[v]);
        const auto heaviest =
            std::max_element(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
        for (const cage::Influence& influence : own) {
            flips += glm::dot(rotations[influence.joint], rotations[heaviest->joint]) < 0.0f ? 1 : 0;
        }
    }
    return flips;
}

/// In double.
std::vector<glm::dvec3> skinnedOnCpu(SuppleSkinning skinning, const cage::Character& character,
                                     std::span<const glm::dvec3> morphed, std::span<const skinning::Affine> palette,
                                     const glm::dmat4& transform = glm::dmat4(1.0)) {
    switch (skinning) {
    case SUPPLE_SKINNING_DUAL_QUATERNION:
        return skinWithDualQuaternions(morphed, character.weights, palette, transform);
    case SUPPLE_SKINNING_CENTERS_OF_ROTATION:
        return skinAboutCenters(morphed, centersOf(skinning::findCenters(character)), character.weights, palette,
                                transform);
    case SUPPLE_SKINNING_DELTA_MUSH:
    case SUPPLE_SKINNING_DELTA_MUSH_LIGHT:
        return skinByMush(morphed, mushOf(*skinning::findDeltaMush(character)), palette,
                          skinning == SUPPLE_SKINNING_DELTA_MUSH_LIGHT, transform);
    default:
        return skinning::deformOnCpu(morphed, character.weights, palette);
    }
}

TEST_F(DeformOnGpu, MorphsAgreeWithTheCpuAndBetweenMappings) {
    const ValidationGuard guard;
    constexpr uint32_t kInstances = 5;
    for (const SuppleSkinning skinning : kSkinnings) {
        std::vector<std::vector<glm::vec3>> narrow;
        for (const SuppleMapping mapping : kMappings) {
            PosedGroup gpu(context(mapping), riggedTube({.segments = 21, .joints = 4, .morphTargets = 7}),
                           {skinning, kInstances});
            ASSERT_TRUE(gpu.valid());
            const cage::Character& character = gpu.character();
            std::vector<std::vector<glm::dvec3>> wanted;
            for (uint32_t i = 0; i < kInstances; ++i) {
                Noise noise(100 + i);
                std::vector<float> weights;
                for (int t = 0; t < 7; ++t) {
                    weights.push_back(2.0f * noise());
                }
                const std::vector<glm::mat4> joints = noisyJoints(character, i, {.stretch = 0.5f});
                gpu.poses().setMatrixPose(i, glm::value_ptr(joints[0]));
                gpu.poses().setMorphWeights(i, weights.data());
                const auto morphed = skinning::morphOnCpu(character.cage, character.morphs, weights);
                const auto palette = paletteOf(character, joints);
                wanted.push_back(skinnedOnCpu(skinning, character, morphed, palette));
            }
            gpu.deform();
            double worst = 0.0;
            for (uint32_t i = 0; i < kInstances; ++i) {
                worst = std::max(worst, worstError(gpu.cage(i), wanted[i]));
                if (mapping == SUPPLE_MAPPING_NARROW) {
                    narrow.push_back(gpu.cage(i));
                } else {
                    EXPECT_TRUE(sameBits(gpu.cage(i), narrow[i])) << "mappings differ, instance " << i;
                }
            }
            std::printf("%s, mapping %d: morphs and skin within %.1e of the extent\n", skinningName(skinning), mapping,
                        worst);
            EXPECT_LT(worst, 1e-6);
        }
    }
}

/// By vertex: whether the joint of most weight, the first of several, is `joint`.
std::vector<bool> hangsOn(const cage::SkinWeights& weights, uint32_t vertexCount, uint32_t joint) {
    std::vector<bool> hangs;
    for (uint32_t v = 0; v < vertexCount; ++v) {
        const auto own =
            std::span(weights.influences).subspan(weights.starts[v], weights.starts[v + 1] - weights.starts[v]);
        const auto heaviest =
            std::max_element(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
        hangs.push_back(heaviest->joint == joint);
    }
    return hangs;
}

TEST_F(DeformOnGpu, VerticesSayWhetherThePoseMirrorsThem) {
    const ValidationGuard guard;
    constexpr uint32_t kLimb = 2;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleSkinning skinning : kSkinnings) {
            PosedGroup gpu(context(mapping), riggedTube({.segments = 9, .joints = 4}), {skinning, 4});
            ASSERT_TRUE(gpu.valid());
            const cage::Character& character = gpu.character();
            std::vector<glm::mat4> joints = noisyJoints(character, 5, {.stretch = 0.5f});
            gpu.poses().setMatrixPose(0, glm::value_ptr(joints[0]));
            joints[kLimb] = joints[kLimb] * glm::scale(glm::mat4(1.0f), {1.0f, 1.0f, -1.0f});
            gpu.poses().setMatrixPose(1, glm::value_ptr(joints[0]));
            gpu.poses().setMatrixPose(2, glm::value_ptr(joints[0]));
            gpu.poses().setTransform(2, glm::scale(glm::mat4(1.0f), {-1e-13f, 1e-13f, 1e-13f}));
            joints[kLimb] = glm::mat4(0.0f); // flat: not mirrored
            joints[kLimb][3][3] = 1.0f;
            gpu.poses().setMatrixPose(3, glm::value_ptr(joints[0]));
            gpu.deform();
            const std::vector<bool> limb = hangsOn(character.weights, character.cage.vertexCount(), kLimb);
            ASSERT_GT(std::count(limb.begin(), limb.end(), true), 0);
            for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
                EXPECT_EQ(gpu.sides(0)[v], 1.0f) << v;
                EXPECT_EQ(gpu.sides(1)[v], limb[v] ? -1.0f : 1.0f) << v;
                EXPECT_EQ(gpu.sides(2)[v], limb[v] ? 1.0f : -1.0f) << v;
                EXPECT_EQ(gpu.sides(3)[v], 1.0f) << v;
            }
        }
    }
}

TEST_F(DeformOnGpu, WeightsOfZeroLeaveTheBits) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleSkinning skinning : kSkinnings) {
            PosedGroup with(context(mapping), riggedTube({.morphTargets = 4}), {skinning, 2});
            PosedGroup without(context(mapping), riggedTube(), {skinning, 2});
            ASSERT_TRUE(with.valid() && without.valid());
            const std::vector<glm::mat4> joints = noisyJoints(with.character(), 3, {.stretch = 0.5f});
            const std::vector<float> others = {1, 1, 1, 1};
            for (PosedGroup* gpu : {&with, &without}) {
                gpu->poses().setMatrixPose(1, glm::value_ptr(joints[0]));
            }
            with.deform();
            without.deform();
            EXPECT_TRUE(sameBits(with.cage(0), without.cage(0)));
            EXPECT_TRUE(sameBits(with.cage(1), without.cage(1)));
            // A neighbor's weights change nothing, and given back weights are gone.
            with.poses().setMorphWeights(0, others.data());
            with.deform();
            EXPECT_FALSE(sameBits(with.cage(0), without.cage(0)));
            EXPECT_TRUE(sameBits(with.cage(1), without.cage(1)));
            with.poses().setMorphWeights(0, nullptr);
            with.deform();
            EXPECT_TRUE(sameBits(with.cage(0), without.cage(0)));
        }
    }
}

TEST_F(DeformOnGpu, ClipsAnimateMorphWeights) {
    const ValidationGuard guard;
    cage::Character character = riggedTube({.morphTargets = 2});
    character.morphs.weights = {0.5f, 0.25f};
    character.clips.push_back(clipOf({channel(0, cage::ChannelPath::weights, {0, 2}, {0, 1, 1, -1})}));
    PosedGroup gpu(context(SUPPLE_MAPPING_NARROW), std::move(character), {SUPPLE_SKINNING_LINEAR, 4});
    ASSERT_TRUE(gpu.valid());
    gpu.poses().setClipPose(0, 0, 0.5);
    gpu.poses().setRestPose(1);
    gpu.poses().setClipPose(3, 0, 0.5);
    gpu.poses().setBindPose(3);
    gpu.deform();
    const std::vector<std::vector<float>> weights = {{0.25f, 0.5f}, {0.5f, 0.25f}, {0, 0}, {0, 0}};
    for (uint32_t i = 0; i < 4; ++i) {
        EXPECT_LT(
            worstError(gpu.cage(i), skinning::morphOnCpu(gpu.character().cage, gpu.character().morphs, weights[i])),
            1e-7)
            << "instance " << i;
    }
}

class RotationsBlended : public DeformOnGpu, public testing::WithParamInterface<SuppleSkinning> {};
INSTANTIATE_TEST_SUITE_P(Skinnings, RotationsBlended,
                         testing::Values(SUPPLE_SKINNING_DUAL_QUATERNION, SUPPLE_SKINNING_CENTERS_OF_ROTATION,
                                         SUPPLE_SKINNING_DELTA_MUSH, SUPPLE_SKINNING_DELTA_MUSH_LIGHT));

TEST_P(RotationsBlended, AgreeWithThePapers) {
    const ValidationGuard guard;
    struct Case {
        const char* name;
        JointNoise noise;
        glm::mat4 transform;
    };
    glm::mat4 placed = glm::rotate(glm::translate(glm::mat4(1.0f), {3, 1, -2}), 0.7f, {0, 1, 0});
    const Case cases[] = {
        {"rigid", {}, glm::mat4(1.0f)},
        {"turned any way", {.upright = 0.0f}, glm::mat4(1.0f)},
        {"scaled and sheared", {.stretch = 1.0f, .upright = 0.0f}, glm::mat4(1.0f)},
        {"mirrored", {.stretch = 1.0f, .mirror = -1.0f, .upright = 0.0f}, glm::mat4(1.0f)},
        {"placed by a rigid transform", {.stretch = 1.0f}, placed},
        {"placed by an uneven, mirroring one", {.stretch = 1.0f}, glm::scale(placed, {2.0f, -0.5f, 1.0f})},
    };
    uint32_t flips = 0;
    for (const Case& c : cases) {
        std::vector<glm::vec3> narrow[2];
        for (const SuppleMapping mapping : kMappings) {
            // Six joints: vertices of two influences; then random ones of up to five, so that quaternions meet from
            // both sides.
            for (const bool many : {false, true}) {
                cage::Character character = riggedTube({.segments = 30, .joints = 6});
                if (many) {
                    Noise noise(9);
                    character.weights = {{0}, {}};
                    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
                        float sum = 0.0f;
                        const size_t begin = character.weights.influences.size();
                        for (uint32_t j = 0; j < 1 + v % 5; ++j) {
                            character.weights.influences.push_back({(v + j) % 6, noise() + 1.01f});
                            sum += character.weights.influences.back().weight;
                        }
                        for (size_t i = begin; i < character.weights.influences.size(); ++i) {
                            character.weights.influences[i].weight /= sum;
                        }
                        character.weights.starts.push_back(static_cast<uint32_t>(character.weights.influences.size()));
                    }
                }
                PosedGroup gpu(context(mapping), std::move(character), {GetParam(), 1});
                ASSERT_TRUE(gpu.valid());
                const std::vector<glm::mat4> joints = noisyJoints(gpu.character(), 21, c.noise);
                gpu.poses().setMatrixPose(0, glm::value_ptr(joints[0]));
                gpu.poses().setTransform(0, c.transform);
                gpu.deform();
                flips += flippedInfluences(gpu.character(), joints);
                const std::vector<glm::dvec3> wanted =
                    skinnedOnCpu(GetParam(), gpu.character(), doublePositions(gpu.character().cage),
                                 paletteOf(gpu.character(), joints), glm::dmat4(c.transform));
                const double worst = worstError(gpu.cage(0), wanted);
                std::printf("%-36s mapping %d, %s influences: within %.1e of the extent\n", c.name, mapping,
                            many ? "up to five" : "one or two", worst);
                EXPECT_LT(worst, 1e-6) << c.name;
                if (mapping == SUPPLE_MAPPING_NARROW) {
                    narrow[many ? 1 : 0] = gpu.cage(0);
                } else {
                    EXPECT_TRUE(sameBits(gpu.cage(0), narrow[many ? 1 : 0])) << c.name << ": mappings differ";
                }
            }
        }
    }
    std::printf("%u influences are taken with the other sign of their quaternion\n", flips);
    EXPECT_GT(flips, 500u);
}

/// Where no vertex has anything of its neighbors' joints.
class RotationsAlone : public RotationsBlended {};
INSTANTIATE_TEST_SUITE_P(Skinnings, RotationsAlone,
                         testing::Values(SUPPLE_SKINNING_DUAL_QUATERNION, SUPPLE_SKINNING_CENTERS_OF_ROTATION));

TEST_P(RotationsAlone, MoveVerticesOfOneJointAsLinearOnes) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        PosedGroup linear(context(mapping), riggedTube(), {SUPPLE_SKINNING_LINEAR, 1});
        PosedGroup dual(context(mapping), riggedTube(), {GetParam(), 1});
        ASSERT_TRUE(linear.valid() && dual.valid());
        const std::vector<glm::mat4> joints = noisyJoints(linear.character(), 5, {.stretch = 1.0f});
        for (PosedGroup* gpu : {&linear, &dual}) {
            gpu->poses().setMatrixPose(0, glm::value_ptr(joints[0]));
            gpu->deform();
        }
        const cage::SkinWeights& weights = linear.character().weights;
        const double size = extent(std::vector<glm::dvec3>(linear.cage(0).begin(), linear.cage(0).end()));
        double alone = 0.0, between = 0.0;
        uint32_t aloneCount = 0;
        for (uint32_t v = 0; v < linear.character().cage.vertexCount(); ++v) {
            const double distance = static_cast<double>(glm::length(linear.cage(0)[v] - dual.cage(0)[v])) / size;
            const bool one = weights.starts[v + 1] - weights.starts[v] == 1;
            aloneCount += one ? 1 : 0;
            double& worst = one ? alone : between;
            worst = std::max(worst, distance);
        }
        std::printf("mapping %d: %u vertices of one joint differ by %.1e of the extent, those between by %.1e\n",
                    mapping, aloneCount, alone, between);
        EXPECT_GT(aloneCount, 50u);
        EXPECT_LT(alone, 1e-6);
        EXPECT_GT(between, 1e-3) << "both skinnings are the same";
    }
}

/// Girth and volume of a tube whose last joint is twisted, in parts of the straight one's.
struct TubeMeasure {
    double radius = 1e30;
    double volume = 0.0;
};
TubeMeasure measured(const std::vector<glm::vec3>& cage, uint32_t segments, uint32_t sides) {
    TubeMeasure result;
    const auto area = [&](uint32_t ring, glm::dvec3 center) { // of a ring, about +x
        double sum = 0.0;
        for (uint32_t k = 0; k < sides; ++k) {
            const glm::dvec3 a = glm::dvec3(cage[ring * sides + k]) - center;
            const glm::dvec3 b = glm::dvec3(cage[ring * sides + (k + 1) % sides]) - center;
            sum += 0.5 * glm::cross(a, b).x;
        }
        return sum;
    };
    double before = 0.0;
    for (uint32_t ring = 0; ring <= segments; ++ring) {
        glm::dvec3 center(0.0);
        for (uint32_t k = 0; k < sides; ++k) {
            center += glm::dvec3(cage[ring * sides + k]) / static_cast<double>(sides);
        }
        for (uint32_t k = 0; k < sides; ++k) {
            result.radius = std::min(result.radius, glm::length(glm::dvec3(cage[ring * sides + k]) - center));
        }
        const double here = area(ring, center);
        result.volume += ring == 0 ? 0.0 : 0.5 * (before + here) * 8.0 / segments;
        before = here;
    }
    return result;
}

TEST_F(DeformOnGpu, ATwistKeepsItsGirthWhereRotationsAreBlended) {
    const ValidationGuard guard;
    constexpr uint32_t kSegments = 32, kSides = 24;
    const TubeOptions options{.segments = kSegments, .sides = kSides, .joints = 2};
    for (const float degrees : {90.0f, 170.0f, 250.0f}) {
        TubeMeasure ratio[std::size(kSkinnings)];
        for (const SuppleSkinning skinning : kSkinnings) {
            PosedGroup gpu(context(SUPPLE_MAPPING_AUTO), riggedTube(options), {skinning, 2});
            ASSERT_TRUE(gpu.valid());
            glm::mat4 joints[2] = {glm::mat4(1.0f), glm::translate(glm::mat4(1.0f), {4, 0, 0})};
            joints[1] = glm::rotate(joints[1], glm::radians(degrees), {1, 0, 0});
            gpu.poses().setMatrixPose(1, glm::value_ptr(joints[0]));
            gpu.deform();
            const TubeMeasure straight = measured(gpu.cage(0), kSegments, kSides);
            const TubeMeasure twisted = measured(gpu.cage(1), kSegments, kSides);
            ratio[skinning] = {twisted.radius / straight.radius, twisted.volume / straight.volume};
        }
        std::printf("twisted by %3.0f degrees: linear blending keeps %.3f of the radius, %.3f of the volume; dual "
                    "quaternions %.6f and %.6f\n",
                    degrees, ratio[0].radius, ratio[0].volume, ratio[1].radius, ratio[1].volume);
        const double collapse = std::abs(std::cos(0.5 * glm::radians(static_cast<double>(degrees))));
        EXPECT_NEAR(ratio[0].radius, collapse, 1e-4) << "the half way ring of linear blending";
        for (const SuppleSkinning skinning : {SUPPLE_SKINNING_DUAL_QUATERNION, SUPPLE_SKINNING_CENTERS_OF_ROTATION}) {
            EXPECT_NEAR(ratio[skinning].radius, 1.0, 1e-6) << skinningName(skinning);
            EXPECT_NEAR(ratio[skinning].volume, 1.0, 1e-6) << skinningName(skinning);
        }
    }
}

TEST_P(RotationsBlended, ScaledJointsDoNotDependOnTheOrigin) {
    // A joint that bends and doubles in size, in a tube that stands at the origin or far from it: the same shape, and
    // the place of the joint itself stays where both joints put it.
    const ValidationGuard guard;
    std::vector<glm::vec3> shapes[2];
    const glm::vec3 origins[2] = {glm::vec3(0.0f), glm::vec3(100.0f, -50.0f, 70.0f)};
    for (int far = 0; far < 2; ++far) {
        PosedGroup gpu(context(SUPPLE_MAPPING_AUTO), riggedTube({.joints = 2, .origin = origins[far]}),
                       {GetParam(), 1});
        ASSERT_TRUE(gpu.valid());
        glm::mat4 joints[2] = {glm::translate(glm::mat4(1.0f), origins[far]),
                               glm::translate(glm::mat4(1.0f), origins[far] + glm::vec3(4, 0, 0))};
        joints[1] = glm::scale(glm::rotate(joints[1], 1.2f, {0, 0, 1}), glm::vec3(2.0f));
        gpu.poses().setMatrixPose(0, glm::value_ptr(joints[0]));
        gpu.deform();
        shapes[far] = gpu.cage(0);
        glm::vec3 middle(0.0f);
        for (uint32_t k = 0; k < 12; ++k) {
            shapes[far][8 * 12 + k] -= origins[far];
            middle += shapes[far][8 * 12 + k] / 12.0f;
            shapes[far][8 * 12 + k] += origins[far];
        }
        const bool mush = skinning::isMush(static_cast<skinning::SkinningMode>(GetParam()));
        EXPECT_LT(glm::length(middle - glm::vec3(4, 0, 0)), mush ? 0.1f : 1e-4f)
            << "the ring round the joint stays round it; delta mush pulls it inwards";
    }
    double worst = 0.0;
    for (size_t v = 0; v < shapes[0].size(); ++v) {
        worst = std::max<double>(worst, glm::length(shapes[0][v] - (shapes[1][v] - origins[1])));
    }
    EXPECT_LT(worst, 1e-4) << "132 units away, single precision leaves 1e-5";
}

TEST_P(RotationsBlended, EvenScaleOfTheWholeScalesTheShape) {
    // Skeletons in other units than their mesh, and roots that scale or mirror everything.
    const ValidationGuard guard;
    PosedGroup gpu(context(SUPPLE_MAPPING_AUTO), riggedTube({.joints = 4}), {GetParam(), 3});
    ASSERT_TRUE(gpu.valid());
    const std::vector<glm::mat4> joints = noisyJoints(gpu.character(), 31, {});
    const glm::mat4 whole[3] = {glm::mat4(1.0f), glm::scale(glm::mat4(1.0f), glm::vec3(0.01f)),
                                glm::scale(glm::mat4(1.0f), {-3.0f, 3.0f, 3.0f})};
    for (uint32_t i = 0; i < 3; ++i) {
        std::vector<glm::mat4> moved;
        for (const glm::mat4& joint : joints) {
            moved.push_back(whole[i] * joint);
        }
        gpu.poses().setMatrixPose(i, glm::value_ptr(moved[0]));
    }
    gpu.deform();
    for (uint32_t i = 1; i < 3; ++i) {
        std::vector<glm::dvec3> wanted;
        for (const glm::vec3& p : gpu.cage(0)) {
            wanted.emplace_back(whole[i] * glm::vec4(p, 1.0f));
        }
        EXPECT_LT(worstError(gpu.cage(i), wanted), 1e-6);
    }
}

TEST_F(DeformOnGpu, CharactersWithMorphTargets) {
    const ValidationGuard guard;
    for (const std::string& path :
         sharedAssets({"khronos/SimpleMorph/SimpleMorph.gltf", "khronos/AnimatedMorphCube/AnimatedMorphCube.gltf",
                       "khronos/MorphStressTest.gltf", "characters/mh_female1605_morph.glb"})) {
        const std::string name = std::filesystem::path(path).filename();
        const Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        const auto targets = static_cast<uint32_t>(character->morphs.targets.size());
        ASSERT_GT(targets, 0u) << name;
        ASSERT_GT(character->clips.size(), 0u) << name;
        const auto clips = static_cast<uint32_t>(character->clips.size());
        // Every clip at four times, then every target alone.
        const uint32_t instances = 4 * clips + targets;
        double worst = 0.0, moved = 0.0;
        std::vector<std::vector<glm::vec3>> narrow;
        for (const SuppleMapping mapping : kMappings) {
            PosedGroup gpu(context(mapping), *character, {SUPPLE_SKINNING_LINEAR, instances});
            ASSERT_TRUE(gpu.valid()) << name;
            std::vector<std::vector<glm::dvec3>> wanted;
            for (uint32_t i = 0; i < instances; ++i) {
                skinning::Pose pose;
                if (i < 4 * clips) {
                    const double time = 0.31 * (i % 4) * character->clips[i / 4].duration;
                    skinning::sampleClip(*character, character->clips[i / 4], time, pose);
                    gpu.poses().setClipPose(i, i / 4, time);
                } else {
                    std::vector<float> weights(targets, 0.0f);
                    weights[i - 4 * clips] = 1.0f;
                    skinning::restPose(*character, pose);
                    pose.morphWeights.assign(weights.begin(), weights.end());
                    gpu.poses().setRestPose(i);
                    gpu.poses().setMorphWeights(i, weights.data());
                }
                wanted.push_back(skinning::deformOnCpu(*character, pose));
                pose.morphWeights.assign(targets, 0.0);
                const std::vector<glm::dvec3> without = skinning::deformOnCpu(*character, pose);
                for (size_t v = 0; v < without.size(); ++v) {
                    moved = std::max(moved, glm::length(without[v] - wanted[i][v]) / extent(without));
                }
            }
            gpu.deform();
            for (uint32_t i = 0; i < instances; ++i) {
                worst = std::max(worst, worstError(gpu.cage(i), wanted[i]));
                if (mapping == SUPPLE_MAPPING_NARROW) {
                    narrow.push_back(gpu.cage(i));
                } else {
                    EXPECT_TRUE(sameBits(gpu.cage(i), narrow[i])) << name << ": mappings differ, instance " << i;
                }
            }
        }
        std::printf(
            "%-24s %2u targets, %u poses: within %.1e of the extent; targets move vertices by up to %.2f of it\n",
            name.c_str(), targets, instances, worst, moved);
        EXPECT_LT(worst, 1e-6) << name;
        EXPECT_GT(moved, 1e-3) << name;
    }
}

TEST_F(DeformOnGpu, LargeGroupsAreWindowsOfInstances) {
    // Poses of an odd number of elements, in windows of sixteen instances: the bits of one window.
    constexpr uint32_t kInstances = 37;
    for (const SuppleMapping mapping : kMappings) {
        std::vector<std::vector<glm::vec3>> cages[2];
        for (const bool small : {false, true}) {
            WrappedVulkan& wrapped = wrappedVulkan();
            host::DeviceOptions options;
            options.validation = true;
            options.suppleGetInstanceProcAddr = &wrappedGetInstanceProcAddr;
            Result<std::unique_ptr<host::Device>> device = host::Device::create(options);
            ASSERT_TRUE(device.ok()) << device.error().message;
            wrapped.maxStorageBufferRange = small ? 1u << 16 : 0;
            {
                PosedContext own(**device, mapping);
                PosedGroup gpu(own, riggedTube({.morphTargets = 4}), {SUPPLE_SKINNING_DUAL_QUATERNION, kInstances});
                ASSERT_TRUE(gpu.valid());
                for (uint32_t i = 0; i < kInstances; ++i) {
                    const std::vector<glm::mat4> joints = noisyJoints(gpu.character(), i, {.stretch = 1.0f});
                    const float weights[] = {0.1f * static_cast<float>(i), 1, 0, -1};
                    gpu.poses().setMatrixPose(i, glm::value_ptr(joints[0]));
                    gpu.poses().setMorphWeights(i, weights);
                }
                gpu.deform();
                for (uint32_t i = 0; i < kInstances; ++i) {
                    cages[small ? 1 : 0].push_back(gpu.cage(i));
                }
            }
            EXPECT_EQ((*device)->validation()->messageCount(), 0u);
        }
        for (uint32_t i = 0; i < kInstances; ++i) {
            EXPECT_TRUE(sameBits(cages[0][i], cages[1][i])) << "mapping " << mapping << ", instance " << i;
        }
    }
}

TEST(DeformShader, EveryHelperMustBePrecise) {
    // What makes the mappings agree: the static check must see `precise` go from any helper on the way to the position.
    for (const char* helper : {"transformed", "weighted", "morphed", "blendedLinearly", "sum4", "crossed", "influence",
                               "blendedAsDualQuaternions", "applied", "turned", "apart", "blendedAboutCenter", "slid",
                               "withPart", "rotationOf", "blendedByMush"}) {
        const std::vector<uint32_t> spirv = compileShader("deform/deform.comp", helper, "-DMUSH");
        ASSERT_FALSE(spirv.empty());
        uint32_t checked = 0;
        EXPECT_FALSE(imprecisePositionArithmetic(spirv, "p", checked).empty()) << helper;
    }
}

} // namespace
} // namespace supple::test
