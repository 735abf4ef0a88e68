// What checks tables from files: all tables that are built pass, and whatever does not fit is refused.
#include "surface/table_check.h"

#include "surface/schemes.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/table_cases.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <set>

namespace supple::surface {
namespace {

/// Cages of all kinds.
std::vector<test::NamedCage> cages() {
    std::vector<test::NamedCage> all{{"cube", test::cube()},
                                     {"grid", test::grid(4, 3)},
                                     {"one quad", test::grid(1, 1)},
                                     {"torus", test::torus(6, 5)},
                                     {"jack", test::jack()},
                                     {"biped", test::biped()},
                                     {"poles of valence 9", test::trapezohedron(9)},
                                     {"dodecahedron", test::dodecahedron()},
                                     {"octagonal prism", test::prism(8)}};
    for (const test::PmCage& own : test::pmZoo()) {
        all.push_back({own.name.c_str(), own.cage});
    }
    for (const test::SubdivisionCage& own : test::subdivisionZoo()) {
        all.push_back({own.name.c_str(), own.cage});
    }
    for (test::NamedCage& own : all) {
        own.cage = test::withAttributes(std::move(own.cage));
    }
    return all;
}

std::vector<SchemeId> checkedSchemes() {
    std::vector<SchemeId> checked;
    for (const Scheme& scheme : schemes()) {
        if (canCheckTables(scheme.id)) {
            checked.push_back(scheme.id);
        }
    }
    return checked;
}

/// One recipe's tables of every kShare-th cage from `first` on pass, if the scheme takes it. Returns how many it takes.
constexpr size_t kShare = 3;
size_t checkSome(const Recipe& recipe, const std::vector<test::NamedCage>& cages, size_t first,
                 double& mostPoolPerWord) {
    size_t taken = 0;
    for (size_t c = first; c < cages.size(); c += kShare) {
        const test::NamedCage& own = cages[c];
        const Result<Tables> tables = buildTables(recipe, own.cage);
        if (!tables) {
            continue;
        }
        const Status status = checkTables(*tables, test::sourceOf(recipe, own.cage));
        EXPECT_TRUE(status.ok()) << own.name << ", " << test::nameOf(recipe) << ": " << status.error().message;
        mostPoolPerWord = std::max(mostPoolPerWord,
                                   static_cast<double>(tables->poolStride) / static_cast<double>(tables->words.size()));
        ++taken;
    }
    return taken;
}

TEST(TableCheck, TablesThatAreBuiltPass) {
    const std::vector<test::NamedCage> all = cages();
    for (const SchemeId scheme : checkedSchemes()) {
        double mostPoolPerWord = 0.0;
        const std::vector<Recipe> recipes = test::recipesOf(scheme);
        for (size_t r = 0; r < recipes.size(); ++r) {
            EXPECT_GT(checkSome(recipes[r], all, r % kShare, mostPoolPerWord), 2u) << test::nameOf(recipes[r]);
        }
        std::printf("%s: at most %.2f coefficients of an instance's pool per word of the tables\n",
                    schemeOf(scheme).name, mostPoolPerWord);
        EXPECT_LT(mostPoolPerWord, 4.0); // half of what is refused
    }
}

/// Tables of P_m with whatever it can have, and of polygons.
struct Sample {
    Recipe recipe;
    cage::Cage cage;
    Tables tables;

