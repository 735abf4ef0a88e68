// What checks tables from files: all tables that are built pass, and whatever does not fit is refused.
#include "surface/table_check.h"

#include "cage/gltf/reader.h"
#include "shaders/shared/surface.h"
#include "surface/schemes.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/table_cases.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <span>

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

std::vector<SchemeId> allSchemes() {
    std::vector<SchemeId> all{SchemeId::loopFragments};
    for (const Scheme& scheme : schemes()) {
        all.push_back(scheme.id);
    }
    return all;
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
    for (const SchemeId scheme : allSchemes()) {
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

TEST(TableCheck, TablesOfCharactersPass) {
    size_t checked = 0;
    for (const std::string& path : test::allCharacters()) {
        const Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        const cage::Cage& cage = character->cage;
        for (const SchemeId scheme : allSchemes()) {
            const std::vector<Recipe> recipes = test::recipesOf(scheme);
            Recipe recipe = recipes[7 * checked % recipes.size()];
            recipe.mapFrames = recipe.mapFrames.empty() ? recipe.mapFrames : cage::mapFramesOf(*character);
            const Result<Tables> tables = buildTables(recipe, cage);
            if (!tables) {
                continue;
            }
            const TableSource source{recipe, cage.vertexCount(), cage.faceCount(),
                                     static_cast<uint32_t>(character->parts.size()),
                                     static_cast<uint32_t>(character->materials.size())};
            const Status status = checkTables(*tables, source);
            EXPECT_TRUE(status.ok()) << path << ", " << test::nameOf(recipe) << ": " << status.error().message;
            ++checked;
        }
    }
    EXPECT_GT(checked, 8u);
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

/// A change, and the message, but for limits.
struct Change {
    const char* message;
    void (*make)(Tables&);
};
/// "patches: 18, of # faces".
std::string withoutLimit(std::string message) {
    const size_t of = message.rfind(", of ");
    if (of != std::string::npos) {
        message.replace(of + 5, message.find(' ', of + 5) - of - 5, "#");
    }
    return message;
}
/// Makes one change after the other, each in tables that are whole.
void expectRefused(const Sample& sample, std::span<const Change> changes) {
    ASSERT_TRUE(sample.check().ok()) << sample.check().error().message;
    for (size_t c = 0; c < changes.size(); ++c) {
        Sample changed = sample;
        changes[c].make(changed.tables);
        const Status status = changed.check();
        ASSERT_FALSE(status.ok()) << "change " << c << ": " << changes[c].message;
        EXPECT_EQ(status.error().code, ErrorCode::asset);
        EXPECT_EQ(withoutLimit(status.error().message), changes[c].message) << "change " << c;
    }
}

TEST(TableCheck, PatchesAndRanges) {
    constexpr Change kChanges[] = {
        {"patches: an unknown class", [](Tables& t) { t.patches[3].patchClass = static_cast<PatchClass>(99); }},
        {"patches: a count of corners not its class's", [](Tables& t) { t.patches[3].cornerCount = 6; }},
        {"patches: 18, of # faces", [](Tables& t) { t.patches[3].face = 18; }},
        {"patches: 999, of # cage vertices", [](Tables& t) { t.patches[3].corners[1] = 999; }},
        {"patches: 2, of # parts", [](Tables& t) { t.patches[3].part = 2; }},
        {"patches: 2, of # materials", [](Tables& t) { t.patches[3].material = 2; }},
        {"patches: there are none", [](Tables& t) { t.patches.clear(); }},
        {"ranges of patches: they do not have all patches", [](Tables& t) { t.ranges.pop_back(); }},
        {"ranges of patches: classes out of order", [](Tables& t) { t.ranges[1].patchClass = t.ranges[0].patchClass; }},
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
        {"pool: 4294967295, of # coefficients", [](Tables& t) { t.tangents = ~0u; }},
        {"pool: 4294967295, of # coefficients", [](Tables& t) { t.faces = ~0u; }},
        {"pool: 4294967295, of # coefficients", [](Tables& t) { t.inner = ~0u; }},
        {"tables: no whole elements", [](Tables& t) { t.words.push_back(0); }},
        {"tables: neither one UV set nor two", [](Tables& t) { t.uvSets = 3; }},
        {"tables: texture coordinates not as the recipe says",
         [](Tables& t) { t.uvMode = static_cast<cage::UvMode>(7); }},
        {"tables: leaves of texture coordinates", [](Tables& t) { t.uvLeaves = true; }},
        {"tables: frames of normal maps not as the recipe says", [](Tables& t) { t.mapFrames = true; }},
        {"tables: corner normals that the scheme does not have", [](Tables& t) { t.cornerNormals = true; }},
        {"tables: steps of subdivision", [](Tables& t) { t.isolationSteps = 33; }},
        {"tables: made for another rate", [](Tables& t) { t.rate = 8; }},
        {"tables: fragments not as the recipe says", [](Tables& t) { t.fragments.classes.resize(1); }},
        {"tables: triangles not as the recipe says",
         [](Tables& t) {
             t.triangles.indices = {0, 1, 2};
         }},
        {"tables: levels of detail not as the recipe says", [](Tables& t) { t.lod = {}; }},
        {"tables: an indexed mesh not as the recipe says", [](Tables& t) { t.mesh = {}; }},
        {"constructions: too many", [](Tables& t) { t.constructions.resize(65, t.constructions[0]); }},
        {"constructions: an unknown stage", [](Tables& t) { t.constructions[0].stage = static_cast<Stage>(3); }},
        {"constructions: an unknown kernel", [](Tables& t) { t.constructions[0].kernel.kernel = Kernel::count; }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[0].kernel.kernel = Kernel::prepVertex; }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[0].kernel.kind = 77; }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[0].stage = Stage::assemble; }},
    };
    expectRefused(pmSample(), kChanges);
}

