// What a pass of one group wrote, as timings report it.
#pragma once

#include <cstdint>

namespace supple::runtime {

class View;

struct PassCost {
    uint64_t points = 0;
    uint64_t bytes = 0;           ///< 0: nothing was recorded,
    bool onDevice = false;        ///< or the device alone knows both
    const View* solved = nullptr; ///< the view whose budget the pass has solved

    PassCost& operator+=(const PassCost& more) {
        points += more.points;
        bytes += more.bytes;
        onDevice = onDevice || more.onDevice;
        solved = solved != nullptr ? solved : more.solved;
        return *this;
    }
};

} // namespace supple::runtime
