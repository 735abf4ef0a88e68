// What the benchmark is run on: cages made on the spot, the demo character, which is embedded, and files.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "tools/bench/opensubdiv_peers.h"

#include <supple/supple.h>

#include <string>
#include <vector>

namespace supple::bench {

struct BenchCage {
    std::string name; ///< as --cages takes it
    cage::Character character;
    std::vector<SuppleScheme> schemes; ///< that it is measured under
    std::vector<PeerRules> peers;      ///< by which OpenSubdiv is measured on it too
    bool bothFormats = false;          ///< p-rep also with 24-byte vertices
};

/// Whether a cage is also measured as an indexed mesh of the scheme, which stores the samples that patches share once.
[[nodiscard]] bool sharesSamples(SuppleScheme scheme);

/// The names of the built-in ones.
[[nodiscard]] const std::vector<std::string>& builtInCages();
/// ErrorCode::io: man_casual_quads, a file that lies beside the source tree on some machines, is not there.
[[nodiscard]] Result<BenchCage> makeCage(const std::string& name);
/// From a file, called as the file without its folder and suffix.
[[nodiscard]] Result<BenchCage> readCage(const std::string& path);

} // namespace supple::bench
