// At levels a lane of the wide mapping takes a line of samples of a patch, where its class has lines. It has the
// positions of the narrow mapping, to the bit, on borders and inside, whatever levels and capacities are.
#include "runtime/arrays/character_arrays.h"
#include "surface/lod/grid.h"
#include "surface/patch_class.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_random.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/prep_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tools/common/cage_arrays.h"
#include "tools/common/procedural.h"

#include <bit>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace supple::test {
namespace {

/// What a crowd of cages has come to.
struct Compared {
    ComparedBits positions;
    double worstNormal = 0.0; ///< degrees
    std::set<surface::PatchClass> classes;
    std::set<uint32_t> capacities;
};

class LodMappings : public testing::Test {
protected:
    void compare(const cage::Cage& cage, SuppleScheme scheme) {
        const std::optional<RandomLevels::Drawn> narrow = draw(narrow_, cage, scheme), wide = draw(wide_, cage, scheme);
        ASSERT_TRUE(narrow.has_value() && wide.has_value());
        std::map<uint32_t, LodSurface::Patch> ofWide; // records lie in any order
        for (const LodSurface::Patch& patch : wide->surface.patches) {
            ofWide[patch.patch] = patch;
        }
        ASSERT_EQ(ofWide.size(), narrow->surface.patches.size());
        for (const LodSurface::Patch& patch : narrow->surface.patches) {
            const LodSurface::Patch& other = ofWide[patch.patch];
            ASSERT_EQ(patch.capacity, other.capacity);
            ASSERT_EQ(patch.levels, other.levels);
            const surface::PatchClass patchClass = narrow->patches[patch.patch].patchClass;
            comparePatch(*narrow, patch, *wide, other, surface::rowOf(patchClass).form);
            compared_.classes.insert(patchClass);
            compared_.capacities.insert(patch.capacity);
        }
    }
    void expectSame(const std::set<surface::PatchClass>& classes) const {
        compared_.positions.print("positions");
        std::printf("normals within %.2g degrees\n", compared_.worstNormal);
        EXPECT_EQ(compared_.positions.different, 0u);
        EXPECT_LE(compared_.worstNormal, 0.05);
        EXPECT_EQ(compared_.classes, classes);
        EXPECT_GE(compared_.capacities.size(), 3u); // chance gives most patches a level near 63
    }

private:
    static std::optional<RandomLevels::Drawn> draw(RandomLevels& random, const cage::Cage& cage, SuppleScheme scheme) {
        const host::CageArrays arrays(cage);
        Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, "cage");
        EXPECT_TRUE(character.ok());
        SuppleGroupDesc desc{};
        desc.scheme = scheme;
        return random.draw(std::move(*character), desc);
    }
    void comparePatch(const RandomLevels::Drawn& narrow, const LodSurface::Patch& patch,
                      const RandomLevels::Drawn& wide, const LodSurface::Patch& other, surface::lod::Form form) {
        for (uint32_t s = 0; s < surface::lod::sampleCount(form, patch.capacity); ++s) {
            compared_.positions.compare(std::bit_cast<glm::vec3>(narrow.surface.positions[patch.firstVertex + s]),
                                        std::bit_cast<glm::vec3>(wide.surface.positions[other.firstVertex + s]));
            raise(compared_.worstNormal, angleDegrees(narrow.surface.normals[patch.firstVertex + s],
                                                      wide.surface.normals[other.firstVertex + s]));
        }
    }
    RandomLevels narrow_{SUPPLE_MAPPING_NARROW}, wide_{SUPPLE_MAPPING_WIDE};
    Compared compared_;
};

using surface::PatchClass;

TEST_F(LodMappings, OfPm) {
    const ValidationGuard guard;
    for (const PmCage& zoo : pmZoo()) {
        if (zoo.name == "fan over triangles 5, hard ring" || zoo.name == "fan over quads 5, hard ring" ||
            zoo.name == "fan over pentagons 5, hard ring") {
            compare(zoo.cage, SUPPLE_SCHEME_PM);
        }
    }
    compare(torus(7, 5), SUPPLE_SCHEME_PM);
    expectSame({PatchClass::regular, PatchClass::polar, PatchClass::p3, PatchClass::p4, PatchClass::p5});
}

TEST_F(LodMappings, OfPrep) {
    const ValidationGuard guard;
    compare(torus(7, 5), SUPPLE_SCHEME_PREP);
    compare(perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2), SUPPLE_SCHEME_PREP);
    expectSame({PatchClass::regular, PatchClass::perturbed});
}

TEST_F(LodMappings, OfLoop) {
    const ValidationGuard guard;
    const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
    for (size_t z = 0; z < zoo.size(); z += 48) {
        compare(zoo[z].cage, SUPPLE_SCHEME_LOOP);
    }
    expectSame({PatchClass::loopRegular, PatchClass::loopIrregular, PatchClass::loopIrregularSharp});
}

TEST_F(LodMappings, OfBlend) {
    const ValidationGuard guard;
    const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
    for (size_t z = 0; z < zoo.size(); z += 96) {
        compare(zoo[z].cage, SUPPLE_SCHEME_BLEND);
    }
    compare(torus(7, 5), SUPPLE_SCHEME_BLEND);
    expectSame({PatchClass::blend, PatchClass::blendRegular});
}

} // namespace
} // namespace supple::test
