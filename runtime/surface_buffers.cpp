#include "runtime/surface_buffers.h"

#include <utility>

namespace supple::runtime {

void SurfaceBuffers::give(uint64_t frame) {
    leaving_ = buffers_.release();
    lastFrame_ = frame - 1;
    state_ = State::leaving;
    ++version_;
}

void SurfaceBuffers::free() {
    freedBytes_ = leaving_.use().total();
    leaving_ = {};
    state_ = State::freed;
}

Status SurfaceBuffers::take(const gpu::Device& device) {
    if (state_ == State::leaving) {
        buffers_ = std::exchange(leaving_, {});
    } else if (Status made = create(device); !made) {
        return made;
    }
    freedBytes_ = 0;
    unseenFrames_ = 0;
    state_ = State::there;
    ++version_;
    return success();
}

gpu::MemoryUse SurfaceBuffers::use() const {
    gpu::MemoryUse use = buffers_.use();
    use += leaving_.use();
    return use;
}

} // namespace supple::runtime
