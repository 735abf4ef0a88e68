#include "surface/schemes.h"

#include "cage/trim.h"
#include "surface/blend/scheme.h"
#include "surface/borders.h"
#include "surface/kernel/scheme.h"
#include "surface/lod/tables.h"
#include "surface/pm/scheme.h"
#include "surface/prep/scheme.h"
#include "surface/shared_samples.h"

#include <algorithm>
#include <bit>

namespace supple::surface {

namespace {

Result<Tables> buildScheme(const Recipe& recipe, const cage::Cage& cage) {
    if (recipe.scheme == SchemeId::pm) {
        Result<pm::Mesh> mesh = pm::buildMesh(cage);
        if (!mesh) {
            return mesh.error();
        }
        SpokeLimits spokes;
        for (const pm::Sector& sector : mesh->sectors) {
            spokes.add(sector.vertex, sector.edges());
        }
        const Status fits = spokes.check();
        if (!fits) {
            return fits.error();
        }
        return pm::buildTables(*mesh);
    }
    if (subdivides(recipe.scheme)) {
        const auto subdivision =
            recipe.scheme == SchemeId::loop ? kernel::Subdivision::loop : kernel::Subdivision::catmullClark;
        const Result<kernel::Mesh> mesh = kernel::buildMesh(cage, subdivision);
        if (!mesh) {
            return mesh.error();
        }
        const uint32_t depth = recipe.rate > 1 ? static_cast<uint32_t>(std::bit_width(recipe.rate - 1)) : 0;
        return kernel::buildTables(*mesh, depth);
    }
    if (recipe.scheme == SchemeId::blend) {
        const Result<blend::Mesh> mesh = blend::buildMesh(cage, recipe.blend);
        if (!mesh) {
            return mesh.error();
        }
        if (recipe.lod) {
            return blend::buildTables(*mesh, 0);
        }
        const uint32_t rate = std::max(recipe.rate, 1u);
        return blend::buildTables(*mesh, mesh->refined ? (rate + 1) / 2 : rate);
    }
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    if (!topology) {
        return topology.error();
    }
    const Status accepted = prep::accepts(cage);
    if (!accepted) {
        return accepted.error();
    }
    SpokeLimits spokes;
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        spokes.add(v, topology->spokeCount(v));
    }
    const Status fits = spokes.check();
    if (!fits) {
        return fits.error();
    }
    return prep::buildTables(cage, *topology, recipe.prep);
}

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage) {
    Result<Tables> tables = buildScheme(recipe, cage);
    if (tables && tables->patches.empty()) {
        return Error{ErrorCode::asset, "every face is a hole: there is no surface"};
    }
    if (tables && !recipe.attributes && !tables->ranges.empty()) {
        // They come last (finishTables).
        tables->words.resize(size_t{4} * tables->attributes);
        for (PatchRange& range : tables->ranges) {
            range.attributes = 0;
        }
    }
    if (tables && recipe.lod) {
        if (!hasLevels(recipe.scheme)) {
            return Error{ErrorCode::argument, std::string(schemeName(recipe.scheme)) + " has no levels of detail"};
        }
        lod::appendTables(*tables);
    }
    if (tables && recipe.shared) {
        if (recipe.scheme != SchemeId::prep && recipe.scheme != SchemeId::pm) {
            return Error{ErrorCode::argument, std::string(schemeName(recipe.scheme)) + " has no shared samples"};
        }
        appendSharedSamples(*tables, recipe.attributes);
    }
    return tables;
}

} // namespace

const char* schemeName(SchemeId scheme) {
    switch (scheme) {
    case SchemeId::prep:
        return "p-rep";
    case SchemeId::pm:
        return "P_m";
    case SchemeId::catmullClark:
        return "Catmull-Clark";
    case SchemeId::loop:
        return "Loop";
    case SchemeId::blend:
        return "blend";
    }
    return "";
}

Result<Tables> buildTables(const Recipe& recipe, const cage::Cage& cage) {
    if (!cage::hasTrimTiles(cage)) {
        return build(recipe, cage);
    }
    cage::Cage laid = cage;
    laid.cornerFaceUvs = cage::tileCoordinates(cage);
    return build(recipe, laid);
}

} // namespace supple::surface
