#include "runtime/surface_sets.h"

namespace supple::runtime {

Status SurfaceSets::create(const Desc& desc, const std::function<void(const Which&, SetContents&)>& fill) {
    sets_.assign(size_t{desc.windows} * kSetsOfWindow, {}); // also without kinds: passes ask for them and bind none
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
    // Addresses are by binding, which says the same in all kinds.
    bound_.resize(desc.device->mapping.sharesDispatches ? 1 : desc.kinds.size());
    Status status = success();
    for (size_t k = 0; k < bound_.size() && status; ++k) {
        status = bound_[k].create(*desc.device, desc.passes->layout(desc.kinds[k]), static_cast<uint32_t>(all.size()),
                                  "supple surface");
    }
    for (size_t i = 0; i < all.size() && status; ++i) {
        SetContents contents(*desc.device, views_, status);
        fill(all[i], contents);
        for (size_t k = 0; k < bound_.size() && status; ++k) {
            bound_[k].write(*desc.device, desc.passes->layout(desc.kinds[k]), i, contents.resources());
        }
        for (size_t k = 0; k < desc.kinds.size() && status; ++k) {
            sets_[index(all[i])][static_cast<size_t>(desc.kinds[k])] = bound_[std::min(k, bound_.size() - 1)][i];
        }
    }
    return status;
}

} // namespace supple::runtime
