// The draws of a whole view by a call per bin. A bin is what a material system can draw without changing state: all
// draws of bindless materials, those of one pipeline, or those of one material.
#pragma once

#include "host/graph.h"
#include "host/pipelines.h"
#include "host/shaders/view_draws.h"

#include <functional>
#include <span>
#include <vector>

namespace supple::host {

/// Supple's commands draw nothing where a capacity has no patches, and most do not. A compute pass of the host gathers
/// those that draw something, behind suppleRecord, so that a call issues no others.
class ViewDraws {
public:
    /// The bin of a draw that is left out.
    static constexpr uint32_t kNoBin = UINT32_MAX;
    using BinOf = std::function<uint32_t(uint32_t surface, const SuppleLevelDraw& draw)>;

    /// How record() reads what Supple wrote: it belongs into SuppleRecordDesc.after, beside kDrawn.
    static constexpr Scope kReads{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    /// What is to wait for the drawing of the frame before, and is to be visible to this frame's: kDrawn.
    static constexpr Scope kWrites{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};

    /// `surfaces`: of all groups of one view that have levels. A bin keeps their order. When a group is made anew or
    /// destroyed, make this anew, too. ErrorCode::unsupported: the device lacks multiDrawIndirect or
    /// shaderDrawParameters. ErrorCode::argument: the surfaces are not of one view.
    [[nodiscard]] static Result<ViewDraws> create(Device& device, std::span<const SuppleLevelOutput> surfaces,
                                                  uint32_t bins, const BinOf& binOf);

    /// Gathers the commands of the frame that was recorded before.
    void record(VkCommandBuffer commands) const;
    /// Binds the view's indices, too. The shader finds its ViewDraw at firstDraw(bin) + gl_DrawID of drawn().
    void draw(VkCommandBuffer commands, uint32_t bin) const;

    [[nodiscard]] uint32_t firstDraw(uint32_t bin) const { return bins_[bin].first; }
    /// The most that a call of the bin may issue.
    [[nodiscard]] uint32_t drawCount(uint32_t bin) const { return bins_[bin].count; }
    [[nodiscard]] const Buffer& drawn() const { return drawn_; }
    /// SUPPLE_BUCKETS_BINDING and SUPPLE_PATCHES_BINDING of supple_surface.glsl, for all surfaces.
    [[nodiscard]] const SuppleBufferRange& buckets() const { return buckets_; }
    [[nodiscard]] const SuppleBufferRange& patches() const { return patches_; }

private:
    struct Bin {
        uint32_t first = 0, count = 0;
    };

    explicit ViewDraws(Device& device) : countsDraws_(device.countsDraws()) {}
    [[nodiscard]] Status takeBuffers(std::span<const SuppleLevelOutput> surfaces);
    /// Fills bins_.
    [[nodiscard]] std::vector<shared::ViewDraw> sorted(std::span<const SuppleLevelOutput> surfaces, const BinOf& binOf);
    [[nodiscard]] Status createBuffers(Device& device, std::span<const shared::ViewDraw> draws);
    [[nodiscard]] Status createPipeline(Device& device);

    bool countsDraws_;
    SuppleBufferRange indices_{}, indirect_{}, buckets_{}, patches_{};
    std::vector<Bin> bins_;
    Buffer draws_, binTable_, commands_, drawn_, counts_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

} // namespace supple::host
