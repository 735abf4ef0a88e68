// The masks of a group that plays, which layers name: uploaded when they change.
#pragma once

#include "gpu/buffer_plan.h"
#include "runtime/asset.h"
#include "runtime/asset_match.h"
#include "runtime/change_staging.h"
#include "shaders/shared/pose.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

/// Masks are numbered from 1. Setting and recording allocate nothing.
class PlayedMasks {
public:
    PlayedMasks() = default;
    /// The asset, with its clip table, must outlive this.
    explicit PlayedMasks(const Asset& asset);
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, uint32_t framesInFlight);

    /// `joints`: one a joint; `morphs`: one a target of the clip table (skinning/playback.h, writeMask).
    void set(uint32_t mask, std::span<const float> joints, std::span<const float> morphs);
    [[nodiscard]] bool has(uint32_t mask) const { return kinds_[mask - 1] != Kind::none; }
    /// What the device reads.
    [[nodiscard]] std::span<const float> values() const { return values_; }

    /// Joints and morph targets that the other version of the asset lacks have what they would have if the mask did not
    /// name them.
    void takeOver(const PlayedMasks& other, const AssetMatch& match);

    [[nodiscard]] VkBuffer buffer() const { return buffer_.buffer(); }
    [[nodiscard]] VkDeviceSize bytes() const { return values_.size() * sizeof(float); }
    /// The bytes of it.
    VkDeviceSize recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, uint64_t frame);
    void cancelFrame(uint64_t frame) { isChanged_ = isChanged_ || frame_ == frame; }

private:
    [[nodiscard]] size_t floats() const { return values_.size() / shared::kMaxMasks; } ///< of a mask

    const Asset* asset_ = nullptr;
    std::vector<float> values_;
    std::vector<float> joints_;                         ///< one run a mask, one value a joint: for another version
    enum class Kind : uint8_t { none, joints, morphs }; ///< joints: with or without morph targets
    std::array<Kind, shared::kMaxMasks> kinds_{};
    bool isChanged_ = true;
    uint64_t frame_ = 0; ///< the last that recorded an upload
    gpu::PlannedBuffer buffer_;
    ChangeStaging staging_;
};

} // namespace supple::runtime
