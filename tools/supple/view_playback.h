// What the viewer's figure plays on the device, if its clips are to go over into each other.
#pragma once

#include "host/figure.h"
#include "tools/common/transition_setting.h"

#include <cstdint>
#include <optional>

namespace supple::tools {

/// Its group plays (host::GroupOptions::plays).
class ViewPlayback {
public:
    /// There is another group, or it has played something else.
    void forget() { clip_.reset(); }
    /// While the figure plays, by the seconds that its clip goes on.
    void advance(double seconds) { time_ += seconds; }
    /// The clip at a time of it, or the rest pose. A clip that is not the one that was shown last is gone over to,
    /// during `seconds`; without a method, and to what stands, at once.
    [[nodiscard]] Status show(const host::FigureGroup& group, uint32_t clip, double time,
                              std::optional<host::TransitionMethod> method, double seconds);

private:
    [[nodiscard]] bool isShown(const host::Figure& figure, uint32_t clip, double time) const;

    double time_ = 0.0;            ///< the group's
    std::optional<uint32_t> clip_; ///< that was shown last
    double start_ = 0.0, offset_ = 0.0;
};

} // namespace supple::tools