TEST(TableCheck, SectionsOfPm) {
    constexpr Change kChanges[] = {
        {"ranges of patches: 4294967295 and 11 more, of # elements",
         [](Tables& t) { t.ranges[0].section.table = ~0u; }},
        {"corner attributes: 4294967295, of # words", [](Tables& t) { t.ranges[0].attributes = ~0u; }},
        {"smooth texture coordinates: 4294967295 and 83 more, of # elements",
         [](Tables& t) { t.ranges[0].smoothUvs = ~0u; }},
        {"corner attributes: 4294967295, of # elements", [](Tables& t) { t.attributes = ~0u; }},
        {"ring: 4294967295 and 71 more, of # words", [](Tables& t) { t.ring = ~0u; }},
        {"ring: it does not begin an element", [](Tables& t) { ++t.ring; }},
        {"patch records: 4294967295 and 1 more, of # elements", [](Tables& t) { t.edgeClasses = ~0u; }},
        {"sectors: spokes do not follow each other", [](Tables& t) { t.constructions[0].section.count = 0; }},
        {"sectors: 17179869180 and 41 more, of # words", [](Tables& t) { t.constructions[1].section.table = ~0u; }},
        {"facets: other records than those of the class", [](Tables& t) { ++t.constructions.back().section.table; }},
        {"facets: other records than those of the class", [](Tables& t) { --t.constructions.back().section.count; }},
    };
    expectRefused(pmSample(), kChanges);
}

TEST(TableCheck, ClassesOfOtherSchemes) {
    const auto becomes = [](Tables& tables, PatchClass patchClass) {
        for (PatchInfo& patch : tables.patches) {
            patch.patchClass = patchClass;
        }
    };
    Recipe recipe;
    recipe.attributes = false;
    Sample pm = sampleOf(recipe, test::torus(6, 5));
    becomes(pm.tables, PatchClass::blend);
    pm.tables.ranges[0].patchClass = PatchClass::blend;
    pm.tables.words.resize(2 * pm.tables.words.size()); // their records are larger
    EXPECT_EQ(pm.check().error().message, "ranges of patches: a class of another scheme");
    Sample polygons = polygonsSample();
    becomes(polygons.tables, PatchClass::p3);
    EXPECT_EQ(polygons.check().error().message, "patches: a class of another scheme");
}

