// Recordings that tests make, read and make again, and their hashes.
#pragma once

#include "tests/support/crowd.h"
#include "tools/replay/replayer.h"

#include <array>
#include <cstdint>
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

/// What another context makes of the recording. A call that fails is a failure.
[[nodiscard]] Hashes replay(host::Device& device, std::span<const std::byte> recording,
                            tools::Replayer::Options options = {});

/// How many hashes of the recording the replay has; others are failures.
size_t expectSame(const Hashes& recorded, const Hashes& replayed);

} // namespace supple::test
