// Joints and weights of a glTF file: sums, sets, vertices without any.
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

/// One triangle on three joints.
Character withWeights(const std::vector<std::vector<uint32_t>>& joints,
                      const std::vector<std::vector<float>>& weights) {
    return readWell(skinnedTriangle(3, joints, weights));
}

TEST(GltfSkin, WeightsAreNormalisedWithOneWarning) {
    const Character c =
        withWeights({{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}}, {{0.5f, 0.5f, 0, 0, 0.25f, 0.25f, 0, 0, 1.5f, 0.5f, 0, 0}});
    EXPECT_EQ(c.weights.influences[2].weight, 0.5f);
    EXPECT_EQ(c.weights.influences[4].weight, 0.75f);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 WEIGHTS: normalised: they do not sum to 1 at 2 vertices, largest "
                                   "deviation 1"}));
    // Rounding is nobody's fault.
    EXPECT_EQ(withWeights({{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}},
                          {{0.5f, 0.50005f, 0, 0, 0.5f, 0.5f, 0, 0, 0.5f, 0.49995f, 0, 0}})
                  .warnings,
              Strings());
}

TEST(GltfSkin, SeveralSetsAndRepeatedJoints) {
    const std::vector<uint32_t> j0 = {2, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const std::vector<uint32_t> j1 = {1, 9, 9, 9, 0, 0, 0, 0, 0, 0, 0, 0};
    const Character c = withWeights(
        {j0, j1}, {{0.25f, 0.125f, 0.25f, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {0.375f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}});
    ASSERT_EQ(c.weights.starts[1], 2u) << "joints named twice are merged, joints of zero weight dropped";
    EXPECT_EQ(c.weights.influences[0].joint, 1u);
    EXPECT_EQ(c.weights.influences[0].weight, 0.5f);
    EXPECT_EQ(c.weights.influences[1].joint, 2u);
    EXPECT_EQ(c.weights.influences[1].weight, 0.5f);
}

TEST(GltfSkin, VerticesWithoutWeightHangOnTheirFirstJoint) {
    const Character c = withWeights({{1, 2, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0}}, {{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}});
    EXPECT_EQ(c.weights.starts, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(c.weights.influences[0].joint, 1u);
    EXPECT_EQ(c.weights.influences[1].joint, 0u) << "out of range";
    EXPECT_EQ(c.weights.influences[0].weight, 1.0f);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 WEIGHTS: all zero at 2 vertices; bound to the first joint named there"}));
}

} // namespace
} // namespace supple::cage
