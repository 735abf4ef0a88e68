// At levels a lane of the wide mapping takes a line of samples of a patch, where its class has lines. It has the
// positions of the narrow mapping, to the bit, on borders and inside, at all capacities and whatever levels are.
#include "runtime/arrays/character_arrays.h"
#include "surface/lod/grid.h"
#include "surface/patch_class.h"
#include "tests/support/exact_tables.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_random.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/prep_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/tangent_word.h"
#include "tests/support/worst.h"
#include "tools/common/cage_arrays.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

namespace supple::test {
namespace {

using surface::PatchClass;

/// What both mappings draw of cages.
class Mappings {
public:
    explicit Mappings(RandomLevels::Options options = {})
        : narrow_(with(options, SUPPLE_MAPPING_NARROW)), wide_(with(options, SUPPLE_MAPPING_WIDE)) {}

    void compare(const cage::Cage& cage, SuppleScheme scheme, RandomLevels::Range range) {
        narrow_.setRange(range);
        wide_.setRange(range);
        const std::optional<RandomLevels::Drawn> narrow = draw(narrow_, cage, scheme);
        const std::optional<RandomLevels::Drawn> wide = draw(wide_, cage, scheme);
        ASSERT_TRUE(narrow.has_value() && wide.has_value());
        compareDrawn(*narrow, *wide);
    }
    /// Classes with lines have come in all capacities.
    void expectSame(const std::set<PatchClass>& classes) const {
        positions_.print("positions");
        std::printf("normals within %.2g degrees, tangents within %.2g\n", worstNormal_, worstTangent_);
        EXPECT_EQ(positions_.different, 0u);
        EXPECT_LE(worstNormal_, 0.05);
        EXPECT_LE(worstTangent_, 0.05);
        EXPECT_EQ(otherSigns_, 0u);
        std::set<PatchClass> found;
        for (const auto& [patchClass, capacities] : capacities_) {
            found.insert(patchClass);
            if (surface::hasLines(patchClass)) {
                EXPECT_EQ(capacities.size(), surface::lod::kCapacities.size()) << surface::className(patchClass);
            }
        }
        EXPECT_EQ(found, classes);
    }
    [[nodiscard]] uint64_t tangents() const { return tangents_; }

private:
    static RandomLevels::Options with(RandomLevels::Options options, SuppleMapping mapping) {
        options.mapping = mapping;
        // By their own words narrow lanes evaluate records: there is no bucket's to go by.
        options.wrongCapacities = options.wrongCapacities && mapping == SUPPLE_MAPPING_WIDE;
        return options;
    }
    static std::optional<RandomLevels::Drawn> draw(RandomLevels& random, const cage::Cage& cage, SuppleScheme scheme) {
        const host::CageArrays arrays(cage);
        Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, "cage");
        if (!character.ok() || !random.valid()) {
            ADD_FAILURE() << (character.ok() ? "no context" : character.error().message);
            return std::nullopt;
        }
        SuppleGroupDesc desc{};
        desc.scheme = scheme;
        return random.draw(std::move(*character), desc);
    }
    void compareDrawn(const RandomLevels::Drawn& narrow, const RandomLevels::Drawn& wide) {
        std::map<uint32_t, LodSurface::Patch> ofWide; // records lie in any order
        for (const LodSurface::Patch& patch : wide.surface.patches) {
            ofWide[patch.patch] = patch;
        }
        ASSERT_EQ(ofWide.size(), narrow.surface.patches.size());
        for (const LodSurface::Patch& patch : narrow.surface.patches) {
            const LodSurface::Patch& other = ofWide[patch.patch];
            ASSERT_EQ(patch.capacity, other.capacity);
            ASSERT_EQ(patch.levels, other.levels);
            const PatchClass patchClass = narrow.patches[patch.patch].patchClass;
            capacities_[patchClass].insert(patch.capacity);
            for (uint32_t s = 0; s < surface::lod::sampleCount(surface::rowOf(patchClass).form, patch.capacity); ++s) {
                compareSample(narrow.surface, patch.firstVertex + s, wide.surface, other.firstVertex + s);
            }
        }
    }
    void compareSample(const LodSurface& narrow, uint32_t vertex, const LodSurface& wide, uint32_t other) {
        positions_.compare(std::bit_cast<glm::vec3>(narrow.positions[vertex]),
                           std::bit_cast<glm::vec3>(wide.positions[other]));
        raise(worstNormal_, angleDegrees(narrow.normals[vertex], wide.normals[other]));
        if (!narrow.tangents.empty()) {
            const glm::dvec4 a = decodeTangent(narrow.tangents[vertex]), b = decodeTangent(wide.tangents[other]);
            raise(worstTangent_, angleDegrees(glm::dvec3(a), glm::dvec3(b)));
            otherSigns_ += a.w != b.w ? 1 : 0;
            ++tangents_;
        }
    }
    RandomLevels narrow_, wide_;
    ComparedBits positions_;
    double worstNormal_ = 0.0, worstTangent_ = 0.0; ///< degrees
    uint64_t tangents_ = 0, otherSigns_ = 0;
    std::map<PatchClass, std::set<uint32_t>> capacities_;
};

/// Texture coordinates that go on from face to face.
cage::Cage withUvsOfPositions(cage::Cage cage) {
    cage.cornerUvs.clear();
    for (const uint32_t v : cage.faceVertices) {
        const glm::vec3& p = cage.positions[v];
        cage.cornerUvs.emplace_back(p.x + 0.37f * p.z + 0.1f * p.y * p.y, p.y - 0.21f * p.z);
    }
    return cage;
}

struct Variant {
    const char* name;
    RandomLevels::Options options;
};
RandomLevels::Options smallWithTangents() {
    RandomLevels::Options options;
    options.vertexFormat = SUPPLE_VERTEX_16;
    options.tangents = true;
    return options;
}
RandomLevels::Options wrongCapacities() {
    RandomLevels::Options options;
    options.wrongCapacities = true;
    return options;
}

class LodMappings : public testing::TestWithParam<Variant> {
protected:
    void compare(const cage::Cage& cage, SuppleScheme scheme) {
        mappings_.compare(withUvsOfPositions(cage), scheme, RandomLevels::Range::all);
        compareLow(cage, scheme);
    }
    /// Levels are low, capacities are not.
    void compareLow(const cage::Cage& cage, SuppleScheme scheme) {
        mappings_.compare(withUvsOfPositions(cage), scheme, RandomLevels::Range::low);
        mappings_.compare(withUvsOfPositions(cage), scheme, RandomLevels::Range::least);
    }
    /// Some of the zoo: it has five variants of a cage, smooth ones and sharp ones, and a step that five does not
    /// divide meets them all.
    void compareZoo(SuppleScheme scheme, size_t step) {
        const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
        for (size_t z = 0; z < zoo.size(); z += step) {
            SCOPED_TRACE(zoo[z].name);
            compare(zoo[z].cage, scheme);
        }
    }
    /// Edges of different sharpness at a corner, fractions, darts, sharp vertices, endless creases, boundaries, holes.
    void compareSharp(SuppleScheme scheme) {
        const std::set<std::string> names{"dart of 1.200000", "dart at a sharp vertex of 3.300000",
                                          "creases of different sharpness", "crease into a boundary"};
        size_t found = 0;
        for (const SubdivisionCage& zoo : subdivisionZoo()) {
            if (names.contains(zoo.name)) {
                SCOPED_TRACE(zoo.name);
                compare(zoo.cage, scheme);
                ++found;
            }
        }
        EXPECT_EQ(found, names.size());
        cage::Cage holed = withRandomSharpness(perturbed(torus(6, 5), 0.05f, 3), 3);
        holed.holes = {2, 9, 10};
        compare(holed, scheme);
    }
    void expectSame(const std::set<PatchClass>& classes) const {
        mappings_.expectSame(classes);
        EXPECT_EQ(mappings_.tangents() > 0, GetParam().options.tangents);
    }

private:
    ValidationGuard guard_;
    Mappings mappings_{GetParam().options};
};

TEST_P(LodMappings, OfPm) {
    for (const PmCage& zoo : pmZoo()) {
        if (zoo.name == "fan over triangles 5, hard ring" || zoo.name == "fan over quads 5, hard ring" ||
            zoo.name == "fan over pentagons 5, hard ring") {
            compare(zoo.cage, SUPPLE_SCHEME_PM);
        }
    }
    for (uint32_t seed = 1; seed <= 5; ++seed) {
        compareLow(perturbed(dodecahedron(), 0.05f, seed), SUPPLE_SCHEME_PM);
        compareLow(perturbed(trapezohedron(5), 0.05f, seed), SUPPLE_SCHEME_PM);
    }
    compareLow(perturbed(quartered(gyroBipyramid(5)), 0.02f, 1), SUPPLE_SCHEME_PM);
    compareLow(perturbed(quartered(gyroBipyramid(5)), 0.02f, 2), SUPPLE_SCHEME_PM);
    compareLow(torus(12, 9), SUPPLE_SCHEME_PM);
    expectSame({PatchClass::regular, PatchClass::polar, PatchClass::p3, PatchClass::p4, PatchClass::p5});
}

TEST_P(LodMappings, OfPrep) {
    compareLow(torus(12, 9), SUPPLE_SCHEME_PREP);
    compare(perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2), SUPPLE_SCHEME_PREP);
    expectSame({PatchClass::regular, PatchClass::perturbed});
}

