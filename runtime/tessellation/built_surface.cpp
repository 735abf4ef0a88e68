#include "runtime/tessellation/built_surface.h"

namespace supple::runtime {

namespace {

OutputWish outputWish(const TessellationDesc& desc) {
    OutputWish wish{desc.asset->character.name};
    wish.groupFlags = desc.group.flags;
    wish.format = desc.group.vertexFormat;
    wish.schemeChosen = desc.schemeChosen;
    if (desc.view != nullptr) {
        wish.viewFlags = desc.view->desc().flags;
        wish.format = desc.view->desc().vertexFormat;
    }
    return wish;
}

} // namespace

BuiltSurface askedSurface(const TessellationDesc& desc) {
    BuiltSurface built;
    built.scheme = std::make_shared<SchemeTables>();
    built.scheme->prepared = std::make_shared<PreparedTables>();
    built.outputs.streams =
        desc.view != nullptr ? StreamSet::ofView(desc.view->desc().flags) : StreamSet::ofGroup(desc.group.flags);
    built.askedRate = askedRate(desc.group);
    return built;
}

Result<BuiltSurface> buildSurface(const TessellationDesc& desc) {
    BuiltSurface built = askedSurface(desc);
    std::optional<uint32_t> viewFlags;
    if (desc.view != nullptr) {
        viewFlags = desc.view->desc().flags;
    }
    Result<SurfaceRecipe> recipe =
        surfaceRecipe({desc.asset->character, desc.parts, desc.asset->cageOf(desc.piece), desc.group,
                       schemeIdOf(desc.group, desc.group.scheme), desc.schemeChosen, viewFlags, desc.device->mapping});
    if (!recipe) {
        return recipe.error();
    }
    built.uvNote = std::move(recipe->uvNote);
    Result<std::shared_ptr<SchemeTables>> tables = desc.asset->tablesFor(*desc.device, recipe->recipe, desc.piece);
    if (!tables) {
        return tables.error();
    }
    built.scheme = std::move(*tables);
    const surface::Tables& own = built.tables();
    const surface::Scheme& scheme = surface::schemeOf(built.scheme->recipe().scheme);
    Result<SurfaceOutputs> outputs = surfaceOutputs(outputWish(desc), own, scheme.name);
    if (!outputs) {
        return outputs.error();
    }
    built.outputs = *outputs;
    built.beginRate = beginRate(built.askedRate, own, scheme.rates);
    const uint32_t taken = built.beginRate << own.isolationSteps;
    if (own.rate != 0 && taken != built.askedRate && !scheme.isMesh()) {
        built.rateNote = "rate " + std::to_string(built.askedRate) + ": " + scheme.name + " has " +
                         scheme.ratesInWords + " segments an edge of the cage, here " + std::to_string(taken);
    }
    return built;
}

surface::ProgramOptions programOptionsOf(const TessellationDesc& desc, const BuiltSurface& built) {
    surface::ProgramOptions options = programOptionsOf(outputWish(desc), built.outputs, built.beginRate);
    options.instances = desc.group.capacity;
    return options;
}

} // namespace supple::runtime
