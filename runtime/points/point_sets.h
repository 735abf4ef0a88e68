// The point sets of a group.
#pragma once

#include "runtime/points/point_set.h"

#include <memory>
#include <utility>
#include <vector>

namespace supple::runtime {

class CpuGroup;

/// Passes on what concerns all of them. Frames of the group do not wait for what a set uploads: until it is there, they
/// leave the set out.
class PointSets final : public gpu::FrameMember {
public:
    void add(std::shared_ptr<PointSet> set) { sets_.push_back({std::move(set), false, 0}); }
    /// Room for another one, so that add() needs no memory.
    void makeRoom() { sets_.reserve(sets_.size() + 1); }
    /// Frames up to `lastFrame` may still use it.
    void remove(const PointSet& set, uint64_t lastFrame);
    [[nodiscard]] bool empty() const;

    /// The group's surfaces, which points are found on; null until setSurfaces().
    [[nodiscard]] const std::shared_ptr<const CpuGroup>& surfaces() const { return surfaces_; }
    void setSurfaces(std::shared_ptr<const CpuGroup> surfaces) { surfaces_ = std::move(surfaces); }

    [[nodiscard]] gpu::MemoryUse memoryUse() const;
    [[nodiscard]] gpu::TaskNeeds taskNeeds() const;
    void addTransfers(Transfers& transfers) const;
    PassCost record(gpu::Dispatches& dispatches, uint64_t frame, const glm::vec3& pastStep);

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
        uint64_t lastFrame = 0; ///< of a removed one
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
};

} // namespace supple::runtime
