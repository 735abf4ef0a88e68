// Which markers of a clip playback passes on its way from one time to another.
#pragma once

#include "cage/character.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace supple::skinning {

/// Times are unwrapped. Forwards it is (from, to], backwards (`to` below `from`) [to, from).
struct MarkerInterval {
    double from = 0.0, to = 0.0; ///< seconds, at most 1e9 from 0
    bool loop = false;           ///< the clip occurs once every duration, before 0 too. Else once, from 0 on
    bool start = false;          ///< `from` itself belongs to the interval; the pass that ends there does not
};

struct PassedMarker {
    uint32_t marker = 0; ///< index into Clip::markers
    double time = 0.0;   ///< unwrapped
};

/// Fills as much of `out` as there is, in the order in which playback passes them; returns how many there are. A clip
/// shorter than a microsecond does not loop.
[[nodiscard]] uint64_t markersBetween(const cage::Clip& clip, const MarkerInterval& interval,
                                      std::span<PassedMarker> out);

} // namespace supple::skinning
