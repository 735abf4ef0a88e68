// Whether the contestants do the same job: compared once, before anything is timed.
#pragma once

#include "tools/bench/cages.h"
#include "tools/bench/opensubdiv_peers.h"
#include "tools/bench/workbench.h"

#include <span>
#include <string>
#include <vector>

namespace supple::bench {

struct Agreement {
    std::string what;
    double difference = 0.0; ///< the largest between two points or components; peers': of the cage's extent
    double bound = 0.0;
    [[nodiscard]] bool holds() const { return difference <= bound; }
};

/// Bicubic coefficients of the cage's p-rep patches, 64 floats each, as the device gathered them.
[[nodiscard]] Result<std::vector<float>> bicubicCoefficients(host::Device& device, Workbench& workbench,
                                                             const BenchCage& quads);

/// AVX2, the plain loop and the device's p-rep on `coefficients` of the sphere.
[[nodiscard]] Result<std::vector<Agreement>> compareEvaluations(host::Device& device, Workbench& workbench,
                                                                const BenchCage& sphere,
                                                                std::span<const float> coefficients);

/// OpenSubdiv's evaluators with each other and with the device's fragments or Loop. Empty if OpenSubdiv refuses the
/// cage.
[[nodiscard]] Result<std::vector<Agreement>> comparePeers(host::Device& device, Workbench& workbench,
                                                          const OpensubdivPeers& peers, const BenchCage& cage,
                                                          PeerRules rules);

} // namespace supple::bench