TEST_P(LodMappings, OfCatmullClark) {
    compareZoo(SUPPLE_SCHEME_CATMULL_CLARK, 41);
    compareSharp(SUPPLE_SCHEME_CATMULL_CLARK);
    compareLow(torus(12, 9), SUPPLE_SCHEME_CATMULL_CLARK);
    for (uint32_t seed = 1; seed <= 6; ++seed) {
        compare(perturbed(straightCrease(), 0.05f, seed), SUPPLE_SCHEME_CATMULL_CLARK);
    }
    expectSame({PatchClass::regular, PatchClass::irregular, PatchClass::irregularSharp, PatchClass::creased});
}

TEST_P(LodMappings, OfLoop) {
    compareZoo(SUPPLE_SCHEME_LOOP, 48);
    compareLow(quartered(quartered(gyroBipyramid(6))), SUPPLE_SCHEME_LOOP);
    expectSame({PatchClass::loopRegular, PatchClass::loopIrregular, PatchClass::loopIrregularSharp});
}

TEST_P(LodMappings, OfBlend) {
    compareZoo(SUPPLE_SCHEME_BLEND, 41);
    compareSharp(SUPPLE_SCHEME_BLEND);
    compareLow(torus(12, 9), SUPPLE_SCHEME_BLEND);
    expectSame({PatchClass::blend, PatchClass::blendSharp, PatchClass::blendRegular});
}

INSTANTIATE_TEST_SUITE_P(Options, LodMappings,
                         testing::Values(Variant{"Plain", {}}, Variant{"SmallWithTangents", smallWithTangents()},
                                         Variant{"WrongCapacities", wrongCapacities()}),
                         [](const auto& variant) { return std::string(variant.param.name); });

} // namespace
} // namespace supple::test