TEST(TableCheck, IndexedMesh) {
    constexpr Change kChanges[] = {
        {"edges of the indexed mesh: 7, of # kinds", [](Tables& t) { t.mesh.edges[0].kind = shared::kEdgeKinds; }},
        {"edges of the indexed mesh: no record of a patch",
         [](Tables& t) { t.mesh.edges[0].kind = shared::kHalvesEdges; }},
        {"edges of the indexed mesh: they do not follow each other",
         [](Tables& t) { t.mesh.edges[0].section.count = 0; }},
        {"edges of the indexed mesh: 4294967295 and 212 more, of # elements",
         [](Tables& t) { t.mesh.edges[0].section.table = ~0u; }},
        {"edges of the indexed mesh: another number of edges or corners",
         [](Tables& t) { t.mesh.edgeCount = 1u << 30; }},
        {"edges of the indexed mesh: another number of edges or corners",
         [](Tables& t) { t.mesh.cornerCount = 1u << 30; }},
        {"indexed mesh: tangents not as the recipe says", [](Tables& t) { t.mesh.tangents = false; }},
        {"patches of the indexed mesh: another number of patches", [](Tables& t) { t.mesh.patches.pop_back(); }},
        {"patches of the indexed mesh: 4294967295, of # edges", [](Tables& t) { t.mesh.patches[1].edges[2] = ~0u; }},
        {"patches of the indexed mesh: 52, of # corners",
         [](Tables& t) { t.mesh.patches[1].corners[2] = t.mesh.cornerCount; }},
        {"attributes of edges: another number of edges", [](Tables& t) { --t.mesh.attributes.count; }},
        {"attributes of edges: 4294967295 and 70 more, of # elements",
         [](Tables& t) { t.mesh.attributes.table = ~0u; }},
    };
    expectRefused(pmSample(), kChanges);
}

TEST(TableCheck, Levels) {
    constexpr Change kChanges[] = {
        {"levels of detail: borders of other patches", [](Tables& t) { t.lod.borders = static_cast<Borders>(77); }},
        {"edges with levels: a kind of other patches", [](Tables& t) { t.lod.edges[0].borders = Borders::charts; }},
        {"edges with levels: no record of a patch", [](Tables& t) { t.lod.edges[0].borders = Borders::halves; }},
        {"edges with levels: they do not follow each other", [](Tables& t) { t.lod.edges[0].first = 1; }},
        {"edges with levels: they do not follow each other",
         [](Tables& t) {
             t.lod.edges.push_back({Borders::cubics, t.lod.edgeCount, t.lod.edges[0].section});
         }},
        {"edges with levels: another number of edges", [](Tables& t) { t.lod.edgeCount = 1u << 30; }},
        {"edges with levels: 4294967295 and 36 more, of # elements",
         [](Tables& t) { t.lod.edges[0].section.table = ~0u; }},
        {"patches with levels: another number of patches", [](Tables& t) { ++t.lod.patches.count; }},
        {"patches with levels: 4294967295 and 35 more, of # elements", [](Tables& t) { t.lod.patches.table = ~0u; }},
        {"runs of patches: they do not have all patches", [](Tables& t) { t.lod.runs.pop_back(); }},
        {"runs of patches: a patch of another class or material", [](Tables& t) { t.lod.runs[0].material = 55; }},
        {"runs of patches: a patch of another class or material",
         [](Tables& t) { t.lod.runs[0].patchClass = PatchClass::perturbed; }},
        {"runs of patches: an empty one", [](Tables& t) { t.lod.runs[0].patchCount = 0; }},
        {"runs of patches: 0 and 4294967294 more, of # patches", [](Tables& t) { t.lod.runs[0].patchCount = ~0u; }},
        {"depths of chains: 4294967295, of # coefficients", [](Tables& t) { t.lod.depth = ~0u; }},
        {"depths of chains: 4294967295, of # elements",
         [](Tables& t) {
             t.lod.depth = 1;
             t.lod.depthLanes = ~0u;
         }},
        {"depths of chains: other lanes", [](Tables& t) { t.lod.depth = 1; }},
    };
    expectRefused(pmSample(), kChanges);
}

