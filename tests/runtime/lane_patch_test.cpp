// Wide mapping: where a group has patches enough, a lane takes a whole patch, or a sector of one. Every class of
// patches that does so has the positions of the narrow mapping, to the bit, in grids and inside of indexed meshes, with
// few samples and with many.
#include "tests/support/gpu_comparison.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/subdivision_zoo.h"
#include "tools/common/procedural.h"

#include <gtest/gtest.h>
#include <set>

namespace supple::test {
namespace {

constexpr uint32_t kInstances = 64; // a single patch of each is enough

void compareAll(host::Device& device, const cage::Cage& cage, GpuOptions options, ComparedBits& bits,
                std::set<uint32_t>& classes) {
    options.instanceCount = kInstances;
    options.format = SUPPLE_VERTEX_16;
    options.mapping = SUPPLE_MAPPING_NARROW;
    GpuSurface narrow(device, cage, options);
    options.mapping = SUPPLE_MAPPING_WIDE;
    GpuSurface wide(device, cage, options);
    ASSERT_TRUE(narrow.valid() && wide.valid());
    narrow.evaluate();
    wide.evaluate();
    const bool isMesh = (options.flags & SUPPLE_GROUP_INDEXED_MESH) != 0;
    for (const uint32_t instance : {0u, kInstances - 1}) {
        const uint32_t vertices = isMesh ? narrow.output().grid.drawRanges[0].samplesPerPatch : 0;
        for (uint32_t v = 0; v < vertices; ++v) {
            bits.compare(narrow.sharedVertex(instance, v).position, wide.sharedVertex(instance, v).position);
        }
        for (uint32_t p = 0; !isMesh && p < wide.patches().size(); ++p) {
            for (uint32_t s = 0; s < narrow.sampleCount(p); ++s) {
                bits.compare(narrow.vertex(instance, p, s).position, wide.vertex(instance, p, s).position);
            }
        }
    }
    for (const SupplePatchInfo& patch : wide.patches()) {
        classes.insert(patch.patchClass);
    }
}

class LanePatches : public testing::Test {
protected:
    void compare(const cage::Cage& cage, SuppleScheme scheme, uint32_t rate, uint32_t flags) {
        ASSERT_NO_FATAL_FAILURE(
            compareAll(*testDevice(), cage, {.rate = rate, .scheme = scheme, .flags = flags}, bits_, classes_));
    }
    void expectClasses(size_t count) const {
        bits_.print("positions");
        EXPECT_EQ(bits_.different, 0u);
        EXPECT_GT(bits_.samples, 0u);
        EXPECT_EQ(classes_.size(), count);
    }
    ComparedBits bits_;
    std::set<uint32_t> classes_;
};

constexpr uint32_t kMesh = SUPPLE_GROUP_INDEXED_MESH;

TEST_F(LanePatches, OfPm) {
    const ValidationGuard guard;
    for (const PmCage& zoo : pmZoo()) {
        if (zoo.name == "fan over triangles 5, hard ring") { // samples go through workgroup memory at low rates
            compare(zoo.cage, SUPPLE_SCHEME_PM, 4, 0);
        } else if (zoo.name == "fan over quads 5, hard ring" || zoo.name == "fan over pentagons 5, hard ring") {
            compare(zoo.cage, SUPPLE_SCHEME_PM, 9, kMesh);
        }
    }
    expectClasses(5);
}

TEST_F(LanePatches, OfPrep) {
    const ValidationGuard guard;
    compare(torus(7, 5), SUPPLE_SCHEME_PREP, 3, 0);
    compare(perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2), SUPPLE_SCHEME_PREP, 4, kMesh);
    expectClasses(2);
}

TEST_F(LanePatches, OfLoopAndBlend) {
    const ValidationGuard guard;
    const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
    for (size_t z = 0; z < zoo.size(); z += 48) {
        compare(zoo[z].cage, SUPPLE_SCHEME_LOOP, 4, z == 0 ? kMesh : 0);
        compare(zoo[z].cage, SUPPLE_SCHEME_BLEND, 3, 0);
    }
    expectClasses(6);
}

} // namespace
} // namespace supple::test
