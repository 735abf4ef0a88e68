#include "runtime/queries/query_kernels.h"

#include "gpu/memory.h"
#include "shaders/queries_aim_comp.h"
#include "shaders/queries_boxes_comp.h"
#include "shaders/queries_finish_comp.h"
#include "shaders/queries_list_comp.h"
#include "shaders/queries_pick_comp.h"
#include "shaders/queries_refine_comp.h"
#include "supple/supple_queries.h"

#include <algorithm>

namespace supple::runtime {

using namespace supple::shared;

namespace {

static_assert(sizeof(QueryPush) <= gpu::kPushConstantBytes);
static_assert(sizeof(SuppleRay) == 32 && sizeof(SuppleTriangleHit) == 32 && sizeof(SuppleHit) == 64);

/// Lanes of a dispatch at most, so that their numbers have room in 32 bits.
constexpr uint64_t kMostLanes = uint64_t{1} << 30;

} // namespace

Result<QueryKernels> QueryKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    const gpu::Binding bindings[] = {
        gpu::wideStorage(kPieceBinding),     gpu::narrowTexels(kPieceTexelBinding),
        gpu::wideStorage(kQueryCageBinding), gpu::narrowTexels(kQueryCageTexelBinding),
        gpu::storage(kRayBinding),           gpu::storage(kBestBinding),
        gpu::storage(kQueryBoxBinding),      gpu::storage(kHitBinding),
        gpu::wideStorage(kInstanceBinding),  gpu::narrowTexels(kInstanceTexelBinding),
        gpu::storage(kTriangleBinding),
    };
    QueryKernels made;
    made.device_ = &device;
    made.pipelines_ = &pipelines;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::create(device, bindings, sizeof(QueryPush), "supple queries");
    if (!layout) {
        return layout.error();
    }
    made.layout_ = std::move(*layout);
    Result<TreeKernels> trees = TreeKernels::create(device, pipelines);
    if (!trees) {
        return trees.error();
    }
    made.trees_ = std::move(*trees);
    return made;
}

Status QueryKernels::prepare() {
    gpu::Pipelines::Batch batch(*pipelines_);
    const gpu::Kernel boxes = batch.get(layout_, queries_boxes_comp, {}, "supple queries, boxes"),
                      aim = batch.get(layout_, queries_aim_comp, {}, "supple queries, aim"),
                      list = batch.get(layout_, queries_list_comp, {}, "supple queries, list"),
                      pick = batch.get(layout_, queries_pick_comp, {}, "supple queries, pick"),
                      finish = batch.get(layout_, queries_finish_comp, {}, "supple queries, hits"),
                      refine = batch.get(layout_, queries_refine_comp, {}, "supple queries, refine");
    if (Status made = batch.make(); !made) {
        return made;
    }
    boxes_ = boxes;
    aim_ = aim;
    list_ = list;
    pick_ = pick;
    finish_ = finish;
    refine_ = refine;
    return success();
}

void QueryKernels::recordBoxes(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const QueryPush& push) const {
    const uint64_t local = device_->mapping.wide ? 1 : device_->mapping.localSize;
    dispatches.dispatch(boxes_, set, push, (push.instanceCount + local - 1) / local);
}

void QueryKernels::recordAim(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const QueryPush& push) const {
    recordRays(dispatches, aim_, set, push, push.instanceCount);
}

void QueryKernels::recordRays(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set,
                              QueryPush push, uint64_t lanes) {
    const uint64_t local = dispatches.device().mapping.localSize;
    const auto rays =
        static_cast<uint32_t>(std::min<uint64_t>(std::max<uint64_t>(kMostLanes / std::max<uint64_t>(lanes, 1), 1),
                                                 UINT32_MAX / kRaysPerLane) *
                              kRaysPerLane);
    const uint32_t end = push.rayCount;
    for (uint32_t first = 0; first < end; first += std::min(rays, end - first)) {
        push.firstRay = first;
        push.rayCount = first + std::min(rays, end - first);
        const uint64_t blocks = (push.rayCount - first + kRaysPerLane - 1) / kRaysPerLane;
        dispatches.dispatch(kernel, set, push, (lanes * blocks + local - 1) / local);
    }
}

void QueryKernels::recordEachRay(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set,
                                 const QueryPush& push) {
    const uint64_t local = dispatches.device().mapping.localSize;
    dispatches.dispatch(kernel, set, push, (push.rayCount + local - 1) / local);
}

void QueryKernels::recordList(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const QueryPush& push) const {
    dispatches.dispatch(list_, set, push, 1);
}

void QueryKernels::recordPick(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const QueryPush& push,
                              VkBuffer sizes) const {
    dispatches.dispatchIndirect(pick_, set, std::as_bytes(std::span(&push, 1)), sizes,
                                VkDeviceSize{push.firstDispatch} * gpu::kVec4Bytes);
}

void QueryKernels::recordRefine(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const QueryPush& push) const {
    recordEachRay(dispatches, refine_, set, push);
}

void QueryKernels::recordFinish(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const QueryPush& push) const {
    recordEachRay(dispatches, finish_, set, push);
}

} // namespace supple::runtime
