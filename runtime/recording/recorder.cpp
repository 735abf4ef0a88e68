#include "runtime/recording/recorder.h"

#include "runtime/cooked/file.h"

#include <algorithm>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace supple::runtime {

namespace {

/// Bytes that there is room for at first.
constexpr size_t kRoom = size_t{256} << 10;

} // namespace

calls::AssetHash hashOfCharacter(std::span<const std::byte> cooked) {
    const XXH128_hash_t hash = XXH3_128bits(cooked.data(), cooked.size());
    return {hash.low64, hash.high64};
}

Recorder::Recorder(const SuppleRecordingDesc& desc, const RecordedContext& context) : desc_(desc) {
    bytes_.reserve(kRoom);
    write(ChunkKind::header, kRecordingMagic, kRecordingVersion, context);
}

size_t Recorder::open(ChunkKind kind) {
    const size_t first = bytes_.size();
    CallWriter writer(bytes_);
    writer(kind, uint32_t{0});
    return first;
}

void Recorder::close(size_t first) {
    const auto bytes = static_cast<uint32_t>(bytes_.size() - first - sizeof(ChunkHead));
    std::memcpy(bytes_.data() + first + offsetof(ChunkHead, bytes), &bytes, sizeof(bytes));
    bytes_.resize((bytes_.size() + kChunkAlignment - 1) / kChunkAlignment * kChunkAlignment);
}

calls::AssetHash Recorder::noteAsset(const Prepared& prepared) {
    const std::vector<std::byte> file = writeCookedCharacter(prepared);
    const calls::AssetHash hash = hashOfCharacter(file);
    const std::scoped_lock lock(mutex_);
    if (assets_.insert({hash.low, hash.high}).second) {
        // A file of more than 4 GiB is left out: a chunk has no room for it.
        const bool within = file.size() < UINT32_MAX - kRoom;
        const bool withBytes = within && (desc_.flags & SUPPLE_RECORDING_WITHOUT_ASSETS) == 0;
        const size_t first = open(ChunkKind::asset);
        CallWriter writer(bytes_);
        writer(hash);
        writer.text(prepared.character.name.c_str());
        writer.list(withBytes ? file.data() : nullptr, static_cast<uint32_t>(file.size()));
        close(first);
    }
    return hash;
}

void Recorder::noteBytes(std::span<const std::byte> call) {
    const std::scoped_lock lock(mutex_);
    const size_t first = open(ChunkKind::call);
    bytes_.insert(bytes_.end(), call.begin(), call.end());
    close(first);
}

void Recorder::note(const FrameHashes& hashes) {
    const std::scoped_lock lock(mutex_);
    write(ChunkKind::hashes, hashes);
}

void Recorder::keepRoom() {
    if (bytes_.capacity() - bytes_.size() < kRoom / 2) {
        bytes_.reserve(2 * bytes_.size() + kRoom);
    }
}

Status Recorder::handOver() {
    if (bytes_.empty()) {
        return success();
    }
    const bool taken = desc_.write(bytes_.data(), bytes_.size(), desc_.user) != 0;
    bytes_.clear();
    if (bytes_.capacity() > 16 * kRoom) { // characters were in it
        bytes_.shrink_to_fit();
    }
    keepRoom();
    return taken ? success() : Error{ErrorCode::argument, "the host has not taken what was recorded"};
}

Status Recorder::flush() {
    const std::scoped_lock lock(mutex_);
    return handOver();
}

Status Recorder::finish() {
    const std::scoped_lock lock(mutex_);
    write(ChunkKind::end);
    return handOver();
}

} // namespace supple::runtime
