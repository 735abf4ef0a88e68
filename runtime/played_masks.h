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
    /// The asset, with its clip table, must outlive this. `keepsBefore`: behind the masks, the device reads what they
    /// were in the last frame.
    PlayedMasks(const Asset& asset, bool keepsBefore);
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
    void cancelFrame(uint64_t frame);

private:
    /// In a mask.
    [[nodiscard]] size_t floats() const { return values_.size() / (keepsBefore_ ? 2 : 1) / shared::kMaxMasks; }
    /// What they are is also what they were in the last frame.
    void keepBefore();

    const Asset* asset_ = nullptr;
    std::vector<float> values_;
    std::vector<float> joints_;                         ///< one run a mask, one value a joint: for another version
    enum class Kind : uint8_t { none, joints, morphs }; ///< joints: with or without morph targets
    std::array<Kind, shared::kMaxMasks> kinds_{};
    bool keepsBefore_ = false;
    bool isSet_ = false;  ///< since the last frame
    bool differ_ = false; ///< from what they were in the last frame
    bool isChanged_ = true;
    uint64_t frame_ = 0;    ///< the last that recorded an upload
    uint64_t recorded_ = 0; ///< the last
    gpu::PlannedBuffer buffer_;
    ChangeStaging staging_;
};

} // namespace supple::runtime
