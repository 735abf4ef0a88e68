// SUPPLE_CONTEXT_FAN_RECORDS: the positions of p-rep have the bits that they have without, in both mappings and in each
// form of evaluation, and so have the coefficients that inspection shows. What the flag does not reach stays as it is.
#include "tests/support/gpu_comparison.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/meshes.h"
#include "tools/common/procedural.h"

#include <gtest/gtest.h>
#include <set>

namespace supple::test {
namespace {

const uint32_t kLanePatches = 64; ///< instances of which a single patch is enough for a lane a patch

class FanRecords : public testing::TestWithParam<SuppleMapping> {
protected:
    void compare(const cage::Cage& cage, GpuOptions options) {
        options.mapping = GetParam();
        GpuSurface plain(*testDevice(), cage, options);
        options.contextFlags |= SUPPLE_CONTEXT_FAN_RECORDS;
        GpuSurface records(*testDevice(), cage, options);
        ASSERT_TRUE(plain.valid() && records.valid());
        plain.evaluate();
        records.evaluate();
        if ((options.flags & SUPPLE_GROUP_MOTION) != 0) {
            comparePrevious(plain, records);
        }
        for (const uint32_t instance : std::set<uint32_t>{0, options.instanceCount - 1}) {
            for (uint32_t p = 0; p < plain.patches().size(); ++p) {
                comparePatch(plain, records, instance, p);
            }
        }
    }
    void TearDown() override {
        positions_.print("positions");
        EXPECT_EQ(positions_.different, 0u);
        EXPECT_GT(positions_.samples, 0u);
        EXPECT_EQ(coefficients_.different, 0u);
        EXPECT_GT(coefficients_.samples, 0u);
        EXPECT_EQ(classes_.size(), 2u) << "regular and perturbed patches";
        EXPECT_LT(largestTurn_, 1e-3f) << "of normals";
    }

private:
    static void comparePrevious(GpuSurface& plain, GpuSurface& records) {
        std::vector<std::vector<std::byte>> all;
        for (GpuSurface* surface : {&plain, &records}) {
            surface->evaluate(); // now there is a frame before
            const SuppleBufferRange& range = surface->output().streams.previousPositions;
            Result<std::vector<std::byte>> read = testDevice()->readBuffer(
                range.buffer, range.offset, VkDeviceSize{surface->output().grid.vertexCount} * range.stride);
            ASSERT_TRUE(read.ok());
            all.push_back(std::move(*read));
        }
        EXPECT_EQ(all[0], all[1]);
    }
    void comparePatch(const GpuSurface& plain, const GpuSurface& records, uint32_t instance, uint32_t p) {
        const uint32_t patchClass = plain.patches()[p].patchClass;
        classes_.insert(patchClass);
        EXPECT_EQ(records.patches()[p].patchClass, patchClass);
        for (uint32_t s = 0; s < plain.sampleCount(p); ++s) {
            const GpuSurface::Vertex &a = plain.vertex(instance, p, s), &b = records.vertex(instance, p, s);
            positions_.compare(a.position, b.position);
            largestTurn_ = std::max(largestTurn_, glm::distance(a.normal, b.normal));
        }
        for (uint32_t k = 0; k < (patchClass == SUPPLE_PATCH_PERTURBED ? 32u : 16u); ++k) {
            coefficients_.compare(plain.coefficient(instance, p, k), records.coefficient(instance, p, k));
        }
    }

    ComparedBits positions_, coefficients_;
    std::set<uint32_t> classes_;
    float largestTurn_ = 0.0f;
};

/// Few patches: in the wide mapping a lane takes a row, or at another format one of fewer samples.
TEST_P(FanRecords, OfFewPatches) {
    const ValidationGuard guard;
    compare(perturbed(cage::makeSplitTorus(3, 3), 0.02f, 2), {.rate = 5});
    compare(perturbed(torus(5, 4), 0.02f, 3), {.rate = 4, .format = SUPPLE_VERTEX_16});
}

TEST_P(FanRecords, OfManyPatches) {
    const ValidationGuard guard;
    for (const cage::Cage& cage : {cage::makeSplitTorus(3, 3), torus(5, 4)}) {
        compare(perturbed(cage, 0.02f, 4),
                {.instanceCount = kLanePatches, .rate = 4, .format = SUPPLE_VERTEX_16, .flags = SUPPLE_GROUP_PATCHES});
    }
}

/// Open fans end in borders of their own; a corner with one face is sharp, or has a normal of its own.
TEST_P(FanRecords, OfBorders) {
    const ValidationGuard guard;
    for (const SuppleCornerRule corners : {SUPPLE_CORNERS_SHARP, SUPPLE_CORNERS_SMOOTH}) {
        compare(perturbed(withoutFaces(jack(), {0, 7}), 0.02f, 5), {.rate = 3, .corners = corners});
        compare(perturbed(grid(3, 2), 0.1f, 6), {.rate = 3, .corners = corners});
        compare(perturbed(fan(5, 2, 4.0, false), 0.05f, 7), {.rate = 3, .corners = corners});
    }
}

/// Far from the origin, and flat, where zeros have signs.
TEST_P(FanRecords, OfOddPlaces) {
    const ValidationGuard guard;
    cage::Cage far = perturbed(cage::makeSplitTorus(3, 3), 0.02f, 8);
    for (glm::vec3& p : far.positions) {
        p += glm::vec3(1e4f, -3e4f, 7e3f);
    }
    compare(far, {.rate = 4});
    compare(grid(4, 4), {.rate = 2});
}

/// Previous positions come from the records of the frame before.
TEST_P(FanRecords, OfTheFrameBefore) {
    const ValidationGuard guard;
    const uint32_t flags = SUPPLE_GROUP_PATCHES | SUPPLE_GROUP_MOTION;
    compare(perturbed(biped(), 0.02f, 10), {.rate = 3, .flags = flags});
}

TEST_P(FanRecords, InSharedDispatches) {
    const ValidationGuard guard;
    compare(perturbed(biped(), 0.02f, 9), {.contextFlags = SUPPLE_CONTEXT_SHARED_DISPATCHES, .rate = 4});
}

INSTANTIATE_TEST_SUITE_P(Mappings, FanRecords, testing::ValuesIn(kMappings),
                         [](const testing::TestParamInfo<SuppleMapping>& of) { return mappingName(of.param); });

} // namespace
} // namespace supple::test