    [[nodiscard]] Status check() const { return checkTables(tables, test::sourceOf(recipe, cage)); }
};
Sample sampleOf(Recipe recipe, const cage::Cage& cage) {
    Sample sample{std::move(recipe), test::withAttributes(cage), {}};
    Result<Tables> tables = buildTables(sample.recipe, sample.cage);
    EXPECT_TRUE(tables.ok());
    if (tables) {
        sample.tables = std::move(*tables);
    }
    return sample;
}
Sample pmSample() {
    Recipe recipe;
    recipe.lod = recipe.indexedMesh = recipe.tangents = true;
    recipe.uvMode = cage::UvMode::cornersPlus1;
    return sampleOf(recipe, test::fanOverPentagons(6));
}
Sample polygonsSample() {
    Recipe recipe;
    recipe.scheme = SchemeId::polygons;
    recipe.tangents = true;
    return sampleOf(recipe, test::prism(8));
}

/// A change, and how the message begins.
struct Change {
    const char* message;
    void (*make)(Tables&);
};
/// Makes one change after the other, each in tables that are whole.
void expectRefused(const Sample& sample, std::span<const Change> changes) {
    ASSERT_TRUE(sample.check().ok()) << sample.check().error().message;
    for (size_t c = 0; c < changes.size(); ++c) {
        Sample changed = sample;
        changes[c].make(changed.tables);
        const Status status = changed.check();
        ASSERT_FALSE(status.ok()) << "change " << c << ": " << changes[c].message;
        EXPECT_EQ(status.error().code, ErrorCode::asset);
        EXPECT_EQ(status.error().message, changes[c].message) << "change " << c;
    }
}

TEST(TableCheck, PatchesAndRanges) {
    constexpr Change kChanges[] = {
        {"patches: an unknown class", [](Tables& t) { t.patches[3].patchClass = static_cast<PatchClass>(16); }},
        {"patches: a count of corners not its class's", [](Tables& t) { t.patches[3].cornerCount = 6; }},
        {"patches: 18, of 18 faces", [](Tables& t) { t.patches[3].face = 18; }},
        {"patches: 14, of 14 cage vertices", [](Tables& t) { t.patches[3].corners[1] = 14; }},
        {"patches: 2, of 2 parts", [](Tables& t) { t.patches[3].part = 2; }},
        {"patches: 2, of 2 materials", [](Tables& t) { t.patches[3].material = 2; }},
        {"patches: there are none", [](Tables& t) { t.patches.clear(); }},
        {"ranges of patches: they do not have all patches", [](Tables& t) { t.ranges.pop_back(); }},
        {"ranges of patches: classes out of order", [](Tables& t) { std::swap(t.ranges[0], t.ranges[1]); }},
        {"ranges of patches: an unknown class",
         [](Tables& t) { t.ranges.back().patchClass = static_cast<PatchClass>(99); }},
        {"ranges of patches: a class without records",
         [](Tables& t) { t.ranges.back().patchClass = PatchClass::triangle; }},
        {"ranges of patches: a patch of another class",
         [](Tables& t) { t.ranges.back().patchClass = PatchClass::blend; }},
        {"ranges of patches: they do not follow each other", [](Tables& t) { ++t.ranges[0].firstPatch; }},
        {"ranges of patches: they do not follow each other", [](Tables& t) { t.ranges[0].section.count = 0; }},
        {"draw ranges: they do not have all patches", [](Tables& t) { t.drawRanges.pop_back(); }},
        {"draw ranges: they do not follow each other", [](Tables& t) { ++t.drawRanges[1].firstPatch; }},
        {"draw ranges: a patch of another domain", [](Tables& t) { t.drawRanges[0].domain = static_cast<Domain>(4); }},
        {"draw ranges: a patch of another part or material", [](Tables& t) { t.drawRanges[0].part ^= 1; }},
        {"draw ranges: a patch of another part or material", [](Tables& t) { t.drawRanges[0].material = 7; }},
    };
    expectRefused(pmSample(), kChanges);
}

TEST(TableCheck, LayoutAndRecipe) {
    constexpr Change kChanges[] = {
        {"pool: instances do not begin on 256 bytes", [](Tables& t) { t.poolStride += 8; }},
        {"pool: too large for these tables", [](Tables& t) { t.poolStride = 1u << 30; }},
        {"pool: 4294967295, of 256 coefficients", [](Tables& t) { t.tangents = ~0u; }},
        {"pool: 4294967295, of 256 coefficients", [](Tables& t) { t.faces = ~0u; }},
        {"pool: 4294967295, of 256 coefficients", [](Tables& t) { t.inner = ~0u; }},
        {"tables: no whole elements", [](Tables& t) { t.words.push_back(0); }},
        {"tables: neither one UV set nor two", [](Tables& t) { t.uvSets = 3; }},
        {"tables: texture coordinates not as the recipe says",
         [](Tables& t) { t.uvMode = static_cast<cage::UvMode>(7); }},
        {"tables: leaves of texture coordinates", [](Tables& t) { t.uvLeaves = true; }},
        {"tables: frames of normal maps not as the recipe says", [](Tables& t) { t.mapFrames = true; }},
        {"tables: corner normals that the scheme does not have", [](Tables& t) { t.cornerNormals = true; }},
        {"tables: steps of subdivision", [](Tables& t) { t.isolationSteps = 33; }},
        {"tables: made for another rate", [](Tables& t) { t.rate = 8; }},
        {"tables: fragments", [](Tables& t) { t.fragments.classes.resize(1); }},
        {"tables: triangles not as the recipe says",
         [](Tables& t) {
             t.triangles.indices = {0, 1, 2};
         }},
        {"tables: levels of detail not as the recipe says", [](Tables& t) { t.lod = {}; }},
        {"tables: an indexed mesh not as the recipe says", [](Tables& t) { t.mesh = {}; }},
        {"constructions: an unknown stage", [](Tables& t) { t.constructions[0].stage = static_cast<Stage>(3); }},
        {"constructions: an unknown kernel", [](Tables& t) { t.constructions[0].kernel.kernel = Kernel::count; }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[0].kernel.kernel = Kernel::prepVertex; }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[0].kernel.kind = 77; }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[0].kernel.name = "another"; }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[0].kernel.name = nullptr; }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[0].stage = Stage::assemble; }},
    };
    expectRefused(pmSample(), kChanges);
}

} // namespace
} // namespace supple::surface
