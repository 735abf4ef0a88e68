// Which look the next frame of the viewer has: on a CPU device a fast one while something moves, then the studio's,
// pass by pass.
#pragma once

#include <cstdint>

namespace supple::tools {

enum class Look : uint32_t {
    automatic, ///< fast while something moves and the device is a CPU, else the studio's
    fast,
    studio,
};

/// How one frame's picture comes about.
struct LookStep {
    enum class Kind {
        studio, ///< the whole studio at once
        fast,   ///< one light, coarse triangles, fewer pixels
        refine, ///< one pass of many that are averaged
        keep,   ///< the picture stays as it is
    };
    Kind kind = Kind::studio;
    uint32_t pass = 0;       ///< of refining
    uint32_t scaleIndex = 0; ///< of kFastScales
};

/// Shares of the window's width and height that fast pictures have.
inline constexpr float kFastScales[] = {1.0f, 0.75f, 0.5f};

class LookPace {
public:
    /// `fixed`: frames do not depend on how long they take.
    LookPace(bool cpuDevice, uint32_t refiningPasses, bool fixed)
        : cpuDevice_(cpuDevice), passes_(refiningPasses), fixed_(fixed) {}

    /// same: the frame is to show what the last one did. seconds: since the last frame began.
    [[nodiscard]] LookStep next(Look look, bool same, double seconds);

private:
    /// Fewer pixels where fast frames take too long, more where there is time.
    void chooseScale(double seconds);

    bool cpuDevice_;
    uint32_t passes_;
    bool fixed_;
    uint32_t calm_ = 0; ///< frames since something moved
    uint32_t scale_ = 2;
    bool wasFast_ = false;
    double fastSeconds_ = 0.0; ///< a mean over the last fast frames
    uint32_t fastFrames_ = 0;  ///< since the scale changed
};

} // namespace supple::tools
