#include "surface/patch_records.h"
#include "surface/table_check_common.h"
#include "surface/table_header.h"

#include <algorithm>
#include <iterator>

namespace supple::surface {

namespace {

/// Coefficients of an instance's pool for each word of the tables: no small file takes large memory. The most that was
/// found is 2.74, for Catmull-Clark, poles of valence 250 and rate 64.
constexpr uint64_t kMostPoolPerWord = 8;
/// Each is a dispatch. The most that was found is 8, for Catmull-Clark.
constexpr size_t kMostConstructions = 64;

bool isPatchClass(PatchClass patchClass) {
    return static_cast<size_t>(patchClass) < std::size(kPatchClasses);
}

bool checkPatch(TableCheck& check, const PatchInfo& patch) {
    const TableSource& source = check.source();
    bool fits = check.require(isPatchClass(patch.patchClass), "an unknown class") &&
                check.require(patch.cornerCount == cornerCount(domainOf(patch.patchClass)),
                              "a count of corners not its class's") &&
                check.within(patch.face, 1, source.faces, "faces") &&
                check.within(patch.part, 1, source.parts, "parts") &&
                (patch.material == cage::kNone || check.within(patch.material, 1, source.materials, "materials"));
    const uint32_t whole = source.wholeVertices != 0 ? source.wholeVertices : source.vertices;
    for (const uint32_t corner : patch.corners) {
        fits = fits && (corner == cage::kNone || check.within(corner, 1, whole, "cage vertices"));
    }
    return fits;
}

void checkPatches(TableCheck& check) {
    check.begin("patches");
    const std::vector<PatchInfo>& patches = check.tables().patches;
    check.require(!patches.empty(), "there are none");
    (void)std::all_of(patches.begin(), patches.end(), [&](const PatchInfo& patch) { return checkPatch(check, patch); });
}

/// A range and its patches, the first of which is `first`.
bool checkRange(TableCheck& check, const PatchRange& range, uint64_t first) {
    const Tables& tables = check.tables();
    const uint64_t count = range.section.count;
    const bool hasFragments = !tables.fragments.classes.empty(); // what evaluates its patches
    if (!check.require(isPatchClass(range.patchClass), "an unknown class") ||
        !check.require(hasFragments || rowOf(range.patchClass).evaluate != Kernel::count, "a class without records") ||
        !check.require(range.firstPatch == first && count > 0, "they do not follow each other") ||
        !check.within(first, count, tables.patches.size(), "patches") ||
        !check.elements(range.section.table, count * recordElements(tables, range.patchClass))) {
        return false;
    }
    const auto begin = tables.patches.begin() + static_cast<ptrdiff_t>(first);
    return check.require(std::all_of(begin, begin + static_cast<ptrdiff_t>(count),
                                     [&](const PatchInfo& patch) { return patch.patchClass == range.patchClass; }),
                         "a patch of another class");
}

void checkRanges(TableCheck& check) {
    check.begin("ranges of patches");
    const Tables& tables = check.tables();
    if (check.source().recipe.scheme == SchemeId::polygons) {
        check.require(tables.ranges.empty(), "polygons have none");
        return;
    }
    uint64_t next = 0;
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        const PatchRange& range = tables.ranges[r];
        if (!check.require(r == 0 || tables.ranges[r - 1].patchClass < range.patchClass, "classes out of order") ||
            !checkRange(check, range, next)) {
            return;
        }
        next += range.section.count;
    }
    check.require(next == tables.patches.size(), "they do not have all patches");
}

void checkDraws(TableCheck& check) {
    check.begin("draw ranges");
    const Tables& tables = check.tables();
    uint64_t next = 0;
    for (const DrawRange& draw : tables.drawRanges) {
        if (!check.require(draw.firstPatch == next && draw.patchCount > 0, "they do not follow each other") ||
            !check.within(next, draw.patchCount, tables.patches.size(), "patches")) {
            return;
        }
        for (; next < uint64_t{draw.firstPatch} + draw.patchCount; ++next) {
            const PatchInfo& patch = tables.patches[next];
            if (!check.require(draw.domain == domainOf(patch.patchClass), "a patch of another domain") ||
                !check.require(draw.part == patch.part && draw.material == patch.material,
                               "a patch of another part or material")) {
                return;
            }
        }
    }
    check.require(next == tables.patches.size(), "they do not have all patches");
}

void checkPool(TableCheck& check) {
    check.begin("pool");
    const Tables& tables = check.tables();
    check.require(tables.poolStride > 0 && tables.poolStride % 16 == 0, "instances do not begin on 256 bytes");
    check.require(tables.poolStride <= kMostPoolPerWord * tables.words.size(), "too large for these tables");
    for (const uint32_t first : {tables.tangents, tables.faces, tables.inner, tables.meshVertices, tables.frames}) {
        (void)check.pool(first, 0);
    }
    check.require(tables.cageStride == cageStrideFor(check.source().vertices), "another deformed cage");
}

void checkStages(TableCheck& check) {
    check.begin("constructions");
    check.require(check.tables().constructions.size() <= kMostConstructions, "too many");
    for (const Construction& construction : check.tables().constructions) {
        check.require(construction.stage <= Stage::deepen, "an unknown stage");
        check.require(construction.kernel.kernel < Kernel::count, "an unknown kernel");
    }
}

/// Steps of subdivision before patches are made of the cage's faces.
uint32_t mostSteps(SchemeId scheme) {
    switch (scheme) {
    case SchemeId::fragments:
        return 2;
    case SchemeId::catmullClark:
    case SchemeId::blend:
        return 1;
    default:
        return 0;
    }
}

/// What must be as the recipe says.
void checkRecipe(TableCheck& check) {
    check.begin("tables");
    const Tables& tables = check.tables();
    const Recipe& recipe = check.source().recipe;
    const SchemeId scheme = recipe.scheme;
    const bool exact = scheme == SchemeId::catmullClark || scheme == SchemeId::loop,
               mesh = scheme == SchemeId::polygons, fragments = scheme == SchemeId::fragments;
    check.require(tables.words.size() % 4 == 0, "no whole elements");
    check.require(tables.words.size() >= shared::kTableHeaderWords, "no room for their header");
    check.require(tables.uvSets == 1 || tables.uvSets == 2, "neither one UV set nor two");
    check.require(tables.uvMode == cage::UvMode::all || (recipe.attributes && tables.uvMode == recipe.uvMode),
                  "texture coordinates not as the recipe says");
    check.require(tables.uvLeaves == (exact && tables.uvMode != cage::UvMode::all), "leaves of texture coordinates");
    check.require(tables.mapFrames == (!mesh && !recipe.mapFrames.empty()),
                  "frames of normal maps not as the recipe says");
    check.require(!tables.cornerNormals ||
                      (scheme == SchemeId::prep && recipe.prep.cornerRule == prep::CornerRule::smooth),
                  "corner normals that the scheme does not have");
    check.require(tables.isolationSteps <= mostSteps(scheme), "steps of subdivision");
    check.require(tables.fragments.classes.empty() != fragments, "fragments not as the recipe says");
    check.require(tables.triangles.indices.empty() != mesh, "triangles not as the recipe says");
    check.require(recipe.lod != tables.lod.edges.empty(), "levels of detail not as the recipe says");
    check.require((recipe.indexedMesh && !mesh) != tables.mesh.edges.empty(), "an indexed mesh not as the recipe says");
}

} // namespace

