// The point sets of a group.
#pragma once

#include "runtime/points/point_set.h"

#include <memory>
#include <utility>
#include <vector>

namespace supple::runtime {

class CpuGroup;
class PointFinder;

/// Frames of the group do not wait for what a set uploads: until it is there, they leave the set out.
class PointSets final : public gpu::FrameMember {
public:
    void add(std::shared_ptr<PointSet> set) { sets_.push_back({std::move(set)}); }
    /// Room for another one, so that add() needs no memory.
    void makeRoom() { sets_.reserve(sets_.size() + 1); }
    /// Frames up to `lastFrame` may still use it.
    void remove(const PointSet& set, uint64_t lastFrame);
    [[nodiscard]] bool empty() const;

    /// The group's surfaces, which points are found on; null until setSurfaces().
    [[nodiscard]] const std::shared_ptr<const CpuGroup>& surfaces() const { return surfaces_; }
    void setSurfaces(std::shared_ptr<const CpuGroup> surfaces) { surfaces_ = std::move(surfaces); }
    /// What findPoints() keeps from call to call.
    [[nodiscard]] std::shared_ptr<PointFinder>& finder() { return finder_; }

    [[nodiscard]] gpu::MemoryUse memoryUse() const;
    [[nodiscard]] gpu::TaskNeeds taskNeeds() const;
    /// Whether some set remembers where its points were.
    [[nodiscard]] bool havePasts() const;
    /// Whether the next recording is the first of some set.
    [[nodiscard]] bool beginsAny() const;
    /// Notes that the group is recorded in the frame, with the sets that there are.
    void noteAsked(uint64_t frame);
    /// What the sets write that were there when the group was recorded.
    void addTransfers(Transfers& transfers, uint64_t frame) const;
    PassCost record(gpu::Dispatches& dispatches, uint64_t frame, const glm::vec3& pastStep);
    /// Whether points of some set have the positions of surface vertices.
    [[nodiscard]] bool copyVertices() const;
    /// Behind the surface vertices.
    PassCost recordCopies(gpu::Dispatches& dispatches) const;
    /// The surfaces have other buffers, or are about to free theirs.
    [[nodiscard]] Status bindVertices();
    void unbindVertices();

    /// Whether something is due for recordStatics().
    [[nodiscard]] bool uploadsPending() const;
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) override;
    void countStatics(gpu::StaticCount& count) const override;
    [[nodiscard]] Status stageStatics() override;
    void recordWarmUp(VkCommandBuffer commandBuffer) const override;
    void beginFrame(uint64_t completedFrame) override;
    void cancelFrame(uint64_t frame) override;

private:
    struct Entry {
        std::shared_ptr<PointSet> set;
        bool removed = false;
        uint64_t lastFrame = 0;  ///< of a removed one
        uint64_t askedFrame = 0; ///< noteAsked()
    };
    template <class F>
    void forEach(F&& visit) const {
        for (const Entry& entry : sets_) {
            if (!entry.removed) {
                visit(*entry.set);
            }
        }
    }

    std::vector<Entry> sets_;
    std::shared_ptr<const CpuGroup> surfaces_;
    std::shared_ptr<PointFinder> finder_;
};

} // namespace supple::runtime
