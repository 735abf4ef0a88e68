#include "runtime/planned_pipelines.h"

#include "runtime/skinning_choice.h"
#include "runtime/surface_outputs.h"
#include "runtime/surface_recipe.h"

namespace supple::runtime {

namespace {

Result<std::shared_ptr<const PreparedTables>> tablesOf(const Prepared& prepared, const surface::Recipe& recipe,
                                                       const std::shared_ptr<const PreparedPiece>& piece) {
    if (std::shared_ptr<const PreparedTables> known = prepared.findServing(recipe, piece.get())) {
        return known;
    }
    Result<std::shared_ptr<PreparedTables>> built = prepared.build(recipe, piece);
    return built ? Result<std::shared_ptr<const PreparedTables>>(std::move(*built)) : built.error();
}

Status makeProgram(const PipelineMakers& makers, const surface::Tables& tables, const surface::ProgramOptions& options,
                   uint32_t rate) {
    surface::Evaluation evaluation;
    evaluation.rate = rate;
    if (!options.lod) {
        evaluation.layOut(tables);
    }
    const Result<surface::Program> program = makers.surface->prepare(tables, options, evaluation);
    return program ? success() : program.error();
}

Status makeSurface(const PipelineMakers& makers, const Prepared& prepared, const PlannedGroup& group,
                   const SchemeParts& parts) {
    const bool whole = parts.parts.size() == prepared.character.parts.size();
    const Result<PlannedSurface> surface =
        plannedSurface(prepared, group, parts, whole ? nullptr : prepared.pieceOf(parts.parts), makers.device->mapping);
    if (!surface) {
        return surface.error();
    }
    const auto finest = tablesOf(prepared, surface->recipe, surface->piece);
    if (!finest) {
        return finest.error();
    }
    const surface::Tables& tables = (*finest)->tables;
    const surface::Scheme& scheme = surface::schemeOf(surface->recipe.scheme);
    const OutputWish wish{prepared.character.name, surface->groupFlags, group.viewFlags, group.desc.vertexFormat,
                          parts.chosen};
    const Result<SurfaceOutputs> outputs = surfaceOutputs(wish, tables, scheme.name);
    if (!outputs) {
        return outputs.error();
    }
    const uint32_t rate = beginRate(askedRate(group.desc), tables, scheme.rates);
    surface::ProgramOptions options = programOptionsOf(wish, *outputs, rate);
    options.view = group.viewFlags.has_value();
    options.lod = surface->recipe.lod;
    options.backFaces = options.lod && (*group.viewFlags & SUPPLE_VIEW_BACK_FACES) != 0;
    options.levelOffset =
        (group.desc.flags & SUPPLE_GROUP_ONE_LEVEL) != 0 ? 1 : 0; // where it lies matters to no pipeline
    if (!surface->hasRates) {
        return makeProgram(makers, tables, options, rate);
    }
    for (const surface::Recipe& recipe : ratesBelow(surface->recipe, tables)) {
        const auto own = tablesOf(prepared, recipe, surface->piece);
        Status made =
            own ? makeProgram(makers, (*own)->tables, options, recipe.rate >> tables.isolationSteps) : own.error();
        if (!made) {
            return made;
        }
    }
    const Result<BoundsKernels*> bounds = makers.kernels->bounds();
    return bounds ? (*bounds)->make(true) : bounds.error();
}

Status makeCulling(const PipelineMakers& makers, const PlannedGroup& group) {
    Status status = success();
    if (group.viewFlags || (group.desc.flags & SUPPLE_GROUP_BOUNDS) != 0) {
        const Result<BoundsKernels*> bounds = makers.kernels->bounds();
        status = bounds ? (*bounds)->make(false) : bounds.error();
    }
    if (status && group.viewFlags && (*group.viewFlags & SUPPLE_VIEW_OCCLUSION) != 0) {
        const Result<OcclusionKernels*> occlusion = makers.kernels->occlusion();
        const Result<gpu::Kernel> made = occlusion ? (*occlusion)->make() : occlusion.error();
        status = made ? success() : made.error();
    }
    if (status && group.viewFlags) {
        const Result<surface::Programs::Solver> solver = makers.surface->prepareSolver();
        status = solver ? success() : solver.error();
    }
    return status;
}

Status makeStages(const PipelineMakers& makers, const Prepared& prepared, const PlannedGroup& group, bool pieces) {
    PlannedStages planned;
    planned.skinning = skinningOf(prepared.character, group.desc.skinning);
    planned.morphs = prepared.deform.firstInfluences != 0;
    planned.deforms = group.desc.poseSource != SUPPLE_POSES_CAGE_BUFFER;
    planned.pieces = pieces;
    const bool soft = (group.desc.flags & SUPPLE_GROUP_SOFT) != 0;
    planned.jiggles = soft && !prepared.character.weights.jiggles.empty();
    planned.cloths = soft && !prepared.character.cloths.empty();
    if (group.desc.poseSource == SUPPLE_POSES_PLAYBACK) {
        const Result<skinning::PoseKernels*> pose = makers.kernels->pose();
        if (!pose) {
            return pose.error();
        }
        skinning::PoseNeeds needs;
        needs.mixes = (group.desc.flags & SUPPLE_GROUP_UPDATE_RATES) != 0;
        needs.springs =
            (group.desc.flags & SUPPLE_GROUP_SPRINGS) != 0 && !prepared.character.springBones.springs.empty();
        needs.steps = needs.springs || planned.jiggles || planned.cloths;
        needs.drivers = planned.morphs && !prepared.character.drivers.empty();
        needs.morphs = planned.morphs;
        needs.clips = skinning::clipKinds(prepared.character);
        if (const Result<skinning::PosePipelines> made = (*pose)->make(planned.skinning, needs); !made) {
            return made.error();
        }
    }
    return makers.stages->makePipelines(planned, *makers.device, *makers.pipelines);
}

} // namespace

Status makePipelines(const PipelineMakers& makers, const Prepared& prepared, const PlannedGroup& group) {
    std::vector<SchemeParts> schemes;
    if (group.desc.scheme != SUPPLE_SCHEME_CAGE) {
        Result<std::vector<SchemeParts>> found = schemesOf(prepared, group.desc);
        if (!found) {
            return found.error();
        }
        schemes = std::move(*found);
    }
    Status status = success();
    bool pieces = false;
    for (const SchemeParts& parts : schemes) {
        pieces = pieces || parts.parts.size() < prepared.character.parts.size();
        status = status ? makeSurface(makers, prepared, group, parts) : status;
    }
    status = status ? makeCulling(makers, group) : status;
    return status ? makeStages(makers, prepared, group, pieces) : status;
}

} // namespace supple::runtime
