// Evaluation by classes of patches: what a vertex takes in either mapping and, where a scheme has that, with fan
// records in the place of coefficients (SUPPLE_CONTEXT_FAN_RECORDS). All ways of a class take turns in one process.
#pragma once

#include "tools/bench/rounds.h"
#include "tools/bench/workbench.h"

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace supple::bench {

struct KernelSubject {
    const char* patchClass = ""; ///< whose dispatch alone is measured; empty: all of the surface
    SuppleScheme scheme = SUPPLE_SCHEME_PREP;
    const char* cage = ""; ///< makeCage(), or "crowd": the crowd's character, which plays
};
/// What may decide whether fan records are taken comes first.
[[nodiscard]] std::span<const KernelSubject> kernelSubjects();

/// A context for each way of evaluation.
class KernelWays {
public:
    [[nodiscard]] static Result<KernelWays> create(host::Device& device);

    struct Way {
        std::string name;
        bool fanRecords = false;
        std::unique_ptr<Workbench> workbench;
    };
    [[nodiscard]] std::span<const Way> all() const { return ways_; }

private:
    std::vector<Way> ways_;
};

struct KernelsDesc {
    KernelSubject subject;
    uint32_t characters = 0; ///< fewer where memory is short
    uint32_t rate = 0;
    RoundOptions rounds;
};
/// A row: class, scheme, cage, rate, patches and vertices of the class, and ways. Each has the nanoseconds a vertex of
/// evaluation and, where all of a surface is measured, of a frame from pose or deformation to vertices (medians; on CPU
/// devices of processor time, else the device's), their ratios within a round to the first way, and the milliseconds
/// from creating the group to the end of its first frame. Fails if positions of two ways differ in a bit.
[[nodiscard]] Result<nlohmann::ordered_json> measureKernels(host::Device& device, const KernelWays& ways,
                                                            const KernelsDesc& desc);

struct LevelKernelsDesc {
    KernelSubject subject;
    uint32_t characters = 0;
    uint32_t frames = 0; ///< that are measured
};
/// The same in a view of levels: evaluation of all patches of the cage, by timestamps in frames that take turns.
[[nodiscard]] Result<nlohmann::ordered_json> measureLevelKernels(host::Device& device, const KernelWays& ways,
                                                                 const LevelKernelsDesc& desc);

} // namespace supple::bench
