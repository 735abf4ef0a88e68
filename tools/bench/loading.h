// From a parsed character to its first frame: what each step takes, and what then lies on the device.
#pragma once

#include "tools/bench/cages.h"
#include "tools/bench/workbench.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::bench {

/// Milliseconds of wall time, medians over loads into a context that has the pipelines already.
struct LoadTimes {
    double createAsset = 0.0;  ///< weights and morph targets packed and staged; the rig
    double createGroup = 0.0;  ///< connectivity, the scheme's tables built and staged, buffers, descriptor sets
    double record = 0.0;       ///< the first frame, with its uploads
    double submit = 0.0;       ///< until the device is done with it
    double secondSubmit = 0.0; ///< the same of the next frame, which uploads a pose and no tables
    double prepare = 0.0;      ///< what any thread can do before (supplePrepare), without reading the file
    double hitch = 0.0;        ///< creating the asset and the group of what was prepared, with a budget of uploads
    double arrive = 0.0;       ///< the longest that recording takes of the frames that then upload, to the first drawn
    double parse = 0.0;        ///< reading the character from a GLB, which comes before prepare
    double cooked = 0.0;       ///< reading what was prepared from a cooked file, in the place of both
    [[nodiscard]] double untilRecorded() const { return createAsset + createGroup + record; }
    [[nodiscard]] double untilDone() const { return untilRecorded() + submit; }
};

struct Loading {
    std::string cage, scheme;
    uint32_t faces = 0, patches = 0;
    LoadTimes times;
    Workbench::StaticBytes bytes;
};

/// Rate 8, 16-byte vertices, with the attributes if the character has any.
[[nodiscard]] Result<Loading> measureLoading(host::Device& device, Workbench& workbench, const BenchCage& cage,
                                             SuppleScheme scheme, uint32_t loads);

/// One pipeline, as a scheme's first group makes it.
struct PipelineTime {
    std::string name;
    uint64_t spirvBytes = 0;
    double cold = 0.0, warm = 0.0; ///< milliseconds, the shader module's included
};

struct Pipelines {
    std::string cage, scheme;
    std::vector<PipelineTime> pipelines;
    double cold = 0.0, warm = 0.0;                     ///< milliseconds, all of them
    double sideBySide = 0.0;                           ///< the same cold, on all threads (SuppleContextDesc.runJobs)
    double coldCpu = 0.0, warmCpu = 0.0;               ///< of cold and warm, CPU time of the process
    double coldFirstFrame = 0.0, warmFirstFrame = 0.0; ///< submit to end: drivers that compile at first use do it here
    double coldSecondFrame = 0.0, warmSecondFrame = 0.0; ///< the same of the next frame
    double warmUp = 0.0; ///< recording and running suppleRecordWarmUp, in a context that has done nothing else
    double preparedFirstFrame = 0.0, preparedSecondFrame = 0.0; ///< submit to end of the frames behind it
    uint32_t createdWhileRecording = 0;
};

enum class PipelineUse {
    plain, ///< a group of one rate
    inView ///< in a view that culls and has motion and attributes; it plays on the device
};

/// Everything a group of the cage needs, in a context of its own with an empty VkPipelineCache, then in another with
/// that cache filled, then in a third one that records a warm-up before its first frame. Then once more without a
/// cache, on all threads.
[[nodiscard]] Result<Pipelines> measurePipelines(host::Device& device, SuppleMapping mapping, const BenchCage& cage,
                                                 SuppleScheme scheme, PipelineUse use);

} // namespace supple::bench
