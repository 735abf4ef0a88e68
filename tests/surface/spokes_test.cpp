// How many edges a vertex may have: records of bicubic patches hold a step from one spoke to the next.
#include "shaders/shared/surface.h"
#include "surface/borders.h"
#include "surface/schemes.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace supple::surface {
namespace {

constexpr uint32_t kMost = shared::kMaxSpokeStep;

TEST(Spokes, StepsAreReadAsTheyAreWritten) {
    using namespace shared;
    constexpr uint32_t kLast = kMaxSpokes - 1;
    for (const auto& [spoke, next] :
         {std::pair(0u, 1u), {0u, kMost}, {kMost, 0u}, {kLast - kMost, kLast}, {kLast, kLast - kMost}}) {
        const uint32_t word = spokeWord(spoke, next);
        EXPECT_EQ(SUPPLE_SPOKE(word), spoke);
        EXPECT_EQ(SUPPLE_NEXT_SPOKE(word), next);
    }
}

TEST(Spokes, AVertexOfTooManyEdgesIsNamed) {
    for (const SchemeId scheme : {SchemeId::prep, SchemeId::pm}) {
        Recipe recipe;
        recipe.scheme = scheme;
        const Result<Tables> most = buildTables(recipe, test::fan(kMost, 2, 6.283185307179586, true));
        EXPECT_TRUE(most.ok()) << most.error().message;
        const Result<Tables> tooMany = buildTables(recipe, test::fan(kMost + 1, 2, 6.283185307179586, true));
        ASSERT_FALSE(tooMany.ok());
        EXPECT_EQ(tooMany.error().code, ErrorCode::limit);
        EXPECT_NE(tooMany.error().message.find("vertex 0 has 512 edges"), std::string::npos) << tooMany.error().message;
    }
}

} // namespace
} // namespace supple::surface
