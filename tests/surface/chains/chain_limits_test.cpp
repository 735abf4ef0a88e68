// How many faces round a vertex chains of leaves count.
#include "surface/build.h"
#include "tests/support/large_pole.h"

#include <gtest/gtest.h>
#include <string>

namespace supple::test {
namespace {

using Build = Result<surface::Tables> (*)(const surface::Recipe&, const cage::Cage&, surface::PatchEdges*);

/// `most` faces are taken; one more is refused, and the error says which vertex has how many.
void expectLimit(Build build, cage::Cage (*pole)(uint32_t faces), uint32_t most) {
    surface::Recipe recipe;
    recipe.rate = 2;
    const Result<surface::Tables> taken = build(recipe, pole(most), nullptr);
    EXPECT_TRUE(taken) << taken.error().message;
    const Result<surface::Tables> refused = build(recipe, pole(most + 1), nullptr);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::limit);
    EXPECT_NE(refused.error().message.find("vertex 0 has " + std::to_string(most + 1) + " faces"), std::string::npos)
        << refused.error().message;
}

TEST(ChainLimits, QuadsRoundAVertex) {
    expectLimit(
        surface::catmull_clark::build,
        [](uint32_t faces) {
            return largePoleOfQuads({2 * faces, 2});
        },
        5461);
}

TEST(ChainLimits, TrianglesRoundAVertex) {
    expectLimit(
        surface::loop::build,
        [](uint32_t faces) {
            return largePoleOfTriangles({faces, 2});
        },
        10922);
}

} // namespace
} // namespace supple::test
