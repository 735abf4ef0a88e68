// The buffers of a group's surfaces, which may go back while no instance is drawn (SuppleGroupDesc.keepUnseenFrames).
#pragma once

#include "gpu/buffer_plan.h"

#include <cstdint>

namespace supple::runtime {

/// While the buffers are given back, planned buffers of the plan are null and have no bytes.
class SurfaceBuffers {
public:
    SurfaceBuffers() : plan_(buffers_) {}
    SurfaceBuffers(const SurfaceBuffers&) = delete;
    SurfaceBuffers& operator=(const SurfaceBuffers&) = delete;

    /// The buffers may go after so many recordings in a row without an instance to draw; 0: they stay.
    void setKeepFrames(uint64_t frames) { keepFrames_ = frames; }
    [[nodiscard]] bool mayGo() const { return keepFrames_ > 0; }
    [[nodiscard]] gpu::BufferPlan& plan() { return plan_; }
    [[nodiscard]] Status create(const gpu::Device& device) {
        return plan_.create(device, gpu::MemoryKind::deviceLocal);
    }

    [[nodiscard]] bool areThere() const { return state_ == State::there; }
    /// Their memory is the device's again.
    [[nodiscard]] bool areFreed() const { return state_ == State::freed; }
    /// The group is recorded, with instances to draw or without.
    void noteRecorded(bool draws) { unseenFrames_ = draws ? 0 : unseenFrames_ + 1; }
    /// Whether there has been nothing to draw for long enough.
    [[nodiscard]] bool areIdle() const { return mayGo() && unseenFrames_ >= keepFrames_; }

    /// `frame` and those behind it do not use them. Earlier frames may be in flight.
    void give(uint64_t frame);
    /// Whether they are given back, and no frame uses them any more.
    [[nodiscard]] bool mayBeFreed(uint64_t completedFrame) const {
        return state_ == State::leaving && completedFrame >= lastFrame_;
    }
    void free();
    /// They are there again: empty, if they were freed.
    [[nodiscard]] Status take(const gpu::Device& device);

    /// The group takes the place of one whose buffers these were: the version goes on from theirs.
    void takePlaceOf(const SurfaceBuffers& before) { version_ = before.version_ + (before.areThere() ? 0 : 1); }
    /// Rises whenever they go or come.
    [[nodiscard]] uint64_t version() const { return version_; }
    [[nodiscard]] gpu::MemoryUse use() const;
    /// Bytes that are freed, and that take() needs.
    [[nodiscard]] VkDeviceSize freedBytes() const { return freedBytes_; }

private:
    enum class State { there, leaving, freed };

    gpu::BufferSet buffers_, leaving_;
    gpu::BufferPlan plan_;
    State state_ = State::there;
    uint64_t keepFrames_ = 0, unseenFrames_ = 0;
    uint64_t lastFrame_ = 0; ///< that may use what is leaving
    uint64_t version_ = 0;
    VkDeviceSize freedBytes_ = 0;
};

} // namespace supple::runtime
