#include "runtime/pose_source.h"

namespace supple::runtime {

namespace {

/// SUPPLE_POSES_SET: the host sets poses on the CPU; all go to the device in every frame.
class SetPoses final : public PoseSource {
public:
    explicit SetPoses(const PoseSourceDesc& desc)
        : device_(desc.device), framesInFlight_(desc.framesInFlight), capacity_(desc.capacity),
          poses_(*desc.asset, desc.capacity, desc.layout, desc.room) {}

    void reset(uint32_t slot) override { poses_.reset(slot); }
    void setTransform(uint32_t slot, const glm::mat4& transform) override { poses_.setTransform(slot, transform); }
    void setPosition(uint32_t slot, const glm::dvec3& position) override { poses_.setPosition(slot, position); }
    void setOrigin(const glm::dvec3& origin, uint32_t) override { poses_.setOrigin(origin); }
    void setMorphWeights(uint32_t slot, const float* weights) override { poses_.setMorphWeights(slot, weights); }
    [[nodiscard]] glm::mat4 jointTransform(uint32_t slot, uint32_t joint) override {
        return poses_.jointTransform(slot, joint);
    }
    [[nodiscard]] std::optional<skinning::Box> boundsOf(uint32_t slot, const skinning::Reach& reach) override {
        return poses_.boundsOf(slot, reach);
    }
    [[nodiscard]] uint64_t boundsVersion(uint32_t slot) const override { return poses_.version(slot); }
    void teleport(uint32_t slot) override { poses_.teleport(slot); }
    void setWind(const glm::dvec3& velocity) override { poses_.setWind(velocity); }
    void settleSteps() override { poses_.settleSteps(); }
    void cancelFrame(uint64_t frame) override { poses_.cancelFrame(frame); }
    [[nodiscard]] bool takesModifiers() const override { return poses_.takesModifiers(); }
    void setModifiers(uint32_t slot, std::span<const PlacedModifier> modifiers) override {
        poses_.setModifiers(slot, modifiers);
    }
    void setModifierGoal(uint32_t slot, uint32_t index, const ModifierGoal& goal) override {
        poses_.setModifierGoal(slot, index, goal);
    }
    [[nodiscard]] uint32_t modifierCount(uint32_t slot) override { return poses_.modifierCount(slot); }
    [[nodiscard]] std::span<const uint32_t> modifierWords(uint32_t slot, uint32_t index) override {
        return poses_.modifierWords(slot, index);
    }
    [[nodiscard]] HostPoses* host() override { return &poses_; }
    void takeOver(PoseSource& other, uint32_t count, const AssetMatch& match) override {
        poses_.takeOver(*other.host(), count, match);
    }

