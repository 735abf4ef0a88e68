#include "surface/schemes.h"

#include "cage/features.h"
#include "cage/trim.h"
#include "surface/build.h"
#include "surface/lod/table_check.h"
#include "surface/lod/tables.h"
#include "surface/mesh_tables.h"
#include "surface/table_check_common.h"
#include "surface/table_header.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <string>

namespace supple::surface {

namespace {

// Margins are a little above what was found (tests/surface/bounds_test.cpp), for rounding and for rarer valences.
constexpr Scheme kSchemes[] = {
    {SchemeId::prep, RateRule::any, "p-rep", &prep::build, "", true, true, false, true, true, kAllUvModes,
     [](const cage::Cage&) { return 0.04f; }, // 0.0276, at valence 59
     &prep::check},
    {SchemeId::pm, RateRule::any, "P_m", &pm::build, "", true, true, false, false, true, kAllUvModes, &pm::boundsMargin,
     &pm::check},
    // Points of the limit are means of the cage's.
    {SchemeId::fragments, RateRule::doubling, "fragments", &fragments::build, "2, 4, 8..", false, false, false, false,
     false, kAllUvModes, [](const cage::Cage&) { return 0.001f; }, &fragments::check},
    {SchemeId::loop, RateRule::upTo, "Loop", &loop::build, "", true, true, true, false, false, kAllUvModes,
     [](const cage::Cage&) { return 0.001f; }, &loop::check},
    {SchemeId::blend, RateRule::one, "blend", &blend::build, "an even number of", true, false, false, false, false,
     kAllUvModes & ~uvModeBit(cage::UvMode::boundaries), &blend::boundsMargin, &blend::check},
    {SchemeId::catmullClark, RateRule::upTo, "Catmull-Clark", &catmull_clark::build, "an even number of", true, true,
     true, false, false, kAllUvModes, [](const cage::Cage&) { return 0.001f; }, &catmull_clark::check},
    // Its vertices are the cage's.
    {SchemeId::polygons, RateRule::none, "polygons", &polygons::build, "", false, true, false, false, false, kLinearUvs,
     [](const cage::Cage&) { return 0.0f; }, &polygons::check},
};

/// It is no scheme of a host's: fragments may have Loop's rules.
constexpr Scheme kLoopFragments = {SchemeId::loopFragments,
                                   RateRule::doubling,
                                   "Loop in fragments",
                                   &fragments::build,
                                   "2, 4, 8..",
                                   false,
                                   false,
                                   false,
                                   false,
                                   false,
                                   kAllUvModes,
                                   [](const cage::Cage&) { return 0.001f; },
                                   &fragments::check};

/// Whether the tables are for the recipe's rate, along an edge of what the steps of subdivision leave.
bool isMadeFor(const Tables& tables, const Recipe& recipe) {
    if (recipe.rate > kMaxRate) {
        return false;
    }
    uint32_t rate = schemeOf(recipe.scheme).tableRate(recipe.rate, recipe.lod);
    for (uint32_t step = 0; step < std::min(tables.isolationSteps, 2u); ++step) {
        rate = (rate + 1) / 2;
    }
    return tables.rate == rate;
}

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage) {
    const Scheme& scheme = schemeOf(recipe.scheme);
    PatchEdges edges;
    Result<Tables> tables = scheme.build(recipe, cage, recipe.lod || recipe.indexedMesh ? &edges : nullptr);
    if (!tables) {
        return tables;
    }
    if (tables->patches.empty()) {
        return Error{ErrorCode::asset, "every face is a hole: there is no surface"};
    }
    tables->cageStride = cageStrideFor(cage.vertexCount());
    if (!recipe.attributes && tables->attributes > 0) {
        // They come last (finishTables).
        tables->words.resize(size_t{4} * tables->attributes);
        for (PatchRange& range : tables->ranges) {
            range.attributes = 0;
        }
    }
    if (recipe.lod) {
        if (!scheme.hasLevels) {
            return Error{ErrorCode::argument, std::string(scheme.name) + " has no levels of detail"};
        }
        lod::appendTables(edges, *tables);
    }
    if (recipe.indexedMesh) {
        if (!scheme.hasIndexedMesh) {
            return Error{ErrorCode::argument, std::string(scheme.name) + " has no indexed mesh"};
        }
        if (!scheme.isMesh()) {
            appendMeshTables(edges, recipe.attributes, recipe.attributes && recipe.tangents, *tables);
        }
    }
    writeHeader(*tables);
    return tables;
}

} // namespace

uint32_t Scheme::tableRate(uint32_t rate, bool lod) const {
    switch (rates) {
    case RateRule::doubling:
        return std::bit_ceil(rate);
    case RateRule::one:
    case RateRule::upTo:
        return lod ? 0 : rate;
    case RateRule::none:
        return 1;
    default:
        return 0;
    }
}

bool serves(const Recipe& own, const Tables& tables, const Recipe& recipe) {
    if (own == recipe) {
        return true;
    }
    Recipe lower = own;
    lower.rate = recipe.rate;
    const uint32_t patchRate = tables.isolationSteps > 0 ? (recipe.rate + 1) / 2 : recipe.rate;
    return schemeOf(recipe.scheme).rates == RateRule::upTo && lower == recipe && recipe.rate > 0 &&
           recipe.rate < own.rate && chains::haveSameChains(patchRate, tables.rate);
}

std::span<const Scheme> schemes() {
    return kSchemes;
}

const Scheme& schemeOf(SchemeId id) {
    const auto* found =
        std::find_if(std::begin(kSchemes), std::end(kSchemes), [&](const Scheme& row) { return row.id == id; });
    return found != std::end(kSchemes) ? *found : kLoopFragments;
}

Result<Tables> buildTables(const Recipe& recipe, const cage::Cage& cage) {
    if (!cage::hasTrimTiles(cage)) {
        return build(recipe, cage);
    }
    cage::Cage laid = cage;
    laid.cornerFaceUvs = cage::tileCoordinates(cage);
    return build(recipe, laid);
}

Status checkTables(const Tables& tables, const TableSource& source) {
    const Scheme& scheme = schemeOf(source.recipe.scheme);
    TableCheck check(tables, source);
    check.begin("tables");
    check.require(isMadeFor(tables, source.recipe), "made for another rate");
    // What build() refuses: with such tables nobody asks it.
    check.require(scheme.hasLevels || !source.recipe.lod, "levels of detail, which the scheme does not have");
    check.require(scheme.hasIndexedMesh || !source.recipe.indexedMesh,
                  "an indexed mesh, which the scheme does not have");
    // What comes first makes the rest easier to check.
    for (void (*part)(TableCheck&) : {&checkMembers, &checkBicubicPatches, &checkCornerAttributes, &checkIndexedMesh,
                                      &lod::checkLevels, scheme.check, &checkHeader}) {
        if (!check.failed()) {
            part(check);
        }
    }
    return check.status();
}

} // namespace supple::surface
