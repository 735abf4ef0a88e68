#include "runtime/queries/nearest_kernels.h"

#include "runtime/queries/query_kernels.h"
#include "shaders/queries_nearest_comp.h"
#include "shaders/queries_nearest_finish_comp.h"
#include "supple/supple_queries.h"

namespace supple::runtime {

static_assert(sizeof(SupplePlace) == 16);

Status NearestKernels::prepare(gpu::Pipelines& pipelines, const gpu::ComputeLayout& layout) {
    gpu::Pipelines::Batch batch(pipelines);
    const gpu::Kernel find = batch.get(layout, queries_nearest_comp, {}, "supple queries, nearest"),
                      finish = batch.get(layout, queries_nearest_finish_comp, {}, "supple queries, nearest points");
    if (Status made = batch.make(); !made) {
        return made;
    }
    find_ = find;
    finish_ = finish;
    return success();
}

void NearestKernels::recordFind(gpu::Dispatches& dispatches, const gpu::BoundSet& set,
                                const shared::QueryPush& push) const {
    QueryKernels::recordRays(dispatches, find_, set, push, uint64_t{push.pieceCount} * push.instanceCount);
}

void NearestKernels::recordFinish(gpu::Dispatches& dispatches, const gpu::BoundSet& set,
                                  const shared::QueryPush& push) const {
    QueryKernels::recordEachRay(dispatches, finish_, set, push);
}

} // namespace supple::runtime
