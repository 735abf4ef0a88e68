// The benchmark itself: what runs, in which heats, and the result as JSON (docs/benchmarks.md).
#pragma once

#include "base/result.h"
#include "tools/bench/cages.h"
#include "tools/common/machine.h"

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace supple::bench {

struct BenchOptions {
    std::vector<std::string> cages = builtInCages();
    std::vector<std::string> files;
    std::vector<std::string> schemes; ///< empty: all
    std::vector<uint32_t> rates = {4, 8, 16, 32};
    uint32_t rounds = 7;
    bool quick = false;   ///< shorter turns, fewer loads, of pipelines in views p-rep's alone
    bool loading = true;  ///< and pipelines
    uint32_t kernels = 0; ///< characters of which evaluation is measured by classes of patches; 0: it is not
    SuppleMapping mapping = SUPPLE_MAPPING_AUTO;
    /// Characters of the crowd, 0: no crowd. Left out: as many as the device is good for, where the sphere is measured.
    std::optional<uint32_t> crowd;
    /// The most characters of the scene, 0: no scene. Left out: kSceneCharacters (targets.h), where the sphere is
    /// measured.
    std::optional<uint32_t> scene;
    /// Is given the result so far after every measurement, "complete" being false: a failure later loses nothing.
    std::function<Status(const nlohmann::ordered_json&)> keep;
};

/// Before the first Vulkan call of the process: has drivers compile anew what an earlier run left in their own caches
/// on disk, as far as they can be told.
void disableDriverCaches();

/// Fails where contestants do not do the same job.
[[nodiscard]] Result<nlohmann::ordered_json> runBench(host::Device& device, const tools::Machine& machine,
                                                      const BenchOptions& options);

} // namespace supple::bench
