// What is soft of instances whose poses the host sets: the device moves it, by poses of steps that the CPU makes and
// hands over in each frame.
#pragma once

#include "gpu/buffer_plan.h"
#include "runtime/host_springs.h"
#include "runtime/host_steps.h"
#include "runtime/pose_list.h"
#include "skinning/deform_kernels.h"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::runtime {

/// Frames allocate nothing.
class HostSoft {
public:
    HostSoft() = default; ///< not taken
    /// `layout`: of what is shown.
    HostSoft(const skinning::PoseLayout& layout, uint32_t capacity, const StateRoom& room);
    /// False: nothing is soft, whatever this is told.
    [[nodiscard]] bool areTaken() const { return capacity_ > 0; }
    /// Once; this stays where it is from then on, as its planned buffers point into it.
    [[nodiscard]] Status create(const gpu::Device& device, uint32_t windowSize, uint32_t framesInFlight);
    /// What an instance takes of a buffer that is bound by windows.
    [[nodiscard]] static VkDeviceSize windowBytes(const skinning::PoseLayout& layout);
    [[nodiscard]] gpu::MemoryUse memoryUse() const;

    // A frame: of rising instances that run steps, each begins, takes its steps in their order and ends.
    void beginFrame(uint64_t frame);
    /// `placement`: on the device.
    void begin(uint32_t slot, const HostSteps::Due& due, const glm::mat4& placement);
    /// `way`: of HostSteps::Due; `now`: the frame's pose. Joints that swing are as `springs` have just left them.
    void step(uint32_t slot, float way, const skinning::InstancePose& now, HostSprings& springs);
    void end(uint32_t slot, const skinning::InstancePose& now);
    void endFrame();
    /// Behind it, if this is taken; the bytes.
    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer);

    [[nodiscard]] StepPoses stepPoses() const;
    [[nodiscard]] const PoseList::Window& listed(uint32_t window) const { return list_.window(window); }

    void restore(uint32_t slot); ///< as before the last frame, which is cancelled
    /// The first `count` instances, of the same asset.
    void takeOver(const HostSoft& other, uint32_t count);

private:
    /// Poses of all instances, or of one.
    struct Poses {
        std::vector<skinning::Affine> palettes;
        std::vector<glm::vec4> rotations; ///< where the layout has some
        std::vector<float> morphWeights;
        void resize(const skinning::PoseLayout& layout, size_t count);
    };
    void copy(const Poses& from, uint32_t slot, Poses& to) const;
    void put(const skinning::InstancePose& now, Poses& to, uint32_t slot) const;
    void mix(uint32_t slot, float way, const skinning::InstancePose& now); ///< into mixed_
    void endWindow();
    [[nodiscard]] VkDeviceSize stepBytes() const { return layout_.stride * gpu::kVec4Bytes; }
    [[nodiscard]] VkDeviceSize poseBytes() const { return shared::kMostDueSteps * stepBytes(); } ///< of an instance

    const gpu::Device* device_ = nullptr;
    skinning::PoseLayout layout_; ///< of steps
    uint32_t capacity_ = 0, windowSize_ = 0, windowCount_ = 0, framesInFlight_ = 2;
    StateRoom room_;
    Poses before_, undo_; ///< of the last frame that each was shown in; as these were before the frame
    Poses mixed_;         ///< of one step

    PoseList list_;
    uint64_t frame_ = 0;
    uint32_t window_ = 0;            ///< that is being listed
    uint32_t steps_ = 0, shown_ = 0; ///< in it so far
    std::vector<VkBufferCopy> poseCopies_, placeCopies_;

    gpu::BufferSet buffers_, staging_;
    gpu::PlannedBuffer poses_, places_, posesStaging_, placesStaging_;
};

} // namespace supple::runtime