TEST(TableCheck, Polygons) {
    constexpr Change kChanges[] = {
        {"surface vertices: there are none", [](Tables& t) { t.triangles.vertices.count = 0; }},
        {"surface vertices: 4294967295 and 39 more, of # elements",
         [](Tables& t) { t.triangles.vertices.table = ~0u; }},
        {"directions of tangents: not as the recipe says", [](Tables& t) { t.triangles.directions = 0; }},
        {"directions of tangents: 4294967295 and 39 more, of # words", [](Tables& t) { t.triangles.directions = ~0u; }},
        {"corner attributes: 4294967295 and 79 more, of # elements", [](Tables& t) { t.attributes = ~0u; }},
        {"triangles: another number of triangles", [](Tables& t) { t.triangles.indices.pop_back(); }},
        {"triangles: 4294967295, of # surface vertices", [](Tables& t) { t.triangles.indices[5] = ~0u; }},
        {"ranges of patches: polygons have none", [](Tables& t) { t.ranges.resize(1); }},
        {"tables: made for another rate", [](Tables& t) { t.rate = 0; }},
        {"faces: 4294967295 and 7 more, of # elements", [](Tables& t) { t.constructions[0].section.table = ~0u; }},
        {"long faces: 4294967295 and 1 more, of # elements", [](Tables& t) { t.constructions[1].section.table = ~0u; }},
        {"frames: 4294967295 and 15 more, of # elements", [](Tables& t) { t.constructions[2].section.table = ~0u; }},
        {"frames: 63 and 47 more, of # coefficients", [](Tables& t) { t.tangents = t.poolStride - 1; }},
    };
    expectRefused(polygonsSample(), kChanges);
}

TEST(TableCheck, SectionsOfPrep) {
    constexpr Change kChanges[] = {
        {"vertices: 17179869180 and 15 more, of # words", [](Tables& t) { t.constructions[0].section.table = ~0u; }},
        {"perturbed edges: 4294967295 and 11 more, of # elements",
         [](Tables& t) { t.constructions.back().section.table = ~0u; }},
        {"perturbed edges: 111 and 47 more, of # coefficients", [](Tables& t) { t.inner = t.poolStride - 1; }},
        {"perturbed edges: 4294967295 and 5 more, of # elements", [](Tables& t) { t.edgeClasses = ~0u; }},
    };
    Recipe recipe;
    recipe.scheme = SchemeId::prep;
    expectRefused(sampleOf(recipe, test::cube()), kChanges);
}

TEST(TableCheck, SectionsOfBlend) {
    constexpr Change kChanges[] = {
        {"tables: made for another rate", [](Tables& t) { t.isolationSteps = 2; }},
        {"constructions: not a step and charts", [](Tables& t) { t.constructions.pop_back(); }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[0].kernel.kernel = Kernel::subdivisionIsolateMeshInPool; }},
        {"stencils: vertices that do not begin the pool", [](Tables& t) { t.constructions[0].to = 1; }},
        {"rows of stencils: 4294967295 and 4 more, of # elements",
         [](Tables& t) { t.constructions[0].section.table = ~0u; }},
        {"charts: 4294967295 and 49 more, of # elements", [](Tables& t) { t.constructions[1].section.table = ~0u; }},
        {"rows of stencils: another number than of vertices", [](Tables& t) { --t.constructions[0].coefficients; }},
        {"charts: 0, of # vertices",
         [](Tables& t) { t.constructions[0].section.count = t.constructions[0].coefficients = 0; }},
        {"coordinates: 4294967295 and 6 more, of # elements", [](Tables& t) { t.coordinates = ~0u; }},
        {"tables: made for another rate", [](Tables& t) { t.rate = 5; }},
        {"smooth texture coordinates: 100000 and 383 more, of # elements",
         [](Tables& t) {
             t.words.resize(400004);
             t.ranges[0].smoothUvs = 100000;
         }},
        {"tables: fragments not as the recipe says", [](Tables& t) { t.fragments.classes.resize(1); }},
    };
    Recipe recipe;
    recipe.scheme = SchemeId::blend;
    recipe.rate = 8;
    recipe.uvMode = cage::UvMode::cornersOnly;
    expectRefused(sampleOf(recipe, test::prism(8)), kChanges);
}

