// Reads recordings, which may be anybody's (runtime/recording/format.h).
#pragma once

#include "base/result.h"
#include "runtime/recording/format.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace supple::runtime {

/// A character, and its cooked file unless the recording was made without.
struct RecordedAsset {
    calls::AssetHash hash;
    const char* name = "";
    const std::byte* bytes = nullptr; ///< null: only the hash is there
    uint32_t byteCount = 0;
    template <class A, class T>
    static void fields(A& a, T& c) {
        a(c.hash);
        a.text(c.name);
        a.list(c.bytes, c.byteCount);
    }
};
struct RecordingEnd {};

/// What a recording has next.
using RecordingEvent = std::variant<RecordedAsset, Call, FrameHashes, RecordingEnd>;

/// Calls tell(FrameHashes) for the hashes in bytes that are whole chunks, of this process's own recorder.
void forEachHashes(std::span<const std::byte> chunks, const std::function<void(const FrameHashes&)>& tell);

/// A part of a recording.
struct Chunk {
    ChunkKind kind = ChunkKind::end;
    std::span<const std::byte> bytes;
};

class RecordingReader {
public:
    /// Refuses what is no recording of this version. The bytes must outlive the reader. `name` begins every error.
    [[nodiscard]] static Result<RecordingReader> open(std::span<const std::byte> bytes, const std::string& name);

    /// Without the device's name.
    [[nodiscard]] const RecordedContext& context() const { return context_; }
    [[nodiscard]] const std::string& deviceName() const { return deviceName_; }
    /// The next event; null behind the last one. Its pointers are good until the next call.
    [[nodiscard]] Result<std::optional<RecordingEvent>> next();

private:
    RecordingReader(std::span<const std::byte> bytes, std::string name)
        : all_(bytes), left_(bytes), name_(std::move(name)), memory_(std::make_unique<CallMemory>()) {}
    [[nodiscard]] Error refused(const std::string& reason) const;
    [[nodiscard]] Result<std::optional<RecordingEvent>> read(const Chunk& chunk);

    std::span<const std::byte> all_, left_;
    std::string name_, deviceName_;
    RecordedContext context_;
    std::unique_ptr<CallMemory> memory_;
};

} // namespace supple::runtime
