// The table of stages between the joint palettes and the surfaces, and the stages of a group.
#pragma once

#include "runtime/stages/cage_stage.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace supple::runtime {

/// In the order of the frame: deform first, gather last.
[[nodiscard]] std::span<const CageStageRow> cageStageRows();

/// The rows of a context with what each has once per context.
class CageStageTable {
public:
    CageStageTable() = default;
    /// `rows` must outlive the table.
    explicit CageStageTable(std::span<const CageStageRow> rows) : rows_(rows), kernels_(rows.size()) {}

    [[nodiscard]] std::span<const CageStageRow> rows() const { return rows_; }
    /// Makes the row's kernels if they are not there, on any thread. Pipelines that exist know their layouts, so
    /// kernels stay.
    [[nodiscard]] Result<CageKernels*> kernels(size_t row, const gpu::Device& device, gpu::Pipelines& pipelines);
    /// Makes the pipelines of all stages of a group that is to come: on any thread, also beside recording.
    [[nodiscard]] Status makePipelines(const PlannedStages& planned, const gpu::Device& device,
                                       gpu::Pipelines& pipelines);

private:
    std::span<const CageStageRow> rows_;
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>(); ///< of kernels_
    std::vector<std::shared_ptr<CageKernels>> kernels_;                  ///< by row
};

/// The stages of a group, by row. Passes on what concerns all of them.
class CageStages final : public gpu::FrameMembers {
public:
    /// Makes those that the group wants.
    [[nodiscard]] Status create(CageStageTable& table, gpu::Pipelines& pipelines, const CageStageDesc& desc);
    [[nodiscard]] BoundBytes boundBytes() const;
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging);
    /// `cages`: what the last stage leaves them in.
    [[nodiscard]] Status createSets(const gpu::PlannedBuffer& cages, const InstanceListing& listing);
    /// The stages of a group whose instances in the first `count` slots are this group's now.
    void takeOver(CageStages& other, uint32_t count, const AssetMatch& match);

    [[nodiscard]] gpu::MemoryUse memoryUse() const;
    /// The deformed cages that a surface is made from.
    [[nodiscard]] const gpu::PlannedBuffer& cagesOf(uint32_t surface) const;
    [[nodiscard]] bool has(size_t row) const { return stages_[row] != nullptr; }
    /// How often stages are recorded in a frame, at most.
    [[nodiscard]] uint32_t count(uint32_t surfaces) const {
        return static_cast<uint32_t>(stages_.size()) * std::max(surfaces, 1u);
    }
    /// Whether instances may be left out by what is known of them before they are posed (CageStageRow::keepsReach).
    [[nodiscard]] bool keepReach() const { return keepReach_; }
    /// What the dispatches of all of them follow from.
    [[nodiscard]] CageStageRow::Tasks tasks() const { return tasks_; }

    /// Begins a frame of the group at the host's time: finds who is new, then records the uploads of all stages.
    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, double time, const InstanceSlots& slots);
    /// In a frame that recordUpload() has begun. `surface`: if the row is recorded for each of them.
    PassCost record(gpu::Dispatches& dispatches, size_t row, uint32_t surface = SUPPLE_NO_SURFACE);
    void recordEarly(gpu::Dispatches& dispatches, uint32_t round);
    void cancelFrame(uint64_t frame) override;

private:
    void findNew(const InstanceSlots& slots);
    [[nodiscard]] CageFrame frame(gpu::Dispatches& dispatches, uint32_t surface) const;
    template <class F>
    void forEach(F&& visit) const {
        std::for_each(stages_.begin(), stages_.end(), [&](const auto& stage) { stage ? visit(*stage) : void(); });
    }

    const gpu::Device* device_ = nullptr;
    std::vector<std::unique_ptr<CageStage>> stages_; ///< by row; null: the group does not have it
    bool keepReach_ = true;
    CageStageRow::Tasks tasks_ = CageStageRow::Tasks::stand;
    VkDeviceSize cageBytes_ = 0; ///< of all instances
    uint32_t stride_ = 0;
    gpu::PlannedBuffer cages_, between_; ///< `between_` if some stage writes apart
    const InstanceWindows* windows_ = nullptr;
    // Empty if no stage keeps instances: then nobody looks through the slots.
    std::vector<uint32_t> pasts_;    ///< by slot: InstanceSlots::birth of what was listed last; 0: nothing
    std::vector<uint32_t> newSlots_; ///< room for all
    uint64_t frame_ = 0;
    double seconds_ = 0.0, time_ = 0.0; ///< of the last recording
    bool timed_ = false;                ///< there was one
};

} // namespace supple::runtime
