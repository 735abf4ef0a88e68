// Work that is recorded once, and once more if the frame that had it is cancelled.
#pragma once

#include <cstdint>

namespace supple::runtime {

class RecordedOnce {
public:
    [[nodiscard]] bool due() const { return due_; }
    void record(uint64_t frame) {
        due_ = false;
        frame_ = frame;
    }
    [[nodiscard]] bool recordedIn(uint64_t frame) const { return !due_ && frame_ == frame; }
    /// The work is due again; `wanted` false: there is none.
    void renew(bool wanted = true) { due_ = wanted; }
    /// The command buffers of `frame` will never run.
    void cancel(uint64_t frame) { due_ = due_ || (frame_ == frame && frame != 0); }

private:
    bool due_ = true;
    uint64_t frame_ = 0; ///< that recorded it; 0: none has
};

} // namespace supple::runtime
