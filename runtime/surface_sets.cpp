#include "runtime/surface_sets.h"

namespace supple::runtime {

Status SurfaceSets::create(const Desc& desc, const std::function<void(const Which&, SetContents&)>& fill) {
    sets_.assign(size_t{desc.windows} * 4, {}); // also without kinds: passes ask for them and bind none
    if (desc.kinds.empty()) {
        return success();
    }
    std::vector<Which> all;
    for (uint32_t w = 0; w < desc.windows; ++w) {
        for (uint32_t pool = 0; pool < (desc.motion ? 2u : 1u); ++pool) {
            all.push_back({w, pool, false});
            if (desc.motion) {
                all.push_back({w, pool, true});
            }
        }
    }
    for (const surface::SetKind kind : desc.kinds) {
        Result<gpu::DescriptorPoolHandle> pool = gpu::createDescriptorPool(
            *desc.device, desc.passes->layout(kind), static_cast<uint32_t>(all.size()), "supple surface");
        if (!pool) {
            return pool.error();
        }
        pools_.push_back(std::move(*pool));
    }
    Status status = success();
    for (const Which& which : all) {
        SetContents contents(*desc.device, views_, status);
        fill(which, contents);
        for (size_t k = 0; k < desc.kinds.size() && status; ++k) {
            const gpu::ComputeLayout& layout = desc.passes->layout(desc.kinds[k]);
            const Result<VkDescriptorSet> set =
                gpu::allocateSet(*desc.device, layout, pools_[k].get(), "supple surface");
            if (!set) {
                return set.error();
            }
            gpu::writeSet(*desc.device, layout, *set, contents.resources());
            sets_[index(which)][static_cast<size_t>(desc.kinds[k])] = *set;
        }
    }
    return status;
}

} // namespace supple::runtime
