// The descriptor sets that surface passes bind: for each window of instances, coefficient pool and kind of output.
#pragma once

#include "gpu/bound_sets.h"
#include "gpu/memory.h"
#include "gpu/pipeline.h"
#include "surface/program.h"
#include "surface/programs.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace supple::runtime {

/// Collects what the sets of one window bind. Each layout takes the bindings that it has.
class SetContents {
public:
    SetContents(const gpu::Device& device, gpu::TexelViews& views, Status& status)
        : device_(&device), views_(&views), status_(&status) {}

    void buffer(uint32_t binding, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize bytes) {
        resources_.push_back({binding, {buffer, offset, bytes}, VK_NULL_HANDLE});
    }
    void texels(uint32_t binding, VkFormat format, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize bytes,
                const char* name) {
        if (device_->mapping.sharesDispatches) {
            return; // tasks read no texels
        }
        resources_.push_back({binding, {}, views_->make(*device_, buffer, format, offset, bytes, name, *status_)});
    }
    [[nodiscard]] std::span<const gpu::BoundResource> resources() const { return resources_; }

private:
    const gpu::Device* device_;
    gpu::TexelViews* views_;
    Status* status_;
    std::vector<gpu::BoundResource> resources_;
};

inline constexpr uint32_t kSetsOfWindow = 4; ///< by SurfaceSets::Which

class SurfaceSets {
public:
    struct Which {
        uint32_t window = 0;
        uint32_t pool = 0;     ///< of coefficients: motion has two, which take turns
        bool previous = false; ///< previous positions are written
    };
    struct Desc {
        const gpu::Device* device = nullptr;
        const surface::Programs* passes = nullptr;
        std::span<const surface::SetKind> kinds; ///< those that the group's program binds
        uint32_t windows = 1;
        bool motion = false;
    };
    /// `fill` says what the sets of a window, pool and kind of output bind.
    [[nodiscard]] Status create(const Desc& desc, const std::function<void(const Which&, SetContents&)>& fill);

    [[nodiscard]] const surface::Sets& at(const Which& which) const { return sets_[index(which)]; }

private:
    [[nodiscard]] size_t index(const Which& which) const {
        return (which.window * 2 + which.pool) * 2 + (which.previous ? 1 : 0);
    }
    std::vector<surface::Sets> sets_;
    std::vector<gpu::BoundSets> bound_; ///< one a kind; of tasks one for all kinds
    gpu::TexelViews views_;
};

} // namespace supple::runtime
