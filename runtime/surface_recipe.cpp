#include "runtime/surface_recipe.h"

#include "runtime/vertex_streams.h"
#include "supple/supple_view.h"
#include "surface/schemes.h"

namespace supple::runtime {

namespace {

using cage::UvMode;

bool wants(const SurfaceWish& wish, uint32_t groupFlag, uint32_t viewFlag) {
    return wish.viewFlags ? (*wish.viewFlags & viewFlag) != 0 : (wish.group.flags & groupFlag) != 0;
}

surface::blend::Options blendOptions(const SuppleBlendOptions& from) {
    using surface::blend::CreaseMode;
    return {from.creaseMode == SUPPLE_CREASES_CURVE ? CreaseMode::curve : CreaseMode::cut,
            from.sharpThreshold > 0.0f ? from.sharpThreshold : 1.0f};
}

surface::prep::Options prepOptions(const SupplePrepOptions& from) {
    using namespace surface::prep;
    return {from.tangentMode == SUPPLE_TANGENTS_PRINTED ? TangentMode::printed : TangentMode::standard,
            from.cornerRule == SUPPLE_CORNERS_SMOOTH ? CornerRule::smooth : CornerRule::sharp};
}

/// What the file says of the parts of a surface: the first part that says anything counts.
std::optional<UvMode> uvModeOfFile(const SurfaceWish& wish) {
    for (const uint32_t part : wish.parts) {
        if (const std::optional<UvMode> mode = wish.character.parts[part].uvMode) {
            return mode;
        }
    }
    return std::nullopt;
}

/// How texture coordinates are interpolated, if the scheme does.
UvMode uvModeOf(const SurfaceWish& wish) {
    if (wish.group.uvInterpolation != SUPPLE_UV_FROM_FILE) {
        return static_cast<UvMode>(static_cast<uint32_t>(wish.group.uvInterpolation) - 1);
    }
    const bool tangents = wants(wish, SUPPLE_GROUP_TANGENTS, SUPPLE_VIEW_TANGENTS);
    return uvModeOfFile(wish).value_or(tangents ? UvMode::cornersPlus1 : UvMode::all);
}

Status chooseUvs(const SurfaceWish& wish, SurfaceRecipe& out) {
    surface::Recipe& recipe = out.recipe;
    const surface::Scheme& scheme = surface::schemeOf(recipe.scheme);
    const bool asked = wish.group.uvInterpolation != SUPPLE_UV_FROM_FILE;
    recipe.uvMode = uvModeOf(wish);
    if (!recipe.attributes || wish.cage.cornerUvs.empty()) {
        recipe.uvMode = UvMode::all; // nobody sees the difference
    } else if (!scheme.interpolates(recipe.uvMode)) {
        const std::string reason = std::string(scheme.name) + " does not interpolate texture coordinates by \"" +
                                   cage::uvModeName(recipe.uvMode) + "\"";
        if (asked && !wish.schemeChosen) {
            return Error{ErrorCode::argument, wish.character.name + ": " + reason};
        }
        recipe.uvMode = UvMode::all;
        out.uvNote = asked || uvModeOfFile(wish) ? reason + ": they are linear" : "";
    }
    return success();
}

} // namespace

surface::SchemeId schemeIdOf(const SuppleGroupDesc& group, SuppleScheme scheme) {
    const bool byLoop = group.fragments != nullptr && group.fragments->rules == SUPPLE_RULES_LOOP;
    return scheme == SUPPLE_SCHEME_FRAGMENTS && byLoop ? surface::SchemeId::loopFragments
                                                       : static_cast<surface::SchemeId>(scheme);
}

uint32_t surfaceFlags(uint32_t groupFlags, surface::SchemeId scheme, bool schemeChosen) {
    const surface::Scheme& row = surface::schemeOf(scheme);
    const uint32_t lacksMesh = schemeChosen && !row.hasIndexedMesh ? SUPPLE_GROUP_INDEXED_MESH : 0;
    const uint32_t lacksDirect = row.hasDirect ? 0 : SUPPLE_GROUP_DIRECT;
    return groupFlags & ~(lacksMesh | lacksDirect);
}

std::vector<surface::Recipe> ratesBelow(const surface::Recipe& finest, const surface::Tables& tables) {
    std::vector<surface::Recipe> recipes;
    for (uint32_t segments = 1; segments <= tables.rate; segments *= 2) {
        recipes.push_back(finest);
        recipes.back().rate = segments << tables.isolationSteps;
    }
    return recipes;
}

Result<SurfaceRecipe> surfaceRecipe(const SurfaceWish& wish) {
    SurfaceRecipe out;
    surface::Recipe& recipe = out.recipe;
    recipe.scheme = wish.scheme;
    const surface::Scheme& scheme = surface::schemeOf(recipe.scheme);
    const bool tangents = wants(wish, SUPPLE_GROUP_TANGENTS, SUPPLE_VIEW_TANGENTS);
    recipe.indexedMesh = (wish.group.flags & SUPPLE_GROUP_INDEXED_MESH) != 0;
    recipe.attributes = wants(wish, SUPPLE_GROUP_ATTRIBUTES, SUPPLE_VIEW_ATTRIBUTES);
    recipe.tangents = (scheme.isMesh() || recipe.indexedMesh) && tangents;
    recipe.lod = wish.viewFlags.has_value() && scheme.hasLevels;
    recipe.rate = scheme.tableRate(askedRate(wish.group), recipe.lod);
    recipe.wide = wish.mapping.wide && scheme.ofMapping;
    const bool direct = (wish.group.flags & SUPPLE_GROUP_DIRECT) != 0; // hosts' shaders read coefficients
    recipe.fanRecords =
        wish.mapping.fanRecords && scheme.hasFanRecords && !recipe.lod && !recipe.indexedMesh && !direct;
    recipe.blend = wish.group.blend != nullptr ? blendOptions(*wish.group.blend) : recipe.blend;
    recipe.prep = wish.group.prep != nullptr ? prepOptions(*wish.group.prep) : recipe.prep;
    if (const Status chosen = chooseUvs(wish, out); !chosen) {
        return chosen.error();
    }
    if (recipe.attributes && tangents) {
        recipe.mapFrames = cage::mapFramesOf(wish.character);
    }
    return out;
}

} // namespace supple::runtime