    void plan(gpu::BufferPlan& staging) override {
        staging_ =
            staging.add({"supple pose staging", frameBytes() * framesInFlight_, VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    }
    [[nodiscard]] Status create(const Buffers& buffers) override {
        target_ = buffers.poses;
        return poses_.soft().create(*device_, buffers.windowSize, framesInFlight_);
    }
    [[nodiscard]] gpu::MemoryUse memoryUse() const override { return poses_.soft().memoryUse(); }
    [[nodiscard]] StepPoses stepPoses() const override { return poses_.soft().stepPoses(); }
    [[nodiscard]] const PoseList::Round* listedSteps(uint32_t window, uint32_t round) const override {
        return &poses_.soft().listed(window).rounds[round];
    }
    PassCost recordUpload(VkCommandBuffer commandBuffer, const HostPoses::Frame& frame,
                          const InstanceSlots& slots) override {
        const uint32_t end = slots.end();
        const VkDeviceSize from = frame.number % framesInFlight_ * frameBytes();
        VkDeviceSize bytes = end * poses_.instanceBytes();
        poses_.write(frame, slots, staging_.mapped() + from);
        if (bytes > 0) {
            const VkBufferCopy region{from, 0, bytes};
            device_->vk.CmdCopyBuffer(commandBuffer, staging_.buffer(), target_, 1, &region);
        }
        if (poses_.soft().areTaken()) {
            bytes += poses_.soft().recordUpload(commandBuffer);
        }
        return {uint64_t{poses_.layout().jointCount} * end, bytes};
    }

private:
    [[nodiscard]] VkDeviceSize frameBytes() const { return capacity_ * poses_.instanceBytes(); }

    const gpu::Device* device_;
    uint32_t framesInFlight_, capacity_;
    HostPoses poses_;
    gpu::PlannedBuffer staging_;
    VkBuffer target_ = VK_NULL_HANDLE;
};

/// SUPPLE_POSES_PLAYBACK: the host says what instances play; the pose pass samples it.
class PlayedPoses final : public PoseSource {
public:
    explicit PlayedPoses(const PoseSourceDesc& desc) : desc_(desc) {}

    void reset(uint32_t slot) override { playback_.reset(slot); }
    void setTransform(uint32_t slot, const glm::mat4& transform) override { playback_.setTransform(slot, transform); }
    void setPosition(uint32_t slot, const glm::dvec3& position) override { playback_.setPosition(slot, position); }
    void setOrigin(const glm::dvec3& origin, uint32_t end) override { playback_.setOrigin(origin, end); }
    void teleport(uint32_t slot) override { playback_.teleport(slot); }
    void setWind(const glm::dvec3& velocity) override { playback_.setWind(velocity); }
    void settleSteps() override { playback_.settleSteps(); }
    void setMorphWeights(uint32_t slot, const float* weights) override { playback_.setMorphWeights(slot, weights); }
    [[nodiscard]] glm::mat4 jointTransform(uint32_t slot, uint32_t joint) override {
        return playback_.jointTransform(slot, joint);
    }
    [[nodiscard]] std::optional<skinning::Box> boundsOf(uint32_t slot, const skinning::Reach& reach) override {
        return playback_.boundsOf(slot, reach);
    }
    [[nodiscard]] uint64_t boundsVersion(uint32_t slot) const override { return playback_.boundsVersion(slot); }
    [[nodiscard]] uint64_t boundsVersions() const override { return playback_.boundsVersions(); }
    [[nodiscard]] bool takesModifiers() const override { return playback_.takesModifiers(); }
    void setModifiers(uint32_t slot, std::span<const PlacedModifier> modifiers) override {
        playback_.setModifiers(slot, modifiers);
    }
    void setModifierGoal(uint32_t slot, uint32_t index, const ModifierGoal& goal) override {
        playback_.setModifierGoal(slot, index, goal);
    }
    [[nodiscard]] uint32_t modifierCount(uint32_t slot) override { return playback_.modifierCount(slot); }
    [[nodiscard]] std::span<const uint32_t> modifierWords(uint32_t slot, uint32_t index) override {
        return playback_.modifierWords(slot, index);
    }
    [[nodiscard]] Playback* playback() override { return &playback_; }
    void takeOver(PoseSource& other, uint32_t count, const AssetMatch& match) override {
        playback_.takeOver(*other.playback(), count, match);
    }

    [[nodiscard]] Status create(const Buffers& buffers) override {
        return playback_.create({desc_.device, desc_.pipelines, desc_.asset, desc_.layout, desc_.capacity,
                                 buffers.windowSize, desc_.framesInFlight, buffers.poses, buffers.instances,
                                 buffers.instanceBytes, desc_.room});
    }
    [[nodiscard]] gpu::MemoryUse memoryUse() const override { return playback_.memoryUse(); }
    void recordWarmUp(VkCommandBuffer commandBuffer) const override { playback_.recordWarmUp(commandBuffer); }

    PassCost recordUpload(VkCommandBuffer commandBuffer, const HostPoses::Frame& frame, const InstanceSlots&) override {
        return {0, playback_.recordUpload(commandBuffer, frame.number)};
    }
    [[nodiscard]] StepPoses stepPoses() const override { return playback_.stepPoses(); }
    [[nodiscard]] const PoseList::Round* listedSteps(uint32_t window, uint32_t round) const override {
        return &playback_.listedPoses(window).rounds[round];
    }
    void beginFrame(uint64_t completedFrame) override { playback_.beginFrame(completedFrame); }
    void cancelFrame(uint64_t frame) override { playback_.cancelFrame(frame); }
    [[nodiscard]] bool has(Playback::Part part) const override { return playback_.has(part); }
    PassCost recordPart(gpu::Dispatches& dispatches, Playback::Part part,
                        const InstanceWindows& windows) const override {
        if (!has(part)) {
            return {};
        }
        windows.forEach([&](uint32_t w) { playback_.record(dispatches, part, w, windows); });
        if (part != Playback::Part::palette) { // whose poses are what is counted
            return {0, 0, windows.visible > 0};
        }
        const skinning::PoseLayout& layout = desc_.layout;
        const uint64_t poses = playback_.poseCount(windows);
        return {layout.jointCount * poses, uint64_t{layout.elements()} * 16 * poses};
    }

private:
    PoseSourceDesc desc_;
    Playback playback_;
};

} // namespace

VkDeviceSize poseWindowBytes(SupplePoseSource source, const Asset& asset, const skinning::PoseLayout& layout,
                             const StateRoom& room) {
    const VkDeviceSize played = source == SUPPLE_POSES_PLAYBACK ? playbackWindowBytes(asset, layout, room) : 0;
    const bool handsSteps = source == SUPPLE_POSES_SET && room.soft;
    const VkDeviceSize steps = handsSteps ? HostSoft::windowBytes(layout) : 0;
    return std::max({played, steps, VkDeviceSize{layout.stride} * 16});
}

std::unique_ptr<PoseSource> makePoseSource(SupplePoseSource source, const PoseSourceDesc& desc) {
    switch (source) {
    case SUPPLE_POSES_SET:
        return std::make_unique<SetPoses>(desc);
    case SUPPLE_POSES_PLAYBACK:
        return std::make_unique<PlayedPoses>(desc);
    default: // the host fills a buffer
        return std::make_unique<PoseSource>();
    }
}

} // namespace supple::runtime
