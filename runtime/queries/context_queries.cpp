// The query pools of a context.
#include "gpu/barriers.h"
#include "runtime/context.h"
#include "runtime/queries/piece_tree.h"
#include "runtime/queries/triangle_faces.h"

#include <limits>

namespace supple::runtime {

namespace {

// What queries write, and all that they do.
constexpr gpu::SyncScope kQueryWrites{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                      VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr gpu::SyncScope kQueryAll{kQueryWrites.stages, kQueryWrites.access | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                                                            VK_ACCESS_2_SHADER_SAMPLED_READ_BIT |
                                                            VK_ACCESS_2_TRANSFER_READ_BIT};

QuerySource sourceOf(const std::shared_ptr<Group>& group) {
    const PointSource points = group->pointSource();
    const uint32_t vertices = group->asset().character.cage.vertexCount();
    return {points.device, points.listing, points.cages, points.cageStride, vertices, points.surfaces, group};
}

/// Lanes own hits by number, and kNothingMet is none.
Status checkLanes(uint64_t lanes) {
    return lanes < std::numeric_limits<uint32_t>::max()
               ? success()
               : Status(Error{ErrorCode::limit, "its groups have " + std::to_string(lanes) +
                                                    " pieces on all instances, more than 32 bits number"});
}

uint64_t mostLanes(const QueryPool& pool) {
    uint64_t lanes = 0;
    for (const QueryPool::Member& member : pool.members()) {
        lanes += member.group != nullptr ? member.group->mostLanes() : 0;
    }
    return lanes;
}

} // namespace

Result<std::shared_ptr<QueryGroup>> Context::queryGroup(const std::shared_ptr<Group>& group,
                                                        std::shared_ptr<QueryPieces> pieces,
                                                        const QueryBuffers& buffers) {
    const Result<QueryKernels*> kernels = kernels_->queries();
    if (!kernels) {
        return kernels.error();
    }
    Status prepared = (*kernels)->prepare();
    prepared = prepared && buffers.areMany() ? (*kernels)->prepareTrees() : prepared;
    if (!prepared) {
        return prepared.error();
    }
    // Pieces that come from a pool of few rays have no tree.
    if (pieces == nullptr || (buffers.areMany() && pieces->firstLeaf == 0)) {
        const auto surfaces = surfacesOf(*group);
        if (!surfaces) {
            return surfaces.error();
        }
        Result<PieceTable> table = pieceTable(**surfaces, QueryPieces::mostElements(*device_));
        if (!table) {
            return table.error();
        }
        const Result<uint32_t> firstLeaf =
            buffers.areMany()
                ? addLeaves(*table, group->asset().character.cage.positions, QueryPieces::mostElements(*device_))
                : Result<uint32_t>(0u);
        if (!firstLeaf) {
            return firstLeaf.error();
        }
        auto made = QueryPieces::create(*device_, std::move(*table));
        if (!made) {
            return made.error();
        }
        pieces = std::move(*made);
        pieces->firstLeaf = *firstLeaf;
    }
    return QueryGroup::create(sourceOf(group), **kernels, std::move(pieces), buffers);
}

Result<uint64_t> Context::createQueryPool(const SuppleQueryPoolDesc& desc) {
    const bool findsNearest = (desc.flags & SUPPLE_QUERY_POOL_NEAREST) != 0;
    Result<std::shared_ptr<QueryPool>> pool = QueryPool::create(*device_, desc.rayCount, framesInFlight_, findsNearest);
    if (!pool) {
        return Error{pool.error().code, "suppleCreateQueryPool: " + pool.error().message};
    }
    if (findsNearest) {
        const Result<QueryKernels*> kernels = kernels_->queries();
        const Status prepared = kernels ? (*kernels)->prepareNearest() : Status(kernels.error());
        if (!prepared) {
            return Error{prepared.error().code, "suppleCreateQueryPool: " + prepared.error().message};
        }
    }
    for (uint32_t g = 0; g < desc.groupCount; ++g) {
        const std::shared_ptr<Group> group = groups.find(desc.groups[g].id);
        Result<std::shared_ptr<QueryGroup>> made = queryGroup(group, nullptr, (*pool)->buffers());
        if (!made) {
            return Error{made.error().code, "suppleCreateQueryPool: group " + std::to_string(g) + " (" +
                                                group->asset().character.name + "): " + made.error().message};
        }
        (*pool)->add(desc.groups[g].id, std::move(*made));
    }
    if (const Status lanes = checkLanes(mostLanes(**pool)); !lanes) {
        return Error{lanes.error().code, "suppleCreateQueryPool: " + lanes.error().message};
    }
    (*pool)->makeRoom();
    makeRoom(retiredPools_, queryPools.slotCount() + 1);
    return queryPools.insert(std::move(*pool));
}

bool Context::destroyQueryPool(uint64_t id) {
    std::shared_ptr<QueryPool> pool = queryPools.remove(id);
    if (pool == nullptr) {
        return false;
    }
    retiredPools_.push_back(retired(std::move(pool)));
    return true;
}

void Context::dropQueries(uint64_t group) {
    queryPools.forEach([&](QueryPool& pool) {
        if (QueryPool::Member* const member = pool.find(group)) {
            pool.put(*member, nullptr, frame_);
        }
    });
}

Status Context::remakeQueries(const Group& before, Remade& remade) {
    const bool sameAsset = before.sharedAsset() == remade.group->sharedAsset();
    std::shared_ptr<QueryPieces> pieces;
    Status status = success();
    queryPools.forEachId([&](uint64_t id, QueryPool& pool) {
        const QueryPool::Member* const member = pool.find(remade.id);
        if (!status || member == nullptr) {
            return;
        }
        pieces = sameAsset ? member->group->pieces() : pieces;
        Result<std::shared_ptr<QueryGroup>> made = queryGroup(remade.group, pieces, pool.buffers());
        status = made ? checkLanes(mostLanes(pool) - member->group->mostLanes() + (*made)->mostLanes())
                      : Status(made.error());
        if (!status) {
            const char* const function = sameAsset ? "suppleSetCapacity: " : "suppleReloadAsset: ";
            status = Error{status.error().code, function + remade.group->asset().character.name +
                                                    ": a query pool of its group: " + status.error().message};
            return;
        }
        pieces = (*made)->pieces();
        pool.makeRoom();
        remade.queries.push_back({id, std::move(*made)});
    });
    return status;
}

void Context::replaceQueries(const Remade& remade) {
    for (const Remade::Queries& own : remade.queries) {
        QueryPool& pool = *queryPools.at(own.pool);
        pool.put(*pool.find(remade.id), own.group, frame_);
    }
}

Status Context::askGroups(QueryPool& pool, const SuppleQueryDesc& desc) const {
    for (QueryPool::Member& member : pool.members()) {
        member.isAsked =
            desc.groups == nullptr && member.group != nullptr && groups.at(member.id)->askedFrame() == frame_;
    }
    for (uint32_t g = 0; g < desc.groupCount; ++g) {
        const std::string name = "suppleRecordQueries: group " + std::to_string(g);
        QueryPool::Member* const member = pool.find(desc.groups[g].id);
        if (member == nullptr) {
            return Error{ErrorCode::staleHandle, name + ": the pool has no such group"};
        }
        if (groups.at(member->id)->askedFrame() != frame_) {
            return Error{ErrorCode::order, name + ": no suppleRecord of this frame has it"};
        }
        member->isAsked = true;
    }
    bool any = false;
    for (QueryPool::Member& member : pool.members()) {
        if (member.isAsked) { // another thread may record the others
            const Group& group = *groups.at(member.id);
            member.isEmpty = group.waitsIn(frame_);
            member.rate = rateOf(group.surfaces());
            any = true;
        }
    }
    return any ? success()
               : Status(
                     Error{ErrorCode::order, "suppleRecordQueries: no suppleRecord of this frame has a group of it"});
}

Status Context::recordQueries(VkCommandBuffer commandBuffer, QueryPool& pool, const SuppleQueryDesc& desc) {
    if (Status open = checkOpen("suppleRecordQueries"); !open) {
        return open;
    }
    if (pool.hasBatch(frame_)) {
        return Error{ErrorCode::order, "suppleRecordQueries: the frame has a batch of the pool already"};
    }
    if (desc.rayCount == 0) {
        return success();
    }
    if (Status asked = askGroups(pool, desc); !asked) {
        return asked;
    }
    device_->beginLabel(commandBuffer, "supple queries");
    Timings::Recording timing;
    if (timings.measuresFrame()) {
        timing = timings.open(commandBuffer, 1);
    }
    timing.beginPass();
    gpu::memoryBarrier(*device_, commandBuffer,
                       {desc.before.stages | kQueryWrites.stages | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                        desc.before.access | kQueryWrites.access},
                       kQueryAll);
    {
        const std::scoped_lock lock(uploading_);
        pool.recordStatics(commandBuffer, frame_);
        for (QueryPool::Member& member : pool.members()) { // pools may have pieces in common
            member.isEmpty = member.isEmpty || (member.isAsked && member.group->staticsPending());
        }
    }
    pool.record(commandBuffer, frame_,
                {{desc.hostRays, desc.rays.buffer, desc.rays.offset},
                 {desc.hostTriangles, desc.triangles.buffer, desc.triangles.offset},
                 {desc.hostPlaces, desc.places.buffer, desc.places.offset, sizeof(SupplePlace)},
                 desc.rayCount,
                 (desc.flags & SUPPLE_QUERY_READ_BACK) != 0});
    timing.endPass(SUPPLE_PASS_QUERIES, {}, SUPPLE_NO_SURFACE,
                   {desc.rayCount, desc.rayCount * uint64_t{sizeof(SuppleHit)}});
    timing.end();
    if (desc.after.stages != 0) {
        gpu::memoryBarrier(*device_, commandBuffer, kQueryWrites, {desc.after.stages, desc.after.access});
    }
    device_->endLabel(commandBuffer);
    return success();
}

} // namespace supple::runtime
