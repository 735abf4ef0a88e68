// The file of a recording: chunks, one behind the other, each as long as a multiple of 8 bytes. Numbers are
// little-endian. A file that ends early, as after a crash, holds good up to its last whole chunk.
//
//   header   magic, version, and what the context was created with
//   asset    hash of a character, and the bytes of its cooked file, or none
//   call     number of the call, its arguments (runtime/recording/calls.h)
//   hashes   of a frame: what it has posed, deformed and evaluated (shaders/shared/word_hash.h)
//   end      the recording was stopped
#pragma once

#include "runtime/recording/calls.h"

#include <cstdint>

namespace supple::runtime {

inline constexpr char kRecordingMagic[] = {'S', 'U', 'P', 'P', 'R', 'E', 'C', '\n'};
inline constexpr uint32_t kRecordingVersion = 4, kOldestRecordingVersion = 2; ///< written; that can be read

enum class ChunkKind : uint32_t { header = 1, asset, call, hashes, end };

/// In front of each chunk's bytes.
struct ChunkHead {
    ChunkKind kind = ChunkKind::header;
    uint32_t bytes = 0; ///< without padding
};
static_assert(sizeof(ChunkHead) == 8);
inline constexpr size_t kChunkAlignment = 8;

/// What a context was created with, and where.
struct RecordedContext {
    uint32_t libraryVersion = 0; ///< SUPPLE_VERSION
    uint32_t contextFlags = 0;   ///< SuppleContextFlags
    uint32_t mapping = 0;        ///< SuppleMapping, never AUTO
    uint32_t framesInFlight = 0;
    uint32_t vendorId = 0, deviceId = 0, driverVersion = 0; ///< VkPhysicalDeviceProperties
    const char* deviceName = "";
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.libraryVersion, c.contextFlags, c.mapping, c.framesInFlight, c.vendorId, c.deviceId, c.driverVersion);
        a.text(c.deviceName);
    }
};

/// A stage of a frame whose words are hashed.
enum class HashedStage : uint32_t { palettes, cages, vertices };

/// Two sums over all words that a stage has written, of one surface if there are several.
struct StageHash {
    SuppleGroup group{};
    HashedStage stage = HashedStage::palettes;
    uint32_t surface = 0;
    uint32_t sums[2] = {};
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.group, c.stage, c.surface, c.sums);
    }
};
struct FrameHashes {
    uint64_t frame = 0;
    const StageHash* hashes = nullptr;
    uint32_t count = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.frame);
        a.list(c.hashes, c.count);
    }
};

} // namespace supple::runtime
