// Writes what a host does to a context: suppleStartRecording. Any threads may note calls at the same time.
#pragma once

#include "base/result.h"
#include "runtime/prepared.h"
#include "runtime/recording/format.h"
#include "supple/supple_recording.h"

#include <cstddef>
#include <mutex>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace supple::runtime {

/// What names a character in a recording, by its cooked file without anything that was prepared for groups.
[[nodiscard]] calls::AssetHash hashOfCharacter(std::span<const std::byte> cooked);

class Recorder {
public:
    /// Begins with the header.
    Recorder(const SuppleRecordingDesc& desc, const RecordedContext& context);

    template <class C>
    void note(const C& call) {
        const std::scoped_lock lock(mutex_);
        write(ChunkKind::call, kCallNumber<C>, call);
        if constexpr (!std::is_same_v<C, calls::Record>) {
            keepRoom(); // suppleRecord finds it, so that it allocates nothing
        }
    }
    /// A call whose number and arguments are written already.
    void noteBytes(std::span<const std::byte> call);
    /// Sees to it that the recording has the character; its hash.
    [[nodiscard]] calls::AssetHash noteAsset(const Prepared& prepared);
    void note(const FrameHashes& hashes);
    /// Hands over to the host what there is. An error if the host does not take it: then there is no point in going on.
    [[nodiscard]] Status flush();
    /// The same, behind the chunk that ends the file.
    [[nodiscard]] Status finish();

    [[nodiscard]] bool hasHashes() const { return (desc_.flags & SUPPLE_RECORDING_HASHES) != 0; }
    [[nodiscard]] bool hashesSurfacesIn(uint64_t frame) const {
        return desc_.surfaceInterval == 0 || frame % desc_.surfaceInterval == 0;
    }

private:
    template <class... T>
    void write(ChunkKind kind, const T&... values) {
        const size_t first = open(kind);
        CallWriter writer(bytes_);
        writer(values...);
        close(first);
    }
    /// Where the chunk begins, for close().
    [[nodiscard]] size_t open(ChunkKind kind);
    void close(size_t first);
    [[nodiscard]] Status handOver();
    void keepRoom();

    SuppleRecordingDesc desc_;
    std::mutex mutex_;
    std::vector<std::byte> bytes_; ///< that the host does not have yet
    std::set<std::pair<uint64_t, uint64_t>> assets_;
};

} // namespace supple::runtime
