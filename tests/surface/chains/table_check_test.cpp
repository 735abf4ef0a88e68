// Checks of tables that come from files (surface/table_check.h): what Catmull-Clark and Loop build passes, and what is
// not theirs is refused with what is wrong. Single words: table_words_test.cpp.
#include "cage/gltf/reader.h"
#include "tests/support/exact_tables.h"
#include "tests/support/large_pole.h"
#include "tests/support/shared_assets.h"
#include "tools/common/procedural.h"

#include <gtest/gtest.h>
#include <random>

namespace supple::test {
namespace {

using surface::Recipe;
using surface::SchemeId;
using surface::Tables;

std::vector<NamedCage> smallCages() {
    const double turn = 6.283185307179586;
    std::vector<NamedCage> cages;
    for (auto& [name, cage] : std::vector<NamedCage>{{"cube", cube()},
                                                     {"grid", grid(4, 3)},
                                                     {"torus", torus(5, 4)},
                                                     {"dodecahedron", dodecahedron()},
                                                     {"jack", jack()},
                                                     {"biped", biped()},
                                                     {"prism", prism(7)},
                                                     {"capped cylinder", cappedCylinder(6, 4)},
                                                     {"bipyramid", gyroBipyramid(5)},
                                                     {"quartered", quartered(gyroBipyramid(7))},
                                                     {"trapezohedron", trapezohedron(40)},
                                                     {"open fan", fan(1, 2, 0.25 * turn, false)},
                                                     {"open fans", fan(5, 3, 0.75 * turn, false)},
                                                     {"disk", fan(3, 3, turn, true)},
                                                     {"split torus", cage::makeSplitTorus(4, 3)},
                                                     {"cut quads", withCutQuads(torus(7, 6), 0.3, 1)}}) {
        cages.push_back({name, rotatedFaces(perturbed(std::move(cage), 0.05f, 3))});
    }
    cage::Cage holes = grid(5, 5);
    holes.holes = {6, 7, 12};
    holes.roundCorners = {0};
    holes.sharpVertices = {{13, 1.5f}, {20, 10.0f}};
    for (uint32_t f = 0; f < holes.faceCount(); ++f) {
        holes.faceMaterials.push_back(f % 3);
        holes.faceParts.push_back(f / 13);
    }
    cages.push_back({"holes", std::move(holes)});
    cages.push_back({"straight crease", straightCrease()});
    return cages;
}

/// Expects that they pass, for whatever of these the scheme builds. How many there were.
uint32_t expectPasses(const char* name, const cage::Cage& cage, const std::vector<Recipe>& recipes,
                      const std::vector<uint32_t>& rates) {
    uint32_t passed = 0;
    for (const Recipe& recipe : recipes) {
        for (const uint32_t rate : rates) {
            const Result<ExactTables> made = makeExactTables(recipe, rate, cage);
            if (!made) {
                continue; // every scheme refuses a face without a split
            }
            const Status status = made->check();
            EXPECT_TRUE(status) << name << ", rate " << rate << ", scheme " << static_cast<uint32_t>(recipe.scheme)
                                << ", UV mode " << static_cast<uint32_t>(recipe.uvMode) << ": "
                                << status.error().message;
            passed += status ? 1 : 0;
        }
    }
    return passed;
}

std::vector<Recipe> allRecipes(SchemeId scheme) {
    std::vector<Recipe> recipes;
    for (const bool wide : {false, true}) {
        for (const bool attributes : {false, true}) {
            Recipe recipe;
            recipe.scheme = scheme;
            recipe.wide = wide;
            recipe.attributes = attributes;
            recipes.push_back(recipe);
            recipe.indexedMesh = true;
            recipes.push_back(recipe);
            recipe.tangents = attributes;
            recipes.push_back(recipe);
            recipe.indexedMesh = recipe.tangents = false;
            recipe.lod = true;
            recipes.push_back(recipe);
        }
        using cage::UvMode;
        for (const UvMode mode : {UvMode::none, UvMode::cornersOnly, UvMode::cornersPlus1, UvMode::boundaries}) {
            Recipe recipe;
            recipe.scheme = scheme;
            recipe.wide = wide;
            recipe.uvMode = mode;
            recipe.lod = mode == UvMode::cornersOnly;
            recipe.indexedMesh = mode == UvMode::boundaries;
            recipes.push_back(recipe);
        }
    }
    return recipes;
}

TEST(ExactTableCheck, TablesOfSmallCagesPass) {
    uint32_t passed = 0;
    for (const NamedCage& cage : smallCages()) {
        for (const SchemeId scheme : {SchemeId::catmullClark, SchemeId::loop}) {
            const std::vector<Recipe> recipes = allRecipes(scheme);
            uint32_t own = expectPasses(cage.name, cage.cage, recipes, {2, 8, 64});
            own += expectPasses(cage.name, withCharts(cage.cage), recipes, {4});
            own += expectPasses(cage.name, withCharts(withCreases(cage.cage, false), true), recipes, {2, 16});
            own += expectPasses(cage.name, withCharts(withCreases(cage.cage, true)), recipes, {6});
            EXPECT_TRUE(own > 0 || scheme == SchemeId::loop) << cage.name;
            passed += own;
        }
    }
    EXPECT_GT(passed, 3000u);
}

TEST(ExactTableCheck, TablesOfLargePolesPass) {
    for (const bool wide : {false, true}) {
        Recipe recipe;
        recipe.wide = wide;
        recipe.lod = true;
        recipe.scheme = SchemeId::catmullClark;
        EXPECT_EQ(expectPasses("pole of quads", largePoleOfQuads(), {recipe}, {8}), 1u);
        recipe.scheme = SchemeId::loop;
        EXPECT_EQ(expectPasses("pole of triangles", withCharts(largePoleOfTriangles()), {recipe}, {8}), 1u);
        recipe.lod = false;
        recipe.indexedMesh = true;
        recipe.uvMode = cage::UvMode::cornersOnly;
        EXPECT_EQ(expectPasses("pole of triangles", withCharts(largePoleOfTriangles()), {recipe}, {8}), 1u);
    }
}

// Whole words in stencils and in the numbers of attributes.
TEST(ExactTableCheck, TablesOfLargeCagesPass) {
    for (const SchemeId scheme : {SchemeId::catmullClark, SchemeId::loop}) {
        Recipe recipe;
        recipe.scheme = scheme;
        EXPECT_EQ(expectPasses("cube sphere", withCharts(cage::makeCubeSphere(106)), {recipe}, {4}), 1u);
        recipe.uvMode = cage::UvMode::boundaries;
        recipe.lod = true;
        EXPECT_EQ(expectPasses("split torus", withCharts(cage::makeSplitTorus(40, 30)), {recipe}, {4}), 1u);
    }
}

TEST(ExactTableCheck, TablesOfCharactersPass) {
    for (const std::string& path : allCharacters()) {
        const Result<cage::Character> character = cage::readGltfFile(path);
        if (!character) {
            continue; // some are there to be refused
        }
        for (const SchemeId scheme : {SchemeId::catmullClark, SchemeId::loop}) {
            Recipe recipe;
            recipe.scheme = scheme;
            recipe.lod = true;
            recipe.wide = true;
            recipe.uvMode = cage::UvMode::cornersOnly;
            Recipe mesh;
            mesh.scheme = scheme;
            mesh.indexedMesh = mesh.tangents = true;
            (void)expectPasses(path.c_str(), character->cage, {recipe, mesh}, {4});
        }
    }
}

/// Tables of a cage with chains, creases and smooth texture coordinates.
ExactTables mixedTables(SchemeId scheme, bool wide = false, bool lod = false) {
    Recipe recipe;
    recipe.scheme = scheme;
    recipe.wide = wide;
    recipe.lod = lod;
    recipe.uvMode = cage::UvMode::cornersOnly;
    const bool loop = scheme == SchemeId::loop;
    const cage::Cage cage = withCharts(withCreases(withoutFaces(jack(), {0, 9}), !loop), true);
    Result<ExactTables> made = makeExactTables(recipe, 8, cage);
    EXPECT_TRUE(made) << made.error().message;
    return made ? std::move(*made) : ExactTables{};
}

void expectRefused(const ExactTables& made, const Tables& changed, const std::string& message) {
    const Status status = made.check(changed);
    ASSERT_FALSE(status) << message;
    EXPECT_EQ(status.error().code, ErrorCode::asset);
    EXPECT_EQ(status.error().message, message);
}

TEST(ExactTableCheck, SaysWhatIsWrong) {
    const ExactTables made = mixedTables(SchemeId::catmullClark);
    Tables tables = made.tables;
    const std::string pool = " of " + std::to_string(tables.poolStride) + " coefficients";
    const std::string elements = " of " + std::to_string(tables.words.size() / 4) + " elements";
    const surface::PatchRange& range = tables.ranges.back();
    const uint64_t first = uint64_t{4} * range.section.table;
    const auto netList = std::find_if(tables.words.begin() + static_cast<ptrdiff_t>(first) + 8, tables.words.end(),
                                      [](uint32_t word) { return word != 0; });
    *netList = 0xFFFFFFFFu;
    expectRefused(made, tables, "irregular quads: 4294967295 and 3 more," + elements);
    tables = made.tables;
    tables.words[4 * range.smoothUvs] = 0xFFFFFFFFu;
    expectRefused(made, tables,
                  "smooth texture coordinates: 4294967295, of " + std::to_string(tables.words.size() / 2) +
                      " pairs of floats");
    tables = made.tables;
    tables.constructions.back().kernel = {surface::Kernel::pmFacet, 0};
    expectRefused(made, tables, "constructions: a kernel that the scheme does not run there");
    tables = made.tables;
    const auto limits = std::ranges::find_if(tables.constructions, [](const surface::Construction& c) {
        return c.kernel.kernel == surface::Kernel::chainsChain && c.kernel.kind == shared::kMakesLimits;
    });
    ASSERT_NE(limits, tables.constructions.end());
    tables.words[4 * limits->section.table + 3] = 0xFFFFFFFFu;
    expectRefused(made, tables, "vertices with chains: 4294967295," + pool);
    tables = made.tables;
    tables.words[4 * tables.constructions.back().section.table + 1] += 1; // a record has two elements
    expectRefused(made, tables, "blocks of chains: not at the record of a vertex, or none");
    tables = made.tables;
    tables.words[4 * tables.constructions.front().section.table] = 0xFFFFFFFFu;
    expectRefused(made, tables, "plain vertices: 4294967295 and 1 more, of 16 spokes");
}

// What tells the last level of chains is not written by anything else.
TEST(ExactTableCheck, DepthIsWrittenOnce) {
    for (const SchemeId scheme : {SchemeId::catmullClark, SchemeId::loop}) {
        const ExactTables made = mixedTables(scheme, false, true);
        ASSERT_TRUE(made.check());
        Tables tables = made.tables;
        ASSERT_GT(tables.lod.depth, 0u);
        for (uint32_t depth = 1; depth < made.tables.lod.depth; ++depth) {
            tables.lod.depth = depth;
            EXPECT_FALSE(made.check(tables)) << depth;
        }
        tables = made.tables;
        tables.lod.depth = 0;
        EXPECT_FALSE(made.check(tables));
    }
}

// Any words and members: the check comes to an end, and reads nothing beyond the tables (under AddressSanitizer).
TEST(ExactTableCheck, ArbitraryTablesAreHarmless) {
    std::mt19937 random(7);
    uint32_t refused = 0;
    constexpr uint32_t kTries = 10000;
    for (const SchemeId scheme : {SchemeId::catmullClark, SchemeId::loop}) {
        const ExactTables made = mixedTables(scheme, true, true);
        ASSERT_TRUE(made.check()) << made.check().error().message;
        for (uint32_t n = 0; n < kTries; ++n) {
            Tables tables = made.tables;
            const auto any = [&](uint32_t value) {
                const uint32_t kinds[] = {static_cast<uint32_t>(random()),
                                          value + 1 + static_cast<uint32_t>(random()) % 8,
                                          static_cast<uint32_t>(random()) % 16,
                                          static_cast<uint32_t>(random()) % made.tables.poolStride,
                                          0xFFFFFFFFu - static_cast<uint32_t>(random()) % 40,
                                          tables.words[random() % tables.words.size()]};
                return kinds[random() % std::size(kinds)];
            };
            for (uint32_t changes = 1 + static_cast<uint32_t>(random()) % 3; changes > 0; --changes) {
                uint32_t& word = tables.words[random() % tables.words.size()];
                word = any(word);
            }
            if (n % 4 == 0) {
                surface::Construction& construction = tables.constructions[random() % tables.constructions.size()];
                uint32_t* const members[] = {&tables.poolStride,
                                             &tables.tangents,
                                             &tables.faces,
                                             &tables.meshVertices,
                                             &tables.ring,
                                             &construction.section.table,
                                             &construction.section.count,
                                             &construction.from,
                                             &construction.to,
                                             &construction.kernel.kind,
                                             &tables.ranges.back().section.table,
                                             &tables.ranges.back().smoothUvs,
                                             &tables.lod.depth,
                                             &tables.lod.depthLanes,
                                             &tables.rate};
                uint32_t& member = *members[random() % std::size(members)];
                member = any(member);
            }
            refused += made.check(tables) ? 0 : 1;
        }
    }
    EXPECT_GT(refused, kTries / 2); // weights may be anything
}

} // namespace
} // namespace supple::test
