#include "runtime/queries/tree_kernels.h"

#include "gpu/memory.h"
#include "shaders/queries_cast_comp.h"
#include "shaders/queries_fit_comp.h"
#include "shaders/queries_refit_comp.h"

#include <algorithm>
#include <iterator>

namespace supple::runtime {

using namespace supple::shared;

Result<TreeKernels> TreeKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    const gpu::Binding bindings[] = {
        gpu::wideStorage(kPieceBinding),
        gpu::narrowTexels(kPieceTexelBinding),
        gpu::wideStorage(kQueryCageBinding),
        gpu::narrowTexels(kQueryCageTexelBinding),
        gpu::storage(kRayBinding),
        gpu::storage(kBestBinding),
        gpu::storage(kQueryBoxBinding),
        gpu::wideStorage(kInstanceBinding),
        gpu::narrowTexels(kInstanceTexelBinding),
        gpu::storage(kTreeBinding),
        gpu::narrowTexels(kTreeTexelBinding),
    };
    TreeKernels made;
    made.pipelines_ = &pipelines;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::create(device, bindings, sizeof(QueryPush), "supple queries, trees");
    if (!layout) {
        return layout.error();
    }
    made.layout_ = std::move(*layout);
    return made;
}

Status TreeKernels::prepare() {
    gpu::Pipelines::Batch batch(*pipelines_);
    const gpu::Kernel made[] = {batch.get(layout_, queries_fit_comp, {}, "supple queries, fit"),
                                batch.get(layout_, queries_refit_comp, {}, "supple queries, refit"),
                                batch.get(layout_, queries_cast_comp, {}, "supple queries, cast")};
    if (Status status = batch.make(); !status) {
        return status;
    }
    std::copy(std::begin(made), std::end(made), kernels_);
    return success();
}

void TreeKernels::record(gpu::Dispatches& dispatches, Pass pass, const gpu::BoundSet& set, const QueryPush& push,
                         VkBuffer sizes, uint32_t first) const {
    const auto place = static_cast<uint32_t>(pass);
    dispatches.dispatchIndirect(kernels_[place], set, std::as_bytes(std::span(&push, 1)), sizes,
                                VkDeviceSize{first + place} * gpu::kVec4Bytes);
}

} // namespace supple::runtime