void checkHeader(TableCheck& check) {
    check.begin("header");
    const auto header = headerOf(check.tables());
    check.require(std::equal(header.begin(), header.end(), check.tables().words.begin()), "it is of other tables");
}

void checkMembers(TableCheck& check) {
    for (void (*part)(TableCheck&) :
         {&checkRecipe, &checkPatches, &checkRanges, &checkDraws, &checkPool, &checkStages}) {
        part(check);
        if (check.failed()) {
            return;
        }
    }
}

bool checkClasses(TableCheck& check, std::initializer_list<PatchClass> classes) {
    const auto& ranges = check.tables().ranges;
    check.begin("ranges of patches");
    return check.require(std::all_of(ranges.begin(), ranges.end(),
                                     [&](const PatchRange& range) {
                                         return std::find(classes.begin(), classes.end(), range.patchClass) !=
                                                classes.end();
                                     }),
                         "a class of another scheme");
}

bool checkKernels(TableCheck& check, std::initializer_list<StageKernels> kernels) {
    check.begin("constructions");
    const auto isOwn = [&](const Construction& construction) {
        return std::any_of(kernels.begin(), kernels.end(), [&](const StageKernels& own) {
            return own.stage == construction.stage &&
                   std::any_of(own.kernels.begin(), own.kernels.end(),
                               [&](const KindOfKernel& kernel) { return kernel == construction.kernel; });
        });
    };
    const auto& all = check.tables().constructions;
    return check.require(std::all_of(all.begin(), all.end(), isOwn), "a kernel that the scheme does not run there");
}

} // namespace supple::surface
