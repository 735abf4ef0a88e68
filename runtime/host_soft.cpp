#include "runtime/host_soft.h"

#include "shaders/pose/straight.h"

#include <algorithm>
#include <cstring>

namespace supple::runtime {

namespace {

/// Where an instance stands: rows, and what aligns them for descriptors.
constexpr uint32_t kPlaceElements = 16;
constexpr VkDeviceSize kPlaceBytes = kPlaceElements * gpu::kVec4Bytes;

skinning::Affine straight(const skinning::Affine& a, const skinning::Affine& b, float part) {
    skinning::Affine between = a;
    for (int row = 0; row < 3; ++row) {
        between.rows[row] = shared::straight(a.rows[row], b.rows[row], part);
    }
    return between;
}

} // namespace

void HostSoft::Poses::resize(const skinning::PoseLayout& layout, size_t count) {
    palettes.resize(count * layout.jointCount);
    rotations.resize(layout.hasRotations() ? palettes.size() : 0);
    morphWeights.resize(count * layout.morphCount);
}

HostSoft::HostSoft(const skinning::PoseLayout& layout, uint32_t capacity, const StateRoom& room)
    : layout_(layout), capacity_(capacity), room_(room) {
    layout_.stride = unshownStride(layout, shared::kMostDueSteps);
    before_.resize(layout_, capacity);
    undo_.resize(layout_, capacity);
    mixed_.resize(layout_, 1);
}

VkDeviceSize HostSoft::windowBytes(const skinning::PoseLayout& layout) {
    constexpr uint32_t kPoses = shared::kMostDueSteps;
    return std::max(VkDeviceSize{kPoses} * unshownStride(layout, kPoses) * gpu::kVec4Bytes, kPlaceBytes);
}

Status HostSoft::create(const gpu::Device& device, uint32_t windowSize, uint32_t framesInFlight) {
    if (!areTaken()) {
        return success();
    }
    device_ = &device;
    windowSize_ = windowSize;
    windowCount_ = (capacity_ + windowSize - 1) / windowSize;
    framesInFlight_ = framesInFlight;
    poseCopies_.reserve(windowCount_);
    placeCopies_.reserve(windowCount_);
    list_ = PoseList(capacity_, windowCount_, room_, shared::kMostDueSteps);
    gpu::BufferPlan local(buffers_), staging(staging_);
    list_.plan(local, staging, framesInFlight);
    constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                          VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const VkDeviceSize poses = capacity_ * poseBytes(), places = capacity_ * kPlaceBytes;
    poses_ = local.add({"supple steps", poses, kUsage, gpu::MemoryPurpose::poses});
    places_ = local.add({"supple places of steps", places, kUsage, gpu::MemoryPurpose::poses});
    posesStaging_ = staging.add({"supple step staging", poses * framesInFlight, VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    placesStaging_ = staging.add({"supple place staging", places * framesInFlight, VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    const Status status = local.create(device, gpu::MemoryKind::deviceLocal);
    return status ? staging.create(device, gpu::MemoryKind::upload) : status;
}

gpu::MemoryUse HostSoft::memoryUse() const {
    gpu::MemoryUse use = buffers_.use();
    use += staging_.use();
    return use;
}

void HostSoft::beginFrame(uint64_t frame) {
    if (areTaken()) {
        frame_ = frame;
        window_ = steps_ = shown_ = 0;
        list_.clear();
        poseCopies_.clear();
        placeCopies_.clear();
    }
}

void HostSoft::begin(uint32_t slot, const HostSteps::Due& due, const glm::mat4& placement) {
    if (!areTaken()) {
        return;
    }
    while (window_ < slot / windowSize_) {
        endWindow();
    }
    const uint32_t slotInWindow = slot - window_ * windowSize_;
    list_.addPose(slotInWindow, 0, 0.0);
    list_.addSteps(slotInWindow, due.steps, {});
    const glm::mat4 rows = glm::transpose(placement);
    const VkDeviceSize first = frame_ % framesInFlight_ * capacity_ + window_ * windowSize_;
    std::memcpy(placesStaging_.mapped() + (first + shown_) * kPlaceBytes, &rows, 3 * sizeof(glm::vec4));
    ++shown_;
    copy(before_, slot, undo_);
}

void HostSoft::copy(const Poses& from, uint32_t slot, Poses& to) const {
    const auto copyRun = [&](const auto& source, auto& target, size_t size) {
        std::copy_n(source.begin() + static_cast<ptrdiff_t>(slot * size), size,
                    target.begin() + static_cast<ptrdiff_t>(slot * size));
    };
    copyRun(from.palettes, to.palettes, layout_.jointCount);
    copyRun(from.rotations, to.rotations, layout_.hasRotations() ? layout_.jointCount : 0);
    copyRun(from.morphWeights, to.morphWeights, layout_.morphCount);
}

void HostSoft::put(const skinning::InstancePose& now, Poses& to, uint32_t slot) const {
    const auto first = static_cast<ptrdiff_t>(size_t{slot} * layout_.jointCount);
    std::copy(now.palette.begin(), now.palette.end(), to.palettes.begin() + first);
    std::copy(now.rotations.begin(), now.rotations.end(), to.rotations.begin() + first);
    std::copy_n(now.morphWeights.begin(), layout_.morphCount,
                to.morphWeights.begin() + static_cast<ptrdiff_t>(size_t{slot} * layout_.morphCount));
}

void HostSoft::mix(uint32_t slot, float way, const skinning::InstancePose& now) {
    if (way >= 1.0f) {
        put(now, mixed_, 0);
        return;
    }
    const size_t first = size_t{slot} * layout_.jointCount, firstWeight = size_t{slot} * layout_.morphCount;
    for (size_t j = 0; j < mixed_.palettes.size(); ++j) {
        mixed_.palettes[j] = straight(before_.palettes[first + j], now.palette[j], way);
    }
    for (size_t j = 0; j < mixed_.rotations.size(); ++j) {
        mixed_.rotations[j] = shared::straightRotation(before_.rotations[first + j], now.rotations[j], way);
    }
    for (size_t t = 0; t < mixed_.morphWeights.size(); ++t) {
        const float from = before_.morphWeights[firstWeight + t];
        mixed_.morphWeights[t] = from + (now.morphWeights[t] - from) * way;
    }
}

void HostSoft::step(uint32_t slot, float way, const skinning::InstancePose& now, HostSprings& springs) {
    if (!areTaken()) {
        return;
    }
    mix(slot, way, now);
    springs.showStep(slot, mixed_.palettes, mixed_.rotations);
    const VkDeviceSize first = (frame_ % framesInFlight_ * capacity_ + window_ * windowSize_) * poseBytes();
    skinning::writePose(layout_, {mixed_.palettes, mixed_.rotations, mixed_.morphWeights, glm::mat4(1.0f)},
                        posesStaging_.mapped() + first + steps_ * stepBytes());
    ++steps_;
}

void HostSoft::end(uint32_t slot, const skinning::InstancePose& now) {
    if (areTaken()) {
        put(now, before_, slot);
    }
}

void HostSoft::endWindow() {
    const VkDeviceSize slot = VkDeviceSize{window_} * windowSize_,
                       inStaging = frame_ % framesInFlight_ * capacity_ + slot;
    if (steps_ > 0) {
        poseCopies_.push_back({inStaging * poseBytes(), slot * poseBytes(), steps_ * stepBytes()});
    }
    if (shown_ > 0) {
        placeCopies_.push_back({inStaging * kPlaceBytes, slot * kPlaceBytes, shown_ * kPlaceBytes});
    }
    list_.endWindow(window_++);
    steps_ = shown_ = 0;
}

void HostSoft::endFrame() {
    while (window_ < windowCount_) {
        endWindow();
    }
}

VkDeviceSize HostSoft::recordUpload(VkCommandBuffer commandBuffer) {
    VkDeviceSize bytes = list_.recordUpload(*device_, commandBuffer, frame_);
    const auto record = [&](const std::vector<VkBufferCopy>& copies, const gpu::PlannedBuffer& from,
                            const gpu::PlannedBuffer& to) {
        if (!copies.empty()) {
            device_->vk.CmdCopyBuffer(commandBuffer, from.buffer(), to.buffer(), static_cast<uint32_t>(copies.size()),
                                      copies.data());
        }
        for (const VkBufferCopy& copy : copies) {
            bytes += copy.size;
        }
    };
    record(poseCopies_, posesStaging_, poses_);
    record(placeCopies_, placesStaging_, places_);
    return bytes;
}

StepPoses HostSoft::stepPoses() const {
    StepPoses steps;
    steps.poses = poses_.buffer();
    steps.scratch = places_.buffer();
    steps.list = list_.buffer();
    steps.poseBytes = poseBytes();
    steps.scratchBytes = kPlaceBytes;
    steps.listBytes = list_.bytes();
    steps.poseStride = layout_.stride;
    steps.scratchStride = kPlaceElements;
    return steps; // nothing travels
}

void HostSoft::restore(uint32_t slot) {
    if (areTaken()) {
        copy(undo_, slot, before_);
    }
}

void HostSoft::takeOver(const HostSoft& other, uint32_t count) {
    for (uint32_t slot = 0; areTaken() && slot < count; ++slot) {
        copy(other.before_, slot, before_);
        copy(other.undo_, slot, undo_);
    }
}

} // namespace supple::runtime
