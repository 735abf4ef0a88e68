// What supple profile measured, and what comes of it: medians, percentiles, spans.
#pragma once

#include "tools/common/statistics.h"

#include <cstdint>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::tools {

inline constexpr double kNanosecondsInMillisecond = 1e6;

/// One pass of one frame.
struct PassSample {
    std::string pass;
    double gpuBegin = 0.0; ///< nanoseconds on the device's clock
    double gpuEnd = 0.0;
    double cpuRecord = 0.0; ///< nanoseconds
    uint64_t points = 0;
    uint64_t bytes = 0;
    size_t surface = 0; ///< of ProfileRun::surfaces
};

/// What a pass works on: a surface of a group, or the group as a whole.
struct ProfiledSurface {
    std::string file;   ///< its name alone
    std::string scheme; ///< empty: the group as a whole, which is posed, deformed and culled
    struct Part {
        std::string name;
        uint32_t patches = 0;
    };
    std::vector<Part> parts; ///< of the surface; they go through passes together
};
/// Whether they tell more than the passes do: there are several surfaces, or several parts.
[[nodiscard]] bool areSeveral(const std::vector<ProfiledSurface>& surfaces);
/// "pip.glb, catmull-clark".
[[nodiscard]] std::string nameOf(const ProfiledSurface& surface);
/// "Body 62 %, Hat 38 % of the patches"; empty if there is one.
[[nodiscard]] std::string partsText(const ProfiledSurface& surface);

/// What a view drew of a frame.
struct DrawnSample {
    uint32_t vertices = 0, wantedVertices = 0, patches = 0;
    uint32_t drawnInstances = 0, droppedInstances = 0;
    float levelScale = 1.0f;
    bool shortfall = false;
};

/// One frame. CPU times are nanoseconds; begins count from the start of the run.
struct FrameSample {
    uint64_t frame = 0;
    std::vector<PassSample> passes;
    double poseBegin = 0.0, poseTime = 0.0;     ///< setting the poses of all instances
    double recordBegin = 0.0, recordTime = 0.0; ///< suppleRecord
    double submitted = 0.0;                     ///< when the frame was handed to the device
    DrawnSample drawn;                          ///< in a view
};

/// Who has memory, and how much. `use.givenBack`: what goes back while nobody is seen.
struct MemoryHolder {
    std::string name; ///< "asset pip.glb"
    SuppleMemoryUse use{};
};

/// One file under one scheme; or several in a view.
struct ProfileRun {
    std::string file; ///< or all of them
    std::string scheme;
    std::string clip; ///< that instances play: its name, or "bind pose"; in a view one for each file
    uint32_t rate = 0;
    uint32_t patchRate = 0; ///< segments along a patch edge: less than the rate where an edge of the cage has several
    uint32_t instances = 0;
    bool playback = false;             ///< poses on the device
    uint32_t budget = 0;               ///< of the view, surface vertices; 0: no view
    uint32_t patches = 0;              ///< an instance; of several kinds the most
    SuppleMemoryUse memory{};          ///< of the context, after the last frame
    std::vector<MemoryHolder> holders; ///< assets, groups, the view; what else there is belongs to the context
    uint32_t keptUnseen = 0;           ///< frames after which groups give memory back; 0: they keep it
    std::vector<ProfiledSurface> surfaces;
    std::vector<FrameSample> frames;
    /// The device's clock and the run's, in nanoseconds, before the first frame and after the last. Empty: the device
    /// cannot tell, and the first frame's work is taken to begin when it was submitted.
    struct Clocks {
        double device = 0.0, run = 0.0;
        double deviation = 0.0; ///< of the two readings
    };
    std::vector<Clocks> clocks;
    std::string hashes; ///< where they were asked for: hashView
};

/// One pass over all frames of a run, all groups and parts of it together; times in milliseconds. Where spans of a pass
/// overlap, their time counts once.
struct PassSummary {
    std::string pass;
    Summary gpu;
    Summary cpuRecord;
    uint64_t points = 0; ///< a frame
    uint64_t bytes = 0;
    [[nodiscard]] double megapointsPerSecond() const; ///< at the median; 0 when the clock showed no time
};

/// What a view drew over all frames of a run.
struct DrawnSummary {
    uint64_t vertices = 0, wantedVertices = 0, patches = 0, drawnInstances = 0; ///< medians
    uint32_t mostDropped = 0;                                                   ///< instances, of a frame
    float leastLevelScale = 1.0f;
    size_t shortfallFrames = 0;
};

struct RunSummary {
    std::vector<PassSummary> passes; ///< in the order of the frame
    std::vector<Summary> surfaces;   ///< GPU: as ProfileRun::surfaces, all passes of each together
    PassSummary total;               ///< GPU: first begin to last end of a frame; CPU, points, bytes: the sums
    Summary covered;                 ///< GPU: of that, what lies within some pass
    Summary pose;                    ///< CPU: setting the poses
    Summary record;                  ///< CPU: suppleRecord
    DrawnSummary drawn;              ///< in a view
};
[[nodiscard]] RunSummary summarizeRun(const ProfileRun& run);

/// By frame, in milliseconds on the device.
struct FrameTimes {
    std::vector<double> frame;   ///< first begin to last end
    std::vector<double> covered; ///< what lies within some pass
    struct Pass {
        std::string pass;
        std::vector<double> times; ///< 0 where a frame does not have it
    };
    std::vector<Pass> passes; ///< in the order of the frame
};
[[nodiscard]] FrameTimes frameTimes(const ProfileRun& run);

} // namespace supple::tools