TEST(TableCheck, SectionsOfFragments) {
    constexpr Change kChanges[] = {
        {"tables: fragments not as the recipe says", [](Tables& t) { t.fragments.classes.clear(); }},
        {"fragments: of another subdivision", [](Tables& t) { t.fragments.loop = true; }},
        {"fragments: steps of another rate", [](Tables& t) { t.fragments.steps = 33; }},
        {"tables: steps of subdivision", [](Tables& t) { t.isolationSteps = 3; }},
        {"tables: made for another rate", [](Tables& t) { t.isolationSteps = 1; }},
        {"tables: made for another rate", [](Tables& t) { t.rate = 4; }},
        {"constructions: other steps than of isolation", [](Tables& t) { t.constructions.pop_back(); }},
        {"constructions: other steps than of isolation", [](Tables& t) { t.constructions[1].to = 1; }},
        {"constructions: a kernel that the scheme does not run there",
         [](Tables& t) { t.constructions[1].kernel.kernel = Kernel::subdivisionIsolate; }},
        {"stencils: 4294967295 and 49 more, of # coefficients", [](Tables& t) { t.constructions[0].to = ~0u; }},
        {"ranges of patches: a class of another scheme",
         [](Tables& t) {
             t.ranges[0].patchClass = PatchClass::blend;
             for (PatchInfo& patch : t.patches) {
                 patch.patchClass = PatchClass::blend;
             }
         }},
        {"fragments: classes do not follow each other", [](Tables& t) { ++t.fragments.classes[1].fragments.table; }},
        {"fragments: classes do not follow each other", [](Tables& t) { t.fragments.classes[0].fragments.count = 0; }},
        {"fragments: 4294967295 and 15 more, of # elements",
         [](Tables& t) { t.fragments.classes[0].fragments.table = ~0u; }},
        {"fragments: another number than in the header",
         [](Tables& t) { --t.fragments.classes.back().fragments.count; }},
        {"fragments: another number of kinds of work", [](Tables& t) { t.fragments.classes[0].blocks.pop_back(); }},
        {"fragments: other points than in the header", [](Tables& t) { --t.fragments.classes[0].sharedPoints; }},
        {"fragments: another size of the scratch buffer", [](Tables& t) { t.fragments.scratchStride -= 16; }},
        {"blocks: they do not follow each other", [](Tables& t) { ++t.fragments.classes[1].blocks[0].table; }},
        {"blocks: 4294967295 and 2 more, of # elements",
         [](Tables& t) {
             t.fragments.classes[0].blocks[1] = {~0u, 1};
         }},
        {"blocks: another number than of lanes", [](Tables& t) { --t.fragments.classes[0].blocks[0].count; }},
        {"smooth texture coordinates: 100000 and 3455 more, of # elements",
         [](Tables& t) {
             t.words.resize(400004);
             t.ranges[0].smoothUvs = 100000;
         }},
    };
    Recipe recipe;
    recipe.scheme = SchemeId::fragments;
    recipe.rate = 8;
    recipe.uvMode = cage::UvMode::cornersOnly;
    expectRefused(sampleOf(recipe, test::prism(8)), kChanges);
}

