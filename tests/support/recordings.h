// Recordings that tests make, read and make again, and their hashes.
#pragma once

#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tools/replay/replayer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <vector>

namespace supple::test {

/// A recording that is kept in memory.
struct Recorded {
    std::vector<std::byte> bytes;
    uint32_t refusedAfter = UINT32_MAX; ///< writes

    [[nodiscard]] SuppleResult start(SuppleContext context, uint32_t flags = SUPPLE_RECORDING_HASHES);
};

/// By frame, group of the recording, stage and surface.
using HashKey = std::tuple<uint64_t, uint64_t, uint32_t, uint32_t>;
using Hashes = std::map<HashKey, std::array<uint32_t, 2>>;

/// What a recording says. What cannot be read is a failure.
struct ReadRecording {
    Hashes hashes;
    std::set<size_t> calls; ///< numbers of those that were made
    bool ended = false;
};
[[nodiscard]] ReadRecording read(std::span<const std::byte> recording);

/// What another context makes of the recording. What cannot be read is a failure, and so is a call that fails.
[[nodiscard]] Hashes replay(host::Device& device, std::span<const std::byte> recording,
                            tools::Replayer::Options options = {});

/// How many hashes of the recording the replay has; others are failures.
size_t expectSame(const Hashes& recorded, const Hashes& replayed);

/// The recording has ended and has at least so many hashes. Other contexts, one in each mapping, have all of them.
ReadRecording expectReplayed(const Recorded& recorded, size_t least,
                             std::span<const SuppleMapping> mappings = kMappings);
/// The same of one that goes on: it is stopped first.
ReadRecording expectReplayed(SuppleContext context, const Recorded& recorded, size_t least,
                             std::span<const SuppleMapping> mappings = kMappings);
/// The same of a host that runs frames: `run(first, last)`. Those before `begins` are not recorded.
void expectReplayedFrom(uint32_t begins, uint32_t ends, CrowdContext& context,
                        const std::function<void(uint32_t first, uint32_t last)>& run, size_t least);

} // namespace supple::test
