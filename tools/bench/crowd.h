// A crowd on the device, from sampling its poses to its vertices, and one character; beside what the device's memory
// takes.
#pragma once

#include "tools/bench/agreement.h"
#include "tools/bench/rounds.h"
#include "tools/bench/workbench.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

struct CrowdDesc {
    uint32_t characters = 0; ///< fewer where memory is short
    std::vector<SuppleScheme> schemes;
    std::vector<uint32_t> rates; ///< of the crowd; the one character has rate 8
    RoundOptions rounds;
    std::function<void(const std::string& what)> progress;
};

/// Names of the character, its joints and influences, and rows: scheme, rate, characters, milliseconds of evaluation
/// and of a frame from pose to vertices, medians; for the crowd also GB/s of evaluation, of vkCmdFillBuffer and of a
/// shader that only stores, and evaluation's share of the faster of the two with the least and largest of the rounds.
[[nodiscard]] Result<nlohmann::ordered_json> measureCrowd(host::Device& device, Workbench& workbench,
                                                          const CrowdDesc& desc);

/// Whether a character in a crowd has the bits it has alone, and others than the first one.
[[nodiscard]] Result<std::vector<Agreement>> compareCrowd(host::Device& device, Workbench& workbench,
                                                          SuppleScheme scheme);

} // namespace supple::bench