TEST(TableCheck, MessagesNameTheWord) {
    Sample sample = pmSample();
    const size_t record = size_t{4} * sample.tables.ranges[0].section.table;
    sample.tables.words[record + 3] = 12345678;
    EXPECT_EQ(withoutLimit(sample.check().error().message), "patch records: 12345678 and 1 more, of # coefficients");
    sample = pmSample();
    sample.tables.words[sample.tables.ranges[0].attributes] = 0xFFFF0000u;
    EXPECT_EQ(withoutLimit(sample.check().error().message), "corner attributes: 65535, of # attributes");
    // The extra word of an edge is read where a flag says so.
    sample = pmSample();
    const size_t edge = size_t{4} * sample.tables.mesh.edges[0].section.table;
    sample.tables.words[edge + 10] &= ~shared::kSingularEdge;
    sample.tables.words[edge + 11] = 12345678;
    EXPECT_TRUE(sample.check().ok());
    sample.tables.words[edge + 10] |= shared::kSingularEdge;
    EXPECT_EQ(withoutLimit(sample.check().error().message), "edges of the indexed mesh: 12345678, of # coefficients");
}

TEST(TableCheck, AnotherSourceIsRefused) {
    const Sample sample = pmSample();
    const auto refused = [&](auto&& change) {
        Recipe recipe = sample.recipe;
        TableSource source = test::sourceOf(recipe, sample.cage);
        change(recipe, source);
        return !checkTables(sample.tables, source).ok();
    };
    EXPECT_FALSE(refused([](Recipe&, TableSource&) {}));
    EXPECT_TRUE(refused([](Recipe&, TableSource& source) { --source.vertices; }));
    EXPECT_TRUE(refused([](Recipe&, TableSource& source) { --source.faces; }));
    EXPECT_TRUE(refused([](Recipe&, TableSource& source) { --source.parts; }));
    EXPECT_TRUE(refused([](Recipe&, TableSource& source) { --source.materials; }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.scheme = SchemeId::prep; }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.scheme = SchemeId::polygons; }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.scheme = SchemeId::blend; }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.lod = false; }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.indexedMesh = false; }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.tangents = false; }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.attributes = false; }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.mapFrames.resize(1); }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.uvMode = cage::UvMode::none; }));
    EXPECT_TRUE(refused([](Recipe& recipe, TableSource&) { recipe.rate = 65; }));
}

/// Builders refuse these; nobody asks them where there are tables.
TEST(TableCheck, WhatTheSchemeDoesNotHaveIsRefused) {
    Recipe recipe;
    recipe.rate = 8;
    for (const SchemeId scheme : {SchemeId::blend, SchemeId::fragments, SchemeId::loopFragments}) {
        recipe.scheme = scheme;
        Sample sample = sampleOf(recipe, test::cube());
        EXPECT_TRUE(sample.check().ok());
        sample.recipe.indexedMesh = true;
        EXPECT_EQ(sample.check().error().message, "tables: an indexed mesh, which the scheme does not have");
    }
    Sample sample = sampleOf(recipe, test::cube());
    sample.recipe.lod = true;
    EXPECT_EQ(sample.check().error().message, "tables: levels of detail, which the scheme does not have");
}

TEST(TableCheck, TablesOfAllRatesAreOfOneMesh) {
    Recipe recipe;
    recipe.scheme = SchemeId::fragments;
    recipe.rate = 2;
    const Sample low = sampleOf(recipe, test::prism(8));
    recipe.rate = 16;
    Sample high = sampleOf(recipe, test::prism(8));
    EXPECT_TRUE(areOfOneMesh(low.tables, high.tables));
    const auto differs = [&](void (*change)(Tables&)) {
        Tables other = high.tables;
        change(other);
        return !areOfOneMesh(low.tables, other);
    };
    EXPECT_FALSE(differs([](Tables&) {}));
    EXPECT_TRUE(differs([](Tables& t) { --t.isolationSteps; }));
    EXPECT_TRUE(differs([](Tables& t) { t.poolStride += 16; }));
    EXPECT_TRUE(differs([](Tables& t) { --t.ranges[0].section.count; }));
    EXPECT_TRUE(differs([](Tables& t) { t.ranges.clear(); }));
    EXPECT_TRUE(differs([](Tables& t) { t.uvSets = 1; }));
}

} // namespace
} // namespace supple::surface
