// The classical path beside cage and surface: crowds of one character, drawn with the same number of triangles as a
// dense skinned mesh (scheme polygons) and as a surface over its cage.
#pragma once

#include "tools/bench/agreement.h"
#include "tools/bench/cages.h"
#include "tools/bench/rounds.h"
#include "tools/bench/workbench.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

struct ClassicalDesc {
    const BenchCage* cage = nullptr; ///< whose first clip is played
    uint32_t characters = 0;         ///< fewer where memory is short
    std::vector<uint32_t> rates;
    RoundOptions rounds;
    std::function<void(const std::string& what)> progress;
    /// Called for each rate whose mesh is too large for the device.
    std::function<void(const std::string& what, const std::string& reason)> leaveOut;
};

/// Whether a dense mesh can be made of it and moves: quads without holes, a clip.
[[nodiscard]] bool hasClassicalPath(const BenchCage& cage);

/// A row per rate: characters, triangles of one, and contestants with milliseconds of a frame from pose to vertices,
/// bytes loaded once, bytes a character, bytes of a file. Ratios to the dense mesh and to its skin alone, with the
/// least and largest of the rounds: of CPU time on CPU devices, else of device time.
[[nodiscard]] Result<nlohmann::ordered_json> measureClassical(host::Device& device, Workbench& workbench,
                                                              const ClassicalDesc& desc);

/// How far the dense mesh is from its surface, of the extent: rounding in the bind pose; in a clip what interpolated
/// weights make of it.
[[nodiscard]] Result<std::vector<Agreement>> compareClassical(host::Device& device, Workbench& workbench,
                                                              const BenchCage& cage);

} // namespace supple::bench
