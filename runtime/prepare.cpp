#include "runtime/prepare.h"

#include "runtime/playback_room.h"
#include "runtime/skinning_choice.h"
#include "runtime/surface_recipe.h"

#include <algorithm>

namespace supple::runtime {

namespace {

Result<std::shared_ptr<const PreparedTables>> tablesFor(Prepared& prepared, const surface::Recipe& recipe,
                                                        const std::shared_ptr<const PreparedPiece>& piece) {
    if (std::shared_ptr<const PreparedTables> known = prepared.find(recipe, piece.get())) {
        return known;
    }
    Result<std::shared_ptr<PreparedTables>> built = prepared.build(recipe, piece);
    if (!built) {
        return built.error();
    }
    prepared.tables.push_back(*built);
    return prepared.tables.back();
}

/// Null: all parts.
std::shared_ptr<const PreparedPiece> pieceFor(Prepared& prepared, const std::vector<uint32_t>& parts) {
    if (parts.size() == prepared.character.parts.size()) {
        return nullptr;
    }
    std::shared_ptr<const PreparedPiece> piece = prepared.pieceOf(parts);
    if (std::find(prepared.pieces.begin(), prepared.pieces.end(), piece) == prepared.pieces.end()) {
        prepared.pieces.push_back(piece);
    }
    return piece;
}

Status prepareSurface(Prepared& prepared, const PlannedGroup& group, const SchemeParts& parts,
                      const gpu::Mapping& mapping) {
    const Result<PlannedSurface> surface =
        plannedSurface(prepared, group, parts, pieceFor(prepared, parts.parts), mapping);
    if (!surface) {
        return surface.error();
    }
    const auto finest = tablesFor(prepared, surface->recipe, surface->piece);
    if (!finest) {
        return finest.error();
    }
    const PreparedTables* measured = finest->get();
    const auto measure = [&] { // without a view nobody asks
        if (group.viewFlags &&
            std::none_of(prepared.measures.begin(), prepared.measures.end(),
                         [&](const Prepared::Measure& measure) { return measure.tables == measured; })) {
            prepared.measures.push_back({measured, prepared.measureOf(*measured)});
        }
        return success();
    };
    if (!surface->hasRates) {
        return measure();
    }
    for (const surface::Recipe& below : ratesBelow(surface->recipe, (*finest)->tables)) {
        const auto own = tablesFor(prepared, below, surface->piece);
        if (!own) {
            return own.error();
        }
        measured = own->get(); // the last one's tables are the surface's
    }
    return measure();
}

} // namespace

Result<PlannedSurface> plannedSurface(const Prepared& prepared, const PlannedGroup& group, const SchemeParts& parts,
                                      std::shared_ptr<const PreparedPiece> piece, const gpu::Mapping& mapping) {
    PlannedSurface surface;
    const cage::Cage& cage = prepared.cageOf(piece.get());
    surface.piece = std::move(piece);
    const surface::SchemeId own = schemeIdOf(group.desc, parts.scheme);
    SuppleGroupDesc desc = group.desc;
    desc.flags = surfaceFlags(desc.flags, own, parts.chosen);
    Result<SurfaceRecipe> recipe =
        surfaceRecipe({prepared.character, parts.parts, cage, desc, own, parts.chosen, group.viewFlags, mapping});
    if (!recipe) {
        return recipe.error();
    }
    surface.recipe = recipe->recipe;
    surface.groupFlags = desc.flags;
    const surface::Scheme& scheme = surface::schemeOf(own);
    surface.hasRates = group.viewFlags && !scheme.hasLevels && scheme.hasRates();
    return surface;
}

Status prepareFor(Prepared& prepared, const PlannedGroup& group, bool wide) {
    const auto has = [&](uint32_t flag) { return (group.desc.flags & flag) != 0; };
    if (posesNodes(group.desc.poseSource, has(SUPPLE_GROUP_MODIFIERS), has(SUPPLE_GROUP_SPRINGS)) && !prepared.clips) {
        prepared.clips = skinning::buildClipTable(prepared.character);
    }
    const skinning::SkinningRow& row = skinning::skinningRow(skinningOf(prepared.character, group.desc.skinning));
    if (Status found = prepared.extras.find(prepared.character, row.extra); !found) {
        return found;
    }
    if (group.viewFlags && !prepared.reach) {
        prepared.reach = skinning::reachOf(prepared.character);
    }
    if (group.desc.scheme == SUPPLE_SCHEME_CAGE) {
        return success();
    }
    const Result<std::vector<SchemeParts>> schemes = schemesOf(prepared, group.desc);
    if (!schemes) {
        return schemes.error();
    }
    for (const SchemeParts& parts : *schemes) {
        if (Status status = prepareSurface(prepared, group, parts, {.wide = wide}); !status) {
            return status;
        }
    }
    return success();
}

} // namespace supple::runtime
