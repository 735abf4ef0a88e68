// Points of a set that have the positions of surface vertices: what copies these behind *evaluate*.
#pragma once

#include "gpu/bound_sets.h"
#include "runtime/points/point_kernels.h"
#include "runtime/points/vertex_points.h"

#include <span>
#include <vector>

namespace supple::runtime {

/// Recording allocates nothing.
class VertexCopies {
public:
    /// What the copies of a part of the set's instances bind beside vertices.
    struct Target {
        VkDescriptorBufferInfo points{}, pasts{};
        uint32_t window = 0;
    };
    /// What must outlive the copies.
    struct Source {
        const gpu::Device* device = nullptr;
        const PointKernels* kernels = nullptr;
        const Surfaces* surfaces = nullptr;
        const InstanceListing* listing = nullptr;
        VkBuffer entries = VK_NULL_HANDLE;
        std::span<const VertexPoints::Run> runs;
    };
    VertexCopies(const Source& source, std::vector<Target> targets);

    /// Before the first recording, and when the surfaces have other buffers. While they have none, nothing is bound.
    [[nodiscard]] Status bind();
    /// The buffers of the surfaces are about to be freed.
    void unbind();
    /// How many dispatches and sets there are at most.
    [[nodiscard]] uint32_t count() const;

    /// Records those of one target. `push`: but for what the surface says.
    void record(gpu::Dispatches& dispatches, size_t target, SupplePointFormat format,
                shared::VertexPointPush push) const;
    void recordWarmUp(gpu::Dispatches& dispatches, SupplePointFormat format) const;
    /// How many points an instance has on vertices as they are now.
    [[nodiscard]] uint64_t points() const;

private:
    /// The surface's points as they are now; null: none.
    [[nodiscard]] const VertexPoints::Run* runOf(uint32_t surface) const;
    void writeSet(size_t set, uint32_t surface, const Target& target, VkBufferView instances);

    Source source_;
    std::vector<Target> targets_;
    std::vector<uint32_t> surfaces_; ///< that have points at some rate
    gpu::TexelViews views_;
    gpu::BoundSets sets_; ///< by surface, then by target; none: not bound
};

} // namespace supple::runtime
