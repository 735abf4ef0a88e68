// What two faces have in common must come out with the same bits from both, in float, as on the device.
#include "tests/support/blend_borders.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/subdivision_zoo.h"

#include <array>
#include <cstdio>

namespace supple::surface::blend {
namespace {

constexpr std::array<uint32_t, 5> kRates{1, 2, 3, 8, 17};

/// Cages of triangles, quads and others, with creases of all kinds, by name of their zoo.
template <class Visit>
void forEachCage(CreaseMode mode, Visit&& visit) {
    for (const test::SubdivisionCage& entry : test::subdivisionZoo()) {
        visit(entry.cage, test::blendMesh(entry.cage, {mode}));
    }
    for (const test::PmCage& entry : test::pmZoo()) {
        // Of the others moved ones with the same connectivity are there.
        if (entry.variant != test::PmVariant::plain && entry.variant != test::PmVariant::alphas) {
            visit(entry.cage, test::blendMesh(entry.cage, {mode}));
        }
    }
}

const char* modeName(CreaseMode mode) {
    return mode == CreaseMode::cut ? "cut" : "curve";
}

TEST(BlendBits, sharedPointsAgree) {
    for (const CreaseMode mode : test::kCreaseModes) {
        test::BlendCounts counts;
        forEachCage(mode,
                    [&](const cage::Cage& cage, const Mesh& mesh) { test::compareSides(cage, mesh, kRates, counts); });
        std::printf("%-5s %llu shared points, %llu differ\n", modeName(mode),
                    static_cast<unsigned long long>(counts.points), static_cast<unsigned long long>(counts.differ));
        EXPECT_GT(counts.points, 1000000u);
        EXPECT_EQ(counts.differ, 0u);
    }
}

TEST(BlendBits, floatsAreNearDoubles) {
    for (const CreaseMode mode : test::kCreaseModes) {
        test::BlendErrors errors;
        forEachCage(mode, [&](const cage::Cage& cage, const Mesh& mesh) { test::compareFloats(cage, mesh, errors); });
        std::printf("%-5s positions within %.1e of the extent, %llu of %llu normals off by more than 0.05 degrees\n",
                    modeName(mode), errors.position, static_cast<unsigned long long>(errors.turned),
                    static_cast<unsigned long long>(errors.normals));
        EXPECT_LT(errors.position, 4e-7);
        EXPECT_EQ(errors.notOfUnitLength, 0u);
        EXPECT_LT(static_cast<double>(errors.turned), 1e-4 * static_cast<double>(errors.normals));
    }
}

} // namespace
} // namespace supple::surface::blend
