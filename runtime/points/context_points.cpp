// The point sets of a context's groups.
#include "runtime/context.h"
#include "runtime/points/point_stencils.h"
#include "runtime/points/vertex_points.h"

#include <algorithm>

namespace supple::runtime {

namespace {

/// Whether handles of points mean the same in both: faces go by number.
bool haveSameFaces(const cage::Cage& a, const cage::Cage& b) {
    return a.vertexCount() == b.vertexCount() && a.faceStarts == b.faceStarts && a.faceVertices == b.faceVertices &&
           a.holes == b.holes;
}

PointRecipe recipeOf(const SupplePointSetDesc& desc) {
    PointRecipe recipe;
    recipe.format = desc.format;
    recipe.onVertices = (desc.flags & SUPPLE_POINT_SET_ON_VERTICES) != 0;
    recipe.points.assign(desc.points, desc.points + desc.pointCount);
    if (desc.tangents != nullptr) {
        recipe.tangents.assign(desc.tangents, desc.tangents + 3 * size_t{desc.pointCount});
    }
    return recipe;
}

Result<PointTableBuffer> tableOf(const gpu::Device& device, const CpuGroup& surfaces, const Group& group,
                                 const PointRecipe& recipe) {
    if (recipe.onVertices && group.view() != nullptr) {
        return Error{ErrorCode::argument, "SUPPLE_POINT_SET_ON_VERTICES: a group of a view has no vertices of all its "
                                          "instances"};
    }
    Result<std::vector<uint32_t>> words =
        pointTable(surfaces, recipe.points, recipe.tangents, recipe.format == SUPPLE_POINT_DERIVATIVES_32,
                   std::min(mostTableElements(device), kMostPointElements));
    if (!words) {
        return words.error();
    }
    Result<VertexPoints> onVertices = recipe.onVertices ? vertexPoints(surfaces, group.surfaces(), recipe.points)
                                                        : Result<VertexPoints>(VertexPoints());
    return onVertices ? makePointTable(device, std::move(*words), std::move(*onVertices)) : onVertices.error();
}

} // namespace

Result<std::shared_ptr<const CpuGroup>> Context::surfacesOf(Group& group) {
    if (group.points().surfaces() == nullptr) {
        auto made = runtime::surfacesOf(group.asset().prepared, group.recipe().desc());
        if (!made) {
            return made.error();
        }
        group.points().setSurfaces(std::move(*made));
    }
    return group.points().surfaces();
}

Result<uint64_t> Context::createPointSet(const SupplePointSetDesc& desc) {
    const std::shared_ptr<Group> group = groups.find(desc.group.id);
    const auto refuse = [&](const Error& error) {
        return Error{error.code, "suppleCreatePointSet: " + group->asset().character.name + ": " + error.message};
    };
    // What is cheap comes first.
    if (const Status room = PointSet::check(group->pointSource(), desc.pointCount, desc.format); !room) {
        return refuse(room.error());
    }
    const auto surfaces = surfacesOf(*group);
    if (!surfaces) {
        return refuse(surfaces.error());
    }
    PointRecipe recipe = recipeOf(desc);
    const Result<PointKernels*> kernels = kernelsFor(recipe);
    if (!kernels) {
        return refuse(kernels.error());
    }
    Result<PointTableBuffer> table = tableOf(*device_, **surfaces, *group, recipe);
    if (!table) {
        return refuse(table.error());
    }
    Result<std::shared_ptr<PointSet>> set =
        PointSet::create(group->pointSource(), **kernels, std::move(recipe), std::move(*table), desc.group.id);
    if (!set) {
        return refuse(set.error());
    }
    if (const Status room = reserveTasks(frame_, (*set)->taskNeeds()); !room) {
        return room.error();
    }
    group->points().makeRoom();
    const uint64_t id = pointSets.insert(*set);
    group->points().add(std::move(*set));
    group->noteBuffersChanged(++groupsMade_);
    return id;
}

bool Context::destroyPointSet(uint64_t id) {
    const std::shared_ptr<PointSet> set = pointSets.remove(id);
    if (set == nullptr) {
        return false;
    }
    if (const std::shared_ptr<Group> group = groups.find(set->group())) {
        group->points().remove(*set, set->lastRecordedFrame() > 0 ? frame_ : 0);
        group->noteBuffersChanged(++groupsMade_);
    }
    return true;
}

void Context::dropPoints(uint64_t group) {
    pointSets.forEachId([&](uint64_t id, const PointSet& set) {
        if (set.group() == group) {
            pointSets.remove(id);
        }
    });
}

Status Context::remakePoints(const Group& before, Remade& remade) {
    Group& group = *remade.group;
    const bool sameAsset = before.sharedAsset() == group.sharedAsset();
    const bool sameFaces = haveSameFaces(before.asset().character.cage, group.asset().character.cage);
    if (sameAsset) {
        group.points().setSurfaces(before.points().surfaces());
    }
    Status status = success();
    pointSets.forEachId([&](uint64_t id, const PointSet& set) {
        if (!status || set.group() != remade.id) {
            return;
        }
        Remade::Points& own = remade.points.emplace_back(Remade::Points{id, nullptr});
        if (!sameFaces) {
            return;
        }
        Result<std::shared_ptr<PointSet>> made = remadeFor(group, set, sameAsset ? set.table() : nullptr);
        if (!made) {
            const char* const function = sameAsset ? "suppleSetCapacity: " : "suppleReloadAsset: ";
            status = Error{made.error().code, function + group.asset().character.name +
                                                  ": a point set of its group: " + made.error().message};
            return;
        }
        group.points().makeRoom();
        group.points().add(*made);
        own.set = std::move(*made);
    });
    group.noteBuffersChanged(++groupsMade_);
    return status;
}

Result<std::shared_ptr<PointSet>> Context::remadeFor(Group& group, const PointSet& set, PointTableBuffer table) {
    const PointRecipe& recipe = set.recipe();
    if (const Status room = PointSet::check(group.pointSource(), set.pointCount(), recipe.format); !room) {
        return room.error();
    }
    const Result<PointKernels*> kernels = kernelsFor(recipe);
    if (!kernels) {
        return kernels.error();
    }
    if (table == nullptr) {
        const auto surfaces = surfacesOf(group);
        if (!surfaces) {
            return surfaces.error();
        }
        Result<PointTableBuffer> made = tableOf(*device_, **surfaces, group, recipe);
        if (!made) {
            return made.error();
        }
        table = std::move(*made);
    }
    return PointSet::create(group.pointSource(), **kernels, recipe, std::move(table), set.group());
}

Result<PointKernels*> Context::kernelsFor(const PointRecipe& recipe) {
    Result<PointKernels*> kernels = kernels_->points();
    if (!kernels) {
        return kernels;
    }
    Status prepared = (*kernels)->prepare(recipe.format);
    prepared = prepared && recipe.onVertices ? (*kernels)->prepareCopies(recipe.format) : prepared;
    return prepared ? kernels : prepared.error();
}

void Context::tellDropped(const Remade& remade) const {
    for (const Remade::Points& own : remade.points) {
        if (own.set == nullptr) {
            log(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_POINTS_DROPPED,
                remade.group->asset().character.name +
                    ": the cage has other faces than before, so a point set of its group is destroyed");
        }
    }
}

void Context::replacePoints(const Remade& remade) {
    for (const Remade::Points& own : remade.points) {
        if (own.set != nullptr) {
            pointSets.replace(own.id, own.set);
        } else {
            pointSets.remove(own.id);
        }
    }
}

} // namespace supple::runtime
