#include "runtime/played_masks.h"

#include "skinning/playback.h"

#include <algorithm>
#include <cstring>

namespace supple::runtime {

PlayedMasks::PlayedMasks(const Asset& asset, bool keepsBefore)
    : asset_(&asset),
      values_(size_t{shared::kMaxMasks} * skinning::maskElements(*asset.clipTable) * 4 * (keepsBefore ? 2 : 1), 1.0f),
      joints_(size_t{shared::kMaxMasks} * asset.clipTable->jointCount, 1.0f), keepsBefore_(keepsBefore) {}

void PlayedMasks::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, uint32_t framesInFlight) {
    buffer_ = device.add({"supple masks", bytes(),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                              VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                          gpu::MemoryPurpose::poses});
    staging_.plan(staging, "supple mask staging", bytes(), framesInFlight);
}

void PlayedMasks::keepBefore() {
    const auto half = static_cast<ptrdiff_t>(values_.size() / 2);
    std::copy(values_.begin(), values_.begin() + half, values_.begin() + half);
    differ_ = false;
}

void PlayedMasks::set(uint32_t mask, std::span<const float> joints, std::span<const float> morphs) {
    if (keepsBefore_ && !isSet_) {
        keepBefore();
        isSet_ = differ_ = true;
    }
    skinning::writeMask(*asset_->clipTable, asset_->rig, joints, morphs,
                        std::span(values_).subspan((mask - 1) * floats(), floats()));
    const uint32_t jointCount = asset_->clipTable->jointCount;
    const std::span<float> own = std::span(joints_).subspan(size_t{mask - 1} * jointCount, jointCount);
    if (joints.empty()) {
        std::fill(own.begin(), own.end(), 1.0f);
    } else {
        std::copy(joints.begin(), joints.end(), own.begin());
    }
    kinds_[mask - 1] = joints.empty() ? Kind::morphs : Kind::joints;
    isChanged_ = true;
}

void PlayedMasks::takeOver(const PlayedMasks& other, const AssetMatch& match) {
    if (match.same) {
        values_ = other.values_;
        joints_ = other.joints_;
        kinds_ = other.kinds_;
        isSet_ = other.isSet_;
        differ_ = other.differ_;
        return;
    }
    const skinning::ClipTable& table = *asset_->clipTable;
    const skinning::ClipTable& otherTable = *other.asset_->clipTable;
    std::vector<float> joints(table.jointCount), morphs(table.targetCount);
    for (uint32_t mask = 1; mask <= shared::kMaxMasks; ++mask) {
        const Kind kind = other.kinds_[mask - 1];
        if (kind == Kind::none) {
            continue;
        }
        for (uint32_t j = 0; j < joints.size(); ++j) {
            const size_t from = size_t{mask - 1} * otherTable.jointCount + match.joints[j];
            joints[j] = match.joints[j] != cage::kNone ? other.joints_[from] : 1.0f;
        }
        const std::span<const float> values =
            std::span(other.values_).subspan((mask - 1) * other.floats(), other.floats());
        const std::span<const float> before = skinning::morphMaskOf(otherTable, values);
        for (uint32_t t = 0; t < morphs.size(); ++t) {
            const float unnamed = kind == Kind::joints ? 0.0f : 1.0f;
            morphs[t] = match.targets[t] != cage::kNone ? before[match.targets[t]] : unnamed;
        }
        set(mask, kind == Kind::joints ? std::span<const float>(joints) : std::span<const float>(), morphs);
    }
}

void PlayedMasks::cancelFrame(uint64_t frame) {
    isChanged_ = isChanged_ || frame_ == frame;
    // What they were in the frame before that stays what they were in the last frame.
    isSet_ = isSet_ || (keepsBefore_ && recorded_ == frame && differ_);
}

VkDeviceSize PlayedMasks::recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, uint64_t frame) {
    if (differ_ && !isSet_) {
        keepBefore();
        isChanged_ = true;
    }
    isSet_ = false;
    recorded_ = frame;
    if (!isChanged_) {
        return 0;
    }
    std::memcpy(staging_.next(), values_.data(), bytes());
    isChanged_ = false;
    frame_ = frame;
    return staging_.recordCopy(device, commandBuffer, 0, buffer(), 0, bytes());
}

} // namespace supple::runtime
